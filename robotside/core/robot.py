"""The port of a robot: the five verbs that a simulated, recorded, faked or real one has to offer."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Protocol, runtime_checkable

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Pose, Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo

__all__ = [
    "Equipped",
    "Levelled",
    "Manoeuvrable",
    "Prompt",
    "Reachable",
    "Resettable",
    "Robot",
    "Simulated",
    "Stoppable",
    "Switchable",
]


class Robot(Protocol):
    """The interface of a robot for the robot side. All calls come from one thread."""

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
        on `/events` is passed on to the operators as the robot side's own, numbered and stamped by it.
        """

    def want(self, topic: str, wanted: bool) -> None:
        """Make the messages of an on-demand topic from now on, or no longer."""

    def close(self) -> None:
        """Let go of everything it holds; no other call follows."""


@runtime_checkable
class Stoppable(Protocol):
    """A robot that has a STOP of its own, which stays pressed even if this robot side fails."""

    def press_stop(self) -> None:
        """Press it, and again as soon as the robot can be reached, until `release_stop`."""

    def release_stop(self) -> None:
        """Release it if it was pressed from here."""


@runtime_checkable
class Manoeuvrable(Protocol):
    """A robot that moves by more than twists; its `info` says which kinds of manoeuvre it knows."""

    def manoeuvre(self, order: Manoeuvre) -> None:
        """Move by `order` until the next order; ValueError with one sentence when it cannot, which changes nothing."""


@runtime_checkable
class Levelled(Protocol):
    """A robot that knows how high and how deep it can go."""

    @property
    def heights(self) -> tuple[float, float]:
        """The lowest and the highest at which it can be, above the map's origin [m]; infinite where nothing ends."""


@runtime_checkable
class Equipped(Protocol):
    """A robot with payloads that take orders; its `info` says which are mounted."""

    def command(self, payload: str, order: Msg) -> None:
        """Command a payload; ValueError with one sentence when it cannot, which changes nothing."""

    def hold_payloads(self) -> None:
        """Every payload that moves stops where it is now."""


@runtime_checkable
class Switchable(Protocol):
    """A robot whose sensors can be switched off."""

    def switch(self, topic: str, on: bool) -> None:
        """Measure what comes on `topic`, or no longer, so that it takes no power; unknown topics are ignored."""


@runtime_checkable
class Prompt(Protocol):
    """A robot whose cameras take pictures at moments of their own, which need not wait for the next `read`."""

    def on_pictures(self, ready: Callable[[], None] | None) -> None:
        """Call `ready`, in any thread, when there is a picture; None for no longer. It asks for `pictures` soon, or for none."""

    def pictures(self, now: float) -> Iterable[tuple[str, Msg]]:
        """Topic and picture of those that no `read` has given yet, up to `now` [s, robot clock]."""


@runtime_checkable
class Reachable(Protocol):
    """A robot on a line of its own, which may be cut."""

    @property
    def reached(self) -> bool:
        """It is heard; one in the hands of others is, too."""


@runtime_checkable
class Simulated(Protocol):
    """A robot whose time can stand still, as only a simulated one's can."""

    def skip_to(self, now: float) -> None:
        """Nothing happened from the last `read` to `now` [s, robot clock]: it goes on from there."""


@runtime_checkable
class Resettable(Protocol):
    """A robot that can be put back to where it started, as only a simulated one can."""

    def reset(self) -> Pose:
        """Put it back, at rest; where it stands now, in `map`. ValueError with one sentence when that cannot be."""
