"""A robot side that patrols for hours with honest clients of every kind: what it holds, every ten seconds.

`python -m bench soak --hours 8`; Ctrl-C or SIGTERM ends it with what there is. The robot side is the one that users start, with the
simulated patrol robot; its clients (`bench/support/soak/visitors.py`) are ours, roslibpy, browsers that read the camera and pages, three that
come and go for ever, one that reads slowly, and the patrol is ordered again whenever it has ended. Samples go to
`out/bench/soak.csv` as they are taken, the curves to `out/bench/soak.png` every five minutes.

Whether something grows is told by the slope of a straight line through twelve stretches of the run without its first half
hour (of a shorter run without its first half);
certain is as much of it as is above twice its standard error.
"""

from __future__ import annotations

import csv
import json
import math
import signal
import statistics
import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any

import httpx
import psutil

from bench.support.child import Child, child
from bench.support.figures import Figure, percentile
from bench.support.harness import Context, Sides
from bench.support.soak.trend import trend
from bench.support.station import Serving, patrol, serving
from bridge.core.errors import BridgeError
from scripts.plots import BLUE, Plot, Series, page

__all__ = ["Row", "figures", "soak"]

FIGURES = (
    Figure("hours", "h", "so long it ran", better="more"),
    Figure("samples", "", "samples"),
    Figure("memory_first", "MB", "resident, median of the first tenth"),
    Figure("memory_last", "MB", "resident, median of the last tenth"),
    Figure("memory_slope", "MB/h", "slope of the resident memory once warm"),
    Figure("memory_doubt", "MB/h", "its standard error"),
    Figure("memory_grows", "MB/h", "growth of the resident memory that is certain", 1.0),
    Figure("blocks_grows", "1/h", "growth of Python's blocks of memory that is certain"),
    Figure("fds_grows", "1/h", "growth of open files and sockets that is certain", 0.5),
    Figure("threads_grows", "1/h", "growth of threads that is certain", 0.5),
    Figure("tasks_grows", "1/h", "growth of tasks of the loop that is certain", 0.5),
    Figure("cpu", "% of a core", "CPU, median"),
    Figure("gap", "ms", "longest time without a /pose at an honest client"),
    Figure("gap_p99", "ms", "the longest of ten seconds, 99 of 100"),
    Figure("visits", "", "times that a flaky client came and went"),
    Figure("faults", "", "faults that the clients saw", 0),
    Figure("tracebacks", "", "tracebacks in the robot's log", 0),
)
REPEATS = 1

OUT = Path(__file__).parents[1] / "out" / "bench"
SAMPLE_PERIOD = 10.0
"""[s]"""
DRAW_PERIOD = 300.0
"""[s]"""
ORDER_PERIOD = 60.0
"""Between two looks whether it still patrols [s]."""
WARM_TIME = 1800.0
"""Left out of slopes, but no more than half of the run [s]: some 29 min lie between two full rounds of Python's collector, and before the
first one is over the memory has not been as full as it gets."""

Row = dict[str, float]
"""One sample."""
CURVES = (
    ("memory", "resident memory", "MB"),
    ("blocks", "Python's blocks of memory", "thousands"),
    ("fds", "open files and sockets", ""),
    ("threads", "threads", ""),
    ("tasks", "tasks of the loop", ""),
    ("cpu", "CPU", "% of a core"),
    ("gap", "longest gap of /pose", "ms"),
    ("pictures", "pictures of the camera to a browser", "1/s"),
)


@contextmanager
def prepare(context: Context) -> Iterator[Sides]:
    """Nothing is kept but the samples."""
    yield Sides(lambda: soak(context.count("hours") * 3600.0, OUT))


def soak(seconds: float, out: Path, period: float = SAMPLE_PERIOD) -> dict[str, float]:
    """Let a robot side serve for so long, or until Ctrl-C; writes soak.csv and soak.png into the folder `out`."""
    out.mkdir(parents=True, exist_ok=True)
    rows: list[Row] = []
    faults: list[str] = []
    with ExitStack() as stack:
        log = stack.enter_context((out / "soak.log").open("w+"))
        robot = stack.enter_context(serving("bench.support.soak.counted", log=log, own_session=True))
        visitors = stack.enter_context(
            child("bench.support.soak.visitors", robot.url, robot.site, own_session=True)
        )
        visitors.receive()
        with suppress(KeyboardInterrupt), _ended_by_either():
            for row in _samples(robot, visitors, seconds, period, faults):
                rows.append(row)
                _write(out, rows)
        log.flush()
        log.seek(0)
        tracebacks = log.read().count("Traceback (most recent call last)")
    if rows:
        draw(rows, out / "soak.png")
    for fault in faults[-20:]:
        print(f"  {fault}")
    return figures(rows) | {"faults": float(len(faults)), "tracebacks": float(tracebacks)}


@contextmanager
def _ended_by_either() -> Iterator[None]:
    """SIGTERM ends it as Ctrl-C does, and Ctrl-C also where a shell has it ignored in the background."""
    before = {
        each: signal.signal(each, signal.default_int_handler) for each in (signal.SIGINT, signal.SIGTERM)
    }
    try:
        yield
    finally:
        for each, handler in before.items():
            signal.signal(each, handler)


def _samples(
    robot: Serving, visitors: Child, seconds: float, period: float, faults: list[str]
) -> Iterator[Row]:
    process = psutil.Process(robot.child.process.pid)
    counts: dict[str, float] = {"tasks": math.nan, "blocks": math.nan, "late": math.nan}
    threading.Thread(target=_follow, args=(robot.child, counts), daemon=True).start()
    visitors.ask({})
    began, ordered, cpu, due = time.monotonic(), -math.inf, robot.cpu(), time.monotonic()
    while (now := time.monotonic()) - began < seconds:
        if now - ordered >= ORDER_PERIOD:
            ordered = now
            _keep_patrolling(robot, faults)
        due += period
        time.sleep(max(0.0, due - time.monotonic()))
        if robot.child.process.poll() is not None:
            raise RuntimeError(f"The robot side ended with {robot.child.process.returncode}.")
        seen = visitors.ask({})
        faults += seen["faults"]
        spent, cpu = robot.cpu() - cpu, robot.cpu()
        yield _row(process, time.monotonic() - began, spent / period, counts, seen, period)


def _follow(robot: Child, counts: dict[str, float]) -> None:
    """Take in what the robot side says of itself until it ends."""
    with suppress(RuntimeError, ValueError):
        while True:
            counts.update(robot.receive())


def _keep_patrolling(robot: Serving, faults: list[str]) -> None:
    try:
        status = httpx.get(f"{robot.site}/healthz", timeout=10.0).json()
        if status["state"] != "RUNNING":
            patrol(robot.url)
    except (httpx.HTTPError, BridgeError) as fault:
        faults.append(f"patrol: {fault!r}")


def _row(
    process: psutil.Process,
    at: float,
    cpu: float,
    counts: Mapping[str, float],
    seen: Mapping[str, Any],
    period: float,
) -> Row:
    return {
        "seconds": round(at, 1),
        "memory": process.memory_info().rss / 1e6,
        "blocks": counts["blocks"] / 1000,
        "fds": process.num_fds(),
        "threads": process.num_threads(),
        "tasks": counts["tasks"],
        "late": counts["late"] * 1e3,
        "cpu": cpu * 100,
        "gap": seen["gap"] * 1e3,
        "poses": seen["poses"] / period,
        "their_poses": seen["their_poses"] / period,
        "pictures": seen["pictures"] / period,
        "pages": seen["pages"],
        "visits": seen["visits"],
        "slow": seen["slow"],
    }


def _write(out: Path, rows: Sequence[Row]) -> None:
    """Add the last row to the file; draw from time to time."""
    with (out / "soak.csv").open("w" if len(rows) == 1 else "a", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        if len(rows) == 1:
            writer.writeheader()
        writer.writerow(rows[-1])
    if len(rows) > 1 and int(rows[-1]["seconds"] / DRAW_PERIOD) > int(rows[-2]["seconds"] / DRAW_PERIOD):
        draw(rows, out / "soak.png")


def draw(rows: Sequence[Row], path: Path) -> None:
    """The curves in one picture."""
    plots = []
    for name, title, unit in CURVES:
        points = [(row["seconds"] / 3600, row[name]) for row in rows if not math.isnan(row[name])]
        if points:
            plots.append(Plot(title, "hours", unit, [Series("", points, BLUE)]))
    page(plots, path)


def figures(rows: Sequence[Row]) -> dict[str, float]:
    """The figures of a run; NaN for slopes of too short a one."""
    if not rows:
        return {}
    tenth = max(1, len(rows) // 10)
    warm = [row for row in rows if row["seconds"] > WARM_TIME]
    warm = warm if len(warm) >= len(rows) / 2 else rows[len(rows) // 2 :]
    hours = [row["seconds"] / 3600 for row in warm]
    memory = trend(hours, [row["memory"] for row in warm])
    return {
        "hours": rows[-1]["seconds"] / 3600,
        "samples": len(rows),
        "memory_first": statistics.median(row["memory"] for row in rows[:tenth]),
        "memory_last": statistics.median(row["memory"] for row in rows[-tenth:]),
        "memory_slope": memory.slope,
        "memory_doubt": memory.doubt,
        "memory_grows": memory.grows,
        **{
            f"{name}_grows": trend(hours, [row[name] for row in warm]).grows
            for name in ("blocks", "fds", "threads", "tasks")
        },
        "cpu": statistics.median(row["cpu"] for row in rows),
        "gap": max(row["gap"] for row in rows),
        "gap_p99": percentile([row["gap"] for row in rows], 0.99),
        "visits": sum(row["visits"] for row in rows),
    }


def again(path: Path) -> dict[str, float]:
    """The figures of the samples in a file."""
    with path.open(newline="") as file:
        return figures([{name: float(text) for name, text in row.items()} for row in csv.DictReader(file)])


if __name__ == "__main__":
    print(json.dumps(again(OUT / "soak.csv"), indent=1))
