"""Forward and inverse kinematics of an arm with four or five joints, both in closed form.

The first joint turns about z, the next three about y, positive downward. The fifth, where there is one, turns the hand about
its own length, which moves the tip nowhere. Lengths in [m], angles in [rad].
"""

from __future__ import annotations

import math
from typing import NamedTuple

from sim.core.shapes import Vec3

__all__ = ["BENDING", "Angles", "Arm", "Reach"]

BENDING = 4
"""Joints that move the tip."""

Angles = tuple[float, ...]
"""Of the joints from the foot on."""


class Reach(NamedTuple):
    """Pose of the hand."""

    tip: Vec3
    """In the frame of the foot."""
    pitch: float
    """Of the hand, positive pointing down."""


class Arm(NamedTuple):
    """The lengths and limits of an arm."""

    foot: tuple[float, float]
    """Ahead of and above the foot's origin: the second joint."""
    upper: tuple[float, float]
    """From the second to the third joint, ahead and up, while all angles are 0."""
    fore: float
    """From the third to the fourth joint."""
    hand: float
    """From the fourth joint to the tip."""
    limits: tuple[tuple[float, float], ...]
    """Least and greatest angle of each joint."""

    @property
    def elbows(self) -> tuple[float, float]:
        """Length of the upper arm, and its angle above the level while all joints are at 0."""
        return math.hypot(*self.upper), math.atan2(self.upper[1], self.upper[0])

    def points(self, angles: Angles) -> tuple[Vec3, Vec3, Vec3, Vec3]:
        """Second, third and fourth joint, and the tip, in the frame of the foot."""
        turn, *bends = angles[:BENDING]
        length, rise = self.elbows
        out, up = self.foot[0], self.foot[1]
        places = [(out, up)]
        for reach, angle in (
            (length, rise - bends[0]),
            (self.fore, -bends[0] - bends[1]),
            (self.hand, -sum(bends)),
        ):
            # only the part beyond the first joint turns with it
            out, up = out + reach * math.cos(angle), up + reach * math.sin(angle)
            places.append((out, up))
        axis = self.foot[0]
        first, second, third, tip = (
            (axis + (far - axis) * math.cos(turn), (far - axis) * math.sin(turn), high)
            for far, high in places
        )
        return first, second, third, tip

    def forward(self, angles: Angles) -> Reach:
        """Pose of the hand at these angles."""
        return Reach(self.points(angles)[3], sum(angles[1:BENDING]))

    def allowed(self, angles: Angles) -> bool:
        """All joints are there, and each is within its limits."""
        return len(angles) == len(self.limits) and self.beyond(angles) is None

    def beyond(self, angles: Angles) -> int | None:
        """Number of the first joint whose angle is beyond its limits or no number; None when there is none."""
        for number, (angle, (low, high)) in enumerate(zip(angles, self.limits, strict=False)):
            if not low - 1e-9 <= angle <= high + 1e-9:
                return number
        return None

    def inverse(self, tip: Vec3, pitch: float = math.nan) -> Angles | None:
        """Angles of the first four joints that put the tip there with the hand at `pitch`; None when none do.

        Elbow up goes before elbow down. With `pitch` NaN it takes the hand nearest to the level that gets there.
        """
        if not math.isnan(pitch):
            return self._with_pitch(tip, pitch)
        for number in range(2 * _PITCHES):
            tried = (number + 1) // 2 * (math.pi / 2 / _PITCHES) * (1 if number % 2 else -1)
            found = self._with_pitch(tip, tried)
            if found is not None:
                return found
        return None

    def _with_pitch(self, tip: Vec3, pitch: float) -> Angles | None:
        length, rise = self.elbows
        x, y, z = tip[0] - self.foot[0], tip[1], tip[2] - self.foot[1]
        far, turn = math.hypot(x, y), math.atan2(y, x)
        for side, towards in ((1, turn), (-1, math.remainder(turn + math.pi, math.tau))):
            # the second way reaches back over the foot
            out, up = side * far - self.hand * math.cos(pitch), z + self.hand * math.sin(pitch)
            away = math.hypot(out, up)
            if not abs(length - self.fore) <= away <= length + self.fore or away < 1e-9:
                continue
            bend = math.acos(min(1.0, max(-1.0, (length**2 + away**2 - self.fore**2) / (2 * length * away))))
            for elbow in (bend, -bend):
                upper = math.atan2(up, out) + elbow
                fore = math.atan2(up - length * math.sin(upper), out - length * math.cos(upper))
                second = math.remainder(rise - upper, math.tau)
                third = math.remainder(-fore - second, math.tau)
                fourth = math.remainder(pitch - second - third, math.tau)
                angles = (towards, second, third, fourth)
                if self.beyond(angles) is None:
                    return angles
        return None


_PITCHES = 18
"""Hands tried between level and straight up or down."""
