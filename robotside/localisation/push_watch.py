"""The watch for wheels that turn in vain: without a laser a robot does not see that something holds it."""

from __future__ import annotations

import math

from bridge.msgs.pilothouse_msgs import Bumper

__all__ = ["PushWatch"]

MAX_PUSH = 0.3
"""Distance that the wheels may turn against an obstacle before it is reported [m]."""


class PushWatch:
    """Remembers what is in touch, and how far the wheels have turned against it."""

    def __init__(self, *, rolls: bool) -> None:
        """`rolls` for a robot on wheels or tracks: what touches any other one pushes it aside."""
        self._rolls = rolls
        self._touch: Bumper | None = None
        self._pushed = 0.0

    @property
    def pushes(self) -> bool:
        """The wheels turn against something and the robot does not get on."""
        return self._pushed > MAX_PUSH

    @property
    def began(self) -> bool:
        """The last step led against something, be it ever so little."""
        return self._pushed > 0.0

    def on_bumper(self, bumper: Bumper) -> None:
        """Remember what is in touch."""
        self._touch = bumper if bumper.pressed and self._rolls else None

    def bearing(self, speed: float) -> float:
        """Of what it may push against at `speed` [m/s], in [rad]; NaN for nothing. One without a bearing lies ahead of its way."""
        if self._touch is None:
            return math.nan
        bearing = self._touch.bearing
        return bearing if math.isfinite(bearing) else 0.0 if speed >= 0 else math.pi

    def on_step(self, into: float) -> None:
        """The wheels went on `into` something [m]; a step that did not ends the push."""
        self._pushed = self._pushed + into if into > 0 else 0.0
