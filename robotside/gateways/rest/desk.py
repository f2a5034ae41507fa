"""The desk: each request at the robot's door, and its answer in the form that it asked for."""

from __future__ import annotations

import asyncio
from collections.abc import Collection
from typing import Any

import msgspec
from starlette.requests import Request
from starlette.responses import Response

from bridge.codec import to_json
from bridge.core.errors import ProtocolError
from bridge.core.robot_catalogue import Operator
from bridge.core.topics import Topic
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import CommandRequest
from robotside.door.station_door import StationDoor
from robotside.gateways.http.asker import operator_of
from robotside.gateways.http.mounts import LONG, STAYS
from robotside.gateways.payloads.table import key_of
from robotside.gateways.plain.callers import Callers
from robotside.gateways.plain.visitor import TIME, Visitor
from robotside.gateways.rest.bodies import CLIENT_ID, CLIENT_NAME, KEY, body_of, header, stamp_of
from robotside.gateways.rest.commands import Command
from robotside.gateways.rest.forms import chosen_form, written
from robotside.gateways.rest.statuses import Rejected, status_of_code

__all__ = ["DEMAND_TIMEOUT", "Desk"]

DEMAND_TIMEOUT = 2.0
"""How long a message is waited for that is made only while somebody wants it [s]."""
_NO_PAYLOAD = ""


class Desk:
    """What one robot answers."""

    def __init__(self, door: StationDoor, keys: Collection[str]) -> None:
        """Clients reach the payloads `keys`."""
        self.door, self.keys = door, frozenset(keys)
        self.clients = Callers(door, self.keys)
        self._people = self.keys | {_NO_PAYLOAD}

    # commands

    async def stop(self, operator: Operator, name: str, form: str) -> Response:
        """Press STOP for anyone."""
        answer = await self.door.stop(operator, name)
        return written(form, to_json(answer), 200 if answer.success else 503)

    async def command(self, request: Request, command: Command, parts: dict[str, Any]) -> Response:
        """Carry out a command of a resource."""
        form = self.form(request)
        known = self._service(command.service, self.keys if command.carried else self._people)
        told = known
        if command.field:
            (told,) = (
                each.type for each in msgspec.structs.fields(known) if each.encode_name == command.field
            )
        body = command.fill(await body_of(request, told), parts)
        return await self._call(request, form, command.service, body, carried=command.carried)

    async def call(self, request: Request, service: str) -> Response:
        """Call a service by its name."""
        form = self.form(request)
        known = self._service(service, self.keys)
        return await self._call(request, form, service, await body_of(request, known))

    async def ask(
        self, request: Request, service: str, body: dict[str, Any], *, carried: bool = True
    ) -> Response:
        """Answer by a service that changes nothing."""
        self._service(service, self.keys if carried else self._people)
        return await self._call(request, self.form(request), service, body, carried=carried)

    async def time(self, request: Request) -> Response:
        """The robot's time, by which a client stamps what it sends from now on."""
        form = self.form(request)
        answer = self._visit(request, {}).ask(TIME, b"")
        return await self._answered(request, form, answer)

    def _service(self, name: str, keys: Collection[str]) -> type[Msg]:
        """The class of a service's requests; Rejected (404) for one that is not there or not carried."""
        if key_of(name) in keys and name in self.door.services:
            return self.door.services[name].request
        raise Rejected(404, _none("service", name))

    async def _call(
        self, request: Request, form: str, service: str, body: dict[str, Any], *, carried: bool = True
    ) -> Response:
        self._take_headers(request, service, body)
        visitor = self._visit(request, body)
        if not carried:
            visitor = Visitor(self.door, visitor.operator, self._people, visitor.name)
        answer = visitor.ask(service, _encoded(body), stamp_of(request))
        return await self._answered(request, form, answer)

    async def _answered(self, request: Request, form: str, answer: Any) -> Response:
        if not isinstance(answer, Msg):
            setattr(request.state, LONG, True)
            answer = await answer
        if getattr(answer, "success", True):
            return written(form, to_json(answer))
        return written(form, to_json(answer), status_of_code(getattr(answer, "code", "")))

    def _take_headers(self, request: Request, service: str, body: dict[str, Any]) -> None:
        """Put what headers say of a command into its request, where the body says nothing else."""
        if not issubclass(self.door.services[service].request, CommandRequest):
            return
        for name, field in ((KEY, "command_id"), (CLIENT_ID, "client_id"), (CLIENT_NAME, "client_name")):
            value = header(request, name)
            if value and (body.get(field) or value) != value:
                raise ProtocolError(f"The header {name} and the field {field} differ.")
            if value:
                body[field] = value

    def _visit(self, request: Request, body: dict[str, Any]) -> Visitor:
        """Who asks, by the header or by what the body says."""
        told = body.get("client_id")
        client = header(request, CLIENT_ID) or (told if isinstance(told, str) else "")
        client, name = client[:64], header(request, CLIENT_NAME)

        def stay(operator: Operator) -> Operator:
            setattr(request.state, STAYS, True)
            return operator

        visitor = self.clients.visit(operator_of(request), client, stay, client)
        visitor.name = name or visitor.name
        return visitor

    # topics

    async def publish(self, request: Request, name: str) -> Response:
        """Give a message to the robot; Refused where it does not obey."""
        form = self.form(request)
        if key_of(name) not in self.keys or name not in self.door.topics:
            raise Rejected(404, _none("topic", name))
        topic = self.door.topics[name]
        if topic.to != "robot":
            raise Rejected(405, f"The robot speaks on {name} and listens to others.", {"Allow": "GET, HEAD"})
        body, stamp = await body_of(request, topic.type), stamp_of(request)
        self._visit(request, {}).publish(name, _encoded(body), stamp)
        return written(form, b'{"success":true,"message":"Taken.","code":""}', 202)

    def topic(self, request: Request, name: str) -> Topic:
        """A topic that the robot tells and that who asks may read; Rejected (404) for none, Refused without the role."""
        if key_of(name) not in self.keys or not self.door.offers(name):
            raise Rejected(404, _none("topic", name))
        topic = self.door.topics.get(name)
        if topic is None:
            raise Rejected(404, _none("topic", name))
        if topic.to == "robot":
            raise Rejected(405, f"The robot listens on {name}; publish there by POST.", {"Allow": "POST"})
        self.door.check(operator_of(request), "subscribe", name)
        return topic

    async def newest(self, request: Request, name: str) -> Response:
        """The newest message of a topic."""
        form, topic = self.form(request), self.topic(request, name)
        msg = await self._made(topic) if topic.on_demand else self.door.last(name)
        if msg is None:
            raise Rejected(503 if topic.on_demand else 404, f"There is no message on {name} yet.")
        return written(form, to_json(msg))

    async def _made(self, topic: Topic) -> Msg | None:
        """The next message of a topic that is made on demand; None when none comes in time."""
        asker = object()
        came: asyncio.Future[Msg] = asyncio.get_running_loop().create_future()

        def on_message(_: str, msg: Msg) -> None:
            if not came.done():
                came.set_result(msg)

        self.door.subscribe(asker, topic.name, on_message)
        try:
            async with asyncio.timeout(DEMAND_TIMEOUT):
                return await came
        except TimeoutError:
            return None
        finally:
            self.door.leave(asker)

    def parts(self, request: Request, **topics: str) -> Response:
        """The newest messages of several topics as one answer; null for those of which there is none."""
        form = self.form(request)
        found = {}
        for part, name in topics.items():
            if key_of(name) in self.keys:
                self.door.check(operator_of(request), "subscribe", name)
                msg = self.door.last(name)
                found[part] = msgspec.Raw(to_json(msg)) if msg is not None else None
        return written(form, msgspec.json.encode(found))

    def one(self, request: Request, topic: str, field: str, id: int) -> Response:
        """The one of a topic's list with that id; Rejected (404) for none."""
        form = self.form(request)
        self.topic(request, topic)
        for each in getattr(self.door.last(topic), field, ()):
            if each.id == id:
                return written(form, to_json(each))
        raise Rejected(404, f"There is none with the id {id}.")

    def topics(self, request: Request) -> Response:
        """All topics that are carried."""
        found = [
            {
                "name": topic.name,
                "type": topic.type.MSGTYPE,
                "verb": "publish" if topic.to == "robot" else "read",
                "rate": topic.rate,
                "doc": topic.doc,
                "on_demand": topic.on_demand,
            }
            for topic in self.door.topics.values()
            if key_of(topic.name) in self.keys and self.door.offers(topic.name)
        ]
        return written(self.form(request), msgspec.json.encode({"topics": found}))

    def services(self, request: Request) -> Response:
        """All services that are carried."""
        found = [
            {"name": name, "type": service.type}
            for name, service in sorted(self.door.services.items())
            if key_of(name) in self.keys
        ]
        return written(self.form(request), msgspec.json.encode({"services": found}))

    def form(self, request: Request) -> str:
        """The form that a request wants its answer in; Rejected (406) for none that there is."""
        return chosen_form(", ".join(request.headers.getlist("accept")))


def _encoded(body: dict[str, Any]) -> bytes:
    try:
        return msgspec.json.encode(body)
    except (ValueError, UnicodeError) as error:
        raise ProtocolError(f"The message cannot be read: {error}.") from error


def _none(what: str, name: str) -> str:
    return f"This robot has no {what} {name[:100]!r} here."
