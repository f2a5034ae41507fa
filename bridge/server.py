"""The robot's end of the socket: a rosbridge v2 server that publishes, answers services and hears commands.

Each message is encoded once per codec, however many clients want it. Each client has its own outbox, in which
a newer message of a stream replaces one that still waits, so that a slow client costs the others nothing.
Camera frames travel on WebSockets of their own at `/camera/NAME`.
"""

from __future__ import annotations

import asyncio
import errno
import itertools
import logging
import re
import socket
import time
from collections import deque
from collections.abc import Awaitable, Callable, Coroutine, Iterable
from dataclasses import dataclass
from http import HTTPStatus
from typing import Any

import msgspec
from msgspec import Raw
from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from bridge.codec import from_json, shown, to_json
from bridge.errors import BridgeError, ProtocolError, Refused
from bridge.frames import sequence
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
from bridge.topics import TOPICS, Topic

__all__ = ["BridgeServer", "Service", "Session"]

log = logging.getLogger(__name__)
MsgClass = type[Msg]

CAMERA_TOPIC = "/camera/image/compressed"
"""Counts as wanted while a camera socket is open."""
_CAMERA_PATH = re.compile(r"/camera/([\w-]+)/?$")
_UNACKNOWLEDGED = 2
"""Frames on their way to one client; a third waits, so that a slow link shows the newest picture, not an old one."""
_UNSENT = 65536
"""Bytes that wait for one client in this process and again in the kernel, before its newer messages replace older."""


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


class Session:
    """One connected client."""

    def __init__(self, id: str, address: str, opened: float) -> None:
        self.id = id
        """Unique in this run of the server."""
        self.address = address
        """`HOST:PORT` of the client."""
        self.opened = opened
        """When it connected [s], robot clock."""
        self.last_heard = opened
        """When anything came from it [s], robot clock."""

    def __repr__(self) -> str:
        return f"Session({self.id!r}, {self.address!r})"


def _ignore(*_: object) -> None:
    """What an owner does who does not care."""


class BridgeServer:
    """Serves any number of clients; all methods belong to the event loop it was started in."""

    def __init__(
        self,
        *,
        services: Iterable[Service],
        on_message: Callable[[Session, str, Any, float | None], None],
        topics: Iterable[Topic] = TOPICS,
        now: Callable[[], float] = time.time,
        on_gone: Callable[[Session], None] = _ignore,
        on_demand: Callable[[str, bool], None] = _ignore,
        cameras: Iterable[str] | None = None,
    ) -> None:
        """`now` is the robot's clock [s].

        `on_message(session, topic, msg, stamp)` hears what clients publish on topics to the robot; `stamp` is when
        the sender meant it [s], robot clock, None when it does not say. `on_gone(session)` hears that a client left.
        `on_demand(topic, wanted)` hears that the first subscriber came or the last one left. `cameras` are the
        names that may be asked for; None allows any.
        """
        self.port = 0
        """Where it listens; 0 until started."""
        self.sessions: set[Session] = set()
        self.topics = {entry.name: entry for entry in topics}
        self.services = {service.name: service for service in services}
        self.now = now
        self.on_message = on_message
        self.rosapi = RosApi(self.topics, {s.name: s.type for s in self.services.values()}, now)
        self._on_gone = on_gone
        self._on_demand = on_demand
        self._camera_names = None if cameras is None else frozenset(cameras)
        self._numbers = itertools.count(1)
        self._latched: dict[str, Outgoing] = {}
        self._subscribers: dict[str, set[_Client]] = {}
        self._cameras: dict[str, set[_CameraSocket]] = {}
        self._server: Server | None = None

    async def start(self, host: str = "127.0.0.1", port: int = 9090) -> None:
        """Begin to listen; port 0 takes a free one. BridgeError when that is not possible."""
        try:
            self._server = await serve(
                self._serve,
                host,
                port,
                process_request=self._admit,
                compression=None,
                open_timeout=5,
                ping_interval=10,
                ping_timeout=20,
                close_timeout=0.5,
                write_limit=_UNSENT,
                server_header="Pilothouse",
                logger=_quiet_log(),
            )
        except OSError as error:
            raise BridgeError(_cannot_listen(host, port, error)) from error
        self.port = next(iter(self._server.sockets)).getsockname()[1]

    async def close(self) -> None:
        """Close all connections and stop listening; nothing is left running."""
        if self._server is not None:
            self._server.close(reason="the robot side is closing")
            await self._server.wait_closed()
            self._server = None

    def publish(self, topic: str, msg: Msg) -> None:
        """Send `msg` to everybody who subscribed; BridgeError for a topic that is not in the table.

        Of a stream a newer message replaces one that still waits for a slow client. All others are kept in order;
        a client for whom too many wait is disconnected.
        """
        entry = self.topics.get(topic)
        if entry is None:
            raise BridgeError(f"There is no topic {topic} in the table.")
        message = Outgoing(topic, msg)
        if entry.latched:
            self._latched[topic] = message
        for client in self._subscribers.get(topic, ()):
            client.deliver(entry, message)

    def publish_frame(self, camera: str, frame: bytes) -> None:
        """Send a packed camera frame to whoever watches `camera`; a newer one replaces one that still waits."""
        for watcher in self._cameras.get(camera, ()):
            watcher.offer(frame)

    def subscribed(self, client: _Client, topic: str) -> None:
        """A client wants `topic` from now on; it gets the last message at once if there is one to keep."""
        if not self._wanted(topic):
            self._on_demand(topic, True)
        self._subscribers.setdefault(topic, set()).add(client)
        if topic in self._latched:
            client.deliver(self.topics[topic], self._latched[topic])

    def unsubscribed(self, client: _Client, topic: str) -> None:
        """A client no longer wants `topic`."""
        clients = self._subscribers.get(topic, set())
        if client in clients:
            clients.discard(client)
            self._left(topic)

    def _wanted(self, topic: str) -> bool:
        watched = topic == CAMERA_TOPIC and any(self._cameras.values())
        return watched or bool(self._subscribers.get(topic))

    def _left(self, topic: str) -> None:
        if not self._wanted(topic):
            self._on_demand(topic, False)

    def _admit(self, connection: ServerConnection, request: Request) -> Response | None:
        camera = _CAMERA_PATH.match(request.path)
        if camera is None or self._camera_names is None or camera[1] in self._camera_names:
            return None
        names = ", ".join(sorted(self._camera_names)) or "none"
        return connection.respond(HTTPStatus.NOT_FOUND, f"No camera {camera[1]} here; there is: {names}.\n")

    async def _serve(self, ws: ServerConnection) -> None:
        _keep_kernel_queue_short(ws)
        camera = _CAMERA_PATH.match(ws.request.path) if ws.request else None
        try:
            await (self._serve_camera(ws, camera[1]) if camera else self._serve_client(ws))
        except Exception:
            log.exception("Serving %s failed", _address(ws))

    async def _serve_client(self, ws: ServerConnection) -> None:
        session = Session(str(next(self._numbers)), _address(ws), self.now())
        client = _Client(self, ws, session)
        self.sessions.add(session)
        try:
            await client.run()
        finally:
            self.sessions.discard(session)
            for topic in list(client.remembered.subscriptions):
                self.unsubscribed(client, topic)
            self._on_gone(session)

    async def _serve_camera(self, ws: ServerConnection, camera: str) -> None:
        watcher = _CameraSocket(ws)
        if not self._wanted(CAMERA_TOPIC):
            self._on_demand(CAMERA_TOPIC, True)
        self._cameras.setdefault(camera, set()).add(watcher)
        try:
            await watcher.run()
        finally:
            self._cameras[camera].discard(watcher)
            self._left(CAMERA_TOPIC)


class _Client:
    """The server's side of one rosbridge connection."""

    def __init__(self, server: BridgeServer, ws: ServerConnection, session: Session) -> None:
        self.remembered = ServerSession()
        self._server = server
        self._ws = ws
        self._session = session
        self._outbox = Outbox(self.remembered)
        self._wake = asyncio.Event()
        self._tasks: set[asyncio.Task[None]] = set()
        self._hear: dict[type[Op], Callable[[Any], None]] = {
            Publish: self._publish,
            CallService: self._call_service,
            Subscribe: self._subscribe,
            Unsubscribe: self._unsubscribe,
            Advertise: self._advertise,
            Unadvertise: self.remembered.unadvertise,
            SetLevel: self.remembered.set_level,
        }

    async def run(self) -> None:
        """Serve until the connection ends."""
        self._begin(self._write())
        try:
            async for text in self._ws:
                self._session.last_heard = self._server.now()
                self._receive(text)
        except ConnectionClosed:
            log.info("%s was cut off", self._session.address)
        finally:
            await _end(self._tasks)

    def deliver(self, entry: Topic, message: Outgoing) -> None:
        """Have a message sent as soon as the client can take it."""
        if entry.rate > 0:
            self._outbox.put_latest(message)
            self._wake.set()
            return
        try:
            self._send(message.frame(self.remembered.subscriptions[entry.name]))
        except ProtocolError as error:
            log.error("%s is not sent: %s", entry.name, error)

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
        entry = self._server.topics.get(topic)
        if entry is None or entry.to != "robot":
            raise ProtocolError(f"This robot does not listen to {topic}.")
        msg = from_json(op.msg, entry.type)
        try:
            self._server.on_message(self._session, topic, msg, op.stamp)
        except Exception:
            log.exception("%s from %s failed", topic, self._session.address)

    def _subscribe(self, op: Subscribe) -> None:
        self._check_type(op)
        self._server.subscribed(self, self.remembered.subscribe(op))

    def _unsubscribe(self, op: Unsubscribe) -> None:
        topic = self.remembered.unsubscribe(op)
        if topic not in self.remembered.subscriptions:
            self._server.unsubscribed(self, topic)

    def _advertise(self, op: Advertise) -> None:
        self._check_type(op)
        self.remembered.advertise(op)

    def _check_type(self, op: Subscribe | Advertise) -> None:
        entry = self._server.topics.get(absolute(op.topic))
        if entry is None:
            raise ProtocolError(f"This robot has no topic {shown(op.topic)}.")
        if op.type and op.type != "*" and ros1_name(op.type) != entry.type.MSGTYPE:
            raise ProtocolError(f"{entry.name} is {entry.type.MSGTYPE}, not {shown(op.type)}.")

    def _call_service(self, op: CallService) -> None:
        name = absolute(op.service)
        try:
            known = self._server.rosapi.answer(name, _named(op.args))
            if known is not None:
                self._answer(op, msgspec.json.encode(known))
                return
            service = self._server.services.get(name)
            if service is None:
                raise Refused(f"This robot has no service {name}.")
            outcome = service.call(self._session, arguments(op.args, service.request))
            if isinstance(outcome, Msg):
                self._answer(op, to_json(outcome))
            else:
                self._begin(self._await_answer(op, outcome))
        except Exception as error:
            self._refuse(op, error)

    async def _await_answer(self, op: CallService, outcome: Awaitable[Msg]) -> None:
        try:
            self._answer(op, to_json(await outcome))
        except Exception as error:
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
            self._ws.transport.abort()

    async def _write(self) -> None:
        clock = asyncio.get_running_loop().time
        try:
            while True:
                frame = self._next(clock())
                if frame is None:
                    await _wait(self._wake, self._outbox.delay(clock()))
                else:
                    await self._ws.send(frame.data, text=frame.text)
        except ConnectionClosed:
            return

    def _next(self, now: float) -> Frame | None:
        while True:
            try:
                return self._outbox.take(now)
            except ProtocolError as error:
                log.error("A message is not sent: %s", error)

    def _begin(self, work: Coroutine[Any, Any, None]) -> None:
        task = asyncio.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)


class _CameraSocket:
    """The server's side of one camera connection."""

    def __init__(self, ws: ServerConnection) -> None:
        self._ws = ws
        self._newest: bytes | None = None
        self._flying: deque[int] = deque()
        self._wake = asyncio.Event()

    async def run(self) -> None:
        """Serve until the connection ends."""
        writer = asyncio.create_task(self._write())
        try:
            async for text in self._ws:
                self._acknowledge(text)
        except ConnectionClosed:
            log.info("%s stopped watching", _address(self._ws))
        finally:
            await _end({writer})

    def offer(self, frame: bytes) -> None:
        """Have a frame sent as soon as the client has room for it."""
        self._newest = frame
        self._wake.set()

    def _acknowledge(self, text: str | bytes) -> None:
        word, _, number = str(text).partition(" ")
        if word == "ack" and number.isdecimal() and int(number) in self._flying:
            while self._flying.popleft() != int(number):
                pass
            self._wake.set()

    async def _write(self) -> None:
        try:
            while True:
                await _wait(self._wake, None)
                while self._newest is not None and len(self._flying) < _UNACKNOWLEDGED:
                    frame, self._newest = self._newest, None
                    self._flying.append(sequence(frame))
                    await self._ws.send(frame)
        except ConnectionClosed:
            return


async def _wait(wake: asyncio.Event, seconds: float | None) -> None:
    """Until `wake` is set or `seconds` have passed; None waits for ever."""
    timer = None if seconds is None else asyncio.get_running_loop().call_later(seconds, wake.set)
    try:
        await wake.wait()
    finally:
        wake.clear()
        if timer is not None:
            timer.cancel()


async def _end(tasks: set[asyncio.Task[None]]) -> None:
    for task in list(tasks):
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


def _named(args: Raw) -> dict[str, Any]:
    """The arguments of a rosapi call; those given as a list are not understood and count as none."""
    values = msgspec.json.decode(args)
    return values if isinstance(values, dict) else {}


def _address(ws: ServerConnection) -> str:
    host, port = (*(ws.remote_address or ("unknown", 0)),)[:2]
    return f"{host}:{port}"


def _keep_kernel_queue_short(ws: ServerConnection) -> None:
    sock = ws.transport.get_extra_info("socket")
    if sock is not None and hasattr(socket, "TCP_NOTSENT_LOWAT"):
        sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NOTSENT_LOWAT, _UNSENT)


def _cannot_listen(host: str, port: int, error: OSError) -> str:
    if error.errno == errno.EADDRINUSE:
        return f"Port {port} on {host} is taken by another program; stop that one or choose another port."
    if error.errno == errno.EACCES:
        return f"Port {port} may be used by the system only; choose one above 1023."
    return f"Cannot listen on {host}:{port} ({error.strerror or error})."


def _quiet_log() -> logging.Logger:
    """A log for the WebSocket library: what it calls errors are strangers who knock and leave."""
    quiet = logging.getLogger("bridge.server.websockets")
    quiet.setLevel(logging.CRITICAL)
    return quiet
