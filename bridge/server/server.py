"""The rosbridge v2 server of a robot: publishes, answers services, takes commands, streams camera frames.

Each message is encoded once in each form, however many clients subscribe. Each client has a send queue of its own,
where a newer message of a stream replaces one that still waits, so that a slow client costs the others nothing.
Clients may publish to each other on topics that are not the robot's own, and offer each other services and actions.
Camera frames travel on WebSockets of their own at `/camera/NAME`.
"""

from __future__ import annotations

import asyncio
import logging
import re
import ssl
import time
from collections.abc import Callable, Iterable, Mapping
from http import HTTPStatus
from types import MappingProxyType
from typing import Any

from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from bridge.core.async_tasks import cancel_all
from bridge.core.camera_frames import ASKS_FOR_SAME
from bridge.core.compat import Compat
from bridge.core.robot_catalogue import Operator
from bridge.core.robot_door import RobotDoor
from bridge.msgs import Msg
from bridge.protocol import MAX_SERVER_FRAME
from bridge.server.callback_connection import CallbackConnection
from bridge.server.camera_socket import CameraSocket
from bridge.server.client_list import CLIENT_TOPICS, publish_clients
from bridge.server.client_services import ClientServices
from bridge.server.flow.message_reducing import MessageReducer
from bridge.server.flow.outgoing_messages import Reduce
from bridge.server.flow.quality_levels import QualityLevels, Shrink
from bridge.server.flow.round_trip import PING_PERIOD
from bridge.server.flow.send_queue import WriteBatch
from bridge.server.handshakes import Handshakes, address_of
from bridge.server.node_graph import NodeGraph
from bridge.server.reception.log_limit import STRANGERS
from bridge.server.reception.pages import PagePolicy
from bridge.server.reception.places import Limits
from bridge.server.reception.reception import anyone
from bridge.server.rosapi.parameters import Parameters
from bridge.server.rosapi.services import RosApi
from bridge.server.rosbridge_session import RosbridgeSession
from bridge.server.server_context import ServerContext
from bridge.server.switchboard import Switchboard
from bridge.server.web_socket_listener import WebSocketListener, tune

__all__ = ["BridgeServer"]

log = logging.getLogger(__name__)
log.addFilter(STRANGERS)

_CAMERA_PATH = re.compile(r"/camera/([\w-]+)/?(?:\?.*)?$")
LIMITS = Limits()
"""Connections that a server has at a time, where nothing else is asked for."""
_CHECK_PERIOD = 1.0
"""Time between two checks of every client [s]."""


_MADE_HERE = frozenset(topic.name for topic in CLIENT_TOPICS)


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
        limits: Limits = LIMITS,
        documents: Mapping[str, Callable[[], bytes]] = MappingProxyType({}),
    ) -> None:
        """`now` is the operators' clock [s], the answer of `/rosapi/get_time`.

        `offers` names those of the robot's topics that `rosapi` lists. `cameras` are the names that may be watched, None for
        any; their frames come by `publish_frame`. `shrink` makes pictures smaller for slow watchers; without it they only
        come less often. `reduce` makes less of a message for subscribers that ask for fewer beams, smaller pictures or
        coarser maps; pictures and maps are reduced in a worker thread. `params` are the initial parameters of
        `/rosapi/get_param`. `limits` says how many connections there may be.
        `documents` are JSON that anybody may have by a GET of their path, without a session.
        """
        self.port = 0
        """Port that it listens on; 0 until started."""
        cameras = None if cameras is None else list(cameras)
        self._door = door
        self._wanted: dict[str, Callable[[], None]] = {}
        """By topic with subscribers, the function that ends its messages."""
        self._switchboard = Switchboard(
            (*door.topics.values(), *CLIENT_TOPICS),
            self._want,
            reduce=reduce,
            now=now,
            cameras=cameras or (),
        )
        publish_clients((), self._switchboard.publish)
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
        self._limits, self._documents = limits, documents
        self._listener = WebSocketListener(limits)
        self._handshakes = Handshakes(door, PagePolicy(), now)
        self._batch: WriteBatch | None = None
        self._tasks: set[asyncio.Task[None]] = set()

    @property
    def operators(self) -> set[Operator]:
        """The connected clients; watchers of a camera are not among them."""
        return set(self._clients)

    async def start(
        self,
        host: str = "127.0.0.1",
        port: int = 9090,
        *,
        tls: ssl.SSLContext | None = None,
        plain_from: Callable[[str], bool] = anyone,
        pages: PagePolicy | None = None,
    ) -> None:
        """Begin to listen; port 0 takes a free one. BridgeError when that is not possible.

        With `tls` clients may come encrypted, on the same port; `plain_from(host)` says who may come without.
        `pages` are the web pages that may connect, by default none.
        """
        self._handshakes = Handshakes(self._door, pages or PagePolicy(), self._context.now)
        self._listener = WebSocketListener(self._limits, tls=tls, plain_from=plain_from)
        self._batch = WriteBatch(asyncio.get_running_loop().call_soon)
        await self._listener.start(
            host, port, self._serve, admit=self._admit, greet=self._greet, max_size=MAX_SERVER_FRAME
        )
        self.port = self._listener.port
        self._tasks |= {
            asyncio.create_task(self._check_clients()),
            asyncio.create_task(self._measure_round_trips()),
        }

    async def close(self) -> None:
        """Close all connections and stop listening; nothing is left running. Takes a second at most."""
        await self._levels.close()
        await self._reducer.close()
        await cancel_all(self._tasks)
        await self._listener.close()

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
        if topic in _MADE_HERE:
            return
        if wanted:
            own = topic in self._door.topics  # pictures of a camera may go as frames alone
            self._wanted[topic] = self._door.subscribe(self, topic, self.publish if own else _ignore)
        else:
            self._wanted.pop(topic)()

    def _admit(self, ws: ServerConnection, request: Request) -> Response | None:
        refusal = self._handshakes.refusal(ws, request)
        if refusal is None and request.path in self._documents:
            return _document(ws, self._documents[request.path]())
        camera = _camera(request)
        if camera is None:
            ws.ping_interval = None  # a client's queue asks for signs of life itself
        if refusal or camera is None or self._cameras is None or camera in self._cameras:
            return refusal
        names = ", ".join(sorted(self._cameras)) or "none"
        return ws.respond(HTTPStatus.NOT_FOUND, f"No camera {camera} here; there is: {names}.\n")

    def _greet(self, ws: ServerConnection, request: Request, response: Response) -> Response | None:
        if response.status_code != HTTPStatus.SWITCHING_PROTOCOLS or not isinstance(ws, CallbackConnection):
            return None
        return self._handshakes.join(ws, request, _camera(request))

    async def _serve(self, ws: ServerConnection) -> None:
        operator = self._handshakes.joined.pop(ws, None) if isinstance(ws, CallbackConnection) else None
        if operator is None or not isinstance(ws, CallbackConnection) or self._batch is None:
            return
        tune(ws)
        camera = _camera(ws.request)
        self._open.add(ws)
        try:
            if camera:
                await self._serve_camera(ws, camera)
            else:
                await self._serve_client(ws, operator, self._batch)
        except ConnectionClosed:
            log.info("%s was cut off", address_of(ws))
        except Exception:
            log.exception("Serving %s failed", address_of(ws))
        finally:
            self._open.discard(ws)
            if camera:
                self._door.leave(operator)

    async def _serve_client(self, ws: CallbackConnection, operator: Operator, batch: WriteBatch) -> None:
        client = RosbridgeSession(ws, batch, operator, self._context, ws.place)
        ws.batch = batch
        self._clients[operator] = client
        client.measure_round_trip()
        publish_clients(self._clients, self._switchboard.publish)
        try:
            await ws.serve(client)
        finally:
            del self._clients[operator]
            publish_clients(self._clients, self._switchboard.publish)
            try:
                self._door.leave(operator)
            finally:
                await client.close()

    async def _check_clients(self) -> None:
        """Check all clients regularly."""
        while True:
            await asyncio.sleep(_CHECK_PERIOD)
            STRANGERS.flush()
            for client in list(self._clients.values()):
                client.check_alive()

    async def _measure_round_trips(self) -> None:
        """Measure the round trips to all clients regularly."""
        while True:
            await asyncio.sleep(PING_PERIOD)
            for client in list(self._clients.values()):
                client.measure_round_trip()

    async def _serve_camera(self, ws: ServerConnection, camera: str) -> None:
        query = ws.request.path.partition("?")[2].split("&") if ws.request else []
        watcher = CameraSocket(ws, coarsest=self._levels.coarsest, knows_same=ASKS_FOR_SAME in query)
        self._switchboard.watch(watcher, camera)
        try:
            await watcher.run()
        finally:
            self._switchboard.unwatch(watcher, camera)


def _camera(request: Request | None) -> str | None:
    """The camera whose frames a request asks for."""
    found = _CAMERA_PATH.match(request.path) if request else None
    return found[1] if found else None


def _document(ws: ServerConnection, text: bytes) -> Response:
    answer = ws.respond(HTTPStatus.OK, text.decode())
    del answer.headers["Content-Type"]
    answer.headers["Content-Type"] = "application/json"
    answer.headers["Cache-Control"] = "no-store"
    return answer
