"""Steering of a boat before its jetty: along its line, over ground so fast as it should, whatever wind, current and waves do to it.

Pure: what the boat measures is passed in. All is in the frame of the jetty, which looks into it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from robotside.core.pose2 import Pose2
from robotside.motion.speed_limit import within

__all__ = ["JettySteering", "Push"]

ASIDE_GAIN, MAX_ASIDE_SPEED = 0.3, 0.25
"""Wanted speed towards the line for a way off it [1/s], and the most [m/s]."""

LEAST_WAY = 0.12
"""The least speed by which a heading turns into a way aside [m/s]: slower, it would have to look too far aside."""

DAMPING = 1.0
"""Push against a speed along the line that is not wanted, for each m/s of it: waves surge."""

STREAM_GAIN, MAX_STREAM = 0.25, 0.30
"""How fast what carries it is learnt [1/s], and the most that is believed [m/s]."""

MAX_ASTERN = 0.4
"""It pushes astern no more than for this speed through the water [m/s]."""

MAX_TURN, MAX_ASKEW = 0.12, 0.7
"""While it turns faster, or looks farther off the line, it slides, which is no stream [rad/s, rad]."""

MAX_STEP = 0.5
"""Longer between two orders than this, it was left alone [s]."""


class Push(NamedTuple):
    """What it is to do."""

    yaw: float
    """To look so far off the jetty's direction [rad]."""
    speed: float
    """Through the water [m/s], negative is astern."""


class JettySteering:
    """Steers one boat; it knows what carries it from how it fares."""

    def __init__(self) -> None:
        self.begin()

    def begin(self) -> None:
        """Know nothing of what carries it."""
        self._stream = (0.0, 0.0)
        self._speed, self._told = math.nan, -math.inf

    def line(
        self, robot: Pose2, off: float, moving: Pose2, ahead: float, *, most: float, way: float, now: float
    ) -> Push:
        """Go `ahead` along the line [m/s], looking aside no farther than `most` for what its bow is `off` it [m, rad]; `now` is in [s].

        `moving` is its speed over ground along the line and to the left [m/s], and how fast it turns [rad/s].
        Through the water it makes at least `way` [m/s], so that its rudder has something to work with.
        """
        self._learn(robot, moving, now)
        self._speed = max(way, ahead - self._stream[0])
        towards = within(-ASIDE_GAIN * off, MAX_ASIDE_SPEED)
        aside = (towards - self._stream[1]) / max(LEAST_WAY, self._speed)
        yaw = within(math.asin(within(aside, 1.0)), most)
        return Push(yaw, self._damped(robot, moving))

    def straight(self, robot: Pose2, moving: Pose2, ahead: float, now: float) -> float:
        """Through the water [m/s], to go `ahead` over ground [m/s] with the rudder amidships; `now` is in [s]."""
        self._learn(robot, moving, now)
        self._speed = ahead - self._stream[0]
        return self._damped(robot, moving)

    def _damped(self, robot: Pose2, moving: Pose2) -> float:
        """What is told for the speed through the water that is wanted, for waves surge."""
        x, y = math.cos(robot.yaw), math.sin(robot.yaw)
        carried = x * self._stream[0] + y * self._stream[1]
        lacks = self._speed + carried - x * moving.x - y * moving.y
        return max(-MAX_ASTERN, self._speed + DAMPING * lacks)

    def lie(self) -> None:
        """What holds it now is not the water: nothing is learnt from that."""
        self._speed = math.nan

    def _learn(self, robot: Pose2, moving: Pose2, now: float) -> None:
        """What carries it is what it goes beside what it was told."""
        step, self._told = now - self._told, now
        slides = abs(moving.yaw) > MAX_TURN or abs(robot.yaw) > MAX_ASKEW
        if slides or not (step < MAX_STEP and math.isfinite(self._speed)):
            return
        x, y = self._speed * math.cos(robot.yaw), self._speed * math.sin(robot.yaw)
        gain = STREAM_GAIN * step
        self._stream = (
            within(self._stream[0] + gain * (moving.x - x - self._stream[0]), MAX_STREAM),
            within(self._stream[1] + gain * (moving.y - y - self._stream[1]), MAX_STREAM),
        )
