"""The demo, as far as the mission is on the robot: the rest takes minutes of driving."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from mcap.reader import make_reader
from PIL import Image

ROOT = Path(__file__).parents[2]


def test_the_demo_finds_the_robot_and_sends_it_a_mission(tmp_path):
    command = [
        sys.executable,
        "-m",
        "examples.demo",
        "--out",
        str(tmp_path),
        "--until",
        "sent",
        "--drawn",
        "20",
    ]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False, timeout=120)
    summary = json.loads((tmp_path / "summary.json").read_text())
    # how fast it is depends on who else uses this machine: that is for the benchmarks to judge
    checks = [check for step in summary["steps"] for check in step["checks"]]
    slow = [check for check in checks if check["timed"] and not check["ok"]]
    assert len(summary["failures"]) == len(slow), done.stdout + done.stderr
    assert done.returncode == (1 if summary["failures"] else 0)
    assert [step["name"] for step in summary["steps"]][-1] == "sent"
    for step in summary["steps"]:
        with Image.open(tmp_path / step["picture"]) as picture:
            assert picture.size == (1280, 800)
            assert len(picture.getcolors(1 << 20)) > 100
    with (tmp_path / "run.mcap").open("rb") as recording:
        topics = {channel.topic for _, channel, _ in make_reader(recording).iter_messages()}
    assert {"/pose", "/scan", "/map", "/mission", "/control/status"} <= topics
