"""The library of visible tags ends no process when one of its detectors is done with."""

from __future__ import annotations

import os
import subprocess
import sys

from robotside.perception.tag_reader import TagReader
from tests.lacking import lacking

MADE_AND_FREED = """
import numpy as np
from robotside.perception.tag_reader import detector
from sim.world.tag_pattern import cells
picture = np.pad(np.kron(np.array(cells(1)), np.ones((12, 12))), 24, constant_values=1)
grey = (picture * 220 + 20).astype(np.uint8)
for _ in range(20):
    made = detector()
    assert len(made.detect(grey)) == 1
    del made
    taken = [bytearray(b"\\xff" * size) for size in (16, 24, 32, 48, 64, 96, 128, 600, 4000) * 20]
print("whole")
"""


def test_a_detector_that_is_freed_touches_nothing_that_was_freed_before() -> None:
    """What is freed is overwritten at once here, so that whoever still reads it fails."""
    if not TagReader().able:
        lacking("pupil_apriltags")
    environment = {**os.environ, "MALLOC_PERTURB_": "90", "MALLOC_CHECK_": "3"}
    run = subprocess.run(
        [sys.executable, "-c", MADE_AND_FREED], capture_output=True, text=True, env=environment, check=False
    )
    assert (run.returncode, run.stdout) == (0, "whole\n"), run.stderr[-500:]
