"""The server's side of one connection: a client of the rosbridge protocol."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable, Callable, Coroutine, Mapping
from dataclasses import dataclass
from typing import Any

import msgspec
from msgspec import Raw

from bridge.codec import from_json, shown, to_json
from bridge.errors import BridgeError, ProtocolError, Refused
from bridge.msgs import Msg, ros1_name
from bridge.outbox import Frame, Outbox, Outgoing
from bridge.protocol import (
    Advertise,
    CallService,
    Op,
    Publish,
    ServerSession,
    ServiceResponse,
    SetLevel,
    Status,
    Subscribe,
    Unadvertise,
    Unsubscribe,
    absolute,
    arguments,
    encode,
    parse,
)
from bridge.rosapi import RosApi
from bridge.sockets import Socket, end, wait
from bridge.switchboard import Switchboard
from bridge.topics import Topic

__all__ = ["Client", "Offer", "Service", "Session"]

log = logging.getLogger(__name__)
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
        """When anything came from it [s], operators' clock."""

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
class Offer:
    """What a server has for its clients, the same for all of them."""

    switchboard: Switchboard
    services: Mapping[str, Service]
    rosapi: RosApi
    now: Callable[[], float]
    """The operators' clock [s]."""
    on_message: Callable[[Session, str, Any, float | None], None]


class Client:
    """One client of the rosbridge protocol."""

    def __init__(self, socket: Socket, session: Session, offer: Offer) -> None:
        self.remembered = ServerSession()
        """What it asked for."""
        self._socket = socket
        self._session = session
        self._offer = offer
        self._outbox = Outbox(self.remembered)
        self._wake = asyncio.Event()
        self._tasks: set[asyncio.Task[None]] = set()
        self._hear: dict[type[Op], Callable[[Any], object]] = {
            Publish: self._publish,
            CallService: self._call_service,
            Subscribe: self._subscribe,
            Unsubscribe: self._unsubscribe,
            Advertise: self._advertise,
            Unadvertise: self.remembered.unadvertise,
            SetLevel: self.remembered.set_level,
        }

    async def run(self) -> None:
        """Serve until the connection ends; raises what the socket raises when it ends badly."""
        self._begin(self._write())
        try:
            async for text in self._socket:
                self._session.last_heard = self._offer.now()
                self._receive(text)
        finally:
            await end(self._tasks)
            for topic in list(self.remembered.subscriptions):
                self._offer.switchboard.unsubscribe(self, topic)

    def deliver(self, entry: Topic, message: Outgoing) -> None:
        """Have a message sent as soon as the client can take it; of a stream, the newest only."""
        if entry.rate > 0:
            self._outbox.put_latest(message)
            self._wake.set()
            return
        try:
            self._send(message.frame(self.remembered.subscriptions[entry.name]))
        except ProtocolError as error:
            log.warning("%s is not sent: %s", entry.name, error)

    def _receive(self, text: str | bytes) -> None:
        try:
            op = parse(text)
            hear = self._hear.get(type(op))
            if hear is None:
                raise ProtocolError(f"{op.__struct_config__.tag} is not for a server.")
            hear(op)
        except ProtocolError as error:
            self._remark(str(error))

    def _publish(self, op: Publish) -> None:
        topic = absolute(op.topic)
        entry = self._offer.switchboard.topics.get(topic)
        if entry is None or entry.to != "robot":
            raise ProtocolError(f"This robot does not listen to {shown(topic)}.")
        msg = from_json(op.msg, entry.type)
        try:
            self._offer.on_message(self._session, topic, msg, op.stamp)
        except Exception:
            log.exception("%s from %s failed", topic, self._session.address)

    def _subscribe(self, op: Subscribe) -> None:
        self._check_type(op)
        self._offer.switchboard.subscribe(self, self.remembered.subscribe(op))

    def _unsubscribe(self, op: Unsubscribe) -> None:
        topic = self.remembered.unsubscribe(op)
        if topic not in self.remembered.subscriptions:
            self._offer.switchboard.unsubscribe(self, topic)

    def _advertise(self, op: Advertise) -> None:
        self._check_type(op)
        self.remembered.advertise(op)

    def _check_type(self, op: Subscribe | Advertise) -> None:
        entry = self._offer.switchboard.topics.get(absolute(op.topic))
        if entry is None:
            raise ProtocolError(f"This robot has no topic {shown(op.topic)}.")
        if op.type and op.type != "*" and ros1_name(op.type) != entry.type.MSGTYPE:
            raise ProtocolError(f"{entry.name} is {entry.type.MSGTYPE}, not {shown(op.type)}.")

    def _call_service(self, op: CallService) -> None:
        name = absolute(op.service)
        try:
            known = self._offer.rosapi.answer(name, op.args)
            if known is not None:
                self._answer(op, known)
                return
            service = self._offer.services.get(name)
            if service is None:
                raise Refused(f"This robot has no service {shown(name)}.")
            outcome = service.call(self._session, arguments(op.args, service.request))
            if isinstance(outcome, Msg):
                self._answer(op, to_json(outcome))
            else:
                self._begin(self._await_answer(op, outcome))
        except Exception as error:  # noqa: BLE001 -- a service may fail in any way; the caller and the log are told
            self._refuse(op, error)

    async def _await_answer(self, op: CallService, outcome: Awaitable[Msg]) -> None:
        try:
            self._answer(op, to_json(await outcome))
        except Exception as error:  # noqa: BLE001 -- a service may fail in any way; the caller and the log are told
            self._refuse(op, error)

    def _refuse(self, op: CallService, error: Exception) -> None:
        if isinstance(error, BridgeError):
            reason = str(error)
        else:
            log.error("%s from %s failed", op.service, self._session.address, exc_info=error)
            reason = f"The robot failed at {op.service}; its log says why."
        self._answer(op, msgspec.json.encode(reason), result=False)

    def _answer(self, op: CallService, values: bytes, *, result: bool = True) -> None:
        response = ServiceResponse(id=op.id, service=op.service, values=Raw(values), result=result)
        self._send(Frame(encode(response), text=True))

    def _remark(self, sentence: str) -> None:
        log.debug("%s: %s", self._session.address, sentence)
        if self.remembered.wants("error"):
            self._send(Frame(encode(Status(level="error", msg=sentence)), text=True))

    def _send(self, frame: Frame) -> None:
        if self._outbox.put(frame):
            self._wake.set()
        else:
            log.warning("%s does not read what it asked for and is disconnected", self._session.address)
            self._socket.transport.abort()

    async def _write(self) -> None:
        clock = asyncio.get_running_loop().time
        while True:
            frame = self._next(clock())
            if frame is None:
                await wait(self._wake, self._outbox.delay(clock()))
            else:
                await self._socket.send(frame.data, text=frame.text)

    def _next(self, now: float) -> Frame | None:
        while True:
            try:
                return self._outbox.take(now)
            except ProtocolError as error:
                log.warning("A message is not sent: %s", error)

    def _begin(self, work: Coroutine[Any, Any, None]) -> None:
        task = asyncio.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._ended)

    def _ended(self, task: asyncio.Task[None]) -> None:
        self._tasks.discard(task)
        if not task.cancelled() and task.exception() is not None:
            log.info("%s can no longer be sent to: %s", self._session.address, task.exception())
            self._socket.transport.abort()
