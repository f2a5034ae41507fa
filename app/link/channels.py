"""Channels of the mailbox beside the robot's topics, and the posts that one link puts into them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from app.link.feeds import Mailbox
from bridge.core.errors import BridgeError
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import ControlStatus

if TYPE_CHECKING:
    from app.link.event_order import KnownEvents
    from app.link.subscriptions import Seen
    from bridge.client.client import BridgeClient

__all__ = [
    "ANSWER",
    "CAPABILITIES",
    "EVENT",
    "KNOWN",
    "LINK",
    "MISSED",
    "OUTCOME",
    "SEEN",
    "SIGNAL",
    "Answer",
    "LinkPosts",
    "watched",
]

EVENT, MISSED, LINK, OUTCOME = "event", "missed", "link", "outcome"
"""`Event`s, what was `Missed`, `LinkState`s, `Outcome`s, all queued."""
KNOWN = "known"
"""Newest wins: how far the robot's events are `KnownEvents`; it comes after them."""
ANSWER = "answer"
"""`Answer`s of services that are no commands, queued."""
SIGNAL = "signal"
"""`SignalNews` of what controls of a view tell the robot, queued."""
ANSWER_TIMEOUT = 5.0
"""Longest time for the answer of a service that is no command [s]."""
CAPABILITIES, SEEN = "offer", "seen"
"""The robot's `Capabilities` when it is known and when it changed, and what is `Seen` of the topic looked at."""


_WATCHED = "watched "


def watched(topic: str) -> str:
    """Channel of what is `Seen` of a topic that somebody watches by `Link.look_at`; newest wins."""
    return _WATCHED + topic


@dataclass(frozen=True, slots=True)
class Answer:
    """What became of a call of a service."""

    service: str
    message: Msg | None
    """The answer; None where the robot refused or did not answer."""
    problem: str = ""
    """Why there is none, as a sentence."""
    request: Msg | None = None
    """What was asked."""


class LinkPosts:
    """Everything that one link posts. Called in the network thread."""

    def __init__(self, mailbox: Mailbox, now: Callable[[], float]) -> None:
        """`now` is our clock [s]."""
        self._mailbox, self._now = mailbox, now

    def queue(self, channel: str) -> Callable[[Any], None]:
        """A function that queues a value in that channel: none is ever dropped."""
        return lambda value: self._mailbox.queue(channel, value, self._now())

    async def answer(self, client: BridgeClient, service: str, request: Msg, response: type[Msg]) -> None:
        """Call a service and queue its `Answer`."""
        try:
            message = await client.call(service, request, response, timeout=ANSWER_TIMEOUT)
            found = Answer(service, message, request=request)
        except BridgeError as error:
            found = Answer(service, None, str(error), request)
        self.queue(ANSWER)(found)

    def post_message(self, name: str, message: Msg, received: float) -> None:
        """A message of a topic, by our name of it, that came at `received` [s], our clock; newest wins."""
        # whether a STOP is obeyed is shown in the next frame
        self._mailbox.post(name, message, received, urgent=isinstance(message, ControlStatus))

    def post_seen(self, seen: Seen, received: float) -> None:
        """Something came of the topic that is looked at."""
        if seen.message is None:
            self._mailbox.queue(SEEN, seen, self._now())
        else:
            self._mailbox.post(SEEN, seen, received)

    def post_watched(self, seen: Seen, received: float) -> None:
        """Something came of a topic that is watched."""
        if seen.message is None:
            self._mailbox.queue(watched(seen.topic), seen, self._now())
        else:
            self._mailbox.post(watched(seen.topic), seen, received)

    def post_known(self, known: KnownEvents) -> None:
        """More of the robot's log is known."""
        self._mailbox.post(KNOWN, known, self._now())
