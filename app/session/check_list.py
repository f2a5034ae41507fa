"""State of the check list: unfolded until the robot first moves, afterwards as the operator chooses; and whether it is over."""

from __future__ import annotations

import math
from collections.abc import Callable

from app.link.feeds import Feeds
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Checklist

__all__ = ["CheckListState"]

MIN_MOVING_SPEED = 0.05
"""A robot is on its way at this speed [m/s], or turning at this rate [rad/s]."""


class CheckListState:
    """One robot's check list on every screen that shows it. Everything here happens in the UI thread."""

    def __init__(self, feeds: Feeds, running: Callable[[], bool]) -> None:
        """`running` tells whether a task runs."""
        self._feeds, self._running = feeds, running
        self._chosen: bool | None = None
        """What a finger wanted last; None while nothing, or before something that folds it."""
        self._moved = self._was_ready = False

    @property
    def ready(self) -> bool:
        """The robot has told its list, and all on it is good."""
        told: Checklist | None = self._feeds.latest("/checklist")
        return told is not None and bool(told.checks) and all(check.state == "ok" for check in told.checks)

    @property
    def open(self) -> bool:
        """Its sentences are to be read."""
        return not (self.ready or self._moved) if self._chosen is None else self._chosen

    @property
    def moved(self) -> bool:
        """The robot has moved since it was met."""
        return self._moved

    @property
    def over(self) -> bool:
        """The robot has moved and nothing on the list is bad: it need not lie over a picture any longer."""
        told: Checklist | None = self._feeds.latest("/checklist")
        bad = told is not None and any(check.state == "bad" for check in told.checks)
        return self._moved and not bad and not self._chosen

    def choose(self, unfold: bool) -> None:
        """A finger folded or unfolded it."""
        self._chosen = unfold

    def update(self) -> None:
        """Fold it when the robot first moves and when all has become good; called as time passes."""
        moves, ready = self._moved or self.moves, self.ready
        if moves != self._moved or (ready and not self._was_ready):
            self._chosen = None
        self._moved, self._was_ready = moves, ready

    @property
    def moves(self) -> bool:
        """The robot is on its way or turns, by its odometry; without any, a task runs."""
        told: Odometry | None = self._feeds.latest("/odom")
        if told is None:
            return self._running()
        v, turn = told.twist.twist.linear, told.twist.twist.angular.z
        return self._running() or math.hypot(v.x, v.y, v.z) > MIN_MOVING_SPEED or abs(turn) > MIN_MOVING_SPEED
