"""Pictures of intruders: kept with their events, bounded, over restarts, and erased with any name."""

from __future__ import annotations

import asyncio
from pathlib import Path

from robotside.records import Records
from robotside.records.crops import MAX_CROPS
from robotside.records.opening import open_records

PICTURE = b"\xff\xd8\xff\xe0 a picture"


def opened(state: Path) -> Records:
    return open_records(state, None, asyncio.get_running_loop().call_soon_threadsafe, patience=0.2)


async def test_a_picture_is_there_after_a_restart_until_somebody_is_erased(tmp_path: Path) -> None:
    records = opened(tmp_path)
    with records.together() as job:
        records.crops.keep(7, PICTURE)
        records.crops.keep(8, b"")
    assert await job.kept(10.0) == ""
    records.close()
    records = opened(tmp_path)
    assert (records.crops.of(7), records.crops.of(8)) == (PICTURE, b"")
    assert await records.erase("Ben").kept(10.0) == ""
    assert records.crops.of(7) == b"", "nobody can tell whom it shows"
    records.close()
    assert b"YSBwaWN0dXJl" not in (tmp_path / "records.sqlite3").read_bytes()


def test_the_newest_are_kept() -> None:
    records = Records.in_memory()
    for event in range(1, MAX_CROPS + 6):
        records.crops.keep(event, PICTURE)
    assert [bool(records.crops.of(event)) for event in (1, 5, 6, MAX_CROPS + 5)] == [False, False, True, True]
