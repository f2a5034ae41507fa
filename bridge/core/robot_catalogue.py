"""The services and actions that a robot offers, and its operators, the clients that may use them."""

from __future__ import annotations

import math
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any

from bridge.core.identity import STRANGER, Identity, Role
from bridge.msgs import Msg

__all__ = ["Action", "Service", "Operator"]

MsgClass = type[Msg]


def _ignore() -> None:
    """Nothing is to be ended."""


class Operator:
    """A client that may command the robot, over one connection of any gateway."""

    def __init__(
        self,
        id: str,
        address: str,
        opened: float,
        *,
        identity: Identity = STRANGER,
        way: str = "",
        secure: bool = False,
    ) -> None:
        self.id = id
        """Unique in this run of the robot side."""
        self.address = address
        """`HOST:PORT` of the client."""
        self.opened = opened
        """Time of connection [s], operators' clock."""
        self.last_heard = opened
        """Time of the last message from it [s], operators' clock; answers to pings do not count."""
        self.rtt = math.nan
        """Round-trip time to it [s], measured by the robot side's own pings; NaN until known."""
        self.answered = opened
        """Earliest time [s], operators' clock, at which the message that comes next can have been sent."""
        self.asked_time = False
        """Whether it asked for the operators' clock, by `/rosapi/get_time`, so that its stamps have a meaning."""
        self.identity = identity
        """Who it proved to be."""
        self.way = way
        """The gateway by which it came, as in `rosbridge`; empty when it was not said."""
        self.secure = secure
        """Nobody else reads or changes what it sends and is sent: it came by TLS."""
        self.on_expelled: Callable[[], None] = _ignore
        """Ends its connection, since it may nothing any more; set by its gateway."""

    def role(self, now: float) -> Role:
        """What it may do at `now` [s, operators' clock]; a role that ends is over where NaN is the time."""
        identity = self.identity
        return identity.role if identity.ends == math.inf or now < identity.ends else Role.NONE

    def __repr__(self) -> str:
        return f"Operator({self.id!r}, {self.address!r})"


@dataclass(frozen=True, slots=True)
class Service:
    """A service of the robot: a request with one response."""

    name: str
    type: str
    """ROS type, as in `std_srvs/Trigger`."""
    request: MsgClass
    response: MsgClass
    call: Callable[[Operator, Any], Msg | Awaitable[Msg]]
    """Carries the request out and returns the response. Raises Refused with the sentence for the caller, who gets
    `result: false`."""


@dataclass(frozen=True, slots=True)
class Action:
    """An action of the robot: a goal with feedback on its way and a result, that the client may cancel."""

    name: str
    type: str
    """ROS type, as in `pilothouse_msgs/RunTask`."""
    goal: MsgClass
    result: MsgClass
    feedback: MsgClass
    start: Callable[[Operator, Any, Callable[[Msg], None]], Awaitable[Msg]]
    """Carries a goal out: takes the operator, the goal and a function for feedback, returns the result. Raises Refused with
    the sentence for the client. It is cancelled, as an asyncio task, when the client cancels the goal or is gone."""
