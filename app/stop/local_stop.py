"""STOP of a robot that has none of its own: zero speed is sent for as long as it is latched here, and odometry is the witness.

Nothing here is sent; the link does that. This says what is known of it.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from app.stop.stop_state import StopFacts, judge, silence
from bridge.msgs.nav_msgs import Odometry
from widgets.core.language import tr

__all__ = ["LocalStop"]

MAX_RESTING_SPEED, MAX_RESTING_TURN = 0.02, 0.03
"""A robot slower than this rests [m/s, rad/s]: odometry of real wheels trembles."""
REST_DURATION = 0.3
"""So long its odometry must say so [s]."""
ODOMETRY_TIMEOUT = 1.0
"""Odometry older than this says nothing of now [s]."""


class LocalStop:
    """What the operator may be told of a STOP that this handheld alone holds."""

    def __init__(self, now: Callable[[], float]) -> None:
        """`now` is our clock [s]."""
        self._now = now
        self._pressed_at = math.nan
        self._heard_at = self._rests_since = math.nan
        self._first_at = math.nan

    @property
    def latched(self) -> bool:
        """It was pressed and not released."""
        return not math.isnan(self._pressed_at)

    def press(self) -> None:
        """STOP was pressed; again while it is latched changes nothing."""
        if not self.latched:
            self._pressed_at, self._first_at = self._now(), math.nan

    def release(self) -> None:
        """It was held long enough."""
        self._pressed_at = math.nan

    def on_odometry(self, odometry: Odometry, received: float) -> None:
        """Odometry came at `received` [s], our clock. A speed that is not finite confirms nothing."""
        linear, angular = odometry.twist.twist.linear, odometry.twist.twist.angular
        speed = math.hypot(linear.x, linear.y, linear.z)
        turning = math.hypot(angular.x, angular.y, angular.z)
        self._heard_at = received
        if math.isnan(self._first_at) and self.latched and received >= self._pressed_at:
            self._first_at = received
        if not (speed < MAX_RESTING_SPEED and turning < MAX_RESTING_TURN):
            self._rests_since = math.nan
        elif math.isnan(self._rests_since):
            self._rests_since = received

    @property
    def _confirmed(self) -> bool:
        """Odometry that came since the press, and is young, says that it rests."""
        if math.isnan(self._rests_since) or math.isnan(self._first_at):
            return False
        rested = self._heard_at - max(self._rests_since, self._first_at)
        return rested >= REST_DURATION and self._now() - self._heard_at < ODOMETRY_TIMEOUT

    @property
    def phase(self) -> str:
        """As of `stop_state.Verdict`, with odometry for what the robot says: `ready`, `sent`, `stopped` or `no_answer`."""
        if not self.latched:
            return "ready"
        rests = self._confirmed
        return judge(StopFacts(self._pressed_at, latched=rests or None, at_rest=rests), self._now()).phase

    def sentence(self, drives: bool, reaches: bool = True) -> str:
        """What is the case, for the operator; empty while it is not latched.

        `drives`: there is a topic to send on. `reaches`: the link stands, so that what is sent can arrive.
        """
        if not self.latched:
            return ""
        if not drives:
            return tr(
                "This robot has no STOP of its own and no topic to drive it by: it cannot be stopped from here."
            )
        if not reaches:
            return tr("Nothing reaches it until the link is back. {witness}").format(witness=self._witness)
        return tr("No STOP of its own: zero speed is sent while the link stands. {witness}").format(
            witness=self._witness
        )

    @property
    def _witness(self) -> str:
        """What odometry says of its rest."""
        age = self._now() - self._heard_at
        if math.isnan(age):
            return tr("No odometry has come that could confirm that it rests.")
        if age >= ODOMETRY_TIMEOUT:
            return tr("Its odometry was last heard {age} ago.").format(age=silence(age))
        if self._confirmed:
            return tr("Its odometry says that it rests.")
        return tr("Its odometry does not yet say that it rests.")
