"""Speed at the end of each control's way: the robot's limits, and the share of them that the slider leaves."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from app.link.control_mixer import Reach
from app.screens.drive.speed_card import SpeedCard, allowed
from app.session.session import Session

__all__ = ["ControlReach"]

FIRST_SHARE = 0.6
"""Share of the robot's greatest speed that the slider begins with."""
DEFAULT_REACH = Reach()
"""Ends of the controls where the robot does not publish its limits."""


class ControlReach:
    """The slider, where a layout has one, and what the controls mean at the end of their way."""

    def __init__(self, session: Session, on_change: Callable[[], object]) -> None:
        """`on_change` is called when the ends are others."""
        self._session, self._on_change = session, on_change
        self.speed: SpeedCard | None = None
        """The slider; None where the layout has none."""
        self.reach = DEFAULT_REACH
        """The ends now."""
        self.ends: dict[str, float] = {}
        """Fields of the sticks that show the ends, by name; empty before the limits are known."""
        self._limited = False
        """The robot's own limits have set the slider once."""

    def make_slider(self) -> SpeedCard:
        """Make the slider."""
        self.speed = SpeedCard()
        self.speed.bind(maximum_speed=self._limit)
        return self.speed

    def update(self) -> None:
        """The robot's limits came: the slider's range is theirs; where it stood is kept."""
        limits, info = self._session.feeds.latest("/limits"), self._session.robot.info
        fastest, _ = allowed(info, limits)
        if self.speed is not None:
            self._range(self.speed, fastest)
        self._limited = self._limited or bool(info.max_speed)
        self._limit()

    def _range(self, speed: SpeedCard, fastest: float) -> None:
        limits = self._session.feeds.latest("/limits")
        speed.speed_limit = limits.max_speed if limits is not None else math.nan
        speed.turn_limit = limits.max_yaw_rate if limits is not None else math.nan
        fader = speed.ids.fader
        if self._limited and fader.maximum == fastest:
            return
        fader.minimum, fader.maximum, fader.step = fastest / 10, fastest, 0.0
        wanted = speed.maximum_speed if self._limited else fastest * FIRST_SHARE
        fader.value = min(max(wanted, fader.minimum), fastest)
        speed.maximum_speed = fader.value

    def _limit(self, *_: object) -> None:
        """Slow on the slider is slow in everything but turning, which is never below half, and steering, which is whole."""
        info = self._session.robot.info
        fastest, turn = allowed(info, self._session.feeds.latest("/limits"))
        speed = self.speed.maximum_speed if self.speed is not None else fastest
        share = min(1.0, speed / fastest)
        self.reach = Reach(
            speed=speed,
            yaw_rate=turn * (0.5 + 0.5 * share),
            climb=info.max_climb * share,
            tilt=(info.max_tilt or DEFAULT_REACH.tilt) * share,
            steering=info.max_steering or DEFAULT_REACH.steering,
        )
        self.ends = {
            "max_speed": speed,
            "max_yaw_rate": self.reach.yaw_rate,
            "max_tilt": self.reach.tilt,
            "max_steering": self.reach.steering,
            "most": share,
        }
        self._on_change()

    def show_on(self, stick: Any) -> None:
        """Give a stick the ends that it shows."""
        for name, end in self.ends.items():
            if hasattr(stick, name):
                setattr(stick, name, end)
