"""What `make run` does before the app opens."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_a_robot_that_does_not_exist_is_the_users_mistake_in_one_sentence():
    environment = {**os.environ, "DISPLAY": ":nowhere", "PYTHON": sys.executable, "ROBOT": "horse"}
    command = ["bash", "scripts/run.sh"]
    done = subprocess.run(
        command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False, timeout=60
    )
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("robotside: There is no simulated robot 'horse'; there is")
    assert done.stderr.count("\n") == 1


def test_the_app_opens_beside_all_robots_and_they_end_with_it(tmp_path):
    stand_in = tmp_path / "python"
    stand_in.write_text(
        f'#!/bin/sh\n[ "$1" = main.py ] && echo the app is open && exit\nexec {sys.executable} "$@"\n'
    )
    stand_in.chmod(0o755)
    own = {"PYTHON": str(stand_in), "ROBOT": "patrol,scout", "WORLD": "", "XDG_STATE_HOME": str(tmp_path)}
    environment = {**os.environ, "DISPLAY": ":nowhere", **own}
    command = ["bash", "scripts/run.sh"]
    done = subprocess.run(
        command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False, timeout=120
    )
    said = done.stdout.splitlines()
    assert [line.rpartition("=")[2] for line in said[:2]] == ["Patrol-1", "Scout-1"]
    assert (said[2:], done.stderr, done.returncode) == (["the app is open"], "", 0)
    kept = [folder.name for folder in sorted((tmp_path / "pilothouse").iterdir())]
    assert kept == ["sim-patrol-parking_lot", "sim-scout-parking_lot"]
