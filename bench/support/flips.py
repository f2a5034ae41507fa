"""The database of a used robot, and copies of it that are damaged in the ways that disks and power cuts do."""

from __future__ import annotations

import asyncio
import random
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from bridge.msgs.pilothouse_msgs import Event, Mission, Place, ScheduledTask, TaskOrder, TaskRun, Waypoint
from bridge.msgs.std_msgs import Time
from robotside.records import Records
from robotside.records.database.files import DatabaseFiles
from robotside.records.opening import open_records

__all__ = ["damage", "damaged_copies", "reopen", "use"]

NOW = Time(1_795_279_047, 123_456_789)
EVENTS = 120
PAGE, SECTOR = 4096, 512
"""Of a database and of a disk [bytes]."""
LETTERS = range(32, 127)
WAYS = ("bit", "byte", "bytes", "zeros", "noise", "swapped", "cut", "text")


async def use(state: Path) -> Path:
    """Have a robot used, with a backup in between; returns its database."""
    records = open_records(state, None, asyncio.get_running_loop().call_soon_threadsafe)
    order = TaskOrder(task="patrol", goals=[Waypoint(1.0, 2.0)], speed=0.4)
    with records.together() as job:
        for number in range(40):
            records.places.set(Place(name=f"Office {number} 🚪", x=float(number), note="Klopfen!"))
            records.missions.set(Mission(stamp=NOW, waypoints=[Waypoint(1.5, 2.5)], name=f"Night {number}"))
        records.set_setting("follow_link", "off")
        records.schedule.set(ScheduledTask(order=order, every=60.0, next=NOW))
        records.queue.add(order)
        for _ in range(20):
            run = records.runs.begin(TaskRun(order=order, started=NOW, state="RUNNING", by="Anna"), "")
        records.runs.note(run, '{"lap": 3}')
        for number in range(EVENTS):
            said = f"Überfahrt {number} über die Brücke, at the door of the office. " * 3
            records.events.add(Event(stamp=NOW, level="warn", kind="task", text=said), lambda _: None)
        records.note_stop("Anna")
    assert await job.kept(10.0) == ""
    records.close()
    path = state / "records.sqlite3"
    DatabaseFiles(path).back_up()
    return path


def damage(path: Path, seed: int) -> str:
    """Damage a file in one of the `WAYS`, the same for each seed; returns which."""
    chance, way = random.Random(seed), WAYS[seed % len(WAYS)]
    content = bytearray(path.read_bytes())
    where = chance.randrange(len(content))
    match way:
        case "bit":
            content[where] ^= 1 << chance.randrange(8)
        case "byte":
            header = chance.randrange(100)
            content[header if chance.random() < 0.5 else where] = chance.randrange(256)
        case "bytes":
            for _ in range(chance.choice((3, 30, 300))):
                content[chance.randrange(len(content))] = chance.randrange(256)
        case "swapped":
            one, other = (
                slice(at * PAGE, (at + 1) * PAGE) for at in chance.sample(range(len(content) // PAGE), 2)
            )
            content[one], content[other] = content[other], content[one]
        case "cut":
            del content[where:]
        case "text":
            letters = [number for number, byte in enumerate(content) if byte in LETTERS]
            for number in chance.sample(letters, 5):
                content[number] = chance.choice(b"1\xc3\xff")
        case _:
            _overwrite(content, where, chance, empty=way == "zeros")
    path.write_bytes(content)
    return way


def _overwrite(content: bytearray, where: int, chance: random.Random, *, empty: bool) -> None:
    """Overwrite some sectors from that at `where` on."""
    begin = where // SECTOR * SECTOR
    end = min(begin + SECTOR * chance.choice((1, 8, 16)), len(content))
    content[begin:end] = bytes(end - begin) if empty else chance.randbytes(end - begin)


@contextmanager
def reopen(state: Path) -> Iterator[Records]:
    """The records in `state`, as a start opens them."""
    records = open_records(state, None, lambda *_: None, patience=0.2)
    try:
        yield records
    finally:
        records.close()


def damaged_copies(used: Path, folder: Path, seeds: range) -> Iterator[tuple[int, str, Path]]:
    """Of the state directory `used` copies with a damaged database, each gone with the next: seed, way, directory."""
    for seed in seeds:
        state = folder / f"{seed}"
        shutil.copytree(used, state)
        yield seed, damage(state / "records.sqlite3", seed), state
        shutil.rmtree(state)
