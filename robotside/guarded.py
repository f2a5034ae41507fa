"""The robot's port behind STOP: whoever asks, nothing moves while it is pressed."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from robotside.robot import Robot

__all__ = ["Guarded"]


class Guarded:
    """A `Robot` that brakes instead of driving while STOP is pressed; the one way by which twists reach the port."""

    def __init__(self, robot: Robot, stopped: Callable[[], bool]) -> None:
        """`stopped` tells whether STOP is pressed at this moment."""
        self.info = robot.info
        """Who it is and what it can do."""
        self._robot, self._stopped = robot, stopped

    @property
    def trouble(self) -> str:
        """Why it can be neither driven nor heard just now; empty when all is well."""
        return self._robot.trouble

    def drive(self, twist: Twist) -> None:
        """Move with `twist` in `base_link` until the next `drive` or `stop`; brake while STOP is pressed."""
        if self._stopped():
            self._robot.stop()
        else:
            self._robot.drive(twist)

    def stop(self) -> None:
        """Brake to rest and stay there."""
        self._robot.stop()

    def read(self, now: float) -> Iterable[tuple[str, Msg]]:
        """Topic and message of everything measured up to `now` [s, robot clock] since the last call."""
        return self._robot.read(now)

    def want(self, topic: str, wanted: bool) -> None:
        """Make the messages of an on-demand topic from now on, or no longer."""
        self._robot.want(topic, wanted)

    def close(self) -> None:
        """Let go of everything it holds; no other call follows."""
        self._robot.close()
