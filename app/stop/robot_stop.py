"""STOP of the robot that is connected: its own service or, where it has none, zero speed held from here."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Protocol

from app.link.commands import Outcome
from app.link.feeds import Feeds
from app.stop.local_stop import LocalStop
from app.stop.stop_state import StopState
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import ControlStatus

__all__ = ["RobotStop", "StoppableRobot"]


class StoppableRobot(Protocol):
    """A robot's abilities, as far as STOP needs them."""

    @property
    def foreign(self) -> bool:
        """The robot is known to have no Pilothouse services."""


class RobotStop:
    """State of one robot's STOP for the operator; sending it is the link's part."""

    def __init__(
        self,
        robot: StoppableRobot,
        feeds: Feeds,
        now: Callable[[], float],
        own_id: str,
        drives: Callable[[], bool],
    ) -> None:
        """`now` is our clock [s]; by `own_id` the robot publishes this handheld; `drives` says that the robot has a topic to drive it by."""
        self._robot, self._feeds, self._drives = robot, feeds, drives
        self.local = LocalStop(now)
        """STOP of a robot that has none of its own."""
        self._state = StopState(now, own_id)
        self._connected = False

    @property
    def latched(self) -> bool:
        """STOP is known to be pressed, at the robot or, where it has none, here; the robot may still move."""
        if self._robot.foreign:
            return self.local.latched
        status: ControlStatus | None = self._feeds.latest("/control/status")
        return status is not None and status.stopped

    @property
    def phase(self) -> str:
        """Phase of STOP, as of `stop_state.Verdict`; `ready` again when it has been released."""
        phase = self.local.phase if self._robot.foreign else self._state.verdict.phase
        return "ready" if phase == "released" else phase

    @property
    def unanswered(self) -> bool:
        """STOP was pressed here, and the robot has not answered that it took it."""
        return self._state.unanswered

    @property
    def owed(self) -> bool:
        """STOP was pressed here and not released, and whoever leaves the robot now has to go on sending it.

        A robot without a STOP is owed zero speed after it came to rest as well.
        """
        return self.local.latched if self._robot.foreign else self._state.owed

    @property
    def sentence(self) -> str:
        """The same for the operator; empty where the phase says it all."""
        if self._robot.foreign:
            return self.local.sentence(self._drives(), self._connected)
        return self._state.verdict.sentence

    @property
    def lost_for(self) -> float:
        """Time since the link to a stopped robot was lost [s]; NaN where that did not happen."""
        return self._state.lost_for

    def press(self) -> None:
        """The operator pressed STOP."""
        self._state.press()

    def release(self) -> None:
        """The operator released STOP."""
        self.local.release()
        self._state.forget()

    def set_reachable(
        self, connected: bool, why: str = "", *, at: float = math.nan, hopeless: bool = False
    ) -> None:
        """The link stands or not, as `StopState.reach` takes it."""
        self._connected = connected
        self._state.reach(connected, why, at=at, hopeless=hopeless)

    def on_outcome(self, outcome: Outcome) -> bool:
        """The robot answered to a STOP; False where that STOP was released meanwhile, and its answer says nothing."""
        return self._state.on_outcome(outcome)

    def on_status(self, status: ControlStatus, received: float) -> None:
        """A control status came at `received` [s], our clock."""
        self._state.on_status(status, received)

    def on_odometry(self, odometry: Odometry, received: float) -> None:
        """Odometry came at `received` [s], our clock: the witness of a robot without a STOP."""
        self.local.on_odometry(odometry, received)
