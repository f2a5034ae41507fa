"""Additions to generated message classes: methods, in base classes without fields, and other names.

`bridge/generate/extras.py` lists the classes that each of these is added to.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Self

import msgspec

from bridge.msgs.base import Msg

__all__ = [
    "DETECTED_CLASSES",
    "INTRUDER_CLASSES",
    "MAX_DWELL",
    "MANOEUVRES",
    "MAX_LAPS",
    "MOTIONS",
    "PLACE_KINDS",
    "REACTIONS",
    "TASKS",
    "Quaternion",
    "Twist",
    "zeros36",
]

MOTIONS = ("loop", "random", "intermittent")
"""Orders and pauses in which a mission's points are visited."""
MAX_DWELL = 600.0
"""Longest stay at a point in intermittent motion [s]."""
MANOEUVRES = ("twist", "steer", "course", "tilt", "hover", "take_off", "land", "surface", "rest")
"""Kinds of manoeuvres of all robots."""
MAX_LAPS = 999
"""Most rounds of a mission."""
PLACE_KINDS = ("place", "office", "home", "dock", "reception", "lab", "hall")
"""Kinds of named places."""
REACTIONS = ("stop", "report", "circle")
"""Reactions of a patrol to an intruder: halt, only report it, or circle it once with the camera on it, then continue."""
DETECTED_CLASSES = ("cone", "person", "car", "box")
"""Classes of things that a robot's camera tells apart; a box is a crate, a carton or a barrel that stands free."""
INTRUDER_CLASSES = ("person", "cone")
"""Classes that count as intruders on a patrol whose mission names none."""
TASKS = (
    "patrol",
    "deliver",
    "guide",
    "go_to",
    "go_home",
    "hold",
    "follow_heading",
    "dock",
    "undock",
    "take_off",
    "land",
    "surface",
)
"""Tasks of all robots."""


def zeros36() -> list[float]:
    """An empty 6 x 6 covariance, row by row."""
    return [0.0] * 36


class Quaternion(Msg, frozen=True, gc=False):
    """Methods of a quaternion."""

    if TYPE_CHECKING:
        x: float
        y: float
        z: float
        w: float

    @property
    def roll(self) -> float:
        """Rotation about x [rad], -pi to pi."""
        x, y, z, w = self.x, self.y, self.z, self.w
        return math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))

    @property
    def pitch(self) -> float:
        """Rotation about y [rad], -pi/2 to pi/2; positive is nose down (REP-103)."""
        return math.asin(max(-1.0, min(1.0, 2 * (self.w * self.y - self.z * self.x))))

    @property
    def yaw(self) -> float:
        """Rotation about z [rad], -pi to pi; 0 is east, anticlockwise."""
        x, y, z, w = self.x, self.y, self.z, self.w
        return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))

    @classmethod
    def from_yaw(cls, yaw: float) -> Self:
        """The level orientation that points to `yaw` [rad]."""
        return cls(0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))

    @classmethod
    def from_rpy(cls, roll: float, pitch: float, yaw: float) -> Self:
        """The orientation after turning by roll, pitch and yaw [rad] about fixed x, y and z."""
        cr, sr = math.cos(roll / 2), math.sin(roll / 2)
        cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
        cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
        return cls(
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy,
        )


class Twist(Msg, frozen=True, gc=False):
    """Methods of a twist."""

    if TYPE_CHECKING:
        linear: Msg = Msg()
        angular: Msg = Msg()

    @classmethod
    def planar(cls, forward: float, turn: float) -> Self:
        """A ground robot's twist: `forward` [m/s] along x and `turn` [rad/s] about z."""
        rest, replace = cls(), msgspec.structs.replace
        return cls(replace(rest.linear, x=forward), replace(rest.angular, z=turn))
