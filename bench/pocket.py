"""What the app asks of a battery: wake-ups, frames and bytes a second on the drive screen, on the mission screen, and in a pocket.

The app is the real one, off screen on a phone's glass, beside a robot side in a process of its own; nobody touches it. It is put away
by the event that SDL sends when the activity is paused. A wake-up is a turn in which a thread of the app had given the processor back
and got it again (`voluntary_ctxt_switches` of each thread). In the pocket those of the thread that stands within SDL are left out: a
phone's SDL waits there for Java, a computer's asks the time a thousand times a second. Bytes are all that passes over loopback, headers
included, in both directions, so that nothing else may use it meanwhile. The other way in the pocket is an app that leaves its screen as
it is: what the mission screen costs.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import psutil

from bench.support.figures import Figure
from bench.support.harness import Context, Sides
from bench.support.pair import PHONE, SETTLING, Pair, pair

LEFT_ON = "the mission screen left on"
FIGURES = (
    Figure("drive_wakes", "1/s", "wake-ups, drive screen with its camera"),
    Figure("drive_frames", "1/s", "frames drawn, drive screen"),
    Figure("drive_bytes", "kB/s", "over the link, drive screen"),
    Figure("drive_process", "% of a core", "the whole process, drive screen, software GL included"),
    Figure("mission_wakes", "1/s", "wake-ups, mission screen"),
    Figure("mission_frames", "1/s", "frames drawn, mission screen"),
    Figure("mission_bytes", "kB/s", "over the link, mission screen"),
    Figure("mission_process", "% of a core", "the whole process, mission screen, software GL included"),
    Figure("pocket_wakes", "1/s", "wake-ups in a pocket", target=1, against=LEFT_ON, share=0.01),
    Figure("pocket_frames", "1/s", "frames drawn in a pocket", target=0, against=LEFT_ON),
    Figure(
        "pocket_connections",
        "",
        "open connections in a pocket: without one nothing passes",
        target=0,
        against=LEFT_ON,
    ),
)
REPEATS = 3
WATCHED = 10.0
"""[s]"""
CLOSING = 2.0
"""After it was put away: the link is closed, the settings are written [s]."""


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """What the mission screen cost is what the pocket is held against: one run gives both."""
    left_on: dict[str, float] = {}

    def ours() -> dict[str, float]:
        seen = sample()
        left_on.update({f"pocket_{what}": seen[f"mission_{what}"] for what in ("wakes", "frames")})
        left_on["pocket_connections"] = seen.pop("mission_connections")
        return seen

    yield Sides(ours, lambda: dict(left_on))


def sample() -> dict[str, float]:
    """One sample of every figure; RuntimeError when a widget stays dark."""
    with pair("--size", PHONE) as both:
        connected = both.ask("connect", url=both.url)
        if connected["waiting"]:
            raise RuntimeError(f"Not live: {', '.join(connected['waiting'])}.")
        found = {}
        for screen in ("drive", "mission"):
            both.ask("show", screen=screen)
            both.ask("watch", seconds=SETTLING)
            found |= {f"{screen}_{what}": value for what, value in watched(both).items()}
        found["mission_connections"] = connections(both.process)
        both.ask("put_away")
        time.sleep(CLOSING)
        found |= {f"pocket_{what}": value for what, value in unwatched(both).items()}
        return found


def watched(both: Pair) -> dict[str, float]:
    """On the glass."""
    wakes, carried = wake_ups(both.process, all_of_it=True), loopback()
    seen, began = both.ask("watch", seconds=WATCHED), time.monotonic() - WATCHED
    lasted = time.monotonic() - began
    return {
        "wakes": (wake_ups(both.process, all_of_it=True) - wakes) / lasted,
        "frames": seen["frames"],
        "bytes": (loopback() - carried) / lasted / 1e3,
        "process": seen["process"] * 100,
    }


def unwatched(both: Pair) -> dict[str, float]:
    """In the pocket, where the app cannot be asked anything: its frames are counted by itself, and read by another thread of it."""
    frames = both.ask("drawn")["frames"]
    wakes = wake_ups(both.process)
    time.sleep(WATCHED)
    return {
        "wakes": (wake_ups(both.process) - wakes) / WATCHED,
        "frames": (both.ask("drawn")["frames"] - frames) / WATCHED,
        "connections": connections(both.process),
    }


def wake_ups(process: psutil.Process, *, all_of_it: bool = False) -> int:
    """How often its threads came back to the processor so far; without `all_of_it` those of the first thread are left out."""
    total = 0
    for task in Path(f"/proc/{process.pid}/task").iterdir():
        if all_of_it or task.name != str(process.pid):
            line = next(
                one for one in (task / "status").read_text().splitlines() if one.startswith("voluntary")
            )
            total += int(line.split()[1])
    return total


def connections(process: psutil.Process) -> int:
    """Over which it could send or be sent anything, beside those that only wait to be forgotten."""
    return sum(
        1 for one in process.net_connections("inet") if one.status not in {"TIME_WAIT", "NONE", "CLOSE"}
    )


def loopback() -> int:
    """Bytes that passed over it so far."""
    return int(psutil.net_io_counters(pernic=True)["lo"].bytes_recv)
