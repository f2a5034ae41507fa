"""The handheld's end of the socket: a rosbridge v2 client that connects again by itself and never sends late."""

from __future__ import annotations

import asyncio
import contextlib
import enum
import logging
import math
import random
import socket
import time
from collections.abc import AsyncIterator, Callable
from dataclasses import dataclass
from typing import TypeVar

import msgspec
from msgspec import Raw
from websockets.asyncio.client import ClientConnection, connect
from websockets.asyncio.connection import broadcast
from websockets.exceptions import ConnectionClosed, InvalidHandshake, InvalidStatus
from websockets.protocol import State

from bridge.address import BadAddress, LinkLost, cause, host_and_port, look_up
from bridge.codec import from_builtins, from_json, to_json
from bridge.errors import NoReply, NotConnected, ProtocolError, Refused
from bridge.frames import Frame, unpack
from bridge.msgs import Msg
from bridge.msgs.std_msgs import Time
from bridge.pings import Ping, Pings
from bridge.protocol import (
    BinaryPublish,
    ClientSession,
    Op,
    Publish,
    ServiceResponse,
    Status,
    Subscribe,
    dump,
    parse,
    parse_binary,
)
from bridge.reconnecting import Reconnecting

__all__ = ["BridgeClient", "CameraStream", "LinkState", "Phase"]

log = logging.getLogger(__name__)
M = TypeVar("M", bound=Msg)

OPEN_TIMEOUT = 3.0
"""How long looking up a name may take, and then opening the connection [s]."""
LARGEST = 32 * 1024 * 1024
"""The largest message that is taken [byte]; a big map is one message."""
SILENCE = 3.0
"""A link on which nothing came for this long is lost [s]."""
PING_PERIOD = 0.5
"""[s]"""
_UNSENT = 65536
"""With more bytes than this waiting in the socket nothing is published."""


class Phase(enum.Enum):
    """Where a link is in its life."""

    CONNECTING = "connecting"
    CONNECTED = "connected"
    WAITING = "waiting"
    """Between two attempts."""
    CLOSED = "closed"
    """By `close()`, or because the address can never work."""


@dataclass(frozen=True)
class LinkState:
    """The state of a link, for the operator."""

    phase: Phase
    sentence: str
    """What is the case, in plain words."""
    attempt: int
    """Attempts since the last connection, this one included; 0 when connected."""
    retry_in: float
    """Seconds from this state's beginning to the next attempt; 0 except in WAITING."""


class GetTimeResponse(Msg, frozen=True, gc=False):
    """What `/rosapi/get_time` answers."""

    time: Time = Time()


class BridgeClient(Reconnecting):
    """A link to one robot; all methods belong to the event loop that `run` runs in."""

    def __init__(
        self,
        url: str,
        *,
        on_state: Callable[[LinkState], None] | None = None,
        now: Callable[[], float] = time.monotonic,
        backoff: tuple[float, float] = (0.5, 5.0),
        rng: random.Random | None = None,
    ) -> None:
        """`url` is `ws://HOST:PORT`. `backoff` is the first and the longest wait between attempts [s].

        `now` is this machine's clock [s]; `rng` spreads the waits, so that many handhelds do not come at once.
        """
        super().__init__(url, now, backoff, rng)
        self.state = LinkState(Phase.CLOSED, "Not connected.", 0, 0.0)
        self._on_state = on_state
        self._session = ClientSession()
        self._ws: ClientConnection | None = None
        self._pings = Pings()
        self._heard = -math.inf
        self._complained: set[str] = set()

    @property
    def rtt(self) -> float:
        """How long the last answered ping took [s]; NaN until there is one."""
        return self._pings.rtt

    @property
    def offset(self) -> float:
        """The operators' clock minus `now()` [s], by the least rtt of the last 20 pings; NaN until known."""
        return self._pings.offset

    @property
    def lost(self) -> int:
        """How many of the last 20 pings were not answered within 1.5 s."""
        return self._pings.lost(self._now())

    def robot_time(self) -> float:
        """The operators' clock, which the robot tells, now [s]; NaN until it is known."""
        return self._now() + self.offset

    def subscribe(
        self,
        topic: str,
        type: type[M],
        callback: Callable[[M, float], object],
        *,
        throttle_rate: int = 0,
        queue_length: int = 1,
        compression: str = "none",
    ) -> Callable[[], None]:
        """Have `callback(msg, received)` called for each message, `received` by `now()` [s]; gives the unsubscriber.

        It is remembered over reconnects. `throttle_rate` is the shortest time between two messages [ms];
        `compression` is `none` or `cbor`. A message that does not fit `type` is logged and left out.
        """
        wanted = Subscribe(
            topic=topic,
            type=type.MSGTYPE,
            throttle_rate=throttle_rate,
            queue_length=queue_length,
            compression=compression,
        )
        first, last = self._session.subscribe(wanted, type, callback)
        self._send(first)

        def unsubscribe() -> None:
            if self._session.unsubscribe(last):
                self._send(last)

        return unsubscribe

    def advertise(self, topic: str, type: type[Msg]) -> None:
        """Say that this client publishes on `topic`, now and after each reconnect; foreign servers want to know."""
        self._send(self._session.advertise(topic, type))

    def publish(self, topic: str, msg: Msg, *, stamp: float | None = None) -> bool:
        """Send a message at once. False when it was dropped, because there is no connection or it is stuck.

        It is never sent later. `stamp` is when the operator meant it [s], operators' clock.
        """
        ws = self._ws
        if ws is None or self.state.phase is not Phase.CONNECTED:
            return False
        if ws.transport.get_write_buffer_size() > _UNSENT:
            return False
        if stamp is not None and not math.isfinite(stamp):
            stamp = None
        return self._send(Publish(topic=topic, msg=Raw(to_json(msg)), stamp=stamp))

    async def call(self, service: str, request: Msg | None, response: type[M], *, timeout: float = 2.0) -> M:
        """Ask the robot for something to be done once. `timeout` is how long to wait [s].

        Raises Refused with the robot's own sentence, NotConnected, NoReply, or ProtocolError for an answer that
        is no `response`.
        """
        answer: asyncio.Future[ServiceResponse | None] = asyncio.get_running_loop().create_future()
        args = b"{}" if request is None else to_json(request)

        def answered(found: ServiceResponse | None) -> None:
            if not answer.done():
                answer.set_result(found)

        op = self._session.call(service, args, answered)
        try:
            if not self._send(op):
                raise NotConnected(f"There is no connection to {self.place}.")
            async with asyncio.timeout(timeout):
                found = await answer
        except TimeoutError as error:
            raise NoReply(f"The robot did not answer {service} within {timeout:g} s.") from error
        finally:
            self._session.calls.forget(op.id)
        if found is None:
            raise NotConnected(f"The connection was cut before the robot answered {service}.")
        return _response(found, response)

    async def close(self) -> None:
        """End the link for good; `run` returns. Takes 0.3 s at most."""
        await super().close()
        if self.state.phase is not Phase.CLOSED:
            self._become(Phase.CLOSED, "Not connected.")

    async def stay_connected(self) -> None:
        """Connect again and again; returns when the address can never work."""
        attempt, trouble = 0, ""
        while True:
            attempt += 1
            opening = f"{trouble} Trying again." if trouble else f"Connecting to {self.place}."
            self._become(Phase.CONNECTING, opening, attempt)
            try:
                await self._connect_once()
            except BadAddress as error:
                self._become(Phase.CLOSED, str(error), attempt)
                return
            except LinkLost as error:
                trouble = str(error)
            if self.state.phase is Phase.CONNECTED:
                attempt = 0
            wait = self.wait_before(max(1, attempt))
            self._become(Phase.WAITING, trouble, attempt, wait)
            await asyncio.sleep(wait)

    async def _connect_once(self) -> None:
        """Connect and serve the link until it is lost; raises LinkLost or BadAddress always."""
        ws = await _dial(self.url)
        self._pings = Pings()
        self._heard = self._now()
        self._ws = ws
        work = {asyncio.create_task(self._listen(ws)), asyncio.create_task(self._watch())}
        try:
            for op in self._session.opening():
                self._send(op)
            done, _ = await asyncio.wait(work, return_when=asyncio.FIRST_COMPLETED)
            for task in done:
                task.result()
        finally:
            self._ws = None
            for task in work:
                task.cancel()
            await asyncio.gather(*work, return_exceptions=True)
            self._session.lose()
            await _hang_up(ws)

    async def _listen(self, ws: ClientConnection) -> None:
        async for raw in _arriving(ws):
            self._heard = self._now()
            try:
                # A CBOR map begins with a byte above 127, JSON text never does.
                self._receive(parse_binary(raw) if raw[:1] > b"\x7f" else parse(raw))
            except ProtocolError as error:
                log.debug("%s sent what is no operation: %s", self.url, error)
        raise LinkLost(f"The connection to {self.place} was cut.")

    async def _watch(self) -> None:
        """Ping; raise LinkLost when the link is silent or never was a rosbridge."""
        opened = self._now()
        while True:
            self._ping()
            await asyncio.sleep(PING_PERIOD)
            now = self._now()
            if self.state.phase is not Phase.CONNECTED and now - opened >= SILENCE:
                raise LinkLost(
                    f"{self.place} is a WebSocket but no robot: it did not answer within {SILENCE:g} s."
                )
            if now - self._heard >= SILENCE:
                raise LinkLost(f"Nothing came from {self.place} for {SILENCE:g} s.")

    def _ping(self) -> None:
        ping = self._pings.send(self._now())
        self._send(self._session.call("/rosapi/get_time", b"{}", lambda found: self._pong(ping, found)))

    def _pong(self, ping: Ping, answer: ServiceResponse | None) -> None:
        if answer is None:
            return
        self._pings.answer(ping, self._now(), _time_in(answer))
        if self.state.phase is not Phase.CONNECTED:
            self._become(Phase.CONNECTED, f"Connected to {self.place}.")

    def _receive(self, op: Op | BinaryPublish) -> None:
        if isinstance(op, ServiceResponse):
            self._session.answered(op)
        elif isinstance(op, (Publish, BinaryPublish)):
            self._hear(op)
        elif isinstance(op, Status):
            log.warning("%s says: %s", self.url, op.msg)

    def _hear(self, op: Publish | BinaryPublish) -> None:
        decoded: dict[type[Msg], Msg] = {}
        for subscription in self._session.subscribers(op.topic):
            kind = subscription.type
            try:
                if kind not in decoded:
                    decoded[kind] = _decoded(op, kind)
                subscription.callback(decoded[kind], self._heard)
            except ProtocolError as error:
                self._complain(op.topic, error)
            except Exception:
                log.exception("Showing %s failed", op.topic)

    def _complain(self, topic: str, error: ProtocolError) -> None:
        level = logging.DEBUG if topic in self._complained else logging.WARNING
        self._complained.add(topic)
        log.log(level, "%s from %s is left out: %s", topic, self.url, error)

    def _send(self, op: Op) -> bool:
        if self._ws is None or self._ws.state is not State.OPEN:
            return False
        broadcast([self._ws], dump(op))
        return True

    def _become(self, phase: Phase, sentence: str, attempt: int = 0, retry_in: float = 0.0) -> None:
        self.state = LinkState(phase, sentence, attempt, retry_in)
        if self._on_state is not None:
            try:
                self._on_state(self.state)
            except Exception:
                log.exception("Telling the state of %s failed", self.url)


class CameraStream(Reconnecting):
    """The pictures of one camera, over a WebSocket of their own; connects again by itself."""

    def __init__(
        self,
        url: str,
        on_frame: Callable[[Frame, float], None],
        *,
        now: Callable[[], float] = time.monotonic,
        backoff: tuple[float, float] = (0.5, 5.0),
        rng: random.Random | None = None,
    ) -> None:
        """`url` is `ws://HOST:PORT/camera/NAME`; `on_frame(frame, received)`, `received` by `now()` [s]."""
        super().__init__(url, now, backoff, rng)
        self._on_frame = on_frame

    async def stay_connected(self) -> None:
        """Connect again and again; returns when the address can never work."""
        attempt = 0
        while True:
            attempt += 1
            try:
                ws = await _dial(self.url, ping_interval=2.0)
                attempt = 0
                await self._watch(ws)
            except BadAddress as error:
                log.warning("No pictures: %s", error)
                return
            except LinkLost as error:
                log.info("No pictures: %s", error)
            await asyncio.sleep(self.wait_before(max(1, attempt)))

    async def _watch(self, ws: ClientConnection) -> None:
        try:
            async for raw in _arriving(ws):
                try:
                    frame = unpack(raw)
                except ProtocolError as error:
                    log.debug("%s: %s", self.url, error)
                    continue
                broadcast([ws], f"ack {frame.seq}")
                self._show(frame)
        finally:
            await _hang_up(ws)
        raise LinkLost(f"The pictures from {self.place} were cut off.")

    def _show(self, frame: Frame) -> None:
        try:
            self._on_frame(frame, self._now())
        except Exception:
            log.exception("Showing a picture of %s failed", self.url)


def _decoded(op: Publish | BinaryPublish, type: type[M]) -> M:
    return from_json(op.msg, type) if isinstance(op, Publish) else from_builtins(op.msg, type)


def _response(answer: ServiceResponse, type: type[M]) -> M:
    if answer.result:
        return from_json(answer.values, type)
    reason = msgspec.json.decode(answer.values)
    raise Refused(reason if isinstance(reason, str) and reason else f"The robot refused {answer.service}.")


def _time_in(answer: ServiceResponse) -> float:
    """The operators' clock [s]; NaN when the robot cannot say."""
    try:
        return from_json(answer.values, GetTimeResponse).time.seconds if answer.result else math.nan
    except ProtocolError:
        return math.nan


async def _dial(url: str, *, ping_interval: float | None = None) -> ClientConnection:
    """Open a WebSocket; with `ping_interval` [s] it is closed when its other end no longer answers pings."""
    host, port = host_and_port(url)
    place = f"{host}:{port}"
    try:
        return await connect(
            url,
            host=await look_up(host, OPEN_TIMEOUT),
            port=port,
            compression=None,
            proxy=None,
            open_timeout=OPEN_TIMEOUT,
            ping_interval=ping_interval,
            ping_timeout=ping_interval and ping_interval * 2,
            close_timeout=0.2,
            max_size=LARGEST,
            user_agent_header=None,
            logger=_quiet_log(),
        )
    except socket.gaierror as error:
        raise LinkLost(f"No machine called {host} is known on this network.") from error
    except TimeoutError as error:
        raise LinkLost(f"No robot answers at {place} (no reply within {OPEN_TIMEOUT:g} s).") from error
    except InvalidStatus as error:
        status = error.response.status_code
        raise LinkLost(f"What answers at {place} is no robot (HTTP {status}).") from error
    except (InvalidHandshake, EOFError, ConnectionResetError) as error:
        raise LinkLost(f"What answers at {place} is no robot (it does not speak WebSocket).") from error
    except OSError as error:
        raise LinkLost(f"No robot answers at {place} ({cause(error)}).") from error


async def _arriving(ws: ClientConnection) -> AsyncIterator[bytes]:
    """What comes, text and binary alike as bytes, until the connection ends, however it ends."""
    sock = ws.transport.get_extra_info("socket")
    with contextlib.suppress(ConnectionClosed):
        while True:
            yield await ws.recv(decode=False)
            _acknowledge_at_once(sock)


def _acknowledge_at_once(sock: socket.socket) -> None:
    """Ask the kernel not to sit on acknowledgements: a ROS 1 server holds data back for them, up to 40 ms."""
    if hasattr(socket, "TCP_QUICKACK"):
        with contextlib.suppress(OSError):
            sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_QUICKACK, 1)


async def _hang_up(ws: ClientConnection) -> None:
    """Close a connection; 0.2 s at most, even when nothing listens at its other end any more."""
    try:
        async with asyncio.timeout(0.2):
            await ws.close()
    except TimeoutError:
        log.debug("%s did not say goodbye", ws.remote_address)
    finally:
        ws.transport.abort()


def _quiet_log() -> logging.Logger:
    """A log for the WebSocket library: what it reports, the link reports in plain words."""
    quiet = logging.getLogger("bridge.client.websockets")
    quiet.setLevel(logging.CRITICAL)
    return quiet
