"""Opening handshakes: who comes by a WebSocket, from whose page, and whether that person may."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from http import HTTPStatus

from websockets.asyncio.server import ServerConnection
from websockets.http11 import Request, Response

from bridge.core.errors import Refused
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Operator
from bridge.core.robot_door import RobotDoor
from bridge.server.callback_connection import CallbackConnection
from bridge.server.reception.credentials import bearer, cookie, introduce
from bridge.server.reception.pages import PagePolicy, Verdict
from bridge.server.reception.places import FULL

__all__ = ["Handshakes", "address_of"]


class Handshakes:
    """The opening handshakes of one server."""

    def __init__(
        self,
        door: RobotDoor,
        pages: PagePolicy,
        now: Callable[[], float],
        enter: Callable[..., Operator] | None = None,
    ) -> None:
        """`pages` may connect; `now` is the operators' clock [s].

        `enter(address, secure=, token=, trusted=)` joins at the door, as rosbridge where nothing else is given.
        """
        self._door, self._pages, self._now = door, pages, now
        self._enter = enter or partial(door.join, way="rosbridge")
        self.joined: dict[CallbackConnection, Operator] = {}
        """Who shook hands and is not served yet."""

    def refusal(self, ws: ServerConnection, request: Request) -> Response | None:
        """The answer to a page that may not connect; None for all others."""
        verdict = self._judge(request)
        return ws.respond(HTTPStatus.FORBIDDEN, f"{verdict.refusal}\n") if verdict.refusal else None

    def join(self, ws: CallbackConnection, request: Request, camera: str | None) -> Response | None:
        """Join at the robot's door, at the end of a handshake that is in order.

        The answer to who shows a wrong token, or may not see the `camera` that it asks for; None when it is in.
        """
        try:
            operator = self._identify(ws, request)
        except Refused as refusal:
            return ws.respond(HTTPStatus.UNAUTHORIZED, f"{refusal}\n")
        operator.on_expelled = ws.abort
        self.joined[ws] = operator
        ws.on_lost = lambda: self.part(ws)
        introduce(operator, ws.place, self._now())
        if camera is None:
            return None
        status, said = self._refuse_camera(ws, operator, camera)
        if status is None:
            return None
        self.part(ws)
        return ws.respond(status, f"{said}\n")

    def part(self, ws: CallbackConnection) -> None:
        """Let one go who was never served."""
        operator = self.joined.pop(ws, None)
        if operator is not None:
            self._door.leave(operator)

    def _refuse_camera(
        self, ws: CallbackConnection, operator: Operator, camera: str
    ) -> tuple[HTTPStatus | None, str]:
        if ws.place is not None and ws.place.only_stop:
            return HTTPStatus.SERVICE_UNAVAILABLE, FULL
        try:
            self._door.check(operator, "camera", camera)
        except Refused as refusal:
            unknown = operator.role(self._now()) is Role.NONE
            return HTTPStatus.UNAUTHORIZED if unknown else HTTPStatus.FORBIDDEN, str(refusal)
        return None, ""

    def _judge(self, request: Request) -> Verdict:
        return self._pages.judge(request.headers.get_all("Origin"), request.headers.get_all("Host"))

    def _identify(self, ws: CallbackConnection, request: Request) -> Operator:
        """Who comes: by a token, by the cookie of the robot's own page, else by its address. Raises Refused."""
        headers, verdict = request.headers, self._judge(request)
        token = bearer(headers.get_all("Authorization"))
        if not token and verdict.own and headers.get_all("Origin"):
            token = cookie(headers.get_all("Cookie"), self._pages.cookie_name)
        return self._enter(address_of(ws), secure=ws.below is not None, token=token, trusted=verdict.trusted)


def address_of(ws: ServerConnection) -> str:
    """The other end of a connection, as `HOST:PORT`."""
    host, port = (*(ws.remote_address or ("unknown", 0)),)[:2]
    return f"{host}:{port}"
