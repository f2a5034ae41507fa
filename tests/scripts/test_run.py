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
