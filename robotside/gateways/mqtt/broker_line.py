"""One connection to a broker that comes back by itself: a queue of its own, and nothing from before it was made."""

from __future__ import annotations

import asyncio
import logging
import math
import re
import secrets
import socket
import ssl
from collections import deque
from collections.abc import AsyncIterator, Awaitable, Callable, Iterable, Mapping, Sequence
from contextlib import asynccontextmanager, suppress
from typing import NamedTuple, TypeVar

import aiomqtt
from paho.mqtt.packettypes import PacketTypes
from paho.mqtt.properties import Properties
from paho.mqtt.reasoncodes import ReasonCode
from paho.mqtt.subscribeoptions import SubscribeOptions

from bridge.core.async_tasks import is_cancelled_from_outside
from robotside.gateways.broker.line import Line
from robotside.gateways.gateway_url import GatewayUrl
from robotside.gateways.mqtt.library_client import LibraryClient

__all__ = ["BrokerLine", "Heard", "Reply", "uncut"]

T = TypeVar("T")

log = logging.getLogger(__name__)

KEEPALIVE = 2
"""Between two signs of life [s]; a broker gives up after one and a half of it, and publishes the last will."""
CONNECT_TIMEOUT = 5.0
"""For one answer of the broker [s]."""
PROBE_TIMEOUT = 5.0
"""What a line publishes to itself comes back within so long [s], or the broker does not pass on what it granted."""
EARLY_TIME = 1.0
"""What a broker has kept comes within so long after a subscription [s]."""
MAX_IN = 1024
"""Messages that wait to be handled; more are dropped."""
MAX_REPLIES = 256
"""Answers that wait to be sent; beyond them the oldest are dropped."""

_MIN_FAILURE = 0x80
"""Reason codes from this one on say that something is refused."""
_LOGIN_REFUSED = (0x86, 0x87)
"""A wrong user name or password; not authorized."""


class Heard(NamedTuple):
    """A message that a client published."""

    topic: str
    payload: bytes
    retained: bool
    """It was published to be kept."""
    expiry: float
    """How long it was still good for when the broker passed it on [s]; infinite without an expiry."""
    wish: str
    """Where an answer is wanted; empty when nothing was said."""
    correlation: bytes | None
    """To be repeated in the answer."""
    properties: dict[str, str]
    """The sender's own, each once."""
    early: bool = False
    """It came before the line's own probe did, so that the broker may have kept it from before."""


class Reply(NamedTuple):
    """An answer to a client."""

    topic: str
    payload: bytes
    correlation: bytes | None


class SubscriptionRefused(aiomqtt.MqttError):
    """The broker does not pass on what was asked for."""


class BrokerLine(Line):
    """Connects, subscribes, and does it again whenever that ends; owns its tasks."""

    faults = (aiomqtt.MqttError,)

    def __init__(
        self,
        url: GatewayUrl,
        subscriptions: Iterable[str],
        on_message: Callable[[Heard], None],
        *,
        probe: str,
        kept: str = "",
        will: tuple[str, bytes] | None = None,
        on_up: Callable[[], Awaitable[None]] | None = None,
        on_down: Callable[[str], None] | None = None,
        drops_stale: bool = True,
    ) -> None:
        """`on_up()` is awaited after each connection; `on_down` and `drops_stale` are as of every line.

        `probe` is a topic that the subscriptions have in them, and nobody else publishes on: what is published there must come back.
        `kept` is a topic of which what the broker has kept is heard too, before all else. `will` is the topic and retained message
        that the broker publishes when this end is gone without a word.
        """
        super().__init__(on_down=on_down, drops_stale=drops_stale)
        self._url, self._subscriptions, self._on_message = url, tuple(subscriptions), on_message
        self._probe, self._probed = probe, math.inf
        self._is_early = True
        self._kept = kept
        self._will, self._on_up = will, on_up
        # the same each time, so that a broker ends what it still has of a line before, its last will included, first
        self._id = f"pilothouse-{secrets.token_hex(6)}"
        self._client: aiomqtt.Client | None = None
        self._replies: deque[Reply] = deque(maxlen=MAX_REPLIES)
        self._wake = asyncio.Event()

    @property
    def is_deaf(self) -> bool:
        """The broker let it subscribe, and passes nothing on."""
        return self.is_up and asyncio.get_running_loop().time() - self._probed > PROBE_TIMEOUT

    def reply(self, reply: Reply) -> None:
        """Send an answer as soon as that can be; it is dropped when the line is lost before."""
        if self.is_up:
            self._replies.append(reply)
            self._wake.set()

    async def publish(
        self,
        topic: str,
        payload: bytes,
        *,
        retain: bool = False,
        qos: int = 0,
        timeout: float = CONNECT_TIMEOUT,
        **said: str,
    ) -> None:
        """Publish a message with the user properties `said`; with `qos` 1 it waits for the broker, `timeout` [s] at most. Dropped without a connection."""
        client = self._client
        if client is not None:
            with suppress(aiomqtt.MqttError):  # the line's own task learns of it too
                properties = _properties(said)
                await uncut(
                    client.publish(
                        topic, payload, qos=qos, retain=retain, timeout=timeout, properties=properties
                    )
                )

    async def _connect(self) -> None:
        """One connection from its beginning to its end; returns when what waits is too old to be heard."""
        async with _opened(self._new_client()) as client:
            if self._kept:
                await _subscribe(client, [self._kept], SubscribeOptions.RETAIN_SEND_ON_SUBSCRIBE, deaf=True)
            await _subscribe(client, self._subscriptions, SubscribeOptions.RETAIN_DO_NOT_SEND)
            self._client = client
            self._is_early = True
            await self.publish(self._probe, b"", qos=1)
            self._probed = asyncio.get_running_loop().time()
            self._came_up()
            if self._on_up is not None:
                await self._on_up()
            self._look_alive()
            await self._until_one_ends(self._listen(client), self._watch_loop(), self._send_replies(client))

    def _forget(self) -> None:
        self._client = None
        self._probed = math.inf
        self._replies.clear()

    def _reason(self, error: Exception) -> str:
        return _reason(error)

    async def _listen(self, client: aiomqtt.Client) -> None:
        """Hear messages until they are too old."""
        async for message in client.messages:
            if self._is_stale():
                return
            if str(message.topic) == self._probe:
                self._probed, self._is_early = math.inf, False
            else:
                self._handle(message)

    def _new_client(self) -> aiomqtt.Client:
        url, tls = self._url, ssl.create_default_context() if self._url.scheme == "mqtts" else None
        will = aiomqtt.Will(self._will[0], self._will[1], qos=1, retain=True) if self._will else None
        return LibraryClient(
            url.host,
            url.port,
            username=url.user or None,
            password=url.password or None,
            identifier=self._id,
            protocol=aiomqtt.ProtocolVersion.V5,
            will=will,
            clean_start=True,
            keepalive=KEEPALIVE,
            timeout=CONNECT_TIMEOUT,
            max_queued_incoming_messages=MAX_IN,
            tls_context=tls,
            # without it an answer waits for the broker's acknowledgement of what went before
            socket_options=[(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)],
            logger=_quiet_log(),
        )

    async def _send_replies(self, client: aiomqtt.Client) -> None:
        while True:
            await self._wake.wait()
            self._wake.clear()
            while self._replies:
                await _send_reply(client, self._replies.popleft())

    def _handle(self, message: aiomqtt.Message) -> None:
        try:
            since = asyncio.get_running_loop().time() - self._up_since
            self._on_message(_heard(message)._replace(early=self._is_early and since < EARLY_TIME))
        except Exception:
            log.exception("A message on %s failed", message.topic)


async def uncut(work: Awaitable[T]) -> T:
    """What `work` gives, unless the task was cancelled meanwhile.

    `asyncio.wait_for` of Python 3.11, which the library uses, loses a cancellation that comes together with the result.
    """
    try:
        return await work
    finally:
        if is_cancelled_from_outside():
            raise asyncio.CancelledError


@asynccontextmanager
async def _opened(client: aiomqtt.Client) -> AsyncIterator[aiomqtt.Client]:
    """The client, connected for as long as this is open. A thread connects: given up meanwhile, it is waited for and closed."""
    opening = asyncio.ensure_future(client.__aenter__())
    try:
        await asyncio.shield(opening)
    except aiomqtt.MqttError:
        client._client.disconnect()  # noqa: SLF001 - the library leaves the socket open, and a late answer would make it a client
        raise
    except asyncio.CancelledError:
        with suppress(aiomqtt.MqttError):
            await opening
            await client.__aexit__(None, None, None)
        raise
    try:
        yield client
    finally:
        with suppress(aiomqtt.MqttError):  # it is gone already
            await client.__aexit__(None, None, None)


async def _subscribe(
    client: aiomqtt.Client, topics: Sequence[str], handling: int, *, deaf: bool = False
) -> None:
    """Ask for topics, but for what this client itself publishes where it is `deaf`.

    Raises SubscriptionRefused when the broker does not let it have one of them.
    """
    options = SubscribeOptions(qos=1, noLocal=deaf, retainAsPublished=True, retainHandling=handling)
    granted = await uncut(client.subscribe([(topic, options) for topic in topics]))
    for topic, code in zip(topics, granted, strict=False):
        if _is_failure(code):
            raise SubscriptionRefused(
                f"it does not let the robot read {topic}; allow that in its access list"
            )


def _properties(said: Mapping[str, str]) -> Properties | None:
    if not said:
        return None
    properties = Properties(PacketTypes.PUBLISH)  # type: ignore[no-untyped-call]
    properties.UserProperty = list(said.items())
    return properties


async def _send_reply(client: aiomqtt.Client, reply: Reply) -> None:
    """Send one answer; one that cannot be sent is logged, and the others go on."""
    properties = Properties(PacketTypes.PUBLISH)  # type: ignore[no-untyped-call]
    try:
        if reply.correlation is not None:
            properties.CorrelationData = reply.correlation
        await uncut(client.publish(reply.topic, reply.payload, qos=0, properties=properties))
    except aiomqtt.MqttError:  # the line's own task learns of it too
        pass
    except Exception:
        log.exception("An answer on %.100s cannot be sent", reply.topic)


def _heard(message: aiomqtt.Message) -> Heard:
    said = message.properties
    payload = message.payload
    return Heard(
        str(message.topic),
        bytes(payload) if isinstance(payload, bytes | bytearray) else str(payload).encode(),
        message.retain,
        getattr(said, "MessageExpiryInterval", math.inf),
        getattr(said, "ResponseTopic", ""),
        getattr(said, "CorrelationData", None),
        dict(getattr(said, "UserProperty", ())),
    )


def _is_failure(code: object) -> bool:
    value = code.value if isinstance(code, ReasonCode) else code
    return isinstance(value, int) and value >= _MIN_FAILURE


def _reason(error: Exception) -> str:
    """Why there is no connection, as part of a sentence."""
    text = (
        re.sub(r"^\[(code:|Errno )-?\d+\] ", "", str(error.__cause__ or error).strip())
        or "it does not answer"
    )
    remedy = (
        "; check the user and password in the gateway's URL" if _is_login(error.__cause__ or error) else ""
    )
    return text.rstrip(".")[:200] + remedy


def _is_login(error: BaseException) -> bool:
    """The broker refuses who the robot says it is."""
    return isinstance(error, aiomqtt.MqttCodeError) and getattr(error.rc, "value", None) in _LOGIN_REFUSED


def _quiet_log() -> logging.Logger:
    """The library's log, without what is normal for a broker that comes and goes."""
    quiet = logging.getLogger("robotside.gateways.mqtt.library")
    quiet.setLevel(logging.CRITICAL)
    return quiet
