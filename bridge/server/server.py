"""The rosbridge v2 server of a robot: publishes, answers services, takes commands, streams camera frames.

Each message is encoded once in each form, however many clients subscribe. Each client has a send queue of its own,
where a newer message of a stream replaces one that still waits, so that a slow client costs the others nothing.
Clients may publish to each other on topics that are not the robot's own, and offer each other services and actions.
Camera frames travel on WebSockets of their own at `/camera/NAME`.
"""

from __future__ import annotations

import asyncio
import contextlib
import errno
import logging
import re
import socket
import time
from collections.abc import Callable, Iterable, Mapping
from http import HTTPStatus
from typing import Any

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from bridge.core.async_tasks import cancel_all
from bridge.core.compat import Compat
from bridge.core.errors import BridgeError
from bridge.core.robot_catalogue import Operator
from bridge.core.robot_door import RobotDoor
from bridge.msgs import Msg
from bridge.protocol import MAX_SERVER_FRAME
from bridge.server.callback_connection import CallbackConnection
from bridge.server.camera_socket import CameraSocket
from bridge.server.client_services import ClientServices
from bridge.server.flow.message_reducing import MessageReducer
from bridge.server.flow.outgoing_messages import Reduce
from bridge.server.flow.quality_levels import QualityLevels, Shrink
from bridge.server.flow.round_trip import PING_PERIOD
from bridge.server.flow.send_queue import WriteBatch
from bridge.server.node_graph import NodeGraph
from bridge.server.rosapi.parameters import Parameters
from bridge.server.rosapi.services import RosApi
from bridge.server.rosbridge_session import RosbridgeSession
from bridge.server.server_context import ServerContext
from bridge.server.switchboard import Switchboard

__all__ = ["BridgeServer"]

log = logging.getLogger(__name__)

_CAMERA_PATH = re.compile(r"/camera/([\w-]+)/?(?:\?.*)?$")
_MAX_UNSENT_BYTES = 65536
"""Most bytes that wait for one client in this process and again in the kernel; then newer messages replace older ones."""

_DEAD_TIMEOUT = 15_000
"""A client that leaves data unacknowledged for this long is disconnected by the kernel [ms]."""
_CHECK_PERIOD = 1.0
"""Time between two checks of every client [s]."""
_CLOSE_TIMEOUT = 0.5
"""Time for clients to close before they are cut off [s]."""


def _ignore(topic: str, msg: Msg) -> None:
    """What is done with messages that are wanted otherwise."""


def _any(_: str) -> bool:
    return True


class BridgeServer:
    """The rosbridge server; serves any number of clients. All methods belong to the event loop it was started in."""

    def __init__(
        self,
        door: RobotDoor,
        *,
        offers: Callable[[str], bool] = _any,
        now: Callable[[], float] = time.time,
        cameras: Iterable[str] | None = None,
        shrink: Shrink | None = None,
        reduce: Reduce | None = None,
        params: Mapping[str, Any] | None = None,
        compat: Compat | None = None,
    ) -> None:
        """`now` is the operators' clock [s], the answer of `/rosapi/get_time`.

        `offers` names those of the robot's topics that `rosapi` lists. `cameras` are the names that may be watched, None for
        any; their frames come by `publish_frame`. `shrink` makes pictures smaller for slow watchers; without it they only
        come less often. `reduce` makes less of a message for subscribers that ask for fewer beams, smaller pictures or
        coarser maps; pictures and maps are reduced in a worker thread. `params` are the initial parameters of
        `/rosapi/get_param`.
        """
        self.port = 0
        """Port that it listens on; 0 until started."""
        cameras = None if cameras is None else list(cameras)
        self._door = door
        self._wanted: dict[str, Callable[[], None]] = {}
        """By topic with subscribers, the function that ends its messages."""
        self._switchboard = Switchboard(
            door.topics.values(), self._want, reduce=reduce, now=now, cameras=cameras or ()
        )
        client_services = ClientServices(door.services, door.actions)
        self._clients: dict[Operator, RosbridgeSession] = {}
        nodes = NodeGraph(
            self._switchboard, door.services, door.actions, client_services, self._clients, offers
        )
        self._reducer = MessageReducer()
        self._context = ServerContext(
            switchboard=self._switchboard,
            door=door,
            client_services=client_services,
            rosapi=RosApi(nodes.graph(), Parameters(params), now),
            reducer=self._reducer,
            compat=compat or Compat(),
            now=now,
        )
        self._cameras = None if cameras is None else frozenset(cameras)
        self._levels = QualityLevels(shrink)
        self._open: set[ServerConnection] = set()
        self._connections: dict[CallbackConnection, None] = {}
        self._server: Server | None = None
        self._batch: WriteBatch | None = None
        self._tasks: set[asyncio.Task[None]] = set()

    @property
    def operators(self) -> set[Operator]:
        """The connected clients; watchers of a camera are not among them."""
        return set(self._clients)

    async def start(self, host: str = "127.0.0.1", port: int = 9090) -> None:
        """Begin to listen; port 0 takes a free one. BridgeError when that is not possible."""
        self._batch = WriteBatch(asyncio.get_running_loop().call_soon)
        try:
            self._server = await serve(
                self._serve,
                host,
                port,
                process_request=self._admit,
                compression=None,
                create_connection=self._connection,  # type: ignore[arg-type]  # it is only called
                open_timeout=5,
                ping_interval=5,
                ping_timeout=10,
                close_timeout=_CLOSE_TIMEOUT,
                max_size=MAX_SERVER_FRAME,
                write_limit=_MAX_UNSENT_BYTES,
                server_header="Pilothouse",
                logger=_quiet_log(),
            )
        except OSError as error:
            raise BridgeError(_cannot_listen(host, port, error)) from error
        self.port = next(iter(self._server.sockets)).getsockname()[1]
        self._tasks |= {
            asyncio.create_task(self._check_clients()),
            asyncio.create_task(self._measure_round_trips()),
        }

    async def close(self) -> None:
        """Close all connections and stop listening; nothing is left running. Takes a second at most."""
        await self._levels.close()
        await self._reducer.close()
        await cancel_all(self._tasks)
        server, self._server = self._server, None
        if server is None:
            return
        server.close()
        try:
            async with asyncio.timeout(_CLOSE_TIMEOUT):
                await server.wait_closed()
        except TimeoutError:
            for ws in list(self._open):
                ws.transport.abort()
            await server.wait_closed()

    def publish(self, topic: str, msg: Msg) -> None:
        """Send `msg` to all subscribers; BridgeError for a topic that is not in the table.

        It leaves at the end of this step of the loop. Of a stream a newer message replaces one that still waits for a
        slow client. All others are kept in order; a client for whom too many wait is disconnected.
        """
        self._switchboard.publish(topic, msg)

    def publish_frame(self, camera: str, frame: bytes) -> None:
        """Send a packed camera frame to the watchers of `camera`; it replaces one that still waits."""
        self._switchboard.publish_frame(camera, self._levels.picture(frame))

    def _want(self, topic: str, wanted: bool) -> None:
        """Note the first subscriber of a topic of the robot, or that the last one left."""
        if wanted:
            own = topic in self._door.topics  # pictures of a camera may go as frames alone
            self._wanted[topic] = self._door.subscribe(self, topic, self.publish if own else _ignore)
        else:
            self._wanted.pop(topic)()

    def _connection(self, *args: Any, **options: Any) -> CallbackConnection:
        connection = CallbackConnection(*args, **options)
        connection.connections = self._connections
        return connection

    def _admit(self, connection: ServerConnection, request: Request) -> Response | None:
        camera = _CAMERA_PATH.match(request.path)
        if camera is None:
            connection.ping_interval = None  # a client's queue asks for signs of life itself
        if camera is None or self._cameras is None or camera[1] in self._cameras:
            return None
        names = ", ".join(sorted(self._cameras)) or "none"
        return connection.respond(HTTPStatus.NOT_FOUND, f"No camera {camera[1]} here; there is: {names}.\n")

    async def _serve(self, ws: ServerConnection) -> None:
        _tune(ws)
        camera = _CAMERA_PATH.match(ws.request.path) if ws.request else None
        self._open.add(ws)
        try:
            if camera:
                await self._serve_camera(ws, camera[1])
            elif isinstance(ws, CallbackConnection) and self._batch is not None:
                await self._serve_client(ws, self._batch)
        except ConnectionClosed:
            log.info("%s was cut off", _address(ws))
        except Exception:
            log.exception("Serving %s failed", _address(ws))
        finally:
            self._open.discard(ws)

    async def _serve_client(self, ws: CallbackConnection, batch: WriteBatch) -> None:
        operator = self._door.join(_address(ws), way="rosbridge")
        operator.on_expelled = ws.abort
        client = RosbridgeSession(ws, batch, operator, self._context)
        ws.batch = batch
        self._clients[operator] = client
        client.measure_round_trip()
        try:
            await ws.serve(client)
        finally:
            del self._clients[operator]
            try:
                self._door.leave(operator)
            finally:
                await client.close()

    async def _check_clients(self) -> None:
        """Check all clients regularly."""
        while True:
            await asyncio.sleep(_CHECK_PERIOD)
            for client in list(self._clients.values()):
                client.check_alive()

    async def _measure_round_trips(self) -> None:
        """Measure the round trips to all clients regularly."""
        while True:
            await asyncio.sleep(PING_PERIOD)
            for client in list(self._clients.values()):
                client.measure_round_trip()

    async def _serve_camera(self, ws: ServerConnection, camera: str) -> None:
        watcher = CameraSocket(ws, coarsest=self._levels.coarsest)
        self._switchboard.watch(watcher, camera)
        try:
            await watcher.run()
        finally:
            self._switchboard.unwatch(watcher, camera)


def _address(ws: ServerConnection) -> str:
    host, port = (*(ws.remote_address or ("unknown", 0)),)[:2]
    return f"{host}:{port}"


def _tune(ws: ServerConnection) -> None:
    """Limit the kernel's queue for a slow client, and its patience with a dead one."""
    sock = ws.transport.get_extra_info("socket")
    for option, value in (("TCP_NOTSENT_LOWAT", _MAX_UNSENT_BYTES), ("TCP_USER_TIMEOUT", _DEAD_TIMEOUT)):
        if hasattr(socket, option):
            with contextlib.suppress(OSError):
                sock.setsockopt(socket.IPPROTO_TCP, getattr(socket, option), value)


def _cannot_listen(host: str, port: int, error: OSError) -> str:
    if error.errno == errno.EADDRINUSE:
        return f"Port {port} on {host} is taken by another program; stop that one or choose another port."
    if error.errno == errno.EACCES:
        return f"Port {port} may be used by the system only; choose one above 1023."
    return f"Cannot listen on {host}:{port} ({error.strerror or error})."


def _quiet_log() -> logging.Logger:
    """A log for the WebSocket library, kept quiet: most of its errors are strangers that connect and leave."""
    quiet = logging.getLogger("bridge.server.server.websockets")
    quiet.setLevel(logging.CRITICAL)
    return quiet
