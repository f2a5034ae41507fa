"""The doorkeeper of the web site: who asks, from whose page, and whether that person may have what is asked for."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, MutableMapping, Sequence
from typing import Any, NamedTuple

from starlette.responses import PlainTextResponse, Response
from starlette.types import ASGIApp

from bridge.core.address import at_port
from bridge.core.errors import Refused
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Operator
from bridge.server.reception.credentials import bearer, cookie, introduce
from bridge.server.reception.pages import PagePolicy, Verdict
from bridge.server.reception.places import FULL, Place
from bridge.server.reception.reception import anyone, plain_host
from robotside.door.station_door import StationDoor
from robotside.gateways.http.browser_connection import PLACE
from robotside.gateways.http.mounts import ONLY_STOP, OPERATOR, STAYS, Mount, Mounts
from robotside.gateways.http.presence import Presence, note_presence
from robotside.gateways.plain.standstills import Standstills

__all__ = ["Doorkeeper"]

STOP = "/stop"

Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]


class _Asked(NamedTuple):
    """What decides about a request, of its scope."""

    path: str
    stops: bool
    """It presses STOP."""
    address: str
    secure: bool
    own: str
    """The address by which it came to this robot, as `HOST:PORT`."""
    headers: Callable[[bytes], Sequence[str]]
    mount: Mount | None
    """The application that is asked; None for the site itself."""


class Doorkeeper:
    """An ASGI application before the site: each request joins at the robot's door and leaves when it is answered."""

    def __init__(
        self,
        site: ASGIApp,
        door: StationDoor,
        pages: PagePolicy,
        mounts: Mounts,
        *,
        stop_from_pages: bool = True,
        plain_from: Callable[[str], bool] = anyone,
        standstills: Standstills | None = None,
    ) -> None:
        """It stands before `mounts` as before the `site`.

        `pages` may speak to the robot; STOP may be pressed by every page of the world while `stop_from_pages`: to stop
        without need is safe, and a page that was opened by another name of the robot must be able to stop it.

        `plain_from(host)` says who may come without TLS; all others may press STOP without it and nothing else. What was asked
        across one of the `standstills` is not done, but for STOP; what needs a mount is that one's to look at again, right
        before it does it.
        """
        self._site, self._door, self._pages, self._mounts = site, door, pages, mounts
        self._stop_from_pages, self._plain_from = stop_from_pages, plain_from
        self._standstills = standstills or Standstills()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request."""
        if scope["type"] != "http":
            await self._site(scope, receive, send)
            return
        asked = _read(scope, self._mounts.at(scope["path"]))
        state: dict[str, Any] = scope.setdefault("state", {})
        place: Place | None = state.get(PLACE)
        if not (
            asked.secure or asked.stops or self._plain_from(plain_host(asked.address.rpartition(":")[0]))
        ):
            said = f"This robot speaks without TLS to its own machine only; use https://{asked.own}."
            await _answer(asked, scope, 426, Refused(said))(scope, receive, send)
            return
        verdict = self._pages.judge(asked.headers(b"origin"), asked.headers(b"host"))
        if verdict.refusal and not (asked.stops and self._stop_from_pages):
            await _answer(asked, scope, 403, Refused(verdict.refusal))(scope, receive, send)
            return
        try:
            operator = self._join(asked, verdict)
        except Refused as refusal:
            await _answer(asked, scope, 401, refusal)(scope, receive, send)
            return
        try:
            introduce(operator, place, self._door.now())
            refused = self._refusal(operator, asked, scope, place)
            state[OPERATOR], state[ONLY_STOP] = operator, asked.stops
            presence = note_presence(scope, self._standstills)
            if not asked.stops:
                refused = refused or await _absence(presence, asked, scope)
            await (refused or asked.mount or self._site)(scope, receive, send)
        finally:
            if STAYS not in state:
                self._door.leave(operator)

    def _join(self, asked: _Asked, verdict: Verdict) -> Operator:
        """Who asks. A wrong token raises Refused, but who presses STOP needs none; a cookie that ended counts for nothing."""
        trusted = verdict.trusted and not verdict.refusal
        by_hand = [] if asked.stops and verdict.refusal else asked.headers(b"authorization")
        shown = cookie(asked.headers(b"cookie"), self._pages.cookie_name) if verdict.own else ""
        try:
            if token := bearer(by_hand):
                return self._enter(asked, token, trusted)
            if shown:
                return self._enter(asked, shown, trusted)
        except Refused:
            if by_hand and not asked.stops:
                raise
        return self._enter(asked, "", trusted)

    def _enter(self, asked: _Asked, token: str, trusted: bool) -> Operator:
        way, role = (asked.mount.way, asked.mount.role) if asked.mount else ("http", None)
        if role is not None and asked.stops:
            role = Role.NONE  # it may come from anywhere
        return self._door.join(
            asked.address, way=way, secure=asked.secure, token=token, trusted=trusted, role=role
        )

    def _refusal(
        self, operator: Operator, asked: _Asked, scope: Scope, place: Place | None
    ) -> ASGIApp | None:
        if place is not None and place.only_stop and not asked.stops:
            return _answer(asked, scope, 503, Refused(FULL))
        if asked.mount is not None and asked.stops:
            return None
        try:
            self._door.check(operator, "page", asked.path)
        except Refused as refusal:
            unknown = operator.role(self._door.now()) is Role.NONE
            return _answer(asked, scope, 401 if unknown else 403, refusal)
        return None


async def _absence(presence: Presence, asked: _Asked, scope: Scope) -> ASGIApp | None:
    """The answer to a request that does not count any more; None for one that does."""
    try:
        if asked.mount is None:
            await presence.confirm()
        else:
            presence.check()  # the mount confirms it; a STOP may be in what it has not read yet
    except Refused as refusal:
        return _answer(asked, scope, 503, refusal)
    return None


def _read(scope: Scope, mount: Mount | None) -> _Asked:
    client = scope.get("client") or ("unknown", 0)
    headers: Sequence[tuple[bytes, bytes]] = scope["headers"]

    def values(name: bytes) -> list[str]:
        return [value.decode("latin-1") for key, value in headers if key == name]

    path = scope["path"]
    stops = mount.presses_stop(scope) if mount else path == STOP and scope["method"] == "POST"
    host, port = scope.get("server") or ("", 0)
    own = at_port(host, port)
    return _Asked(path, stops, f"{client[0]}:{client[1]}", scope.get("scheme") == "https", own, values, mount)


def _answer(asked: _Asked, scope: Scope, status: int, refusal: Refused) -> Response:
    headers = {"Cache-Control": "no-store"}
    if status == 401:
        headers["WWW-Authenticate"] = "Bearer"
    if status == 426:
        headers |= {"Upgrade": "TLS/1.2, HTTP/1.1", "Connection": "Upgrade"}
    if status == 503:
        headers["Retry-After"] = "5"
    if asked.mount is not None:
        answer = asked.mount.written(scope, status, refusal)
        answer.headers.update(headers)
        return answer
    return PlainTextResponse(f"{refusal}\n", status, headers)
