"""Clients of a robot's gateways within the program: the gateways' own code, without sockets."""

from __future__ import annotations

import asyncio
import itertools
import json
from typing import Any

from bridge.codec import from_json, to_json
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from bridge.server.flow.send_queue import WriteBatch
from bridge.server.rosbridge_session import RosbridgeSession
from robotside.door.station_door import StationDoor
from robotside.gateways.http.gateway import HttpGateway
from robotside.gateways.payloads.table import KEYS
from robotside.gateways.plain.visitor import TIME
from robotside.gateways.plain.visitors import Visitors
from robotside.gateways.rosbridge.gateway import RosbridgeGateway
from robotside.gateways.scaling.picture_scaling import PictureScaler
from tests.bridge.server.flow.test_send_queue import FrameWriter
from tests.robotside.gateways.adapter_clients import HOST, WAYS, Adapters, Client
from tests.robotside.gateways.memory import MemoryGateway

__all__ = ["Client", "Gateways"]


_PORTS = itertools.count(6000)


class Gateways:
    """All gateways of one door."""

    def __init__(self, door: StationDoor) -> None:
        self._loop = asyncio.new_event_loop()
        self._pictures = PictureScaler()
        self.rosbridge = RosbridgeGateway(door, "127.0.0.1", 0, self._pictures, lambda now: now)
        self.http = HttpGateway(door, "127.0.0.1", 0, self._pictures, lambda: "")
        self.memory = MemoryGateway(door, door.now)
        self._visitors = Visitors(door, "broker", "broker:1", KEYS, role=None, secure=False)
        self._door = door
        self._adapters = Adapters(door, self.http, self._loop)

    def connect(self, how: str, name: str) -> Client:
        """A client that comes by `rosbridge`, `memory`, a `broker` in plain JSON, or one of the adapters' `WAYS`."""
        if how in WAYS:
            return self._adapters.connect(how, name)
        if how == "broker":
            return _Visiting(self._visitors, name)
        return _Direct(self.memory, name) if how == "memory" else self.run(self._connect(name))

    async def _connect(self, name: str) -> Client:
        return _Rosbridge(self, self._door, name)

    def run(self, work: Any) -> Any:
        """Run something in the loop that the gateways belong to."""
        return self._loop.run_until_complete(work)

    def stop(self, name: str) -> None:
        """Press STOP by HTTP."""
        self.run(self._stop(name))

    async def _stop(self, name: str) -> None:
        told: list[Any] = []

        async def receive() -> dict[str, Any]:
            return {"type": "http.request", "body": b"", "more_body": False}

        async def send(message: Any) -> None:
            told.append(message)

        request = {"type": "http", "method": "POST", "path": "/stop", "headers": [], "http_version": "1.1"}
        query = f"name={name}".encode()
        await self.http.site({**request, "query_string": query, "client": ("192.0.2.9", 1)}, receive, send)
        assert told[0]["status"] == 200, told

    def close(self) -> None:
        """End the gateways and their loop."""
        self._adapters.close()
        self.run(self.rosbridge.stop())
        self.run(self.http.stop())
        self.run(self.memory.stop())
        self.run(self._pictures.close())
        self._loop.close()


class _Direct:
    """A client of the gateway in memory."""

    def __init__(self, gateway: MemoryGateway, name: str) -> None:
        self._client = gateway.connect(name)
        self.operator = self._client.operator
        self.leave = self._client.leave

    def publish(self, topic: str, msg: Msg, stamp: float) -> None:
        self._client.publish(topic, msg, stamp)

    def ask(self, service: str, request: CommandRequest) -> CommandResponse:
        answer = self._client.call(service, request)
        assert isinstance(answer, CommandResponse)
        return answer


class _Visiting:
    """A client that a broker passes on, and that speaks plain JSON."""

    def __init__(self, visitors: Visitors, name: str) -> None:
        self._visitors, self._visitor = visitors, visitors.newcomer(name)
        self.operator = self._visitor.operator
        self._visitor.call(TIME, b"")

    def publish(self, topic: str, msg: Msg, stamp: float) -> None:
        self._visitor.heard()
        self._visitor.publish(topic, to_json(msg), stamp, dated=False)

    def ask(self, service: str, request: CommandRequest) -> CommandResponse:
        self._visitor.heard()
        answer = self._visitor.call(service, to_json(request))
        assert isinstance(answer, bytes)
        return from_json(answer, CommandResponse)

    def leave(self) -> None:
        self._visitors.leave(self._visitor)


class _Rosbridge:
    """A client of the rosbridge gateway, that speaks JSON."""

    def __init__(self, gateways: Gateways, door: StationDoor, name: str) -> None:
        self._gateways, self._door = gateways, door
        self._ids = itertools.count()
        self._soon: list[Any] = []
        self._writer = FrameWriter()
        self.operator = door.join(f"{HOST}:{next(_PORTS)}")
        context = gateways.rosbridge.server._context
        self._session = RosbridgeSession(self._writer, WriteBatch(self._soon.append), self.operator, context)
        self._say(op="call_service", service="/rosapi/get_time")

    def publish(self, topic: str, msg: Msg, stamp: float) -> None:
        self._say(op="publish", topic=topic, msg=json.loads(to_json(msg)), stamp=stamp)

    def ask(self, service: str, request: CommandRequest) -> CommandResponse:
        id = str(next(self._ids))
        self._say(op="call_service", service=service, args=json.loads(to_json(request)), id=id)
        (answer,) = (each for each in map(json.loads, self._writer.heard) if each.get("id") == id)
        assert answer["result"], answer
        self._writer.writes.clear()
        return from_json(json.dumps(answer["values"]).encode(), CommandResponse)

    def leave(self) -> None:
        self._door.leave(self.operator)
        self._gateways.run(self._session.close())

    def _say(self, **op: Any) -> None:
        self._gateways_run(json.dumps(op))

    def _gateways_run(self, text: str) -> None:
        assert self._session.on_message(text)
        while self._soon:
            self._soon.pop(0)()
        for ping in self._writer.unanswered:
            self._session.on_pong(ping)
        self._writer.unanswered.clear()
