"""The gateway of plain JSON by WebSocket of one robot."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Mapping
from weakref import WeakKeyDictionary

import msgspec
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from bridge.core.async_tasks import cancel_all
from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Operator
from bridge.server.callback_connection import CallbackConnection
from bridge.server.flow.round_trip import PING_PERIOD
from bridge.server.flow.send_queue import SendQueue, WriteBatch
from bridge.server.handshakes import Handshakes, address_of
from bridge.server.reception.log_limit import STRANGERS
from bridge.server.reception.pages import PagePolicy
from bridge.server.reception.places import Limits
from bridge.server.web_socket_listener import WebSocketListener, tune
from robotside.core.notice import Notice
from robotside.gateways.adapter import Surroundings
from robotside.gateways.addresses import url as url_of
from robotside.gateways.gateway_url import GatewayUrl
from robotside.gateways.payloads.offered import offered
from robotside.gateways.plain.strict_json import MAX_INPUT
from robotside.gateways.plain.visitor import Visitor, refusal
from robotside.gateways.websocket.guide import guide
from robotside.gateways.websocket.plain_messages import NewestMessages
from robotside.gateways.websocket.session import Session
from robotside.gateways.websocket.subscriptions import Subscriptions

__all__ = ["LIMITS", "WebSocketGateway"]

log = logging.getLogger(__name__)
log.addFilter(STRANGERS)

LIMITS = Limits(total=64, per_address=48, per_identity=16, reserve=8)
"""Clients at a time."""
_MAX_FRAME = 4 * MAX_INPUT
"""A message that is longer than it may be is answered up to so many bytes; then its connection ends."""
_CHECKS = 5
"""Between two looks for clients that are gone so many round trips are measured."""


class WebSocketGateway:
    """An `AdapterGateway`: JSON objects with one verb each, at `ws://HOST:PORT`."""

    def __init__(self, robot: Surroundings, url: GatewayUrl) -> None:
        """Who shows no token has the role of the `url`; without one its address decides, as for rosbridge."""
        self._robot, self._door, self._url = robot, robot.door, url
        self._listener = WebSocketListener(LIMITS, tls=robot.tls, plain_from=robot.plain_from)
        pages = robot.pages or PagePolicy()
        self._handshakes = Handshakes(robot.door, pages, robot.door.now, self._enter)
        self._wrong: WeakKeyDictionary[Operator, bytes] = WeakKeyDictionary()
        self._newest = NewestMessages()
        self._sessions: dict[Operator, Session] = {}
        self._batch: WriteBatch | None = None
        self._tasks: set[asyncio.Task[None]] = set()

    async def start(self) -> None:
        """Begin to listen. BridgeError with one sentence when that is not possible."""
        self._batch = WriteBatch(asyncio.get_running_loop().call_soon)
        await self._listener.start(
            self._url.host,
            self._url.port,
            self._serve,
            admit=self._admit,
            greet=self._greet,
            max_size=_MAX_FRAME,
        )
        role = self._url.role
        if role is not None and role > Role.WATCH:
            said = f"Everybody who reaches the WebSocket gateway may {role.word} without a key."
            self._robot.say(
                "control", Notice(Code.GATEWAY_OPEN, said, gateway="websocket", role=role.word), "warn"
            )
        self._tasks.add(asyncio.create_task(self._look_after_clients()))

    async def stop(self) -> None:
        """End all connections and stop listening; nothing is left running."""
        await cancel_all(self._tasks)
        self._tasks.clear()
        await self._listener.close()
        self._newest.clear()

    def endpoints(self) -> Mapping[str, str]:
        """The URL; `wss` where others reach it and it speaks TLS."""
        tls = self._robot.tls is not None
        return {"websocket": url_of("ws", self._url.host, self._listener.port or self._url.port, tls=tls)}

    def guide(self) -> str:
        """How a program of this machine uses it now."""
        audience = self._door.join("127.0.0.1:0", way="websocket", role=self._url.role)
        try:
            return self._guide_for(audience)
        finally:
            self._door.leave(audience)

    def _guide_for(self, operator: Operator) -> str:
        role = operator.role(self._door.now())
        payloads = offered(self._door, self._url.keys) if role > Role.NONE else ()
        return guide(self.endpoints()["websocket"], payloads, role)

    def _enter(self, address: str, *, secure: bool, token: str, trusted: bool) -> Operator:
        """Join; who shows a wrong token is told so and may press STOP."""
        try:
            return self._door.join(
                address, way="websocket", secure=secure, token=token, trusted=trusted, role=self._url.role
            )
        except Refused as error:
            stranger = self._door.join(address, way="websocket", secure=secure, trusted=False, role=Role.NONE)
            self._wrong[stranger] = refusal(error)
            return stranger

    def _admit(self, ws: ServerConnection, request: Request) -> Response | None:
        ws.ping_interval = None  # a client's queue asks for signs of life itself
        return self._handshakes.refusal(ws, request)

    def _greet(self, ws: ServerConnection, request: Request, response: Response) -> Response | None:
        if response.status_code != 101 or not isinstance(ws, CallbackConnection):
            return None
        return self._handshakes.join(ws, request, None)

    async def _serve(self, ws: ServerConnection) -> None:
        operator = self._handshakes.joined.pop(ws, None) if isinstance(ws, CallbackConnection) else None
        if operator is None or not isinstance(ws, CallbackConnection) or self._batch is None:
            return
        tune(ws)
        session = self._sessions[operator] = self._session(ws, operator, self._batch)
        ws.batch = self._batch
        try:
            self._welcome(session)
            await ws.serve(session)
        except ConnectionClosed:
            log.info("%s was cut off", address_of(ws))
        except Exception:
            log.exception("Serving %s failed", address_of(ws))
        finally:
            del self._sessions[operator]
            try:
                self._door.leave(operator)  # first of all: a robot that it drove stops
            finally:
                await session.close()
            if not self._sessions:
                self._newest.clear()

    def _session(self, ws: CallbackConnection, operator: Operator, batch: WriteBatch) -> Session:
        def subscribing(queue: SendQueue) -> Subscriptions:
            return Subscriptions(self._door, operator, queue, self._newest, self._url.keys, self._url.rate)

        visitor = Visitor(self._door, operator, self._url.keys)
        return Session(ws, batch, self._door, visitor, subscribing)

    def _welcome(self, session: Session) -> None:
        wrong = self._wrong.pop(session.operator, b"")
        if wrong:
            session.say({"refused": "token"} | msgspec.json.decode(wrong, type=dict))
        session.say({"guide": self._guide_for(session.operator)})
        session.measure_round_trip()

    async def _look_after_clients(self) -> None:
        """Measure the round trips regularly, and look for clients that are gone."""
        while True:
            for _ in range(_CHECKS):
                await asyncio.sleep(PING_PERIOD)
                for session in list(self._sessions.values()):
                    session.measure_round_trip()
            STRANGERS.flush()
            for session in list(self._sessions.values()):
                session.check_alive()
