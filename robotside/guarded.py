"""The robot's port behind STOP and limits: whoever asks, nothing moves while STOP is pressed, nor farther than it may."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.robot import Robot, Stoppable

__all__ = ["Guarded"]

_REST = Twist()


class Guarded:
    """A `Robot` that brakes instead of driving while STOP is pressed; the one way by which twists reach the port."""

    def __init__(
        self,
        robot: Robot,
        stopped: Callable[[], bool],
        clamp: Callable[[Twist], Twist] = lambda twist: twist,
        info: RobotInfo | None = None,
    ) -> None:
        """`stopped` tells whether STOP is pressed at this moment, `clamp` what may be done of a twist just now.

        `info` is what the robot may do, None for all that it can.
        """
        self.info = info or robot.info
        """Who it is and what it may do."""
        self._robot, self._stopped, self._clamp = robot, stopped, clamp
        self._wanted: Twist | None = None
        self._given: Twist | None = None

    @property
    def trouble(self) -> str:
        """Why it can be neither driven nor heard just now; empty when all is well."""
        return self._robot.trouble

    def press_stop(self) -> None:
        """Brake, and press the STOP behind, if the robot has one of its own."""
        self.stop()
        if isinstance(self._robot, Stoppable):
            self._robot.press_stop()

    def release_stop(self) -> None:
        """Release the STOP behind, if it was pressed from here."""
        if isinstance(self._robot, Stoppable):
            self._robot.release_stop()

    def drive(self, twist: Twist) -> None:
        """Move with `twist` in `base_link`, as far as it may, until the next `drive` or `stop`; brake while STOP is pressed."""
        if self._stopped():
            self.stop()
            return
        self._wanted = twist
        self._give(self._allowed(twist))

    def again(self) -> None:
        """Look anew at the twist that it moves with: the robot is elsewhere now. Call it whenever that is measured."""
        if self._wanted is None:
            return
        twist = self._allowed(self._wanted)
        if twist != self._given:
            self._give(twist)

    def stop(self) -> None:
        """Brake to rest and stay there."""
        self._wanted = self._given = None
        self._robot.stop()

    def _allowed(self, twist: Twist) -> Twist:
        """What may be done of it; when that cannot be told for a fault of the program, it brakes first."""
        try:
            return self._clamp(twist)
        except Exception:
            self.stop()
            raise

    def _give(self, twist: Twist) -> None:
        self._given = twist
        if twist == _REST != self._wanted:
            self._robot.stop()  # brakes harder than driving with no speed
        else:
            self._robot.drive(twist)

    def read(self, now: float) -> Iterable[tuple[str, Msg]]:
        """Topic and message of everything measured up to `now` [s, robot clock] since the last call."""
        return self._robot.read(now)

    def want(self, topic: str, wanted: bool) -> None:
        """Make the messages of an on-demand topic from now on, or no longer."""
        self._robot.want(topic, wanted)

    def close(self) -> None:
        """Let go of everything it holds; no other call follows."""
        self._robot.close()
