"""Vertical manoeuvres: taking off, landing and surfacing."""

from __future__ import annotations

import math

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.core.notice import Notice
from robotside.navigation.navigator import Navigator
from robotside.tasks.behaviours.situation import Situation

__all__ = ["Land", "Surface", "TakeOff"]

TAKE_OFF_TIMEOUT, LANDING_TIMEOUT, SURFACING_TIMEOUT = 60.0, 150.0, 300.0
"""To take off, to land and to surface takes no longer [s]."""

MIN_RISE, RISE_TIMEOUT = 0.1, 20.0
"""To take off, it comes nearer to its height by so much [m] within so long [s]; otherwise there is something that holds it."""

HEIGHT_TOLERANCE = 0.25
"""It has reached its height within this [m]."""

SURFACE_HEIGHT = -0.12
"""A swimmer above this lies at the surface [m]."""


class _UpAndDown(Behaviour):
    """Gives an order again and again until that is done, and rests at any other ending."""

    title, order, lasts = "", "", math.inf

    def __init__(self, navigator: Navigator, situation: Situation, height: float = math.nan) -> None:
        """`height` is that of the order [m], NaN for none."""
        super().__init__(self.order.replace("_", " "))
        self._navigator, self._situation, self._height = navigator, situation, height
        self._began = 0.0

    def initialise(self) -> None:
        """Begin where it is."""
        self._began = self._situation.worked

    def update(self) -> Status:
        """Go on."""
        now = self._situation
        if self.done():
            return Status.SUCCESS
        if now.worked - self._began > self.lasts:
            said = f"{self.title} took longer than {self.lasts:.0f} s; the robot stays where it is."
            self._navigator.reason = Notice(Code.TASK_SLOW, said, seconds=self.lasts)
            return Status.FAILURE
        now.report(self.title.lower(), f"{self.title}.", still=math.nan)
        self.tell_robot()
        return Status.RUNNING

    def terminate(self, new_status: Status) -> None:
        """Stay there."""
        if new_status is not Status.SUCCESS:
            self._navigator.rest()

    def done(self) -> bool:
        """It is up, or down."""
        raise NotImplementedError

    def tell_robot(self) -> None:
        """Give the order."""
        self._navigator.command(Manoeuvre(kind=self.order))


class TakeOff(_UpAndDown):
    """Succeeds in the air; one that flies already goes to the height that is asked for."""

    title, order, lasts = "Taking off", "take_off", TAKE_OFF_TIMEOUT

    _nearest, _since = math.inf, 0.0

    def initialise(self) -> None:
        """Begin where it is."""
        super().initialise()
        self._nearest, self._since = math.inf, self._began

    def update(self) -> Status:
        """Go on, as long as it gets on."""
        status, now = super().update(), self._situation.worked
        off = abs(self._navigator.height - self._height)
        if off < self._nearest - MIN_RISE:
            self._nearest, self._since = off, now
        if status is not Status.RUNNING or math.isnan(off) or now - self._since < RISE_TIMEOUT:
            return status
        reached = self._navigator.height
        said = f"It comes no nearer to {self._height:g} m than {reached:.1f} m; it stays there."
        self._navigator.reason = Notice(Code.HEIGHT_UNREACHED, said, height=self._height, reached=reached)
        return Status.FAILURE

    def done(self) -> bool:
        """It flies, as high as it should."""
        if self._situation.flight not in ("flying", "landing"):
            return False
        return math.isnan(self._height) or not abs(self._navigator.height - self._height) > HEIGHT_TOLERANCE

    def tell_robot(self) -> None:
        """Take off, or climb."""
        if self._situation.flight in ("flying", "landing"):
            self._navigator.command(Manoeuvre(kind="hover", height=self._height))
        else:
            self._navigator.take_off(self._height)


class Land(_UpAndDown):
    """Succeeds on the ground."""

    title, order, lasts = "Landing", "land", LANDING_TIMEOUT

    def done(self) -> bool:
        """It stands."""
        return self._situation.flight == "landed"


class Surface(_UpAndDown):
    """Succeeds at the surface."""

    title, order, lasts = "Surfacing", "surface", SURFACING_TIMEOUT

    def done(self) -> bool:
        """It lies at the surface."""
        return self._navigator.height >= SURFACE_HEIGHT
