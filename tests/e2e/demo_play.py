"""A story of the demo, played as a user plays it, in a process of its own."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

__all__ = ["played"]

ROOT = Path(__file__).parents[2]
PATIENCE = 600.0
"""How long a story may take [s]; a fault, not a delay, uses it up."""
DRAWN = "20"
"""One frame in so many is drawn: that leaves the processor to what is tested."""


def played(folder: Path, *options: str) -> dict[str, Any]:
    """The summary of a story whose expectations held; pictures and the rest are in `folder`.

    How fast it is depends on who else uses this machine: that is for the benchmarks to judge, and alone may fail.
    """
    command = [sys.executable, "-m", "examples.demo", "--out", str(folder), "--drawn", DRAWN, *options]
    pipe = subprocess.PIPE
    process = subprocess.Popen(command, cwd=ROOT, stdout=pipe, stderr=pipe, text=True, start_new_session=True)
    try:
        said = "".join(process.communicate(timeout=PATIENCE))
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)  # and the robot side that it started
        said = "".join(process.communicate())
        pytest.fail(f"the story did not end within {PATIENCE:g} s; it said {said}")
    summary: dict[str, Any] = json.loads((folder / "summary.json").read_text())
    late = {
        f"{step['name']}: expected {check['expected']}, measured {check['measured']}"
        for step in summary["steps"]
        for check in step["checks"]
        if check["timed"] and not check["ok"]
    }
    assert set(summary["failures"]) == late, said
    assert process.returncode == (1 if late else 0)
    assert "Traceback" not in said
    return summary
