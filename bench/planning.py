"""The longest step of the robot's loop while a map of 2000 x 2000 cells comes and ways are planned on it.

A loop at 60 Hz hands a new map in, and then has ways planned from corner to corner, for a robot that turns where it stands and
for one that has to steer. Ours gives both to the worker thread, as the robot side does; the other way does the same work in
the steps of the loop, a bounded bit of a search in each. A step counts from when it was due to its end, since a STOP that
arrives meanwhile waits for that: what the thread takes of the interpreter's lock is in it. The time until the map is used
and the way is there is measured as well.
"""

from __future__ import annotations

import gc
import math
import time
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager

import numpy as np

from bench.support.figures import Figure, percentile
from bench.support.harness import Context, Sides
from bridge.msgs.arrays import Int8Array
from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid
from robotside.autonomy.map_intake import MapIntake
from robotside.core.pose2 import Pose2
from robotside.core.worker import InLoopWorker, Worker
from robotside.core.worker_thread import WorkerThread
from robotside.limits.fence import Fence
from robotside.localisation.pose_estimator import PoseEstimator
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.navigator import Goal, LegState, Navigator
from sim.robot import make

IN_LOOP = "planned in the loop"
FIGURES = (
    Figure(
        "map_step", "ms", "longest step of the loop while the map is made ready", target=50, against=IN_LOOP
    ),
    Figure("map_ready", "s", "from its arrival to its use", against=IN_LOOP),
    *(
        Figure(f"{kind}_{name}", unit, f"{what}, {of}", target=target, against=IN_LOOP)
        for kind, of in (
            ("patrol", "of a robot that turns where it stands"),
            ("commander", "of one that steers and finds no way"),
        )
        for name, unit, what, target in (
            ("step", "ms", "longest step of the loop while a way is planned", 50.0),
            ("step_p99", "ms", "99 of 100 steps meanwhile", None),
            ("planned", "s", "until the way is there or there is none", None),
        )
    ),
)
REPEATS = 3

PERIOD = 1 / 60
"""Between two steps of the loop [s]."""
CELL, SIDE = 0.1, 2000
"""Of the map: a cell's edge [m], and cells along each side."""
MAX_TIME = 120.0
"""Nothing takes longer than this [s]."""


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """The same map for both."""
    msg = halls()

    def ours() -> dict[str, float]:
        with WorkerThread() as worker:
            return measured(msg, worker)

    yield Sides(ours, lambda: measured(msg, InLoopWorker()))


def halls() -> OccupancyGrid:
    """Long halls side by side with a few doors in each wall between them."""
    full = np.zeros((SIDE, SIDE), dtype=np.int8)
    for edge in (full[:4], full[-4:], full[:, :4], full[:, -4:]):
        edge[...] = 100
    doors = np.random.default_rng(1)
    for row in range(200, SIDE, 200):
        full[row : row + 4] = 100
        for door in doors.integers(50, SIDE - 150, 6):
            full[row : row + 4, door : door + 60] = 0
    info = MapMetaData(resolution=CELL, width=SIDE, height=SIDE)
    return OccupancyGrid(info=info, data=Int8Array(full.ravel()))


def measured(msg: OccupancyGrid, worker: Worker) -> dict[str, float]:
    """All figures with this worker."""
    found: dict[str, float] = {}
    far = (SIDE - 10) * CELL
    fence = Fence([[(1.0, 1.0), (far, 1.0), (far, far), (1.0, far)]], [])
    for kind in ("patrol", "commander"):
        with closing(make(kind, "parking_lot", camera=False)) as robot:
            navigator = Navigator(robot, Grid.unknown(), lambda _: None, worker)
            estimator = PoseEstimator(robot.info, _say, _say)
            intake = MapIntake(estimator, navigator, lambda grid: fence.marked(grid, 0.15), _say, worker)
            intake.on_map(msg)
            steps, took = stepped(_taking(intake))
            if kind == "patrol":
                found |= {"map_step": steps[-1] * 1e3, "map_ready": took}
            steps, took = stepped(_way(navigator))
            found |= {
                f"{kind}_step": steps[-1] * 1e3,
                f"{kind}_step_p99": percentile(steps, 0.99) * 1e3,
                f"{kind}_planned": took,
            }
    return found


def _say(*_: object, **__: object) -> None:
    """There is no one to hear it."""


def _taking(intake: MapIntake) -> Callable[[float], bool]:
    """A step that goes on with the map; True once it is used."""

    def step(_: float) -> bool:
        intake.update()
        return intake.has_map

    return step


def _way(navigator: Navigator) -> Callable[[float], bool]:
    """A step that plans from one corner to the other; True once that has ended."""
    corner, other = 100 * CELL, (SIDE - 100) * CELL
    pose, nothing = Pose2(corner, corner, math.pi / 4), np.empty((0, 2))
    navigator.head_for(Goal("The corner", other, other))

    def step(now: float) -> bool:
        leg = navigator.update(pose, nothing, now)
        return leg is LegState.BLOCKED or navigator.controller.under_way

    return step


def stepped(step: Callable[[float], bool]) -> tuple[list[float], float]:
    """Call `step` at 60 Hz until it is True: how long each took from when it was due, in order, and all together [s]."""
    gc.collect()
    gc.freeze()  # what else the bench holds is nothing that the robot's collector looks through
    steps: list[float] = []
    began = due = time.perf_counter()
    try:
        while time.perf_counter() < began + MAX_TIME:
            ended = step(due - began)
            steps.append(time.perf_counter() - due)
            if ended:
                return sorted(steps), time.perf_counter() - began
            due = max(due + PERIOD, time.perf_counter())
            time.sleep(max(0.0, due - time.perf_counter()))
    finally:
        gc.unfreeze()
    raise RuntimeError(f"Nothing was found in {MAX_TIME:.0f} s.")
