"""Two hundred times `kill -9` of the whole robot side while four clients make it write, each time at a random instant.

The process is the one that users start; its records are in a SQLite file on this machine's disk. After each kill it is
started again, and everything that was ever acknowledged is looked for: places, their changes and deletions, the mission,
events that were heard and their acknowledgements, and STOP; then SQLite checks the file. One round in seven kills it while it
opens the database. Anything that is missing counts as lost.

The delay is measured in this process: a place that is changed, from the call to its commit, with a thousand kept.
"""

from __future__ import annotations

import asyncio
import random
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from bench.support.crash import Ledger, crash, find_losses
from bench.support.figures import Figure, percentile
from bench.support.harness import Context, Sides
from bridge.msgs.pilothouse_msgs import Place
from robotside.records.opening import open_records

CHANGES = 500
FIGURES = (
    Figure("kills", "", "how often it was killed"),
    Figure("stops", "", "STOPs that were acknowledged as kept before"),
    Figure("acknowledged", "", "changes that were acknowledged before"),
    Figure("lost", "", "of them lost, or the database not whole", target=0),
    Figure("commit_p50", "ms", "from a change to its commit, median"),
    Figure("commit_p99", "ms", "from a change to its commit, 99 of 100"),
    Figure("blocked_p99", "ms", "of it in the serving loop, 99 of 100"),
)
REPEATS = 1


@contextmanager
def prepare(context: Context) -> Iterator[Sides]:
    """A fresh directory for both."""
    with tempfile.TemporaryDirectory() as folder:
        yield Sides(
            lambda: (
                asyncio.run(_kills(Path(folder), int(context.count("kills"))))
                | asyncio.run(_delays(Path(folder) / "delays"))
            ),
            None,
        )


async def _kills(folder: Path, kills: int) -> dict[str, float]:
    ledger, rng, lost = Ledger(), random.Random(9), list[str]()
    for _ in range(kills):
        lost += (await crash(folder / "state", ledger, rng)).lost
    lost += await find_losses(folder / "state", ledger)
    for each in lost:
        print(f"  {each}")
    return {"kills": kills, "stops": ledger.stops, "acknowledged": ledger.sure, "lost": len(lost)}


async def _delays(state: Path) -> dict[str, float]:
    records = open_records(state, None, asyncio.get_running_loop().call_soon_threadsafe)
    whole, blocked = [], []
    try:
        for number in range(1000):
            with records.together() as job:
                records.places.set(Place(name=f"Place {number}"))
            await job.kept(10.0)
        for number in range(CHANGES):
            begun = time.perf_counter()
            with records.together() as job:
                records.places.set(Place(id=number + 1, name=f"Place {number}", x=1.0))
            blocked.append(time.perf_counter() - begun)
            problem = await job.kept(10.0)
            whole.append(time.perf_counter() - begun)
            if problem:
                raise RuntimeError(problem)
    finally:
        records.close()
    return {
        "commit_p50": percentile(whole, 0.5) * 1e3,
        "commit_p99": percentile(whole, 0.99) * 1e3,
        "blocked_p99": percentile(blocked, 0.99) * 1e3,
    }
