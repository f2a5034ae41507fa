"""Links that are cut at random instants while a robot drives, over all kinds of robots and of clients: 5,000 of them.

**Vehicles**, at full speed: each kind's robot side is a process of its own, driven by our client at 20 Hz over a real socket through a proxy that breaks
the connection by RST or passes nothing any more, while the driver goes on; later what still waited in the line is let
through. All kinds are driven at the same time. The time counts at the robot's port: from the moment that the last
command which it obeyed was given to the command to rest. Missed is a cut after which anything moved the robot later than
300 ms after it was given. Rest is by odometry, and what its brakes need from full speed is taken off.

The robots are the simulated ones, on open ground and in calm water: the patrol robot, the truck, the boat, the swimmer and
the drone, which is in the air, each at its full speed (`bench/support/kinds.py`). The other way is a server that hands every
twist on to the same robots and checks neither its age nor who is gone; these are watched for no longer than ours.

**Clients**, all the other cuts: 21 robots that weigh nothing, in three processes, are driven at the same time by our client with its stamps, by a plain
WebSocket without any, and by roslibpy. The stick is held on after the cut. A link ends by RST; or nothing passes any more and what waited comes late; or
the robot alone hears nothing; or nothing passes for 0.35 to 1.1 s, then all at once, while the stick is still held. A late motion is one
by a command that was given after the cut, or any after the robot had come to rest: a stick has to be heard at zero first.
"""

from __future__ import annotations

import asyncio
import json
import math
import random
import threading
from collections.abc import Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager

from bench.support.child import Child
from bench.support.cuts import Cut, Driver, Line, cut, naive, ours
from bench.support.figures import Figure, percentile
from bench.support.harness import Context, Sides
from bench.support.kinds import KINDS
from bench.support.many_cuts import ManyCut, many
from bench.support.station import serving

RELAY = "a relay without expiry"
VEHICLE_CUTS = 100
"""Of the cuts."""
MAX_TRIES = 3
"""A link on which the robot was not driven at all, since all came late on a busy computer, is no cut; as often it is tried."""
THEIRS = 50
"""The other way does it less often: every time comes to the same."""
CLIENT_NAMES = {
    "ours": "our client, stamped",
    "raw": "a plain WebSocket, no stamps",
    "roslibpy": "roslibpy, no stamps",
}
FIGURES = (
    Figure("cuts", "", "links that were cut"),
    *(
        figure
        for client, what in CLIENT_NAMES.items()
        for figure in (
            Figure(f"cuts_{client}", "", f"of them {what}"),
            Figure(f"late_{client}", "", f"{what}: late motions", 0.0),
            Figure(f"slow_{client}", "%", f"{what}: a command was in force for over 300 ms", 0.0),
            Figure(f"longest_{client}", "ms", f"{what}: the longest time that a command was in force", 300.0),
        )
    ),
    Figure(
        "missed",
        "%",
        "of the vehicles' moved the robot later than 300 ms after the command",
        0.0,
        against=RELAY,
    ),
    Figure(
        "reset_p50", "ms", "last valid command to zero at the robot, broken by RST, median", against=RELAY
    ),
    Figure("silent_p50", "ms", "the same, nothing passes any more, median", against=RELAY),
    Figure("worst", "ms", "the longest of all", 300.0, against=RELAY),
    Figure("late", "s", "at rest later than its brakes need, the longest of all"),
    *(
        Figure(f"way_{kind}", "m", f"{kind}: driven after the last valid command, median", against=RELAY)
        for kind in KINDS
    ),
)
REPEATS = 1


@contextmanager
def prepare(context: Context) -> Iterator[Sides]:
    """Nothing is kept."""
    count = int(context.count("cuts"))
    yield Sides(lambda: both(count), theirs)


def both(count: int) -> dict[str, float]:
    """Vehicles first, then clients of every kind."""
    vehicles = run(min(VEHICLE_CUTS, count), ours)
    found = many(max(0, count - VEHICLE_CUTS))
    for each in found:
        if each.late or each.slow:
            print(f"  {each}")
    named = {name: value for client in CLIENT_NAMES for name, value in of_client(found, client).items()}
    return {**vehicles, **named, "cuts": vehicles["cuts"] + len(found)}


def of_client(found: Sequence[ManyCut], client: str) -> dict[str, float]:
    """Its figures, of the links over which a robot was driven at all."""
    its = [each for each in found if each.client == client and each.obeyed]
    return {
        f"cuts_{client}": len(its),
        f"late_{client}": sum(each.late for each in its),
        f"slow_{client}": sum(each.slow for each in its) / max(1, len(its)) * 100,
        f"longest_{client}": max((each.longest for each in its), default=math.nan) * 1e3,
    }


def cuts(kinds: Iterable[str], count: int, driver: Driver, *flags: str) -> dict[str, list[Cut]]:
    """Cut `count` links of each of these kinds, of all of them at the same time."""
    with ExitStack() as stack:
        robots = {kind: stack.enter_context(robot(kind, *flags)) for kind in kinds}
        return asyncio.run(_all(robots, count, driver))


def run(count: int, driver: Driver, *flags: str) -> dict[str, float]:
    """Cut `count` links, as many of each kind."""
    found = cuts(KINDS, count // len(KINDS), driver, *flags)
    every = [each for its in found.values() for each in its]
    late = [
        each.rest - KINDS[kind].speed / KINDS[kind].braking for kind, its in found.items() for each in its
    ]
    ways = {f"way_{kind}": percentile([each.way for each in its], 0.5) for kind, its in found.items()}
    return {
        "cuts": len(every),
        "missed": sum(each.missed for each in every) / len(every) * 100,
        "reset_p50": percentile([each.zero for each in every if each.hard], 0.5) * 1e3,
        "silent_p50": percentile([each.zero for each in every if not each.hard], 0.5) * 1e3,
        "worst": max(each.longest for each in every) * 1e3,
        "late": max(late),
        **ways,
    }


def theirs() -> dict[str, float]:
    """Without what says nothing of robots that never rest."""
    found = run(THEIRS, naive, "--relay")
    return {name: value for name, value in found.items() if name not in ("cuts", "late")}


@contextmanager
def robot(kind: str, *flags: str) -> Iterator[tuple[int, list[Line]]]:
    """A robot side of that kind: its port on this machine, and the growing list of reports of the robot's own port."""
    told: list[Line] = []
    driven = KINDS[kind]
    options = ("--robot", f"sim:{driven.model}", "--world", driven.world)
    with serving("bench.support.port", *options, *flags) as serves:
        reader = threading.Thread(target=_listen, args=(serves.child, told), daemon=True)
        reader.start()
        yield int(serves.url.rsplit(":", 1)[1]), told
    reader.join(5.0)


def _listen(process: Child, told: list[Line]) -> None:
    lines = process.process.stdout or ()
    told.extend(json.loads(line) for line in lines if line.startswith("["))


async def _all(robots: dict[str, tuple[int, list[Line]]], count: int, driver: Driver) -> dict[str, list[Cut]]:
    async with asyncio.TaskGroup() as group:
        tasks = {
            kind: group.create_task(_each(kind, *where, count, driver)) for kind, where in robots.items()
        }
    return {kind: task.result() for kind, task in tasks.items()}


async def _each(kind: str, port: int, told: list[Line], count: int, driver: Driver) -> list[Cut]:
    rng, found = random.Random(f"cuts of {kind}"), list[Cut]()
    for _ in range(count * MAX_TRIES):
        if len(found) < count:
            each = await cut(port, told, KINDS[kind], driver, rng, 1.0 if len(found) % 2 else -1.0)
            found += [each] if each.obeyed else []
    if len(found) < count:
        raise RuntimeError(f"{kind}: it was driven only {len(found)} times of {count * MAX_TRIES}.")
    return found
