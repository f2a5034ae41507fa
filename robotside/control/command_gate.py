"""The gate for drive commands: authority, age, the STOP latch, the speed cap and the watchdog.

Pure: every call is told the time. Times are seconds of the operators' clock, the one that `/rosapi/get_time` tells.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.control.authority import Authority
from robotside.control.command_expiry import HOLD_TIME, VALID_TIME, CommandExpiry
from robotside.control.latency_speed_cap import UNMEASURED_SHARE, LatencySpeedCap
from robotside.control.neutral_interlock import LET_GO_SENTENCE, NeutralInterlock, Origin
from robotside.core.notice import Notice, Problem
from robotside.motion.manoeuvres import Order, at_rest, finite, paced

__all__ = ["SOMEBODY", "STOP_SENTENCE", "CommandGate", "Ruling"]

STOP_SENTENCE = Notice(Code.STOP_IS_PRESSED, "STOP is pressed; hold Release to drive again.")

SOMEBODY = "somebody"
"""Who pressed STOP without a name."""


_FREE = RobotInfo(max_speed=math.inf, max_yaw_rate=math.inf)
"""Of a robot that nothing limits."""


@dataclass(frozen=True, slots=True)
class Ruling:
    """What is to be done with a drive command."""

    order: Order | None
    """To pass to the robot at once; None when it must not be."""
    said: Problem = ""
    """Why not, as one sentence; empty when no one needs to know."""


class CommandGate(Authority):
    """The one place that decides whether a command may move the robot."""

    def __init__(
        self,
        info: RobotInfo | None = None,
        *,
        follows: Callable[[], bool] = lambda: True,
        unmeasured_share: float = UNMEASURED_SHARE,
    ) -> None:
        """`info` is what the robot may do, `follows` tells whether the speed follows the driver's link.

        A driver whose round trip is not known goes at `unmeasured_share` of the full speed at most, 0 to 1, always.
        """
        super().__init__()
        self._info, self._follows = info or _FREE, follows
        self._unmeasured_share = unmeasured_share
        self._expiry = CommandExpiry()
        self._sticks = NeutralInterlock()
        self._until = -math.inf
        self._giver: Operator | None = None
        self.pace = LatencySpeedCap()
        """How fast the driver's link lets it go."""
        self._stopped = False
        self.stopped_by = ""
        """Who pressed STOP; empty when it is not pressed."""
        self.stopped_by_id = ""
        """The id of who pressed it, as of `id`; empty when it is not pressed and for an operator without one."""
        self.stop_given = -math.inf
        """When the latest STOP was given [s, operators' clock]; what was given before it cannot release it."""
        self.dropped = 0
        """Drive commands that were not obeyed since the start."""

    @property
    def stopped(self) -> bool:
        """STOP is latched."""
        return self._stopped

    @property
    def driving(self) -> bool:
        """A drive command is in force."""
        return self._giver is not None

    def drives(self, client: Operator) -> bool:
        """A drive command of `client` is in force."""
        return self._giver is not None and self._giver.id == client.id

    def on_gone(self, client: Operator) -> bool:
        """Forget a client whose socket closed, and the drive command it `drives` by; True when it had control."""
        self._expiry.forget(client)
        self._sticks.forget(client.id, self._origin(client))
        if self.drives(client):
            self._giver = None
        return super().on_gone(client)

    def stop(self, name: str, client_id: str = "", given: float = -math.inf) -> None:
        """Latch STOP; from anyone, any time. `name` pressed it, whose `client_id` is empty without one.

        It was `given` then [s, operators' clock]. A stick that is held meanwhile has to come to rest before it counts.
        """
        self.stop_given = max(self.stop_given, given)
        if not self._stopped:
            self._stopped, self.stopped_by, self.stopped_by_id = True, name or SOMEBODY, client_id
        self.halt()

    def release_stop(self) -> None:
        """Unlatch STOP; nothing moves by that alone."""
        self._stopped, self.stopped_by, self.stopped_by_id = False, "", ""

    def drive(
        self,
        client: Operator,
        order: Order,
        now: float,
        *,
        stamp: float | None = None,
        auto: bool = False,
        trouble: Problem = "",
    ) -> Ruling:
        """Judge a drive command that has just come; `stamp` is when it was given [s], None when that is not known.

        While the robot drives itself (`auto`), a command of zero means a stick at rest and changes nothing. `trouble` says
        why the robot cannot be driven at all, empty when it can. A stick that was pushed in vain, or whose commands did not
        come in time, counts again once it is heard at zero.
        """
        moving = not at_rest(order)
        said = self._fault(client, order, now, stamp)
        given = now if stamp is None or math.isnan(stamp) else stamp
        counts = not finite(order) or self._sticks.on_command(
            client.id, moving, given, now, partial(self._origin, client)
        )
        if not said and (moving or not (auto or trouble or self.stopped)):
            said = trouble or self._refusal(client, now, counts)
            if not said:
                if self._giver is not None and not self.drives(client):
                    self._sticks.void(self._giver.id)
                self._giver, self._until = client, self._expiry.given(client, now, stamp) + HOLD_TIME
                self._sticks.obey(client.id, self._until + VALID_TIME - HOLD_TIME)
                self.update_speed_cap(now)
                # the robot's own limits are looked at where orders reach its port
                return Ruling(paced(order, self._info, self.pace.share))
        if moving and said and not _overtaken(said):
            self._sticks.void(client.id)
        self.dropped += bool(said)
        return Ruling(None, said)

    def expired(self, now: float) -> bool:
        """True once when the drive command in force has run out or its giver has lost control, so that the robot must stop."""
        if self._giver is None:
            return False
        if not self.holds(self._giver):
            self.halt()
            return True
        if now < self._until:
            return False
        self._sticks.void(self._giver.id)
        self.hold()
        return True

    def update_speed_cap(self, now: float) -> None:
        """Let the speed follow the link of who has control; to be called often."""
        driver = self.driver
        if driver is not None and math.isnan(driver.client.rtt):
            self.pace.limit(self._unmeasured_share, now)
        elif self._follows():
            self.pace.update(driver.client.rtt if driver else math.nan, now)
        else:
            self.pace.free()

    @property
    def follows(self) -> bool:
        """The speed follows the driver's link."""
        return self._follows()

    def hold(self) -> None:
        """End the drive command in force: the robot drives itself from now on."""
        self._giver = None

    def halt(self) -> None:
        """End the drive command in force: the robot was stopped otherwise, and no stick counts before it was at rest."""
        self.hold()
        self._sticks.void_all()

    def _origin(self, client: Operator) -> Origin:
        """Where the commands of `client` come from, over this connection and the next."""
        name = self.id(client)
        return Origin(client.address.rpartition(":")[0], "" if name == client.id else name)

    def _refusal(self, client: Operator, now: float, counts: bool) -> Problem:
        """Why a sound command of `client` is not obeyed; empty when it is, and then it has control."""
        if self.stopped:
            return STOP_SENTENCE
        self._expire(now)
        return self.objection(client) or (self.acquire(client, now) if counts else LET_GO_SENTENCE)

    def _fault(self, client: Operator, order: Order, now: float, stamp: float | None) -> Problem:
        if not finite(order):
            said = "A drive command was dropped: its speeds are not all numbers."
            return Notice(Code.DRIVE_INVALID, said)
        return self._expiry.fault(client, now, stamp, rest=at_rest(order))


def _overtaken(said: Problem) -> bool:
    """An older command came twice or behind a newer one: of the stick itself that says nothing."""
    return isinstance(said, Notice) and said.code == Code.DRIVE_OVERTAKEN
