"""The detector's bench counts as robots do."""

from __future__ import annotations

import subprocess
import sys


def test_it_counts_with_the_one_thread_that_a_robot_has() -> None:
    """The library reads how many once, when numpy is loaded."""
    asked = "import sys, os, bench; print(os.environ.get('OPENBLAS_NUM_THREADS'), 'numpy' in sys.modules)"
    told = subprocess.run(
        [sys.executable, "-c", asked], capture_output=True, text=True, check=True, env={"PATH": ""}
    )
    assert told.stdout.split() == ["1", "False"]
