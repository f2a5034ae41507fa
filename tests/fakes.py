"""Small real objects that stand in for large ones and record what is done to them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bridge.core.identity import Identity, Role
from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from bridge.msgs.arrays import Float32Array, Int8Array
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, Quaternion, Twist, TwistWithCovariance
from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid, Odometry
from bridge.msgs.pilothouse_msgs import Bumper, RobotInfo
from bridge.msgs.sensor_msgs import BatteryState, LaserScan
from bridge.msgs.std_msgs import Header, Time

__all__ = ["Box", "FakeClient", "FakeDock", "FakeRobot", "Pillar"]

STEP = 0.05
"""Between two moves [s]; odometry comes with each, the laser with every other, the battery once a second."""

ROOM = 1.0
"""Of unknown cells round the walls [m]."""


@dataclass(frozen=True)
class Box:
    """Something rectangular [m], on the map."""

    west: float
    south: float
    east: float
    north: float

    def sides(self) -> list[tuple[float, float, float, float]]:
        """As lines from (x, y) to (x, y)."""
        w, s, e, n = self.west, self.south, self.east, self.north
        return [(w, s, e, s), (e, s, e, n), (e, n, w, n), (w, n, w, s)]


@dataclass(frozen=True)
class Pillar:
    """Something round [m], not on the map."""

    x: float
    y: float
    radius: float = 0.12


@dataclass
class FakeDock:
    """A charger of which the robot's laser sees a face of 0.44 m, with two reflecting strips unless it has none."""

    x: float
    """Middle of its face [m]."""
    y: float
    yaw: float
    """Of a robot that stands in it [rad]."""
    strips: tuple[float, ...] = (-0.15, 0.15)
    """Middles of the strips, to the left of the dock's [m]."""
    gives: int = BatteryState.POWER_SUPPLY_STATUS_CHARGING
    """What a battery reports with the contacts met."""
    aside: float = 0.03
    """The contacts meet within this off the middle [m] and 0.2 rad."""

    def line(self, start: float, end: float, nearer: float = 0.0) -> tuple[float, float, float, float]:
        """The part of its face between two distances to the left [m]."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return (
            self.x - s * start - c * nearer,
            self.y + c * start - s * nearer,
            self.x - s * end - c * nearer,
            self.y + c * end - s * nearer,
        )

    def meets(self, pose: tuple[float, float, float], front: float) -> bool:
        """A robot at `pose` touches its contacts."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        ahead = c * (self.x - pose[0]) + s * (self.y - pose[1])
        aside = -s * (self.x - pose[0]) + c * (self.y - pose[1])
        straight = abs(math.remainder(pose[2] - self.yaw, math.tau)) < 0.2
        return straight and abs(aside) <= self.aside and ahead - front < 0.005


MANAGER = Identity("", "", Role.MANAGE)


class FakeClient(Operator):
    """A connected client that may do everything."""

    def __init__(self, name: str = "a", now: float = 0.0, identity: Identity = MANAGER) -> None:
        super().__init__(name, "192.0.2.1:5000", now, identity=identity)
        self.rtt = 0.0
        self.asked_time = True
        self.answered = math.inf


class FakeRobot:
    """A disc that moves exactly as told in a walled hall; its laser and odometry err by nothing unless told to."""

    def __init__(
        self,
        *,
        start: tuple[float, float, float] = (0.0, 0.0, 0.0),
        hall: Box = Box(-10.0, -6.0, 10.0, 6.0),
        boxes: Sequence[Box] = (),
        pillars: Sequence[Pillar] = (),
        drift: float = 0.0,
        beams: int = 180,
        dock: FakeDock | None = None,
    ) -> None:
        """`drift` is how much farther the wheels believe to have gone, as a part of the way."""
        self.dock = dock
        self.info = RobotInfo("Fake-1", "wheels", "fake", "Differential drive", "hall", 0.7, 1.9, 0.18)
        self.pose = start
        self.hall, self.boxes, self.pillars = hall, list(boxes), list(pillars)
        self.commands: list[Twist | None] = []
        """Every drive, and None for every stop, in order."""
        self.twist = Twist()
        self.battery = 0.8
        self.charging = False
        self.more: list[tuple[str, Msg]] = []
        """Messages that come with the next ones."""
        self.silent: set[str] = set()
        """Topics that have stopped coming."""
        self.wanted: dict[str, bool] = {}
        self.closed = False
        self.trouble = ""
        self.contacts = 0
        self._odom, self._drift = (0.0, 0.0, 0.0), drift
        self._angles = np.linspace(-math.pi, math.pi, beams, endpoint=False)
        self._origin: float | None = None
        self._steps = 0
        self._seen_from: object = None
        self._seen: NDArray[np.float64] = np.empty(0)
        self._shine: NDArray[np.float64] = np.empty(0)

    @property
    def at_rest(self) -> bool:
        """Told to stand still."""
        return self.twist == Twist()

    def drive(self, twist: Twist) -> None:
        self.commands.append(twist)
        self.twist = twist

    def stop(self) -> None:
        self.commands.append(None)
        self.twist = Twist()

    def want(self, topic: str, wanted: bool) -> None:
        self.wanted[topic] = wanted

    def close(self) -> None:
        self.closed = True

    def read(self, now: float) -> Iterator[tuple[str, Msg]]:
        if self._origin is None:
            self._origin = now
            if "/map" not in self.silent:
                yield "/map", self.map()
        while self.more:
            yield self.more.pop(0)
        while self._origin + self._steps * STEP <= now + 1e-9:
            stamp = self._origin + self._steps * STEP
            for topic, msg in self._measure(Time.at(stamp)):
                if topic not in self.silent:
                    yield topic, msg
            self._move()
            self._steps += 1

    def map(self, resolution: float = 0.1) -> OccupancyGrid:
        """What the robot knows of the hall: walls and boxes, not pillars."""
        hall = self.hall
        columns = round((hall.east - hall.west + 2 * ROOM) / resolution)
        rows = round((hall.north - hall.south + 2 * ROOM) / resolution)
        x = hall.west - ROOM + (np.arange(columns) + 0.5) * resolution
        y = hall.south - ROOM + (np.arange(rows) + 0.5) * resolution
        cells = np.full((rows, columns), 100, dtype=np.int8)
        cells[np.ix_((y > hall.south) & (y < hall.north), (x > hall.west) & (x < hall.east))] = 0
        for box in self.boxes:
            inside = np.ix_((y > box.south) & (y < box.north), (x > box.west) & (x < box.east))
            cells[inside] = 100
        corner = Pose(Point(hall.west - ROOM, hall.south - ROOM))
        info = MapMetaData(Time(), resolution, columns, rows, corner)
        return OccupancyGrid(Header(frame_id="map"), info, Int8Array(cells.tobytes()))

    def room(self) -> float:
        """Between the body and the nearest thing [m]."""
        return float(self._ranges().min()) - self.info.radius

    def _measure(self, stamp: Time) -> Iterator[tuple[str, Msg]]:
        x, y, yaw = self._odom
        pose = PoseWithCovariance(Pose(Point(x, y), Quaternion.from_yaw(yaw)))
        twist = TwistWithCovariance(self.twist)
        yield "/odom", Odometry(Header(stamp, "odom"), "base_link", pose, twist)
        if self._steps % 2 == 0:
            yield "/scan", self._scan(stamp)
            yield "/bumper", Bumper(Header(stamp, "base_link"), self.room() < 0.0)
        if self._steps % 20 == 0:
            status = BatteryState.POWER_SUPPLY_STATUS_CHARGING if self.charging else 0
            if self.dock is not None:
                docked = self.dock.meets(self.pose, self.info.radius)
                status = self.dock.gives if docked else BatteryState.POWER_SUPPLY_STATUS_DISCHARGING
            yield (
                "/battery_state",
                BatteryState(Header(stamp), percentage=self.battery, power_supply_status=status),
            )

    def _scan(self, stamp: Time) -> LaserScan:
        step = float(self._angles[1] - self._angles[0])
        ranges = self._ranges()
        ranges[ranges > 12.0] = math.inf
        values = Float32Array(ranges.astype(np.float32).tobytes())
        first, last = float(self._angles[0]), float(self._angles[-1])
        shine = Float32Array(self._shine.astype(np.float32).tobytes()) if self.dock else Float32Array()
        return LaserScan(Header(stamp, "laser"), first, last, step, 0.0, 0.1, 0.05, 12.0, values, shine)

    def _ranges(self) -> NDArray[np.float64]:
        seen_from = (self.pose, len(self.boxes), len(self.pillars))
        if seen_from != self._seen_from:
            self._seen_from, self._seen = seen_from, self._cast()
        return self._seen.copy()

    def _cast(self) -> NDArray[np.float64]:
        x, y, yaw = self.pose
        dx, dy = np.cos(self._angles + yaw), np.sin(self._angles + yaw)
        nearest = np.full(len(dx), np.inf)
        for box in (self.hall, *self.boxes):
            for side in box.sides():
                nearest = np.minimum(nearest, _to_line(x, y, dx, dy, side))
        for pillar in self.pillars:
            nearest = np.minimum(nearest, _to_circle(x - pillar.x, y - pillar.y, dx, dy, pillar.radius))
        if self.dock is not None:
            nearest = np.minimum(nearest, _to_line(x, y, dx, dy, self.dock.line(-0.22, 0.22)))
            self._shine = np.full(len(dx), 40.0)
            for strip in self.dock.strips:
                away = _to_line(x, y, dx, dy, self.dock.line(strip - 0.025, strip + 0.025, 0.001))
                self._shine[away < nearest] = 230.0
                nearest = np.minimum(nearest, away)
        return nearest

    def _move(self) -> None:
        v, turn = self.twist.linear.x, self.twist.angular.z
        self.pose = _moved(self.pose, v * STEP, turn * STEP)
        self._odom = _moved(self._odom, v * STEP * (1 + self._drift), turn * STEP * (1 + self._drift))
        if self.room() < 0.0:
            self.contacts += 1


def _moved(pose: tuple[float, float, float], way: float, turn: float) -> tuple[float, float, float]:
    x, y, yaw = pose
    middle = yaw + turn / 2
    return x + way * math.cos(middle), y + way * math.sin(middle), math.remainder(yaw + turn, math.tau)


def _to_line(
    x: float,
    y: float,
    dx: NDArray[np.float64],
    dy: NDArray[np.float64],
    line: tuple[float, float, float, float],
) -> NDArray[np.float64]:
    ax, ay, bx, by = line
    ex, ey = bx - ax, by - ay
    with np.errstate(divide="ignore", invalid="ignore"):
        cross = dx * ey - dy * ex
        distance = ((ax - x) * ey - (ay - y) * ex) / cross
        part = ((ax - x) * dy - (ay - y) * dx) / cross
        hit = (distance > 0) & (part >= 0) & (part <= 1)
    return np.where(hit, distance, np.inf)


def _to_circle(
    x: float, y: float, dx: NDArray[np.float64], dy: NDArray[np.float64], radius: float
) -> NDArray[np.float64]:
    along = x * dx + y * dy
    inside = along**2 - (x * x + y * y - radius * radius)
    with np.errstate(invalid="ignore"):
        distance = -along - np.sqrt(inside)
    return np.where((inside > 0) & (distance > 0), distance, np.inf)
