"""What a robot has for its clients: services, actions, and who they are to it."""

from __future__ import annotations

import math
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any

from bridge.msgs import Msg

__all__ = ["Action", "Service", "Session"]

MsgClass = type[Msg]


class Session:
    """One connected client."""

    def __init__(self, id: str, address: str, opened: float) -> None:
        self.id = id
        """Unique in this run of the server."""
        self.address = address
        """`HOST:PORT` of the client."""
        self.opened = opened
        """When it connected [s], operators' clock."""
        self.last_heard = opened
        """When anything came from it [s], operators' clock; answers to pings do not count."""
        self.rtt = math.nan
        """How long the way to it and back takes, by the server's own pings [s]; NaN until known."""
        self.answered = opened
        """What comes from it now was sent after this [s], operators' clock."""
        self.asked_time = False
        """It has asked for the operators' clock, by `/rosapi/get_time`."""

    def __repr__(self) -> str:
        return f"Session({self.id!r}, {self.address!r})"


@dataclass(frozen=True, slots=True)
class Service:
    """Something a client may ask for once and be answered."""

    name: str
    type: str
    """ROS type, as in `std_srvs/Trigger`."""
    request: MsgClass
    response: MsgClass
    call: Callable[[Session, Any], Msg | Awaitable[Msg]]
    """Does it. Raises Refused with the sentence for the caller, who gets `result: false`."""


@dataclass(frozen=True, slots=True)
class Action:
    """Something that takes a while: a client sets a goal, hears how it goes, and may take it back."""

    name: str
    type: str
    """ROS type, as in `pilothouse_msgs/RunTask`."""
    goal: MsgClass
    result: MsgClass
    feedback: MsgClass
    start: Callable[[Session, Any, Callable[[Msg], None]], Awaitable[Msg]]
    """Does it: takes the goal and where to tell how it goes, gives the result. Raises Refused with the sentence for the
    client. It is cancelled, as tasks of asyncio are, when the client takes the goal back or is gone."""
