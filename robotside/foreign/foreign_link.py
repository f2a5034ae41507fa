"""The line to a robot that is not ours: a bridge client in a thread of its own."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import math
import platform
import secrets
from collections.abc import Callable, Coroutine
from typing import Any, Protocol

from msgspec import structs

from bridge.client.client import BridgeClient, LinkState, Phase
from bridge.client.credentials import Credentials
from bridge.core.address import host_and_port
from bridge.core.errors import BridgeError, NotConnected
from bridge.core.identity import public_id
from bridge.core.network_thread import NetworkThread
from bridge.core.topic_choice import drive_message
from bridge.core.topics import CAMERA
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist, TwistStamped
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse, ControlStatus
from bridge.msgs.rosapi_msgs import TopicsResponse
from robotside.core.text import plain
from robotside.foreign.foreign_topics import CONTROL, Found, match, usual

__all__ = ["ForeignLink", "Listener"]

log = logging.getLogger(__name__)

TOPICS_TIMEOUT = 3.0
"""How long the robot may take to tell its topics [s]."""

STOP_RETRY_PERIOD = 0.3
"""How long a STOP waits for its answer before it is pressed again [s]."""

HOLD_TIME = 1.1
"""So long a robot side of ours wants Release to be held [s]: a second by its own clock."""

MAX_SENDING_GAP = 0.15
"""After a longer pause between two commands zero goes before the next [s]; a robot side of ours takes 0.25 s for a lapse."""

_BINARY = {"/scan", "/map", CAMERA}
"""Worth to be sent as CBOR."""


class Listener(Protocol):
    """Whom a link tells; called in the link's thread."""

    def on_found(self, found: Found) -> None:
        """The robot is reached, stands still, and offers this."""

    def on_lost(self, sentence: str) -> None:
        """The robot is not reached, for this reason."""

    def on_message(self, topic: str, msg: Msg) -> None:
        """A message came on what is `topic` with us."""

    def on_held(self, sentence: str) -> None:
        """The robot is reached and obeys others, for this reason; empty when it obeys us."""


class ForeignLink:
    """Connects, and again whenever the connection is lost; what it is told while there is none is dropped."""

    def __init__(self, url: str, listener: Listener, credentials: Credentials | None = None) -> None:
        """`url` is `ws://HOST:PORT`; BadAddress when that is none. `credentials` are for a robot side of ours."""
        host_and_port(url)
        self._listener = listener
        self._client = BridgeClient(url, on_state=self._become, credentials=credentials)
        self._found: Found | None = None
        self._leave: dict[str, Callable[[], None]] = {}
        self._wanted: set[str] = set()
        self._asking: asyncio.Task[None] | None = None
        self._ordering: asyncio.Task[bool] | None = None
        self._busy = self._mine = False
        self._pressed = self._releases = False
        self._pressing: asyncio.Task[None] | None = None
        self.dropped = False
        """The last command did not leave this machine: there is no connection, or too much waits in it."""
        self._sent_at = -math.inf
        self._id = f"robotside-{secrets.token_hex(4)}"
        # who shows a key is known by it, whatever it calls itself
        self._public_id = (credentials and credentials.id) or public_id(self._id)
        self._name = f"the robot side on {plain(platform.node(), 20) or 'a computer'}"
        self._network = NetworkThread(f"link to {url}")
        self._network.start(self._client.run())

    def robot_time(self) -> float:
        """The foreign robot's clock now [s], as it tells it; NaN while it is not known."""
        return self._client.robot_time()

    @property
    def silent(self) -> bool:
        """Nothing has come from the robot for a second, though the link still stands."""
        return self._client.late

    def drive(self, twist: Twist) -> None:
        """Send a drive command at once, or never; rest even when it may arrive late."""
        self._network.call(self._drive, twist, self._client.robot_time())

    def press_stop(self) -> None:
        """Press the STOP of a robot side of ours, now and whenever it is reached, until `release_stop`."""
        self._network.call(self._press)

    def release_stop(self) -> None:
        """Release it if it was pressed from here."""
        self._network.call(self._release)

    def want(self, topic: str, wanted: bool) -> None:
        """Have the messages of an on-demand topic sent from now on, or no longer."""
        self._network.call(self._want, topic, wanted)

    def close(self) -> None:
        """Bring the robot to rest if it is reached, and end the link and its thread; again does nothing."""
        with contextlib.suppress(NotConnected):
            self._network.start(self._end()).result()
        self._network.close()

    async def _end(self) -> None:
        self._send(Twist(), self._client.robot_time())
        await asyncio.sleep(0)
        for work in (self._asking, self._ordering, self._pressing):
            if work is not None:
                work.cancel()
        await self._client.close()

    def _become(self, state: LinkState) -> None:
        if state.phase is Phase.CONNECTED:
            # first of all, and again when it is known on which topic: whatever it did when the link was lost
            self._send(Twist(), self._client.robot_time())
            self._asking = asyncio.create_task(self._ask())
        elif state.phase in (Phase.WAITING, Phase.CLOSED):
            self._busy = False
            if self._pressing is not None:
                self._pressing.cancel()
            if self._asking is not None:
                self._asking.cancel()
            self._listener.on_lost(state.sentence)

    async def _ask(self) -> None:
        found = await self._offer()
        if CONTROL in found.topics:
            await self._order("/control/acquire")
        if self._found is not None and self._found.command != found.command:
            self._send(Twist(), self._client.robot_time())
        before, self._found = self._found, found
        if before is not None and before.command != found.command:
            self._client.unadvertise(before.command)
        if before is None or (before.command, before.stamped) != (found.command, found.stamped):
            self._client.advertise(found.command, TwistStamped if found.stamped else Twist)
        self._send(Twist(), self._client.robot_time())
        for topic in {*self._leave, *found.topics}:
            if before is None or before.topics.get(topic) != found.topics.get(topic):
                self._unsubscribe(topic)
                self._subscribe(topic)
        self._listener.on_found(found)
        if self._pressed:
            self._press()

    async def _offer(self) -> Found:
        try:
            told = await self._client.call("/rosapi/topics", None, TopicsResponse, timeout=TOPICS_TIMEOUT)
        except BridgeError as error:
            log.info("%s does not tell its topics: %s", self._client.place, error)
            return usual()
        return match(dict(zip(told.topics, told.types, strict=False)))

    def _begin(self, service: str) -> None:
        if self._ordering is None or self._ordering.done():
            self._ordering = asyncio.create_task(self._order(service))

    async def _order(self, service: str, patience: float = TOPICS_TIMEOUT) -> bool:
        """Ask something of a robot side of ours, by our name; whether it may be is told on `CONTROL` as well."""
        asked = CommandRequest(client_id=self._id, client_name=self._name)
        with contextlib.suppress(BridgeError):
            return (await self._client.call(service, asked, CommandResponse, timeout=patience)).success
        return False

    def _press(self) -> None:
        self._pressed = True
        self._work(self._stop())

    def _release(self) -> None:
        pressed, self._pressed = self._pressed, False
        if pressed:
            self._releases = True
            self._work(self._unstop())

    def _work(self, work: Coroutine[Any, Any, None]) -> None:
        """Do what concerns STOP, in the place of what was done of that before."""
        if self._pressing is not None:
            self._pressing.cancel()
        if self._found is None or CONTROL not in self._found.topics:
            work.close()  # not reached yet, or it has no STOP of its own
            return
        self._pressing = asyncio.create_task(work)

    async def _stop(self) -> None:
        """Press STOP until the robot says that it is."""
        while True:
            if await self._order("/stop", STOP_RETRY_PERIOD):
                return
            await asyncio.sleep(STOP_RETRY_PERIOD)

    async def _unstop(self) -> None:
        """Release STOP if it was pressed from here; what was on its way when it was released is seen later."""
        if self._mine and await self._order("/control/acquire"):
            if await self._order("/stop/hold"):
                await asyncio.sleep(HOLD_TIME)
            await self._order("/stop/release")  # an older robot side wants no hold

    def _hear(self, topic: str, msg: Msg) -> None:
        if isinstance(msg, ControlStatus):
            others = msg.driver_id not in ("", self._public_id)
            self._mine = msg.stopped and msg.stopped_by == self._name
            self._busy = msg.mode == "AUTO" and not others
            expected = self._mine and self._pressed
            self._listener.on_held(
                _holder(structs.replace(msg, stopped=not expected and msg.stopped), others)
            )
            if self._mine and self._releases and not self._pressed:
                self._work(self._unstop())
            if msg.stopped and msg.driver_id == self._public_id and not self._mine:
                # only who has control may release STOP, and that is done where it was pressed
                self._begin("/control/release")
        else:
            self._listener.on_message(topic, msg)

    def _subscribe(self, topic: str) -> None:
        if self._found is None or topic not in self._found.topics or topic in self._leave:
            return
        if topic == CAMERA and topic not in self._wanted:
            return
        name, kind = self._found.topics[topic]
        compression = "cbor" if topic in _BINARY else "none"
        self._leave[topic] = self._client.subscribe(
            name, kind, lambda msg, _: self._hear(topic, msg), compression=compression
        )

    def _unsubscribe(self, topic: str) -> None:
        leave = self._leave.pop(topic, None)
        if leave is not None:
            leave()

    def _want(self, topic: str, wanted: bool) -> None:
        if wanted:
            self._wanted.add(topic)
            self._subscribe(topic)
        else:
            self._wanted.discard(topic)
            self._unsubscribe(topic)

    def _drive(self, twist: Twist, stamp: float) -> None:
        if self._busy and twist == Twist():
            # to a robot on a task of its own no speed is a stick that nobody touches
            self._begin("/task/pause")
        self._send(twist, stamp)

    def _send(self, twist: Twist, stamp: float) -> None:
        if self._found is None:
            return
        now, before = asyncio.get_running_loop().time(), self._sent_at
        if twist != Twist() and now - before > MAX_SENDING_GAP:
            # who steers here was late, and was judged for it here: a robot side of ours wants to hear zero after any pause
            rest = drive_message(Twist(), stamp, stamped=self._found.stamped)
            self._client.publish(self._found.command, rest, even_late=True)
        msg = drive_message(twist, stamp, stamped=self._found.stamped)
        sent = self._client.publish(self._found.command, msg, stamp=stamp, even_late=twist == Twist())
        self.dropped = not sent
        self._sent_at = now if sent else before


def _holder(told: ControlStatus, others: bool) -> str:
    """Why the robot does not obey us, as one sentence; empty when it does."""
    if told.stopped:
        return f"The robot's own STOP is pressed, by {told.stopped_by}: release it there."
    if others:
        return f"The robot is driven by {told.driver}: ask there, or wait until it is released."
    if told.mode == "AUTO":
        return "The robot is on a task of its own: pause it there, or press STOP."
    return ""
