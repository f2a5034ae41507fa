"""The last metres to a dock: how they are steered, whether its line can still be reached, what is in the way, and where they begin."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bridge.core.units import wrap
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from robotside.core.pose2 import Points, Pose2
from robotside.kinds.registry import kind_of
from robotside.navigation.navigator import Navigator

__all__ = ["ALIGN_GAP", "CREEP_SPEED", "DOCK_NEAR", "RETREAT_SPEED", "Approach"]

CREEP_SPEED = 0.08
"""On the last bit [m/s]."""

RETREAT_SPEED = 0.12
"""Backwards, away from a dock [m/s]."""

FAR_STANDOFFS = (6.0, 7.5, 5.0, 4.0)
"""From where it stands docked, the approach of a robot that only bends begins so far back [m]: farther, it sees no more of the dock."""

SLANTS = (0.0, 0.09, -0.09, 0.18, -0.18, 0.27, -0.27)
"""On lines turned by so much [rad]: where the map errs by 10 degrees, that of the dock is one of them."""

APPROACH_SPEED = 0.25
"""Farther away [m/s]."""

MAX_TURN = 0.4
"""While it goes there [rad/s]."""

AHEAD, FRONT_AHEAD = 0.5, 0.9
"""The robot steers for a point of its line so far ahead; one that only bends does so with its front [m]."""

MAX_SWING = 1.2
"""Most that the front's way may be off the robot's own direction [rad]."""

MAX_BEARING = 0.6
"""Off its line by more than this, a robot that turns on the spot turns first [rad]."""

DOCK_NEAR = 1.5
"""With contact no farther than this from the place of a dock it stands in that dock [m]."""

ALIGN_GAP = 0.30
"""With its front so near to the dock it has to be on its line, and what it touches is the dock [m]."""

MAX_ASIDE, MAX_ASKEW = 0.03, 0.12
"""Off the line of a dock that is seen by no more than this [m, rad]."""

LINE_SLACK, LINE_DOUBT = 0.06, 0.08
"""It may end beside the line by the first [m] as it is seen now, and by so much more for each metre that it sees the dock from."""

BEND_SHARE = 0.85
"""A line counts as within reach when bends of so much of the tightest lead onto it: the rest is for steering."""

ROLL_STEP = 0.05
"""The way that is left is tried out in such steps [m]."""

TRIED = 4
"""One in so many of them is looked at for what stands there."""

SIDE_ROOM = 0.05
"""What is no nearer than this beside its way is not in the way [m]."""

FACE_ROOM = 0.25
"""What is so near to the dock's face belongs to the dock [m]."""


@dataclass(frozen=True, slots=True)
class Approach:
    """How one robot goes up to a dock; all lengths in its `base_link`."""

    front: float
    """From its middle to what touches the dock [m]."""
    rear: float
    """From its middle to its back [m]."""
    half: float
    """Half its breadth [m]."""
    min_radius: float
    """Of its tightest bend [m]; 0 for one that turns on the spot."""
    standoffs: tuple[float, ...]
    """From where it stands docked back to where the approach may begin, the best first [m]."""
    slants: tuple[float, ...] = (0.0,)
    """It may begin on lines that are turned by these about where it stands docked, the best first [rad]."""

    leave: float = 0.7
    """As far back it goes to leave a dock [m]."""
    retreat: float = RETREAT_SPEED
    """So fast [m/s]."""
    guided: float = 0.1
    """So far back it may touch what guides it out of the dock [m]."""
    look_gap: float = math.inf
    """It comes up to so near by the map to see the dock [m]; infinite for one that sees it from where the approach begins."""
    lock: float = 0.0
    """Most that its front wheels steer [rad]; 0 for one that takes twists only."""

    @classmethod
    def of(cls, info: RobotInfo) -> Approach:
        """That of a robot."""
        front = max((corner.x for corner in info.footprint), default=info.radius)
        rear = -min((corner.x for corner in info.footprint), default=-info.radius)
        half = max((abs(corner.y) for corner in info.footprint), default=info.radius)
        if kind_of(info.kind).docks == "jetty":  # through water that may push it in
            return cls(
                front, rear, half, info.min_radius, (7.5, 6.5, 5.5), leave=4.0, retreat=0.35, guided=0.8
            )
        if info.min_radius > 0:
            lock = info.max_steering if "steer" in info.manoeuvres else 0.0
            return cls(
                front, rear, half, info.min_radius, FAR_STANDOFFS, SLANTS, 2.0, look_gap=2.5, lock=lock
            )
        swims = kind_of(info.kind).docks == "cage"  # it turns only clear of the cage
        return cls(front, rear, half, 0.0, (2.0, 1.6, 1.2, 0.8), leave=1.3 if swims else 0.7)

    def reaches(self, robot: Pose2) -> bool:
        """One that only bends leads onto the dock's line before it is at the dock; whoever turns on the spot always gets there.

        The `robot` is in the dock's frame.
        """
        if not self.min_radius:
            return True
        slack = LINE_SLACK + LINE_DOUBT * max(0.0, self.gap(robot))
        end = self._rolled(robot, self.min_radius / BEND_SHARE, ALIGN_GAP)[-1]
        return abs(self.aside(end)) < slack and abs(end.yaw) < MAX_ASKEW

    def docked(self, face: Pose2) -> Pose2:
        """Where it stands at a dock with its face there."""
        return face.then(Pose2(-self.front, 0.0, 0.0))

    def _rolled(self, robot: Pose2, radius: float, gap: float) -> list[Pose2]:
        """Where it comes along by bends no tighter than `radius` [m], up to `gap` before the dock [m] or where it looks away from it."""
        way = [robot]
        while self.gap(way[-1]) > gap and abs(way[-1].yaw) < math.pi / 2:
            x, y, yaw = way[-1]
            twist = self._onto_line(way[-1], radius)
            yaw += ROLL_STEP * twist.angular.z / twist.linear.x
            way.append(Pose2(x + ROLL_STEP * math.cos(yaw), y + ROLL_STEP * math.sin(yaw), yaw))
        return way

    def gap(self, robot: Pose2) -> float:
        """From its front to the dock, along the dock's line [m]."""
        return -robot.x - self.front

    def steer(self, robot: Pose2) -> Twist:
        """The next bit of the way of a `robot`, whose pose is in the dock's frame."""
        return self._onto_line(robot, self.min_radius)

    def lead(self, robot: Pose2, navigator: Navigator) -> None:
        """Have the robot go that bit."""
        twist = self.steer(robot)
        if self.lock:
            navigator.command(self.order(twist))
        else:
            navigator.move(twist)

    def _onto_line(self, robot: Pose2, radius: float) -> Twist:
        """The same by bends no tighter than `radius` [m], 0 for any."""
        speed = min(APPROACH_SPEED, max(CREEP_SPEED, 0.4 * (-robot.x - self.front)))
        if radius:
            # its front is what has to come to the line, and what is seen of the dock's direction tells least there
            swung = max(-MAX_SWING, min(MAX_SWING, math.atan2(-self.aside(robot), FRONT_AHEAD) - robot.yaw))
            bend = max(-1.0 / radius, min(1.0 / radius, math.tan(swung) / self.front))
            return Twist.planar(speed, speed * bend)
        bearing = wrap(math.atan2(-robot.y, AHEAD) - robot.yaw)
        if abs(bearing) > MAX_BEARING:
            return Twist.planar(0.0, math.copysign(MAX_TURN, bearing))
        turn = 2.0 * speed * math.sin(bearing) / math.hypot(AHEAD, robot.y)
        return Twist.planar(speed, max(-MAX_TURN, min(MAX_TURN, turn)))

    def order(self, twist: Twist) -> Manoeuvre:
        """What `twist` is to one that steers: speed and angle of its wheels, since a slow one may turn less than a twist says."""
        bend = twist.angular.z / twist.linear.x
        angle = math.atan(math.tan(self.lock) * bend * self.min_radius)
        return Manoeuvre(kind="steer", speed=twist.linear.x, steering=angle)

    def aside(self, robot: Pose2) -> float:
        """Of the robot's front off the dock's line, to the left [m]."""
        return robot.y + self.front * math.sin(robot.yaw)

    def off(self, robot: Pose2) -> bool:
        """What is to touch the dock is too far off its line, or the robot too askew, to go on."""
        return abs(self.aside(robot)) > MAX_ASIDE or abs(robot.yaw) > MAX_ASKEW

    def blocked(self, points: Points, dock: Pose2, gap: float = ALIGN_GAP) -> bool:
        """One of the `points` stands between the robot and the `dock`, both in `base_link`.

        One that only bends looks along its bends, as far as to `gap` before the dock [m].
        """
        off = dock.inverse().apply(points)
        short = off[:, 0] < -FACE_ROOM
        if self.min_radius:
            return self._meets(points[short], dock, gap)
        within = (points[:, 0] > self.front) & (np.abs(points[:, 1]) < self.half + SIDE_ROOM)
        return bool(np.any(within & short))

    def _meets(self, points: Points, dock: Pose2, gap: float) -> bool:
        """Its body comes to one of the `points` that it is not at already."""
        way = self._rolled(dock.inverse(), self.min_radius, gap)[::TRIED]
        x, y, yaw = np.array([dock.then(pose) for pose in way]).T[..., None]
        ahead = np.cos(yaw) * (points[:, 0] - x) + np.sin(yaw) * (points[:, 1] - y)
        aside = np.cos(yaw) * (points[:, 1] - y) - np.sin(yaw) * (points[:, 0] - x)
        within = (ahead > -self.rear) & (ahead < self.front) & (np.abs(aside) < self.half + SIDE_ROOM)
        return bool(np.any(within.any(axis=0) & ~within[0]))

    def taken(self, points: Points, dock: Pose2) -> bool:
        """Something stands where the robot would stand at the `dock`, in `base_link`."""
        off = dock.inverse().apply(points)
        beside = np.abs(off[:, 1]) < self.half + SIDE_ROOM
        return bool(np.any(beside & (off[:, 0] < -FACE_ROOM) & (off[:, 0] > -FACE_ROOM - 2 * self.front)))

    def room_behind(self, points: Points) -> float:
        """As far as it can go straight back [m]; infinite where nothing is seen."""
        behind = points[(points[:, 0] < -0.5 * self.rear) & (np.abs(points[:, 1]) < self.half + SIDE_ROOM)]
        return float(np.min(-behind[:, 0])) - self.rear if len(behind) else math.inf
