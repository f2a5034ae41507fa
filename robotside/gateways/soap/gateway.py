"""The SOAP gateway of one robot: its web services at a path of the robot's web site."""

from __future__ import annotations

import asyncio
import logging
import re
from collections.abc import Mapping
from functools import partial

from starlette.requests import ClientDisconnect, Request
from starlette.responses import PlainTextResponse, Response
from starlette.types import Receive, Scope, Send

from bridge.core.async_tasks import cancel_all
from bridge.core.codes import Code
from bridge.core.errors import BridgeError, Refused
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Operator
from robotside.core.notice import Notice
from robotside.gateways.adapter import Surroundings
from robotside.gateways.gateway_url import GatewayUrl
from robotside.gateways.http.mounts import ONLY_STOP, OPERATOR, source
from robotside.gateways.http.presence import presence_of
from robotside.gateways.payloads.offered import offered
from robotside.gateways.plain.callers import Callers, stand_in
from robotside.gateways.plain.strict_json import MAX_INPUT
from robotside.gateways.plain.visitor import Visitor
from robotside.gateways.soap.callbacks import Callbacks
from robotside.gateways.soap.envelope import (
    CONTENT_TYPE,
    SERVER,
    Asked,
    envelope,
    fault,
    read_envelope,
    stops,
)
from robotside.gateways.soap.fields import read, written
from robotside.gateways.soap.guide import guide
from robotside.gateways.soap.messages import Caller, Notify
from robotside.gateways.soap.operations import NOTIFY, STOP, robot_contract, subscriber_contract
from robotside.gateways.soap.robot_services import Call, RobotServices, message_of
from robotside.gateways.soap.subscriptions import News, Subscribed, Subscriptions

__all__ = ["SoapGateway"]

log = logging.getLogger(__name__)

_CHECK_PERIOD = 1.0
"""Between two looks for clients that are silent and subscriptions that are over [s]."""
_STOP_PATIENCE = 0.1
"""STOP waits no longer for the name of who presses it [s]."""
_HOST = re.compile(r"[\w.\-\[\]:]{1,255}", re.ASCII)
_LOOKS_LIKE_STOP = re.compile(rb"[<:]%s[\s/>]" % STOP.name.encode())
"""What the envelope of a STOP has in it: not every one is read whole before its turn."""
_WSDL, _SUBSCRIBER = "wsdl", "subscriber.wsdl"
"""Queries that ask for the contract of the robot's service, and of that of a client for callbacks."""


class SoapGateway:
    """An `AdapterGateway`: operations with WSDL at a path of the web site."""

    def __init__(self, robot: Surroundings, url: GatewayUrl) -> None:
        """Who shows no token has the role of the `url`; without one that of its address, as on the rest of the site."""
        if robot.site is None:
            raise BridgeError("SOAP is served on the robot's web site, which this robot has not.")
        self._site, self._door, self._say, self._url = robot.site, robot.door, robot.say, url
        self._turns, self._key = robot.turns, robot.key
        self._path = f"/{url.path}"
        self._contract, self._subscriber = robot_contract(), subscriber_contract()
        self._judge = self._contract.judge()
        self._operations = {each.name: each for each in self._contract.operations}
        self._callers = Callers(robot.door, url.keys)
        self._subscriptions = Subscriptions(robot.door, url.keys, 1 / url.rate)
        self._callbacks = Callbacks(_notice, self._on_given_up)
        self._subscriptions.on_end = self._callbacks.end
        self._services = RobotServices(
            robot.door, url.keys, self._callers, self._subscriptions, self._callbacks, self.guide
        )
        self._unmount = _nothing
        self._checking: asyncio.Task[None] | None = None

    async def start(self) -> None:
        """Begin to answer. BridgeError when the path is taken."""
        self._unmount = self._site.mount(
            self._path,
            self._answer,
            way="soap",
            role=self._url.role,
            presses_stop=_presses_stop,
            written=self._refusal,
        )
        self._checking = asyncio.create_task(self._check())
        role = self._url.role
        if role is not None and role > Role.WATCH:
            said = f"Everybody who reaches the web site may {role.word} by SOAP without a key."
            self._say("control", Notice(Code.GATEWAY_OPEN, said, gateway="soap", role=role.word), "warn")

    async def stop(self) -> None:
        """Answer nothing more and end everything; nothing is left running."""
        self._unmount()
        self._unmount = _nothing
        if self._checking is not None:
            await cancel_all([self._checking])
            self._checking = None
        self._subscriptions.end_all()
        await self._callbacks.close()
        self._callers.leave_all()

    def endpoints(self) -> Mapping[str, str]:
        """The URL of the WSDL."""
        return {"soap": f"{self._site.url(self._path)}?{_WSDL}"}

    def guide(self) -> str:
        """How a client uses it now."""
        where = self._site.url(self._path)
        return guide(where, self._door, offered(self._door, self._url.keys), self._key)

    async def _check(self) -> None:
        while True:
            await asyncio.sleep(_CHECK_PERIOD)
            self._callers.leave_silent()
            self._subscriptions.end_overdue()

    async def _answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request, an ASGI application."""
        request = Request(scope, receive)
        try:
            answer = await self._answered(request)
        except ClientDisconnect:
            return
        await answer(scope, receive, send)

    async def _answered(self, request: Request) -> Response:
        if request.url.path.rstrip("/") != self._path and not request.scope["state"][ONLY_STOP]:
            return _fault(
                Refused(f"There is nothing at {request.url.path[:100]!r}; it is {self._path}."), 404
            )
        if request.method == "POST":
            return await self._post(request)
        if request.method not in ("GET", "HEAD"):
            refused = Refused(f"SOAP is asked by POST, not {request.method[:20]}.")
            return _fault(refused, 405, {"Allow": "GET, HEAD, POST"})
        query = request.url.query.lower()
        if query in (_WSDL, _SUBSCRIBER):
            contract = self._contract if query == _WSDL else self._subscriber
            return _xml(contract.wsdl(self._location(request)))
        if query:
            return _fault(Refused(f"There are ?{_WSDL} and ?{_SUBSCRIBER}, not {query[:50]!r}."), 404)
        return PlainTextResponse(f"{self.guide()}\n", headers={"Cache-Control": "no-store"})

    def _location(self, request: Request) -> str:
        """Where the service is, by the address that the client itself used."""
        host = request.headers.get("host", "")
        if not _HOST.fullmatch(host):
            return self._site.url(self._path)
        return f"{request.url.scheme}://{host}{self._path}"

    async def _post(self, request: Request) -> Response:
        operator: Operator = request.scope["state"][OPERATOR]
        if request.scope["state"][ONLY_STOP]:
            return await self._stop(operator, await _body_at_hand(request))
        raw = await _body(request)
        if raw is None:
            return _fault(Refused(f"A message has at most {MAX_INPUT} bytes."), 413)
        if _LOOKS_LIKE_STOP.search(raw) and stops(raw):
            return await self._stop(operator, raw)
        try:
            await self._turns.take(source(request.scope))
        except Refused as busy:
            return _fault(busy, code=SERVER)
        try:
            await presence_of(request.scope).confirm()
        except Refused as stale:
            return _fault(stale, 503, {"Retry-After": "5"}, SERVER)
        return await self._in_turn(request, operator, raw)

    async def _in_turn(self, request: Request, operator: Operator, raw: bytes) -> Response:
        """Answer what is no STOP."""
        problem = _wrong_type(request.headers.get("content-type", ""))
        packed = request.headers.get("content-encoding", "").strip()
        if not problem and packed.lower() not in ("", "identity"):
            problem = f"A message comes as it is, not {packed[:60]!r}."
        if problem:
            return _fault(Refused(problem), 415, {"Accept-Encoding": "identity"})
        try:
            asked = read_envelope(raw, self._judge, self._operations)
        except BridgeError as error:
            return _fault(error)
        return await self._do(operator, asked)

    async def _do(self, operator: Operator, asked: Asked) -> Response:
        known = self._operations[asked.operation]
        caller = Caller() if asked.caller is None else read(asked.caller, Caller)
        try:
            visitor = self._visit(operator, caller.client_id or "")
            call = Call(operator, visitor, caller, read(asked.body, known.request))
            answer = await self._services.do(known.name, call)
        except BridgeError as error:
            return _fault(error)
        except Exception:
            log.exception("%s by SOAP from %s failed", known.name, operator.address)
            return _fault(Refused(f"The robot failed at {known.name}; its log says why."), code=SERVER)
        return _xml(envelope(written(f"{known.name}Response", answer)))

    def _visit(self, operator: Operator, client_id: str) -> Visitor:
        """The client behind a request; who gives no id comes for one request, and is gone once that is answered."""
        if not client_id:
            return self._callers.newcomer(operator)
        return self._callers.visit(operator, client_id, partial(stand_in, self._door))

    async def _stop(self, operator: Operator, raw: bytes) -> Response:
        """Press STOP, whatever the rest of the message says."""
        try:
            asked = read_envelope(raw, self._judge, self._operations)
            caller = None if asked.caller is None else read(asked.caller, Caller)
        except BridgeError:
            caller = None
        try:
            done = await self._services.stop(self._callers.newcomer(operator), caller)
        except BridgeError as error:
            return _fault(error)
        return _xml(envelope(written(f"{STOP.name}Response", done)))

    def _refusal(self, scope: Scope, status: int, refusal: BridgeError) -> Response:
        """What the doorkeeper answers; a STOP is pressed all the same, unless it comes from a web page that may not."""
        content = fault(refusal)
        if status == 403 or scope["method"] != "POST":
            return Response(content, status, media_type=CONTENT_TYPE)
        return _UnlessStop(self, content, status, media_type=CONTENT_TYPE)

    async def press_as_nobody(self, request: Request) -> Response | None:
        """The answer to a STOP of somebody who may nothing else; None when the request is none."""
        raw = await _body(request)
        if raw is None or not stops(raw):
            return None
        host, port = request.scope.get("client") or ("unknown", 0)
        secure = request.url.scheme == "https"
        operator = self._door.join(f"{host}:{port}", way="soap", secure=secure, trusted=False, role=Role.NONE)
        try:
            return await self._stop(operator, raw)
        finally:
            self._door.leave(operator)

    def _on_given_up(self, subscribed: Subscribed, reason: str) -> None:
        self._subscriptions.end(subscribed)
        host = subscribed.operator.address.rpartition(":")[0]
        said = f"Nobody at {host} takes the callbacks of a subscription: {reason} It has ended."
        self._say("control", Notice(Code.GATEWAY_CALLBACK_LOST, said, gateway="soap", reason=reason), "warn")


class _UnlessStop(Response):
    """A refusal, unless what is refused turns out to press STOP."""

    def __init__(self, gateway: SoapGateway, content: bytes, status: int, media_type: str) -> None:
        super().__init__(content, status, media_type=media_type)
        self._gateway = gateway

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            answer = await self._gateway.press_as_nobody(Request(scope, receive))
        except ClientDisconnect:
            return
        if answer is None:
            await super().__call__(scope, receive, send)
        else:
            await answer(scope, receive, send)


def _nothing() -> None:
    """Nothing is mounted."""


def _presses_stop(scope: Scope) -> bool:
    """A request says so by its SOAPAction, as SOAP 1.1 has it, so that it is known before its body is read."""
    actions = [value.strip(b'" ') for name, value in scope["headers"] if name == b"soapaction"]
    return scope["method"] == "POST" and actions == [STOP.action.encode()]


async def _body(request: Request) -> bytes | None:
    """The body of a request; None when it is too long."""
    raw = bytearray()
    async for part in request.stream():
        raw += part
        if len(raw) > MAX_INPUT:
            return None
    return bytes(raw)


async def _body_at_hand(request: Request) -> bytes:
    """The body of a STOP, which says who presses it; empty where it is too long, or does not come at once."""
    try:
        async with asyncio.timeout(_STOP_PATIENCE):
            return await _body(request) or b""
    except (TimeoutError, ClientDisconnect):
        return b""


def _wrong_type(told: str) -> str:
    """Why a message of that content type is not read; empty when it is."""
    kind, _, rest = told.partition(";")
    words = dict(part.strip().lower().partition("=")[::2] for part in rest.split(";"))
    if kind.strip().lower() != "text/xml":
        return f"A message of SOAP 1.1 has the content type text/xml, not {kind.strip()[:60]!r}."
    charset = words.get("charset", "utf-8").strip('"')
    return (
        ""
        if charset in ("utf-8", "utf8", "us-ascii")
        else f"A message is written in UTF-8, not {charset[:30]!r}."
    )


def _xml(content: bytes, status: int = 200, headers: Mapping[str, str] | None = None) -> Response:
    return Response(content, status, {"Cache-Control": "no-store", **(headers or {})}, CONTENT_TYPE)


def _fault(
    error: BridgeError, status: int = 500, headers: Mapping[str, str] | None = None, code: str = "Client"
) -> Response:
    return _xml(fault(error, code), status, headers)


def _notice(subscribed: Subscribed, news: list[News]) -> tuple[bytes, str]:
    """The body and the SOAPAction of a callback."""
    told = Notify(subscribed.id, tuple(message_of(topic, msg) for topic, msg in news))
    return envelope(written(NOTIFY.name, told)), NOTIFY.action
