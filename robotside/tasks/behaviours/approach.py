"""The last metres to a dock on wheels: how they are steered, what is in the way, and where they begin."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bridge.core.units import wrap
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.core.pose2 import Points, Pose2
from robotside.kinds.registry import kind_of

__all__ = ["CREEP_SPEED", "DOCK_NEAR", "RETREAT_SPEED", "Approach"]

CREEP_SPEED = 0.08
"""On the last bit [m/s]."""

RETREAT_SPEED = 0.12
"""Backwards, away from a dock [m/s]."""

APPROACH_SPEED = 0.25
"""Farther away [m/s]."""

MAX_TURN = 0.4
"""While it goes there [rad/s]."""

MAX_BEARING = 0.6
"""Off its line by more than this, a robot that turns on the spot turns first [rad]."""

DOCK_NEAR = 1.5
"""With contact no farther than this from the place of a dock it stands in that dock [m]."""

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

    leave: float = 0.7
    """As far back it goes to leave a dock [m]."""

    @classmethod
    def of(cls, info: RobotInfo) -> Approach:
        """That of a robot."""
        front = max((corner.x for corner in info.footprint), default=info.radius)
        rear = -min((corner.x for corner in info.footprint), default=-info.radius)
        half = max((abs(corner.y) for corner in info.footprint), default=info.radius)
        away = (6.0, 5.0, 4.0) if info.min_radius > 0 else (2.0, 1.6, 1.2, 0.8)
        swims = kind_of(info.kind).docks == "cage"  # it turns only clear of the cage
        leave = 2.0 if info.min_radius > 0 else 1.3 if swims else 0.7
        return cls(front, rear, half, info.min_radius, away, leave)

    def steer(self, robot: Pose2) -> Twist:
        """The next bit of the way of a `robot`, whose pose is in the dock's frame."""
        gap = -robot.x - self.front
        ahead = 1.5 if self.min_radius else 0.5
        bearing = wrap(math.atan2(-robot.y, ahead) - robot.yaw)
        speed = min(APPROACH_SPEED, max(CREEP_SPEED, 0.4 * gap))
        if not self.min_radius and abs(bearing) > MAX_BEARING:
            return Twist.planar(0.0, math.copysign(MAX_TURN, bearing))
        most = speed / self.min_radius if self.min_radius else MAX_TURN
        turn = 2.0 * speed * math.sin(bearing) / math.hypot(ahead, robot.y)
        return Twist.planar(speed, max(-most, min(most, turn)))

    def blocked(self, points: Points, dock: Pose2) -> bool:
        """One of the `points` stands between the robot and the `dock`, both in `base_link`."""
        off = dock.inverse().apply(points)
        within = (points[:, 0] > self.front) & (np.abs(points[:, 1]) < self.half + SIDE_ROOM)
        return bool(np.any(within & (off[:, 0] < -FACE_ROOM)))

    def taken(self, points: Points, dock: Pose2) -> bool:
        """Something stands where the robot would stand at the `dock`, in `base_link`."""
        off = dock.inverse().apply(points)
        beside = np.abs(off[:, 1]) < self.half + SIDE_ROOM
        return bool(np.any(beside & (off[:, 0] < -FACE_ROOM) & (off[:, 0] > -FACE_ROOM - 2 * self.front)))

    def room_behind(self, points: Points) -> float:
        """As far as it can go straight back [m]; infinite where nothing is seen."""
        behind = points[(points[:, 0] < -0.5 * self.rear) & (np.abs(points[:, 1]) < self.half + SIDE_ROOM)]
        return float(np.min(-behind[:, 0])) - self.rear if len(behind) else math.inf
