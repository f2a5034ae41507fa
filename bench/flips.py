"""Six hundred copies of a used robot's database, each damaged in another way, and a start on each of them.

Bits, bytes, sectors, swapped pages, cut files and letters that are none, the same ones in each run. A start counts when
the records are open, whatever of them came from the backup.
"""

from __future__ import annotations

import asyncio
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from bench.support.figures import Figure, percentile
from bench.support.flips import damaged_copies, reopen, use
from bench.support.harness import Context, Sides

FIGURES = (
    Figure("copies", "", "damaged databases"),
    Figure("failed", "", "of them on which the robot side did not start", target=0),
    Figure("mended", "", "of them set aside, and a backup put in their place"),
    Figure("start_p50", "ms", "to open one, median"),
    Figure("start_p99", "ms", "to open one, 99 of 100"),
)
REPEATS = 1


@contextmanager
def prepare(context: Context) -> Iterator[Sides]:
    """A fresh directory."""
    with tempfile.TemporaryDirectory() as folder:
        yield Sides(lambda: _starts(Path(folder), int(context.count("flips"))), None)


def _starts(folder: Path, copies: int) -> dict[str, float]:
    used = asyncio.run(use(folder / "used")).parent
    took, failed, mended = list[float](), 0, 0
    for seed, way, state in damaged_copies(used, folder / "copies", range(copies)):
        begun = time.perf_counter()
        try:
            with reopen(state) as records:
                took.append(time.perf_counter() - begun)
                mended += any("was put in its place" in problem for problem in records.problems)
        except Exception as error:  # noqa: BLE001 - any is a start that failed
            print(f"  copy {seed} ({way}): {error!r}")
            failed += 1
    return {
        "copies": copies,
        "failed": failed,
        "mended": mended,
        "start_p50": percentile(took, 0.5) * 1e3,
        "start_p99": percentile(took, 0.99) * 1e3,
    }
