"""The robot's computer with the simulated patrol robot, laser and camera, and one handheld connected.

The share of a core is CPU time of the whole process (physics, drawing, JPEG, autonomy, sockets and the threads of
the software GL) over 20 s; the handheld is the app's own link with every subscription that it makes. The other way
takes the camera's pictures through the JSON topic and not through the binary socket; both draw alike, so that most of what
a patrol costs is in both, and the rows without the process that draws tell the ways apart. The patrol is the same station without
sockets and camera, on a clock that runs as fast as it can, until 100 m are driven. The longest update is CPU time, of a robot
that plans a way round an obstacle that it has just seen: while an update lasts, STOP is not processed. A step of the loop is CPU time of the loop's own thread over
10 s in real time, camera watched, pictures drawn beside it, without sockets.
"""

from __future__ import annotations

import random
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager

from app.link.feeds import Mailbox
from app.link.link import Link
from bench.support.figures import Figure, percentile
from bench.support.harness import Context, Sides
from bench.support.planning import DEEP, LAKE, SHALLOW, lake, longest, trap
from bench.support.station import ROUND, Serving, patrol, serving
from bridge.core.camera_frames import Frame
from bridge.core.network_thread import NetworkThread
from bridge.core.topics import CAMERA
from bridge.msgs.pilothouse_msgs import Mission, SetMissionRequest, StartTaskRequest, TaskProgress
from robotside.core.worker_thread import WorkerThread
from robotside.door.station_door import StationDoor
from robotside.records import Records
from robotside.station.station import Station
from sim.robot import make, make_several
from sim.vehicles.patrol import PARAMETERS

JSON = "pictures as base64 in JSON"
FIGURES = (
    Figure("standing", "% of a core", "the robot stands, camera watched", against=JSON, share=0.6),
    Figure("patrolling", "% of a core", "it patrols, camera watched", against=JSON, share=0.6),
    *(
        Figure(
            f"{what} undrawn",
            "% of a core",
            f"of it without the process that draws, while it {'stands' if what == 'standing' else 'patrols'}",
            against=JSON,
        )
        for what in ("standing", "patrolling")
    ),
    Figure("pictures", "1/s", "camera pictures that arrive meanwhile", better="more", against=JSON),
    Figure("patrol_speed", "×", "a patrol of 100 m over real time", target=100, better="more"),
    *(
        Figure(
            f"step {what}",
            "ms",
            f"a step of the loop, 99 of 100, it {'stands' if what == 'standing' else 'patrols'}",
            target=2,
        )
        for what in ("standing", "patrolling")
    ),
    *(
        Figure(
            f"update {kind} {where}",
            "ms",
            f"longest update while a {kind} looks for a way, {what}",
            target=50,
        )
        for kind, where, what in (
            ("minnow", "lake", "across the lake"),
            ("patrol", "hall", "out of a bend of walls 150 x 80 m large"),
            ("commander", "hall", "round its end"),
        )
    ),
    Figure("patrol_speed_cpu", "×", "the same over the CPU time that it takes", better="more"),
)
REPEATS = 2

STEPS_TIME = 10.0
"""Time over which the steps of the loop are measured [s]."""
WATCH_TIME = 20.0
"""Time over which the CPU time is measured [s]."""
PATROL_LENGTH = 100.0
"""Length of the patrol [m]."""
TICK = 1 / 60
"""Between two steps of the station [s], as when it serves."""


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept: each sample starts a robot side of its own."""
    yield Sides(
        lambda: {**share(PARAMETERS.camera.name), **fast(), **steps(), **updates()}, lambda: share("")
    )


def share(camera: str) -> dict[str, float]:
    """Shares of a core; `camera` is the stream to watch, empty for the JSON topic."""
    with serving() as robot, handheld(robot.url, camera) as pictures:
        time.sleep(2.0)
        standing = watched(robot)
        patrol(robot.url)
        time.sleep(3.0)
        before = len(pictures)
        patrolling = watched(robot)
        rate = (len(pictures) - before) / WATCH_TIME
    return {
        "standing undrawn": standing[0],
        "standing": standing[1],
        "patrolling undrawn": patrolling[0],
        "patrolling": patrolling[1],
        "pictures": rate,
    }


def watched(robot: Serving) -> tuple[float, float]:
    """Its share of a core over `WATCH_TIME` without the process that draws, and with it [%]."""
    began, own, cpu = time.monotonic(), robot.own_cpu(), robot.cpu()
    time.sleep(WATCH_TIME)
    own, cpu = robot.own_cpu() - own, robot.cpu() - cpu
    passed = time.monotonic() - began
    return own / passed * 100, cpu / passed * 100


@contextmanager
def handheld(url: str, camera: str) -> Iterator[list[float]]:
    """The app's link without the app; gives the list of when pictures came [s], which grows."""
    pictures: list[float] = []

    def show(_: Frame, received: float) -> None:
        pictures.append(received)

    with closing(NetworkThread()) as network:
        link = Link(
            url,
            Mailbox(lambda: None),
            network,
            client_id="bench",
            client_name="bench",
            on_picture=show,
        )
        link.start()
        link.watch(camera)
        try:
            yield pictures
        finally:
            link.close()


def fast() -> dict[str, float]:
    """A patrol as fast as this machine can."""
    robot = make("patrol", "parking_lot", camera=False)
    with closing(robot):
        clock = Clock()
        station = Station(robot, Records.in_memory(), now=0.0, clock=clock, rng=random.Random(0))
        driven = Odometer()
        station.bus.subscribe("/task/progress", driven)
        run(station, clock, 2.0)
        begin(station)
        began, wall, cpu = clock.now, time.monotonic(), time.process_time()
        while driven.metres < PATROL_LENGTH:
            run(station, clock, 1.0)
            if clock.now - began > 1000:
                raise RuntimeError(f"The patrol has come {driven.metres:.0f} m in 1000 s.")
        simulated = clock.now - began
        wall, cpu = time.monotonic() - wall, time.process_time() - cpu
    return {"patrol_speed": simulated / wall, "patrol_speed_cpu": simulated / cpu}


def steps() -> dict[str, float]:
    """CPU time of the loop's thread for one of its steps, 99 of 100 [ms]."""
    (robot,) = make_several(["patrol"], "parking_lot", draws_beside=True)
    with closing(robot), WorkerThread("planning") as worker, WorkerThread("looking") as looker:
        station = Station(
            robot,
            Records.in_memory(),
            now=time.monotonic(),
            clock=time.monotonic,
            rng=random.Random(0),
            worker=worker,
            looker=looker,
        )
        station.demand.set(CAMERA, "bench", True)
        paced(station, 4.0)
        found = {"step standing": percentile(paced(station, STEPS_TIME), 0.99) * 1e3}
        begin(station)
        paced(station, 3.0)
        found["step patrolling"] = percentile(paced(station, STEPS_TIME), 0.99) * 1e3
    return found


def paced(station: Station, seconds: float) -> list[float]:
    """CPU time of each step of so many seconds of real time [s]."""
    spent, due = [], time.monotonic()
    for _ in range(round(seconds / TICK)):
        due = max(due + TICK, time.monotonic() - TICK)
        time.sleep(max(0.0, due - time.monotonic()))
        began = time.thread_time()
        station.step(time.monotonic())
        spent.append(time.thread_time() - began)
    return spent


def updates() -> dict[str, float]:
    """The longest updates while a way is looked for [ms]."""
    hall = trap()
    found = {}
    for kind, where, grid, way in (
        ("minnow", "lake", lake(), LAKE),
        ("patrol", "hall", hall, DEEP),
        ("commander", "hall", hall, SHALLOW),
    ):
        with closing(make(kind, "lake" if where == "lake" else "parking_lot", camera=False)) as robot:
            found[f"update {kind} {where}"] = longest(robot, grid, way) * 1e3
    return found


class Clock:
    """A clock that is set by hand."""

    now = 0.0

    def __call__(self) -> float:
        """The time [s]."""
        return self.now


class Odometer:
    """How far the running task has come."""

    metres = 0.0

    def __call__(self, _: str, progress: object) -> None:
        """Take in what the task says."""
        if isinstance(progress, TaskProgress):
            self.metres = progress.distance_driven


def run(station: Station, clock: Clock, seconds: float) -> None:
    """Let so much of the robot's time pass."""
    for _ in range(round(seconds / TICK)):
        clock.now += TICK
        station.step(clock.now)


def begin(station: Station) -> None:
    """Start patrolling `ROUND`, as a client would."""
    door = StationDoor(station)
    session = door.join("bench")
    for name, request in (
        ("/mission/set", SetMissionRequest(mission=Mission(waypoints=ROUND))),
        ("/task/start", StartTaskRequest()),
    ):
        answer = door.call(session, name, request)
        if not getattr(answer, "success", False):
            raise RuntimeError(f"{name}: {answer}")
