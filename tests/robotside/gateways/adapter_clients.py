"""Clients of the gateways that a user asks for, within the program: the adapters' own code, without sockets and brokers."""

from __future__ import annotations

import asyncio
import itertools
import json
from collections.abc import Callable, Mapping
from typing import Any, Protocol
from xml.sax.saxutils import escape

from aiocoap.message import Message
from aiocoap.numbers.codes import Code as CoapCode
from aiokafka.structs import ConsumerRecord
from lxml import etree

from bridge.codec import from_json, to_json
from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from bridge.server.flow.send_queue import WriteBatch
from robotside.door.station_door import StationDoor
from robotside.gateways.adapter import AdapterGateway, Surroundings
from robotside.gateways.broker.command_desk import BYE, CALL, PUBLISH
from robotside.gateways.coap.datagrams import Endpoint
from robotside.gateways.coap.requests import JSON
from robotside.gateways.coap.site import CoapSite
from robotside.gateways.discovery import read_wish
from robotside.gateways.http.gateway import HttpGateway
from robotside.gateways.mqtt.broker_line import Heard
from robotside.gateways.plain.visitor import STOP, TIME
from robotside.gateways.plain.visitors import Visitors
from robotside.gateways.soap.fields import NS, SOAP
from tests.bridge.server.flow.test_send_queue import FrameWriter

__all__ = ["HOST", "WAYS", "Adapters", "Client"]

HOST = "192.0.2.7"
"""Where all clients are that come by a connection of their own."""
_TRIES = 200
"""Turns of the loop within which an answer is there."""


class Client(Protocol):
    """An operator at one gateway."""

    operator: Operator

    def publish(self, topic: str, msg: Msg, stamp: float) -> None: ...
    def ask(self, service: str, request: CommandRequest) -> CommandResponse: ...
    def leave(self) -> None: ...


class Adapters:
    """The gateways of one door that a user asks for, each made when its first client comes."""

    def __init__(self, door: StationDoor, http: HttpGateway, loop: asyncio.AbstractEventLoop) -> None:
        """`http` has the web site; all belong to the `loop`, which runs while somebody asks."""
        self.door, self.loop, self._http = door, loop, http
        self._made: dict[str, Any] = {}

    def connect(self, way: str, name: str) -> Client:
        """A client that comes by one of `WAYS`."""
        return WAYS[way](self, name)

    def gateway(self, way: str) -> Any:
        """The gateway of that name."""
        if way not in self._made:
            self._made[way] = self.run(self._make(way))
        return self._made[way]

    async def _make(self, way: str) -> AdapterGateway:
        adapter, url = read_wish(_URLS[way])
        gateway = adapter.make(Surroundings(self.door, _ignore, site=self._http.mounts), url)
        if way in _ON_SITE:
            await gateway.start()
            for task in asyncio.all_tasks() - {asyncio.current_task()}:
                task.cancel()  # that looks for silent clients by the clock of the machine
        return gateway

    def run(self, work: Any) -> Any:
        """Run something in the loop that the gateways belong to."""
        return self.loop.run_until_complete(work)

    def post(self, method: str, path: str, headers: Mapping[str, str], body: bytes) -> tuple[int, bytes]:
        """What the web site answers."""
        return self.run(self._post(method, path, headers, body))  # type: ignore[no-any-return]

    async def _post(
        self, method: str, path: str, headers: Mapping[str, str], body: bytes
    ) -> tuple[int, bytes]:
        told: list[Any] = []

        async def receive() -> dict[str, Any]:
            return {"type": "http.request", "body": body, "more_body": False}

        async def send(message: Any) -> None:
            told.append(message)

        scope = {"type": "http", "method": method, "path": path, "query_string": b"", "http_version": "1.1"}
        shown = [(name.lower().encode(), value.encode()) for name, value in headers.items()]
        await self._http.site({**scope, "headers": shown, "client": (HOST, 5000)}, receive, send)
        return told[0]["status"], b"".join(each.get("body", b"") for each in told[1:])

    def close(self) -> None:
        """End all of them."""
        for way, gateway in self._made.items():
            if way in _ON_SITE or way == "coap":
                self.run(gateway.stop())
            elif way in _BROKERS:
                gateway._visitors.leave_all()
                self.run(gateway._desk.close())


def _ignore(*_: object, **__: object) -> None:
    """Nobody reads the events of these gateways."""


def _said(request: CommandRequest) -> bytes:
    """The request without what it does not say."""
    given = json.loads(to_json(request))
    return json.dumps({name: value for name, value in given.items() if value not in ("", None)}).encode()


def _known(visitors: Visitors, name: str) -> Operator:
    """Who goes by that name."""
    return next(visitor.operator for key, visitor in visitors._known.items() if name in key)


class Rest:
    """A client of the REST gateway, by its resources."""

    def __init__(self, all: Adapters, name: str) -> None:
        self._all, self._name = all, name
        self._clients = all.gateway("rest")._desk.clients
        status, _ = all.post("GET", "/api/time", self._headers(), b"")
        assert status == 200
        self._key = next(key for key in self._clients._known if key.client == name)
        self.operator = self._clients._known[self._key].operator

    def _headers(self, **more: str) -> dict[str, str]:
        return {"Client-Id": self._name, "Content-Type": "application/json", **more}

    def publish(self, topic: str, msg: Msg, stamp: float) -> None:
        self._all.post("POST", f"/api/topics{topic}", self._headers(Stamp=repr(stamp)), to_json(msg))

    def ask(self, service: str, request: CommandRequest) -> CommandResponse:
        _, answer = self._all.post("POST", f"/api/services{service}", self._headers(), _said(request))
        return from_json(answer, CommandResponse)

    def leave(self) -> None:
        self._clients._leave(self._key)


class Soap:
    """A client of the SOAP gateway, by its operations."""

    def __init__(self, all: Adapters, name: str) -> None:
        self._all, self._name = all, name
        self._callers = all.gateway("soap")._callers
        self._do("GetTime")
        self.operator = next(
            visitor.operator for (_, _, id), visitor in self._callers._known.items() if id == name
        )

    def _do(self, operation: str, stamp: float | None = None, **fields: str) -> etree._Element:
        said = f"<stamp>{stamp!r}</stamp>" if stamp is not None else ""
        header = f'<Caller xmlns="{NS}"><clientId>{self._name}</clientId>{said}</Caller>'
        inner = "".join(f"<{name}>{escape(value)}</{name}>" for name, value in fields.items())
        raw = (
            f'<s:Envelope xmlns:s="{SOAP}"><s:Header>{header}</s:Header>'
            f'<s:Body><{operation} xmlns="{NS}">{inner}</{operation}></s:Body></s:Envelope>'
        )
        headers = {"Content-Type": "text/xml", "SOAPAction": f'"{NS}#{operation}"'}
        _, answer = self._all.post("POST", "/soap", headers, raw.encode())
        return etree.fromstring(answer)[0][0]

    def publish(self, topic: str, msg: Msg, stamp: float) -> None:
        self._do("PublishMessage", stamp, topic=topic, message=to_json(msg).decode())

    def ask(self, service: str, request: CommandRequest) -> CommandResponse:
        if service == STOP:
            top = self._do("Stop")
        else:
            top = self._do("CallService", service=service, message=_said(request).decode())
        if top.tag == f"{{{SOAP}}}Fault":
            code = top.findtext(f".//{{{NS}}}code")
            return CommandResponse(False, top.findtext("faultstring"), code)
        if service == STOP:
            return CommandResponse(True, top[0].text)
        return from_json(top[0].text.encode(), CommandResponse)

    def leave(self) -> None:
        self._do("Leave")


class _Place:
    """What the socket's reception gives: none here."""

    only_stop = False


class _Wire(FrameWriter):
    """A connection of the WebSocket gateway that leads nowhere."""

    place = _Place()


class WebSocket:
    """A client of the plain WebSocket gateway."""

    def __init__(self, all: Adapters, name: str) -> None:
        self._all, self._name = all, name
        self._ids = itertools.count(1)
        self._soon: list[Callable[[], object]] = []
        self._wire = _Wire()
        gateway = all.gateway("websocket")
        self.operator = gateway._enter(f"{HOST}:5001", secure=False, token="", trusted=True)
        self._session = all.run(self._begin(gateway))
        self._say({"call": TIME, "id": next(self._ids)})

    async def _begin(self, gateway: Any) -> Any:
        session = gateway._session(self._wire, self.operator, WriteBatch(self._soon.append))
        session.measure_round_trip()
        return session

    def publish(self, topic: str, msg: Msg, stamp: float) -> None:
        self._say({"publish": topic, "message": json.loads(to_json(msg)), "stamp": stamp})

    def ask(self, service: str, request: CommandRequest) -> CommandResponse:
        id = next(self._ids)
        self._say({"call": service, "request": json.loads(_said(request)), "id": id})
        (answer,) = (each for each in map(json.loads, self._wire.heard) if each.get("id") == id)
        self._wire.writes.clear()
        told = answer.get("response", answer)
        return from_json(json.dumps(told).encode(), CommandResponse)

    def leave(self) -> None:
        self._all.door.leave(self.operator)
        self._all.run(self._session.close())

    def _say(self, said: dict[str, Any]) -> None:
        self._all.run(self._hear(json.dumps(said)))

    async def _hear(self, text: str) -> None:
        self._session.measure_round_trip()  # as its gateway does five times a second
        self._answer_pings()
        assert self._session.on_message(text)
        self._answer_pings()

    def _answer_pings(self) -> None:
        while self._soon:
            self._soon.pop(0)()
        for ping in self._wire.unanswered:
            self._session.on_pong(ping)
        self._wire.unanswered.clear()


class _AtBroker:
    """A client behind a broker, of which its gateway hears and to which it answers."""

    way = ""

    def __init__(self, all: Adapters, name: str) -> None:
        self._all, self._name, self._gateway = all, name, all.gateway(self.way)
        self._told: list[Any] = []
        self._tell(CALL, TIME, b"{}")
        self.operator = _known(self._gateway._visitors, name)

    def publish(self, topic: str, msg: Msg, stamp: float) -> None:
        self._tell(PUBLISH, topic, to_json(msg), stamp)

    def ask(self, service: str, request: CommandRequest) -> CommandResponse:
        answer = self._tell(CALL, service, to_json(request), self._all.door.now())
        return from_json(answer, CommandResponse)

    def leave(self) -> None:
        self._tell(BYE, "", b"")

    def _tell(self, verb: str, name: str, raw: bytes, stamp: float | None = None) -> bytes:
        self._told.clear()
        return self._all.run(self._heard(verb, name, raw, stamp))  # type: ignore[no-any-return]

    async def _heard(self, verb: str, name: str, raw: bytes, stamp: float | None) -> bytes:
        self._gateway._commands.reply = self._told.append
        self._hear(verb, name, raw, stamp)
        for _ in range(_TRIES if verb == CALL else 0):
            if self._told:
                return bytes(self._told[-1][1])
            await asyncio.sleep(0)
        assert verb != CALL, f"{name} was not answered"
        return b""

    def _hear(self, verb: str, name: str, raw: bytes, stamp: float | None) -> None:
        raise NotImplementedError


class Mqtt(_AtBroker):
    """A client of the MQTT gateway."""

    way = "mqtt"

    def _hear(self, verb: str, name: str, raw: bytes, stamp: float | None) -> None:
        topic = self._gateway._names.command(self._name, verb, name)
        properties = {} if stamp is None else {"stamp": repr(stamp)}
        self._gateway._on_command(Heard(topic, raw, False, 2.0, "", None, properties))


class Kafka(_AtBroker):
    """A client of the Kafka gateway."""

    way = "kafka"

    def _hear(self, verb: str, name: str, raw: bytes, stamp: float | None) -> None:
        headers = [(verb, name.encode()), *([] if stamp is None else [("stamp", repr(stamp).encode())])]
        topic, key = self._gateway._names.commands, self._name.encode()
        self._gateway._on_record(
            ConsumerRecord(topic, 0, 0, 0, 0, key, raw, None, len(key), len(raw), tuple(headers))
        )


class _Pipe:
    """One request and its answer."""

    def __init__(self, request: Message) -> None:
        self.request = request
        self.answers: list[Message] = []

    def add_response(self, response: Message, *, is_last: bool) -> None:
        assert is_last
        self.answers.append(response)


class Coap:
    """A client of the CoAP gateway, by requests of one message each."""

    def __init__(self, all: Adapters, name: str) -> None:
        self._all, self._name, self._gateway = all, name, all.gateway("coap")
        self._ask(TIME, b"")
        self.operator = _known(self._gateway._clients, name)

    def publish(self, topic: str, msg: Msg, stamp: float) -> None:
        self._ask(topic, to_json(msg), stamp)

    def ask(self, service: str, request: CommandRequest) -> CommandResponse:
        return from_json(self._ask(service, to_json(request), self._all.door.now()), CommandResponse)

    def leave(self) -> None:
        self._ask("/bye", b"")

    def _ask(self, path: str, raw: bytes, stamp: float | None = None) -> bytes:
        query = [f"client={self._name}", *([] if stamp is None else [f"stamp={stamp!r}"])]
        parts = tuple(path.strip("/").split("/"))
        asked = Message(
            code=CoapCode.POST,
            payload=raw,
            uri_path=parts,
            uri_query=tuple(query),
            accept=JSON,
            content_format=JSON,
        )
        asked.remote = Endpoint(HOST, 5003, "127.0.0.1:5683", None)
        return self._all.run(self._answered(_Pipe(asked)))  # type: ignore[no-any-return]

    async def _answered(self, pipe: _Pipe) -> bytes:
        if self._gateway._site is None:
            door, url = self._all.door, self._gateway._url
            self._gateway._site = CoapSite(
                door,
                self._gateway._clients,
                url.keys,
                url.rate,
                plain_from=lambda _: True,
                pages=self._gateway._page,
                turns=self._gateway._robot.turns,
            )
        await self._gateway._site.answer(pipe)
        return bytes(pipe.answers[0].payload)


WAYS: dict[str, Callable[[Adapters, str], Client]] = {
    "rest": Rest,
    "soap": Soap,
    "websocket": WebSocket,
    "coap": Coap,
    "mqtt": Mqtt,
    "kafka": Kafka,
}
_ON_SITE = ("rest", "soap")
_BROKERS = ("mqtt", "kafka")
_URLS = {
    "rest": "rest=?role=drive",
    "soap": "soap=?role=drive",
    "websocket": "websocket=ws://127.0.0.1:9190?role=drive",
    "coap": "coap=coap://127.0.0.1:5683?role=drive",
    "mqtt": "mqtt=mqtt://192.0.2.99:1883?role=drive",
    "kafka": "kafka=kafka://192.0.2.99:9092?role=drive",
}
