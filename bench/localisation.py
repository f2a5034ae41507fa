"""Whether a robot knows how well it knows its place, and whether it ever believes a wrong one.

A simulated patrol robot is put at a random place of the office or of the car park, is told a pose that is off by some decimetres, and stands for two
seconds or drives for six. At the end its error is compared with the covariance that it tells on `/pose`: the normalised square of the error (NEES) of x, y
and yaw is 3 on average over all runs if that is true, and with 100 runs between 2.5 and 3.5 in 95 of 100 cases; above, it is too sure of itself.
Each run has a map whose cells lie otherwise: what a map draws wrong is the same in all runs on it, and would be one case and not a hundred.
A scout, which has sonars and no laser, does the same in the office, for eight seconds and for twenty.
The peer is a plain Kalman filter over the same sweeps of the same runs, which takes the errors of each sweep for its own.

Then it is made to err, by laser alone, without satellites and compass: it is placed one door off, carried while it stands and while it drives,
stands in a crowd that hides the walls, finds every second parked car gone, and is placed one room off on a floor of equal rooms whose two ends are
alike: there it can only ask. Counted are how soon it is unsure, in how many runs it knows the
true place at the end, in how many it asks, and in how many it believes a wrong place after 3 s: that must be none. The peer there is sure
by the fit of the last sweeps.
"""

from __future__ import annotations

import math
import random
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

import sim.worlds
from bench.support.figures import Figure, percentile
from bench.support.harness import Context, Sides
from bench.support.plain_filter import PlainFilter
from bridge.core.units import wrap
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import SonarRing
from bridge.msgs.sensor_msgs import LaserScan
from robotside.core.pose2 import Points, Pose2
from robotside.localisation.field import Field
from robotside.localisation.odometry_track import OdometryTrack
from robotside.localisation.pose_estimator import PoseEstimator
from robotside.mapping.laser_points import LaserProjection
from robotside.mapping.occupancy_grid import Grid
from robotside.mapping.sonar_points import SonarProjection
from sim.robot import SimRobot, make_several
from sim.world.occupancy import occupancy
from sim.world.tables import Start

PLAIN = "plain Kalman filter"
TROUBLES = {
    "door": "placed one door off",
    "stood": "carried while it stands",
    "drove": "carried while it drives",
    "crowd": "in a crowd",
    "cars": "cars gone",
    "rooms": "placed one room off among equal rooms",
}
FIGURES = (
    Figure(
        "nees_standing", "", "mean NEES of x, y, yaw after standing; 3 is true", target=3.5, against=PLAIN
    ),
    Figure("nees_standing_off", "", "how far from 3 it is; 0.5 is the band of 95 %", target=0.5),
    Figure("nees_driving", "", "mean NEES after driving; 3 is true", target=3.5, against=PLAIN),
    Figure("nees_driving_off", "", "how far from 3 it is; 0.5 is the band of 95 %", target=0.5),
    *(
        each
        for kind in ("standing", "driving")
        for each in (
            Figure(f"sonar_nees_{kind}", "", f"by sonars: mean NEES after {kind}", target=3.5),
            Figure(f"sonar_error_{kind}", "mm", f"by sonars: error of the place, {kind}, rms"),
            Figure(f"sonar_told_{kind}", "mm", f"by sonars: error that it tells, {kind}, rms"),
        )
    ),
    Figure("error_standing", "mm", "error of the place, standing, rms", against=PLAIN),
    Figure("told_standing", "mm", "error that it tells, standing, rms", against=PLAIN),
    Figure("error_driving", "mm", "error of the place, driving, rms", against=PLAIN),
    Figure("told_driving", "mm", "error that it tells, driving, rms", against=PLAIN),
    Figure("sweep", "ms", "CPU time of a sweep", against=PLAIN),
    *(
        each
        for name, what in TROUBLES.items()
        for each in (
            Figure(
                f"{name}_wrong", "%", f"{what}: believes a wrong place after 3 s", target=0.0, against=PLAIN
            ),
            Figure(f"{name}_unsure", "s", f"{what}: until it is unsure, p95"),
            Figure(f"{name}_found", "%", f"{what}: knows its place at the end"),
            Figure(f"{name}_asks", "%", f"{what}: asks the operator at the end"),
            Figure(f"{name}_error", "mm", f"{what}: error while it is sure after 3 s, p95"),
        )
    ),
)
REPEATS = 1

RUNS, EACH = 100, 8
"""Runs for the consistency, standing and driving, and of each trouble."""
TICK = 0.05
ROBOT = "patrol"
DURATION = {
    ("patrol", "standing"): 2.0,
    ("patrol", "driving"): 6.0,
    ("scout", "standing"): 8.0,
    ("scout", "driving"): 20.0,
}
"""How long they last [s]."""
TROUBLE_TIME, GRACE, WRONG = 20.0, 3.0, 0.5
"""How long a run with trouble lasts [s], how long it may take to be noticed [s], and what is a wrong place [m]."""
DOOR, ROOM = 4.4, 4.0
"""Between two doors of the office and of the floor of equal rooms [m]."""


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Both sides are measured in the same runs, by the first that is asked."""
    measured: list[tuple[dict[str, float], dict[str, float]]] = []

    def both() -> tuple[dict[str, float], dict[str, float]]:
        if not measured:
            ours, plain = consistency(ROBOT, ("office", "parking_lot"), RUNS)
            by_sonars, _ = consistency("scout", ("office",), RUNS)
            ours |= {f"sonar_{name}": value for name, value in by_sonars.items()}
            with tempfile.TemporaryDirectory() as folder:
                worlds = {"cars": without_cars(Path(folder)), "rooms": equal_rooms(Path(folder))}
                for name in TROUBLES:
                    more, plain[f"{name}_wrong"] = troubles(name, EACH, worlds.get(name, "office"))
                    ours |= more
            measured.append((ours, plain))
        return measured[0]

    yield Sides(lambda: both()[0], lambda: both()[1])


@dataclass
class Ridden:
    """A robot, and what looks at its sweeps."""

    robot: SimRobot
    ours: PoseEstimator
    plain: PlainFilter
    laser: LaserProjection
    sonars: SonarProjection = field(default_factory=SonarProjection)
    track: OdometryTrack = field(default_factory=OdometryTrack)
    now: float = 0.0
    crowd: bool = False
    spent: list[float] = field(default_factory=list)
    spent_plain: list[float] = field(default_factory=list)

    @property
    def truth(self) -> Pose2:
        """Where it is."""
        return Pose2(*self.robot.simulation.pose())

    def run(self, seconds: float, *, drives: bool) -> None:
        """Let time pass; it wanders where there is room."""
        end = self.now + seconds
        while self.now < end - 1e-9:
            self.now += TICK
            for topic, msg in self.robot.read(self.now):
                self._hear(topic, msg, drives)

    def _hear(self, topic: str, msg: Msg, drives: bool) -> None:
        if topic == "/odom" and isinstance(msg, Odometry):
            pose = Pose2.from_msg(msg.pose.pose)
            self.plain.predict(pose)
            self.track.add(msg.header.stamp.seconds, pose, Pose2(msg.twist.twist.linear.x, 0.0, 0.0))
            self.ours.on_odometry(msg)
        elif isinstance(msg, LaserScan):
            self._sweep(self.laser.points(msg), msg.header.stamp.seconds, drives)
        elif isinstance(msg, SonarRing):
            if drives:
                self.robot.drive(wander(self.sonars.points(msg)))
            self.ours.on_sonar(self.sonars.arcs(msg))

    def _sweep(self, points: Points, stamp: float, drives: bool) -> None:
        if drives:
            self.robot.drive(wander(points))
        if self.crowd:
            points = hidden(points)
        begun = time.thread_time()
        self.ours.on_scan(points, stamp)
        middle = time.thread_time()
        then, now = self.track.at(stamp), self.track.at(self.now)
        self.plain.correct(points if then is None or now is None else then.since(now).apply(points))
        self.spent.append(middle - begun)
        self.spent_plain.append(time.thread_time() - middle)


def wander(points: Points) -> Twist:
    """Ahead where there is room, else turn."""
    ahead = points[(points[:, 0] > 0.0) & (np.abs(points[:, 1]) < 0.4)]
    room = float(ahead[:, 0].min()) if len(ahead) else 9.0
    return Twist.planar(0.4, 0.1) if room > 1.0 else Twist.planar(0.0, 0.7)


def hidden(points: Points) -> Points:
    """The sweep of a laser that people stand round at a metre: they hide two of three directions."""
    bearing = np.arctan2(points[:, 1], points[:, 0])
    behind = np.floor(bearing / 0.35).astype(np.int64) % 3 != 0
    reach = np.hypot(points[:, 0], points[:, 1])
    return np.asarray(points * np.where(behind & (reach > 1.0), 1.0 / reach, 1.0)[:, None])


def grid_of(world: str, shift: tuple[float, float] = (0.0, 0.0)) -> Grid:
    """The map of a world, with its cells moved by `shift` [m]."""
    with closing(make_several([ROBOT], world, camera=False)[0]) as robot:
        return Grid.from_msg(occupancy(robot.simulation.world, 0.0, shift))


def start(world: str, known: Field, place: Pose2, believed: Pose2, seed: int, model: str = ROBOT) -> Ridden:
    """A robot at `place` of `world` that is told to be at `believed`."""
    at = Start(place.x, place.y, math.degrees(place.yaw))
    robot = make_several([(model, at)], world, seed=seed, camera=False)[0]
    info = replace(robot.info, latitude=math.nan, longitude=math.nan)
    ours = PoseEstimator(info, _nobody, _nobody)
    ours.set_map(known)
    ridden = Ridden(robot, ours, PlainFilter(known), LaserProjection(Pose2(info.laser_x, 0.0, 0.0)))
    ridden.run(0.3, drives=False)
    ridden.plain.place(believed, spread=0.3, turn=0.2)
    ours.place(believed)
    return ridden


def _nobody(*_: object, **__: object) -> None:
    """There is no one to hear it."""


def _anywhere(_x: float, _y: float) -> bool:
    return True


def _in_corridor(x: float, y: float) -> bool:
    """In the office's."""
    return abs(y) < 0.4 and -8.0 < x < 7.5


def _in_room(_x: float, y: float) -> bool:
    """Of the floor of equal rooms."""
    return abs(y) > 2.0


WHERE: dict[str, Callable[[float, float], bool]] = {"door": _in_corridor, "rooms": _in_room}
"""Where a trouble begins, but for those that begin anywhere."""


def places(
    grid: Grid, count: int, seed: int, *, where: Callable[[float, float], bool] = _anywhere
) -> list[Pose2]:
    """Random places with room for a robot, at (x, y) [m] for which `where` is true."""
    rng = random.Random(seed)
    rows, columns = np.nonzero(grid.distance > 0.6)
    found: list[Pose2] = []
    while len(found) < count:
        n = rng.randrange(len(rows))
        x, y = grid.centre(int(rows[n]), int(columns[n]))
        if where(x, y):
            shift = rng.uniform(-0.05, 0.05), rng.uniform(-0.05, 0.05)
            found.append(Pose2(x + shift[0], y + shift[1], rng.uniform(-3.1, 3.1)))
    return found


def nees(pose: Pose2, covariance: NDArray[np.float64], truth: Pose2) -> float:
    """The error's square in units of the covariance."""
    off = np.array([pose.x - truth.x, pose.y - truth.y, wrap(pose.yaw - truth.yaw)])
    return float(off @ np.linalg.solve(covariance, off))


Squares = tuple[float, float, float]
"""NEES, the error's square and the one that is told [m2]."""


def consistency(model: str, worlds: Sequence[str], runs: int) -> tuple[dict[str, float], dict[str, float]]:
    """Figures of what the robot tells, and of the plain filter, over so many `runs` in all `worlds` together."""
    found: tuple[dict[str, float], dict[str, float]] = {}, {}
    spent: tuple[list[float], list[float]] = [], []
    for kind in ("standing", "driving"):
        squares: tuple[list[Squares], list[Squares]] = [], []
        for n, world in enumerate(worlds):
            for ridden in _rides(model, world, runs // len(worlds), n + 1, kind):
                squares[0].append(squares_of(ridden.ours.pose, ridden.ours.covariance, ridden.truth))
                squares[1].append(squares_of(ridden.plain.pose, ridden.plain.covariance, ridden.truth))
                spent[0].extend(ridden.spent)
                spent[1].extend(ridden.spent_plain)
        for side in (0, 1):
            mean = np.array(squares[side]).mean(axis=0).tolist()
            found[side][f"nees_{kind}"] = mean[0]
            found[side][f"nees_{kind}_off"] = abs(mean[0] - 3.0)
            found[side][f"error_{kind}"] = 1e3 * math.sqrt(mean[1])
            found[side][f"told_{kind}"] = 1e3 * math.sqrt(mean[2])
    for side in (0, 1):
        if spent[side]:
            found[side]["sweep"] = 1e3 * float(np.mean(spent[side]))
    return found


def _rides(model: str, world: str, runs: int, seed: int, kind: str) -> Iterator[Ridden]:
    """So many rides from random places of `world`, at their end, each on a map whose cells lie otherwise."""
    with closing(make_several([ROBOT], world, camera=False)[0]) as robot:
        drawn = robot.simulation.world
    made = 0
    for each, place in enumerate(places(Grid.from_msg(occupancy(drawn, 0.0)), 2 * runs, seed)):
        if made == runs:
            break
        rng = random.Random(each)
        believed = place.then(Pose2(rng.gauss(0, 0.1), rng.gauss(0, 0.1), rng.gauss(0, 0.05)))
        shift = rng.uniform(-0.05, 0.05), rng.uniform(-0.05, 0.05)
        known = Field(Grid.from_msg(occupancy(drawn, 0.0, shift)))
        try:
            ridden = start(world, known, place, believed, each, model)
        except ValueError:
            continue  # something that is not on the map stands there
        made += 1
        with closing(ridden.robot):
            ridden.run(DURATION[model, kind], drives=kind == "driving")
            yield ridden


def squares_of(pose: Pose2 | None, covariance: NDArray[np.float64], truth: Pose2) -> Squares:
    """How far off a told pose is."""
    if pose is None:
        raise RuntimeError("A robot that was placed has no pose.")
    error = pose.distance(truth.x, truth.y)
    return nees(pose, covariance, truth), error**2, float(covariance[:2, :2].trace())


def without_cars(folder: Path) -> str:
    """The path of a car park whose every second car is gone."""
    text = (Path(next(iter(sim.worlds.__path__))) / "parking_lot.toml").read_text()
    head, *cars = text.split("[[cars]]")
    kept = [each for n, each in enumerate(cars) if n % 2 or n == len(cars) - 1]
    path = folder / "parking_lot.toml"
    path.write_text(head + "".join(f"[[cars]]{each}" for each in kept))
    return str(path)


def equal_rooms(folder: Path) -> str:
    """The path of a floor with four equal rooms on each side of a corridor, which looks the same after half a turn."""
    walls = []
    for n in range(-2, 3):
        west = ROOM * n
        for y in (1.2, -1.2):
            if n < 2:
                walls += [(west, y, west + ROOM / 2 - 0.6, y), (west + ROOM / 2 + 0.6, y, west + ROOM, y)]
            if abs(n) < 2:
                walls.append((west, y, west, math.copysign(5.0, y)))
    text = (
        'name = "rooms"\ndescription = "Equal rooms on both sides of a corridor"\n'
        "[datum]\nlatitude = 45.0\nlongitude = -73.0\n"
        '[ground]\nlength = 16.0\nwidth = 10.0\nlook = "floor"\n'
        "[wall]\nheight = 2.4\nthickness = 0.2\n[start]\nx = 0.0\ny = 0.0\n"
    )
    path = folder / "rooms.toml"
    path.write_text(
        text + "".join(f"[[partitions]]\nfrom = [{a}, {b}]\nto = [{c}, {d}]\n" for a, b, c, d in walls)
    )
    return str(path)


def troubles(name: str, runs: int, world: str) -> tuple[dict[str, float], float]:
    """Figures of a trouble, and the part of the runs in which the plain filter believes a wrong place [%]."""
    grid = grid_of("parking_lot" if name == "cars" else world)
    known, found = Field(grid), list[Trouble]()
    begins, ends = places(grid, 4 * runs, 11, where=WHERE.get(name, _anywhere)), places(grid, 4 * runs, 12)
    for seed, (place, other) in enumerate(zip(begins, ends, strict=True)):
        if len(found) == runs:
            break
        try:
            found.append(trouble(name, known, world, place, other, seed))
        except ValueError:
            continue  # something that is not on the map stands there
    unsure = [each.unsure for each in found if math.isfinite(each.unsure)]
    errors = [error for each in found for error in each.errors]

    def part(of: list[bool]) -> float:
        return 100.0 * sum(of) / len(of)

    ours = {
        f"{name}_wrong": part([each.wrong for each in found]),
        f"{name}_found": part([each.found for each in found]),
        f"{name}_asks": part([each.asks for each in found]),
    }
    if unsure:
        ours[f"{name}_unsure"] = percentile(unsure, 0.95)
    if errors:
        ours[f"{name}_error"] = 1e3 * percentile(errors, 0.95)
    return ours, part([each.plain for each in found])


@dataclass
class Trouble:
    """What one run shows."""

    unsure: float = math.nan
    wrong: bool = False
    plain: bool = False
    found: bool = False
    asks: bool = False
    errors: list[float] = field(default_factory=list)


def trouble(name: str, known: Field, world: str, place: Pose2, other: Pose2, seed: int) -> Trouble:
    """One run."""
    believed = place
    if name == "door":
        place = Pose2(place.x, place.y, 0.0 if seed % 2 else math.pi)
    if name in WHERE:
        off = DOOR if name == "door" else ROOM
        believed = Pose2(place.x + (off if place.x < 0 else -off), place.y, place.yaw)
    ridden, shows = start(world, known, place, believed, seed), Trouble()
    estimator = ridden.ours
    with closing(ridden.robot):
        if name in ("stood", "drove"):
            ridden.run(3.0, drives=name == "drove")
            carry(ridden, other)
        ridden.crowd = name == "crowd"
        begun = ridden.now
        while ridden.now < begun + TROUBLE_TIME:
            ridden.run(0.1, drives=name != "stood" or ridden.now > begun + 5.0)
            _judge(shows, ridden, estimator, ridden.now - begun)
        shows.asks = len(estimator.candidates) > 1
    return shows


def _judge(shows: Trouble, ridden: Ridden, estimator: PoseEstimator, since: float) -> None:
    truth, believed = ridden.truth, ridden.plain.pose
    error = estimator.pose.distance(truth.x, truth.y) if estimator.pose else math.inf
    shows.found = estimator.sure and error < WRONG
    if math.isnan(shows.unsure) and not estimator.sure:
        shows.unsure = since
    if since > GRACE:
        if estimator.sure:
            shows.errors.append(error)
        shows.wrong |= estimator.sure and error > WRONG
        shows.plain |= (
            believed is not None and ridden.plain.sure and believed.distance(truth.x, truth.y) > WRONG
        )


def carry(ridden: Ridden, other: Pose2) -> None:
    """Lift the robot and put it down at `other`; its wheels do not notice."""
    vehicle = ridden.robot.simulation.vehicle
    _, _, z = vehicle.state().position
    half = other.yaw / 2
    turned = 0.0, 0.0, math.sin(half), math.cos(half)
    vehicle.scene.backend.place(vehicle.body, (other.x, other.y, z), turned)
