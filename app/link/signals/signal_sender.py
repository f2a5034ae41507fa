"""Signals on their way to the robot: who listens there is asked first, and nothing leaves while nothing may."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from app.link.signals.signal_rule import Offer, hearing_fault, topic_fault
from app.link.signals.signal_slot import SignalSlot
from bridge.core.errors import BridgeError
from bridge.core.network_thread import NetworkThread
from bridge.msgs import Msg
from bridge.msgs.rosapi_msgs import (
    PublishersRequest,
    PublishersResponse,
    SubscribersRequest,
    SubscribersResponse,
)
from widgets.core.language import tr

__all__ = ["SignalNews", "SignalSender"]

LOOK_PERIOD = 0.05
"""Between two looks at the slot while anything is in it [s]."""
ASK_PERIOD = 5.0
"""Between two questions who listens to a topic [s]."""
ANSWER_TIMEOUT = 3.0
"""For one answer of the robot's rosapi [s]."""


@dataclass(frozen=True, slots=True)
class SignalNews:
    """What became of a signal, or who listens to its topic."""

    topic: str
    problem: str = ""
    """Why nothing may be sent there, in one sentence; empty where it may."""
    sent: Msg | None = None
    """What has just left; None for news of who listens."""
    unsent: bool = False
    """What was to be said once was dropped here, and never left."""


class Robot(Protocol):
    """What the robot offers."""

    @property
    def capabilities(self) -> Any:
        """As it said; None before."""


class Health(Protocol):
    """The link's health."""

    @property
    def silent(self) -> bool:
        """Nothing came for a while."""


class SignalSender:
    """What is wanted is set in any thread; it is sent in the network thread."""

    def __init__(
        self,
        client: Any,
        network: NetworkThread,
        robot: Robot,
        health: Health,
        now: Callable[[], float],
        forbidden: Callable[[], bool],
        services: Collection[str],
        tell: Callable[[SignalNews], object],
    ) -> None:
        """`client` is the link's; `now` our clock [s]. While `forbidden` says so nothing but rest is sent; `services` are those that Pilothouse calls."""
        self._client, self._network, self._robot, self._health = client, network, robot, health
        self._forbidden, self._services, self._tell = forbidden, services, tell
        self.slot = SignalSlot(now)
        self._wake, self._asking = asyncio.Event(), asyncio.Event()
        self._looked: dict[str, type[Msg]] = {}
        """Topics that a control on the glass is bound to, with what it sends."""
        self._faults: dict[str, str] = {}
        """What is known of them; one that is not in it may not be sent to."""
        self._advertised: dict[str, frozenset[str] | None] = {}
        """Topics that this handheld advertised, with the nodes that stood there soon after: what carries its own messages."""
        self._connected = False

    # in any thread

    def say(self, topic: str, msg: Msg) -> None:
        """Send it once, or not at all."""
        self.slot.say(topic, msg)
        self._network.call(self._wake.set)

    def hold(self, topic: str, msg: Msg, rest: Msg) -> None:
        """Send it for as long as this is called again, then `rest`."""
        self.slot.hold(topic, msg, rest)
        self._network.call(self._wake.set)

    def let_go(self, topic: str) -> None:
        """Send the rest of what is held."""
        self.slot.let_go(topic)
        self._network.call(self._wake.set)

    def drop(self) -> None:
        """STOP was pressed: what is held comes to rest, and must be pressed anew."""
        self.slot.drop()
        self._network.call(self._wake.set)

    def look(self, topics: Mapping[str, type[Msg]]) -> None:
        """Controls on the glass send these types to these topics from now on, and to no others; nothing for none."""
        self._network.call(self._look, dict(topics))

    # in the network thread

    def _look(self, topics: dict[str, type[Msg]]) -> None:
        for topic in set(self._looked) - set(topics):
            self._faults.pop(topic, None)  # so that what is held there rests, until its finger is lifted
        self._looked = topics
        self._wake.set()
        self._asking.set()

    async def run(self) -> None:
        """Send until cancelled, and ask now and then who listens."""
        async with asyncio.TaskGroup() as work:
            work.create_task(self._ask_again())
            while True:
                busy = self._connected and self.slot.busy
                await _waited(self._wake, LOOK_PERIOD if busy else None)
                self.send()

    def send(self) -> None:
        """Send what is due."""
        for one in self.slot.due(self._allowed) if self._connected else ():
            if self._client.publish(one.topic, one.msg, even_late=one.kind == "rest"):
                self.slot.sent(one)
                self._tell(SignalNews(one.topic, sent=one.msg))
        for topic in self.slot.take_unsent():
            self._tell(SignalNews(topic, unsent=True))

    def _allowed(self, topic: str, msg: Msg) -> bool:
        if self._health.silent or self._client.late or self._forbidden() or self._faults.get(topic, "?"):
            return False
        return self._looked.get(topic) is type(msg) and not self._fault(topic, type(msg))

    def _fault(self, topic: str, kind: type[Msg]) -> str:
        offer: Offer | None = self._robot.capabilities
        return topic_fault(offer, topic, kind, self._services)

    async def _ask_again(self) -> None:
        while True:
            for topic, kind in list(self._looked.items()):
                if self._connected:
                    await self._ask(topic, kind)
            await _waited(self._asking, ASK_PERIOD if self._connected and self._looked else None)

    async def _ask(self, topic: str, kind: type[Msg]) -> None:
        """Find out whether anybody listens, and advertise the topic once somebody does."""
        fault = self._fault(topic, kind) or await self._hearing(topic)
        if self._looked.get(topic) is not kind:
            return
        if not fault and topic not in self._advertised:
            self._advertised[topic] = None
            self._client.advertise(topic, kind)
            self._asking.set()
        if self._faults.get(topic) != fault:
            self._faults[topic] = fault
            self._tell(SignalNews(topic, fault))

    async def _hearing(self, topic: str) -> str:
        call = self._client.call
        try:
            said = await call(
                "/rosapi/publishers", PublishersRequest(topic), PublishersResponse, timeout=ANSWER_TIMEOUT
            )
            heard = await call(
                "/rosapi/subscribers", SubscribersRequest(topic), SubscribersResponse, timeout=ANSWER_TIMEOUT
            )
        except BridgeError:
            return tr("The robot does not say who listens to {topic}, so nothing is sent there.").format(
                topic=topic
            )
        publishers = set(said.publishers)
        if (
            topic in self._advertised
        ):  # nobody else published it before: who stands there now does so for this handheld
            own = self._advertised[topic]
            self._advertised[topic] = own = frozenset(publishers) if own is None else own
            publishers -= own
        return hearing_fault(topic, publishers, heard.subscribers, ours=self._robot.capabilities.ours)

    def on_connected(self) -> None:
        """A link was made: what the robot was told over the one before comes to rest first."""
        self._connected = True
        self._wake.set()
        self._asking.set()

    def on_lost(self) -> None:
        """The link is gone: nothing old may leave later, and who listens is asked anew."""
        self._connected = False
        self._faults.clear()
        self._advertised = {topic: own for topic, own in self._advertised.items() if own is not None}
        self.slot.drop()
        self._wake.set()

    def finish(self) -> None:
        """Send the rest of what is held a last time."""
        self.slot.drop()
        self.send()


async def _waited(event: asyncio.Event, longest: float | None) -> None:
    """Wait for it, at most `longest` [s], None for ever; it is over then."""
    with contextlib.suppress(TimeoutError):
        async with asyncio.timeout(longest):
            await event.wait()
    event.clear()
