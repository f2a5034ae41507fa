"""`kill -9` of the real robot side while it writes: what was acknowledged is there. bench/database.py does it 200 times."""

from __future__ import annotations

import asyncio
import random
from pathlib import Path

import pytest

from bench.support.crash import Ledger, crash, find_losses

pytestmark = pytest.mark.slow


async def killed(state: Path, ledger: Ledger) -> list[str]:
    rng, lost = random.Random(3), list[str]()
    for early in (0.0, 1.0, 0.0):
        lost += (await crash(state, ledger, rng, early)).lost
    return lost + await find_losses(state, ledger)


def test_what_was_acknowledged_is_there_after_a_kill(tmp_path: Path) -> None:
    ledger = Ledger()
    assert asyncio.run(killed(tmp_path / "state", ledger)) == []
    assert ledger.sure > 0
    assert ledger.events
    assert ledger.stops > 0
