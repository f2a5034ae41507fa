"""The path controller for steered front wheels: bends that they can drive, backwards too, with room for a long body."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bridge.core.units import wrap
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from robotside.core.pose2 import Points, Pose2
from robotside.core.robot import Manoeuvrable, Robot
from robotside.core.text import place_sentence
from robotside.kinds.registry import kind_of
from robotside.navigation.lattice_planner import LatticePlanner
from robotside.navigation.path_controller import CRUISE_SHARE, UNSURE_SPEED, GroundBound, Piece, Search
from robotside.navigation.planner import Planner, Unreachable
from robotside.navigation.pure_pursuit import PathFollower

__all__ = ["AckermannController", "bend_of", "girth"]

MAX_SPEED = 2.0
"""It goes by itself no faster than this [m/s], however fast it may be driven by hand."""

DISCS, GIRTH = (0.0, 0.39, 0.78), 0.36
"""The body is covered by three discs so far ahead of the rear axle and so large, as parts of the robot's radius."""

MARGIN = 0.2
"""Kept between the body and anything on its way, unless the robot's configuration says otherwise [m]."""

NARROW_SHARE = 0.6
"""Of that so much is kept between the body and anything that the laser sees: the rest is for steering."""

BEND_SHARE = 0.8
"""It plans with bends of so much of its tightest, so that it can steer back to a way that it begins askew."""

YAW_TOLERANCE = 0.35
"""It looks to where it should within this [rad]."""

HORIZON, STEP = 6.4, 0.4
"""So far ahead it looks along an arc, and in such steps [m]."""

MIN_ROOM = 1.0
"""With less room than this ahead it stands [m]."""

BRAKING = 1.0
"""Deceleration counted on when something is ahead [m/s2]."""

AIM_BEYOND = 2.0
"""It aims at a way that goes on so far beyond its end [m]."""

END_TOLERANCE, MISSED_DISTANCE = 0.15, 0.6
"""At the end of a way it is so far from it along the way, or past it; farther beside a way, or from its end, than the second it has missed it [m]."""

SWING_TIME, PERIOD = 0.8, 0.05
"""From straight to the tightest bend the front wheels take so long, and they are commanded so often [s]."""

MAX_SWING_SPEED, CREEP_SPEED = 0.3, 0.15
"""No faster than this they are let swing first, and so fast it creeps meanwhile where it cannot stand [m/s]."""

DEFAULT_STEERING = 0.5
"""Of the front wheels, where the robot does not say [rad]."""

MAX_TRIES = 2
"""Ways to come to look where it should, after the first."""


def _end(points: Points) -> NDArray[np.float64]:
    """The direction in which a way ends, of length 1."""
    along = points[-1] - points[max(-4, -len(points))]
    return np.asarray(along / max(float(np.hypot(*along)), 1e-9))


def girth(info: RobotInfo) -> float:
    """Of the discs that cover a truck's body [m]."""
    return GIRTH * info.radius


def bend_of(info: RobotInfo) -> float:
    """The tightest bend that it drives [1/m]; by its speeds where it does not say."""
    return 1.0 / info.min_radius if info.min_radius > 0 else info.max_yaw_rate / info.max_speed


class AckermannController(GroundBound):
    """`path_controller.PathController` of a robot that turns only by driving, and drives backwards too."""

    stands = avoids = True
    keeps_courses = False
    look = 12.0

    def __init__(self, robot: Robot, clearance: float | None = None) -> None:
        """`clearance` is kept on the way [m]; None for the usual one."""
        super().__init__()
        self._margin = MARGIN if clearance is None else clearance
        info = robot.info
        self._robot = robot
        self._bend, self._pursuit = bend_of(info), kind_of(info.kind).pursuit
        self.discs: tuple[float, ...] = tuple(part * info.radius for part in DISCS)
        self._girth = girth(info)
        self.turning = 1.0 / (BEND_SHARE * self._bend)
        self.cruise, self.clear = (
            min(CRUISE_SHARE * info.max_speed, MAX_SPEED),
            self._girth + self._margin + 0.1,
        )
        self._pieces: list[Piece] = []
        self._follower: PathFollower | None = None
        self._speed = 0.0
        self._tries = 0
        self._steered = 0.0
        """About where the front wheels stand, as the bend of the way that it goes [1/m]."""

    @property
    def under_way(self) -> bool:
        """It has a way."""
        return self._follower is not None

    @property
    def ahead(self) -> Points:
        """What is left of the way, from beside the robot on, as the front of the body goes it as well."""
        if self._follower is None:
            return np.empty((0, 2))
        return np.concatenate([self._follower.ahead, *(piece.points for piece in self._pieces[1:])])

    def search(
        self, planner: Planner, pose: Pose2, goal: tuple[float, float, float], name: str, obstacles: Points
    ) -> Search:
        """For a way to `goal`, pose by pose. Unreachable raises."""
        grid = planner.grid
        for place, called in (((pose.x, pose.y), "The robot"), (goal[:2], name)):
            if not grid.holds(*place):
                raise Unreachable(f"{place_sentence(called, *place)} is off the map.")
        pieces = yield from self._among(obstacles, planner, pose, goal)
        if pieces:
            return pieces
        none = Unreachable(f"There is no way to {place_sentence(name, *goal[:2])} that it can drive.")
        # the map's own walls stay where they are: without a way between them there is none to wait for
        free = (yield from self._among(obstacles[:0], planner, pose, goal)) if len(obstacles) else []
        if not free:
            raise none
        way = np.concatenate([piece.points for piece in free])
        raise planner.blocked(none, name, goal[:2], way, obstacles)

    def _among(
        self, obstacles: Points, planner: Planner, pose: Pose2, goal: tuple[float, float, float]
    ) -> Search:
        """A way round the walls of the map and `obstacles`; no pieces when there is none."""
        grid = yield from planner.seeing(obstacles)
        lattice = LatticePlanner(grid, BEND_SHARE * self._bend, self.discs, self._girth, self._margin)
        return (yield from lattice.search(pose, goal))

    def forget(self) -> None:
        """Have no way any more."""
        self._pieces, self._follower, self._speed = [], None, 0.0

    def remaining(self, pose: Pose2) -> float:
        """Along the way to its end [m]."""
        if self._follower is None:
            return math.nan
        rest = (np.hypot(*np.diff(piece.points, axis=0).T).sum() for piece in self._pieces[1:])
        return max(0.0, self._follower.remaining(pose) - AIM_BEYOND) + float(sum(rest))

    def arrived(self, pose: Pose2) -> bool:
        """The way is gone to its end; where it changes over in between, the next piece begins."""
        if self._follower is None or not self._at_end(pose):
            return False
        if pose.distance(*self._pieces[0].points[-1].tolist()) > MISSED_DISTANCE:
            self.forget()  # it came out beside it: the next way begins here
            return False
        if len(self._pieces) == 1:
            return True
        self.follow(self._pieces[1:])
        return False

    def steer(self, pose: Pose2, points: Points, *, sure: bool) -> None:
        """Go on, ahead or back as the piece is."""
        follower = self._follower
        if follower is None:
            return
        way = 1.0 if self._pieces[0].ahead else -1.0
        looking = pose if way > 0 else Pose2(pose.x, pose.y, wrap(pose.yaw + math.pi))
        distance, bearing = follower.aim(looking, self._speed)
        if pose.distance(*follower.ahead[0].tolist()) > MISSED_DISTANCE:
            # only on the way itself is there room for all of its body, and behind it sees nothing
            self.forget()
            self._robot.stop()
            return
        wanted = 2.0 * math.sin(bearing) / max(distance, 0.3)
        if abs(bearing) > math.pi / 2:
            wanted = math.copysign(self._bend, bearing)
        bend = max(-self._bend, min(self._bend, wanted))
        left = max(0.0, follower.remaining(looking) - AIM_BEYOND)
        speed = min(
            follower.speed(looking, bearing, distance),
            max(self._pursuit.min_speed, math.sqrt(2 * self._pursuit.deceleration * left)),
        )
        speed = min(speed if sure else min(speed, UNSURE_SPEED), self._speed + 0.1)
        bend, room = self._free_of(bend, way, points)
        by_bend = math.sqrt(self._pursuit.lateral_acceleration / max(abs(bend), 1e-3))
        self._speed = min(speed, by_bend, math.sqrt(2 * BRAKING * max(0.0, room - MIN_ROOM / 2)))
        if room < MIN_ROOM:
            self._speed = 0.0
        if self._swings(bend) and self._speed <= MAX_SWING_SPEED:
            self._swing(bend, way)
        else:
            self._robot.drive(Twist.planar(way * self._speed, self._speed * bend) if self._speed else Twist())

    def face(self, pose: Pose2, yaw: float) -> bool:
        """It cannot turn where it stands: it drives another way to the same place, and then looks where that has led it."""
        if abs(wrap(yaw - pose.yaw)) < YAW_TOLERANCE or self._tries >= MAX_TRIES:
            self._tries = 0
            return True
        self._tries += 1
        self.forget()
        return False

    def ready(self) -> str:
        """It always is."""
        return ""

    def free(self, bend: float, points: Points, way: float = 1.0) -> float:
        """How far its body can go along an arc, ahead or (`way` -1) back, before it touches one of `points` [m]."""
        return float(self._free(np.array([bend]), points, way)[0])

    def _free_of(self, bend: float, way: float, points: Points) -> tuple[float, float]:
        """The arc next to `bend` that leads on, and how far. `bend` is to the left of the way that it goes."""
        tries = np.unique(np.clip(bend + self._bend * np.linspace(-0.6, 0.6, 7), -self._bend, self._bend))
        tries = np.concatenate(([bend], tries))
        # seen from the body, a way back that bends to its own left is one of the opposite curvature
        rooms = self._free(tries * way, points, way)
        loss = 2.0 * np.clip(MIN_ROOM + 2.0 - rooms, 0.0, None) + np.abs(tries - bend) / self._bend
        best = int(loss.argmin())
        return float(tries[best]), float(rooms[best])

    def _free(self, bends: NDArray[np.float64], points: Points, way: float) -> NDArray[np.float64]:
        """The same for several arcs of `base_link`."""
        near = points[np.hypot(points[:, 0], points[:, 1]) < HORIZON + self.discs[-1] + self._girth]
        if not len(near):
            return np.full(len(bends), HORIZON)
        along = np.arange(STEP, HORIZON + STEP / 2, STEP) * way
        yaw = bends[:, None] * along
        safe = np.where(np.abs(bends) < 1e-6, 1e-6, bends)[:, None]
        x, y = np.sin(safe * along) / safe, (1.0 - np.cos(safe * along)) / safe
        ahead = np.asarray(self.discs)
        px = x[..., None] + ahead * np.cos(yaw)[..., None]
        py = y[..., None] + ahead * np.sin(yaw)[..., None]
        discs = np.column_stack([px.ravel(), py.ravel()])
        at_first = np.hypot(near[:, 0, None] - ahead, near[:, 1, None]).min(axis=1)
        # from what is too close already it may go away
        bound = np.minimum(self._girth + NARROW_SHARE * self._margin, at_first - 0.01).clip(0.0)
        # (p - q)^2 < bound^2, written so that it is one product of all with all
        far = (discs**2).sum(axis=1)[:, None] - 2.0 * (discs @ near.T)
        touches = (far < bound**2 - (near**2).sum(axis=1)).any(axis=1)
        hit: NDArray[np.bool_] = touches.reshape(*yaw.shape, len(ahead)).any(axis=2)
        first = np.where(hit.any(axis=1), hit.argmax(axis=1), hit.shape[1])
        return np.asarray(first * STEP, dtype=np.float64)

    def _swings(self, bend: float) -> bool:
        """The front wheels, which need their time, are far from where this bend has them."""
        most = self._bend / SWING_TIME * PERIOD
        self._steered += max(-most, min(most, bend - self._steered))
        return abs(bend - self._steered) > 0.3 * self._bend

    def _swing(self, bend: float, way: float) -> None:
        """Stand, or creep where no other command is possible, until the front wheels have swung round."""
        self._speed = 0.0
        if isinstance(self._robot, Manoeuvrable) and "steer" in self._robot.info.manoeuvres:
            lock = self._robot.info.max_steering or DEFAULT_STEERING
            # of the wheels the same angle bends a way back to the other side of it
            angle = math.atan(math.tan(lock) * bend * way / self._bend)
            self._robot.manoeuvre(Manoeuvre(kind="steer", speed=0.0, steering=angle))
        else:
            self._robot.drive(Twist.planar(way * CREEP_SPEED, CREEP_SPEED * bend))

    def follow(self, way: list[Piece]) -> None:
        """Go the pieces of `way` one after the other."""
        if self._pieces and self._pieces[0].ahead != way[0].ahead:
            self._steered = -self._steered
        self._pieces = way
        points = way[0].points
        along = _end(points)
        # aiming beyond the end it comes there in the direction of the way
        beyond = points[-1] + np.arange(0.1, AIM_BEYOND + 0.05, 0.1)[:, None] * along
        self._follower = PathFollower(
            np.concatenate([points, beyond]), cruise=self.cruise, parameters=self._pursuit
        )
        self._speed = 0.0

    def _at_end(self, pose: Pose2) -> bool:
        """It is beside the end of the piece, or past it; not before a loop that leads by there."""
        points = self._pieces[0].points
        x, y = points[-1].tolist()
        dx, dy = _end(points).tolist()
        over = (pose.x - x) * dx + (pose.y - y) * dy
        return over > -END_TOLERANCE and pose.distance(x, y) < AIM_BEYOND
