"""The robot's port behind STOP and limits: nothing moves while STOP is pressed, nor farther than it may."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from msgspec.structs import replace

from bridge.core.codes import Code
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Pose, Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from robotside.core.notice import Notice, Problem
from robotside.core.refusal import OrderRefused
from robotside.core.robot import (
    Equipped,
    Levelled,
    Manoeuvrable,
    Prompt,
    Reachable,
    Resettable,
    Robot,
    Simulated,
    Stoppable,
)
from robotside.motion.manoeuvres import VERTICAL_KINDS, Order

__all__ = ["GuardedRobot", "port_info"]

_REST = Twist()


def port_info(robot: Robot) -> RobotInfo:
    """Who `robot` is: one that is reached over a link that passes twists only is not said to know more."""
    info = robot.info
    return info if isinstance(robot, Manoeuvrable) or not info.manoeuvres else replace(info, manoeuvres=[])


def _refused(said: str) -> OrderRefused:
    return OrderRefused(Notice(Code.EQUIPMENT_REFUSED, said))


def _as_it_is(order: Order) -> Order:
    return order


class GuardedRobot:
    """A `Robot` that brakes instead of driving while STOP is pressed; the one way by which orders reach the port."""

    def __init__(
        self,
        robot: Robot,
        stopped: Callable[[], bool],
        clamp: Callable[[Order], Order] = _as_it_is,
        info: RobotInfo | None = None,
    ) -> None:
        """`stopped` tells whether STOP is pressed at this moment, `clamp` what may be done of an order just now.

        `info` is what the robot may do, None for all that it can.
        """
        self.info = info or robot.info
        """Who it is and what it may do."""
        self._robot, self._stopped, self._clamp = robot, stopped, clamp
        self._wanted: Order | None = None
        self._given: Order | None = None

    @property
    def reached(self) -> bool:
        """It is heard; one without a line of its own always is."""
        return not isinstance(self._robot, Reachable) or self._robot.reached

    @property
    def trouble(self) -> Problem:
        """Why it can be neither driven nor heard just now; empty when all is well."""
        trouble = self._robot.trouble
        return Notice(Code.ROBOT_UNREACHABLE, trouble) if trouble else ""

    def press_stop(self) -> None:
        """Brake, hold what moves on it, and press the STOP behind, if the robot has one of its own."""
        self.stop()
        self.hold_payloads()
        if isinstance(self._robot, Stoppable):
            self._robot.press_stop()

    def release_stop(self) -> None:
        """Release the STOP behind, if it was pressed from here."""
        if isinstance(self._robot, Stoppable):
            self._robot.release_stop()

    def follow(self, order: Order) -> None:
        """`drive` or `manoeuvre`, as the order is."""
        if isinstance(order, Manoeuvre):
            self.manoeuvre(order)
        else:
            self.drive(order)

    def drive(self, twist: Twist) -> None:
        """Move with `twist` in `base_link`, as far as it may, until the next order; brake while STOP is pressed."""
        self._take(twist)

    def manoeuvre(self, order: Manoeuvre) -> None:
        """Move by `order`, as far as it may, until the next one; brake while STOP is pressed.

        A robot that does not know the kind gets the twist that comes nearest; OrderRefused where none does, or the robot refuses it.
        """
        if order.kind == "rest":
            self.stop()
            return
        if order.kind in VERTICAL_KINDS and order.kind not in self.info.manoeuvres:
            raise _refused(f"{self.info.name} cannot {order.kind.replace('_', ' ')}.")
        self._take(order)

    def again(self) -> None:
        """Look anew at the order that it moves by: the robot is elsewhere now. Call it whenever that is measured."""
        if self._wanted is None:
            return
        order = self._allowed(self._wanted)
        if order is not self._given and order != self._given:
            self._give(order)

    def stop(self) -> None:
        """Brake to rest and stay there."""
        self._wanted = self._given = None
        self._robot.stop()

    def command(self, payload: str, order: Msg) -> None:
        """Tell a payload what to do; ValueError with one sentence when it cannot."""
        if isinstance(self._robot, Equipped):
            self._robot.command(payload, order)
            return
        raise ValueError(f"{self.info.name} has no {payload.replace('_', ' ')} that takes orders.")

    def hold_payloads(self) -> None:
        """What moves on it stops where it is now."""
        if isinstance(self._robot, Equipped):
            self._robot.hold_payloads()

    @property
    def heights(self) -> tuple[float, float]:
        """The lowest and the highest at which it can be, above the map's origin [m]; infinite where that is not known."""
        return self._robot.heights if isinstance(self._robot, Levelled) else (-math.inf, math.inf)

    @property
    def equipped(self) -> bool:
        """Its payloads take orders."""
        return isinstance(self._robot, Equipped)

    @property
    def resettable(self) -> bool:
        """It can be put back to where it started."""
        return isinstance(self._robot, Resettable)

    @property
    def simulated(self) -> bool:
        """Its time can stand still."""
        return isinstance(self._robot, Simulated)

    def skip_to(self, now: float) -> None:
        """Nothing happened up to `now` [s, robot clock] where it is simulated; in other robots time goes on anyway."""
        if isinstance(self._robot, Simulated):
            self._robot.skip_to(now)

    def reset(self) -> Pose:
        """Put it back, at rest; where it stands now, in `map`. ValueError with one sentence when that cannot be."""
        if isinstance(self._robot, Resettable):
            place = self._robot.reset()
            self._wanted = self._given = None
            return place
        raise ValueError(f"{self.info.name} is real: it cannot be reset from here.")

    def _take(self, order: Order) -> None:
        if self._stopped():
            self.stop()
            return
        self._wanted = order
        self._give(self._allowed(order))

    def _allowed(self, order: Order) -> Order:
        """What may be done of it; when that cannot be told for a fault of the program, it brakes first."""
        try:
            return self._clamp(order)
        except Exception:
            self.stop()
            raise

    def _give(self, order: Order) -> None:
        self._given = order
        if isinstance(order, Twist):
            if order == _REST != self._wanted:
                self._robot.stop()  # brakes harder than driving with no speed
            else:
                self._robot.drive(order)
        elif isinstance(self._robot, Manoeuvrable):
            try:
                self._robot.manoeuvre(order)
            except ValueError as problem:
                raise _refused(str(problem)) from problem
        else:
            self.stop()

    def read(self, now: float) -> Iterable[tuple[str, Msg]]:
        """Topic and message of everything measured up to `now` [s, robot clock] since the last call."""
        return self._robot.read(now)

    def on_pictures(self, ready: Callable[[], None] | None) -> None:
        """Have it call `ready`, in any thread, when there is a picture; None for no longer. Some robots never do."""
        if isinstance(self._robot, Prompt):
            self._robot.on_pictures(ready)

    def pictures(self, now: float) -> Iterable[tuple[str, Msg]]:
        """Topic and picture of those that no `read` has given yet, up to `now` [s, robot clock]."""
        return self._robot.pictures(now) if isinstance(self._robot, Prompt) else ()

    def want(self, topic: str, wanted: bool) -> None:
        """Make the messages of an on-demand topic from now on, or no longer."""
        self._robot.want(topic, wanted)

    def close(self) -> None:
        """Let go of everything it holds; no other call follows."""
        self._robot.close()
