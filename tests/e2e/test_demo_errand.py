"""The demo's second story, as far as its delivery is ordered."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]


def test_the_second_story_makes_places_and_orders_a_delivery(tmp_path):
    command = [sys.executable, "-m", "examples.demo", "--story", "errand", "--out", str(tmp_path)]
    done = subprocess.run(
        [*command, "--until", "ordered", "--drawn", "20"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "Traceback" not in done.stderr
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert [step["name"] for step in summary["steps"]] == ["fenced", "place-made", "place-here", "ordered"]
