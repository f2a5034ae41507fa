"""Steering before a cage of one that glides: its fins push only the way that it looks, and what it has aside it keeps.

Pure: what the robot measures is passed in. All is in the frame of the cage, which looks into it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from bridge.core.units import wrap
from robotside.core.pose2 import Pose2
from robotside.motion.speed_limit import within

__all__ = ["SLIDE", "CageSteering", "Push", "Velocity"]

KEEP_GAIN, MAX_KEEP_SPEED = 0.3, 0.12
"""Wanted speed for a way off the point that is kept [1/s], and the most [m/s]."""

SLIDE = 0.02
"""A speed that is off by more is worth looking along it, to push or to brake [m/s]."""

NEAR = 0.05
"""So near to the point it is there [m]."""

ROOM = 0.5
"""Ahead and astern of the point it has so much room [m]: it needs that to come aside."""

MAX_LOOK, SIDEWAYS = 0.6, 1.1
"""It looks aside no farther than the first for that, so that it sees the tag, and goes astern instead; what is off by more than the
second is aside of it, and either way does [rad]."""

MAX_OFF_COURSE = 0.3
"""Turned away from where it is to look by more, it does not push [rad]."""

ASIDE_GAIN, MAX_ASIDE_SPEED = 0.25, 0.10
"""On the line: wanted speed towards it for a way off it [1/s], and the most [m/s]."""

DAMPING = 2.0
"""Push against a speed aside that is not wanted, for each m/s of it [m/s]."""

LEAST_PUSH = 0.10
"""The least speed by which a bearing turns into a push [m/s]: slower, it would have to look too far aside."""

STREAM_GAIN, MAX_STREAM = 0.15, 0.30
"""How fast what the stream does is learnt [1/s], and the most that is believed [m/s]."""

MAX_STEP = 0.5
"""Longer between two orders than this, it was left alone [s]."""

Velocity = tuple[float, float]
"""Over ground, ahead along the cage's direction and to the left of it [m/s]."""


class Push(NamedTuple):
    """What it is to do."""

    yaw: float
    """To look so far off the cage's direction [rad]."""
    speed: float
    """Through the water [m/s], negative is astern."""


class CageSteering:
    """Steers one robot, against what the water and its own way do to it."""

    def __init__(self) -> None:
        self.begin()

    def begin(self) -> None:
        """Know nothing of the stream."""
        self._stream = (0.0, 0.0)
        self._speed, self._told = math.nan, -math.inf

    def keep(
        self, robot: Pose2, moving: Velocity, point: tuple[float, float], look: float, now: float
    ) -> Push:
        """Go to a `point` [m] and come to rest there: along its own axis, ahead or astern, for it cannot push aside.

        It looks off the cage's direction by `look` [rad] where there is nothing to push for. `now` is in [s].
        """
        self._learn(robot, moving, now)
        ahead = point[0] - robot.x
        away = math.copysign(max(0.0, abs(ahead) - ROOM), ahead), point[1] - robot.y
        far = math.hypot(*away)
        share = min(KEEP_GAIN, MAX_KEEP_SPEED / far) if far > NEAR else 0.0
        wanted = share * away[0], share * away[1]
        off = wanted[0] - moving[0], wanted[1] - moving[1]
        if math.hypot(*off) <= SLIDE:
            return self._push(robot, wanted, look)
        axis = self._axis(robot, off, ahead)
        yaw = within(axis, MAX_LOOK)
        if abs(wrap(robot.yaw - yaw)) > MAX_OFF_COURSE:
            wanted = 0.0, 0.0  # not yet
        elif abs(axis) > MAX_LOOK:
            wanted = self._aslant(robot, moving, wanted[1])
        return self._push(robot, wanted, yaw)

    def _aslant(self, robot: Pose2, moving: Velocity, aside: float) -> Velocity:
        """The speed along its axis by which, with what it slides beside that, it goes `aside` as it should [m/s]."""
        x, y = math.cos(robot.yaw), math.sin(robot.yaw)
        slides = x * moving[1] - y * moving[0]
        speed = within((aside - x * slides) / y, MAX_KEEP_SPEED)
        return speed * x, speed * y

    def _axis(self, robot: Pose2, off: Velocity, ahead: float) -> float:
        """To look so that a push ahead or astern is against what is `off`; to the side where it comes nearer to the point by it [rad]."""
        bearing = math.atan2(off[1], off[0])
        folded = math.remainder(bearing, math.pi)
        if abs(folded) < SIDEWAYS:
            return folded
        if abs(robot.yaw) > MAX_OFF_COURSE:
            return math.copysign(folded, robot.yaw)
        return math.copysign(folded, ahead * off[1])

    def line(self, robot: Pose2, moving: Velocity, ahead: float, most: float, now: float) -> Push:
        """Go `ahead` along the line of the cage [m/s], negative is back, looking aside no farther than `most` [rad]; `now` is in [s]."""
        self._learn(robot, moving, now)
        along = ahead - self._stream[0]
        towards = within(-ASIDE_GAIN * robot.y, MAX_ASIDE_SPEED)
        aside = towards + DAMPING * (towards - moving[1])
        way = math.copysign(1.0, along)
        yaw = within(math.atan2(way * aside, max(abs(along), LEAST_PUSH)), most)
        return self._push(robot, (ahead, 0.0), yaw)

    def lean(self, speed: float) -> Push:
        """Push ahead against what holds it, by a `speed` that it would have through still water [m/s]; the stream is not learnt from that."""
        self._speed = math.nan
        return Push(0.0, speed)

    def _push(self, robot: Pose2, wanted: Velocity, yaw: float) -> Push:
        """Of the `wanted` speed over ground what its axis can give."""
        x, y = math.cos(robot.yaw), math.sin(robot.yaw)
        stream = self._stream
        self._speed = x * (wanted[0] - stream[0]) + y * (wanted[1] - stream[1])
        return Push(yaw, self._speed)

    def _learn(self, robot: Pose2, moving: Velocity, now: float) -> None:
        """The stream is what it goes along its axis beside what it pushes."""
        step, self._told = now - self._told, now
        if not (step < MAX_STEP and math.isfinite(self._speed)):
            return
        x, y = math.cos(robot.yaw), math.sin(robot.yaw)
        stream = self._stream
        beside = x * (moving[0] - stream[0]) + y * (moving[1] - stream[1]) - self._speed
        gain = STREAM_GAIN * step * beside
        self._stream = within(stream[0] + gain * x, MAX_STREAM), within(stream[1] + gain * y, MAX_STREAM)
