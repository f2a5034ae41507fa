"""The port of a robot: the five verbs that a simulated, recorded, faked or real one has to offer."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol, runtime_checkable

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import RobotInfo

__all__ = ["Robot", "Stoppable"]


class Robot(Protocol):
    """What the robot side needs of a robot. All calls come from one thread."""

    info: RobotInfo
    """Who it is and what it can do; does not change while it runs."""

    @property
    def trouble(self) -> str:
        """Why it can be neither driven nor heard just now, as one sentence; empty when all is well."""

    def drive(self, twist: Twist) -> None:
        """Move with `twist` in `base_link` until the next `drive` or `stop`; already within the robot's limits."""

    def stop(self) -> None:
        """Brake to rest and stay there."""

    def read(self, now: float) -> Iterable[tuple[str, Msg]]:
        """Topic and message of everything measured up to `now` [s, robot clock] since the last call.

        A simulation advances to `now`; the first call sets its origin and yields `/map`, if there is a map. What is
        on `/events` is told to the operators as the robot side's own, numbered and stamped by it.
        """

    def want(self, topic: str, wanted: bool) -> None:
        """Make the messages of an on-demand topic from now on, or no longer."""

    def close(self) -> None:
        """Let go of everything it holds; no other call follows."""


@runtime_checkable
class Stoppable(Protocol):
    """A robot that has a STOP of its own, which stays pressed whatever becomes of this robot side."""

    def press_stop(self) -> None:
        """Press it, and again as soon as the robot can be reached, until `release_stop`."""

    def release_stop(self) -> None:
        """Release it if it was pressed from here."""
