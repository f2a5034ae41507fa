"""The OpenAPI description of the gateway, made from its paths and the robot's message classes."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import msgspec
from fastapi.openapi.utils import get_openapi
from msgspec.structs import fields

from bridge.msgs import TYPES, Msg
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from bridge.msgs.rosapi_msgs import GetTimeResponse
from robotside.gateways.payloads.offered import PUBLISH, offered
from robotside.gateways.rest.bodies import CLIENT_ID, CLIENT_NAME, KEY, MAX_HEADER, STAMP
from robotside.gateways.rest.commands import COMMANDS, Command
from robotside.gateways.rest.forms import EVENTS, JSON, TEXT, XML
from robotside.gateways.rest.schemas import Schemas
from robotside.gateways.webhooks.hooks import Wish

if TYPE_CHECKING:
    from fastapi import FastAPI

    from robotside.gateways.rest.desk import Desk

__all__ = ["described"]

Described = dict[str, Any]

_ABOUT = (
    "Commands go through the same door as by every other protocol: the same roles, control, limits and STOP. Who drives "
    f"is who asks with the same key from the same machine, and with the same header {CLIENT_ID}. A drive command needs the "
    f"header {STAMP}, the robot's time in seconds (GET time first), and counts for 0.25 s. A command that is sent again "
    f"with the same {KEY} is done once."
)
_HEADERS = {
    CLIENT_ID: "Tells clients of one machine apart; control belongs to one.",
    CLIENT_NAME: "What people call the client.",
    KEY: "A command with the same key is done once, and answered alike.",
    STAMP: "When it was meant, the robot's time in seconds.",
}
_REFUSALS = {
    "401": "The robot does not know who asks.",
    "403": "The role of who asks is too small, or its page is another's.",
    "404": "There is no such thing.",
    "405": "That is not done here.",
    "406": "No form of the answer is taken.",
    "409": "The robot's state is against it.",
    "413": "The body is too long.",
    "415": "The body is of another form.",
    "422": "Something in the request is wrong; the message names it.",
    "426": "From elsewhere it is asked over TLS.",
    "429": "Too many attempts.",
    "503": "It is not to be had at present.",
}
_REFUSAL = "Refusal"
_ANY: Described = {}
_RESPONSES: dict[str, type[Msg]] = {}
_TOPICS = {
    "/control": "/control/status",
    "/tasks/queue": "/task/queue",
    "/places": "/places",
    "/schedule": "/schedule",
}
_SERVICES = {
    "/tasks/history": "/history/get",
    "/missions": "/missions/get",
    "/missions/current": "/mission/get",
    "/people": "/people/list",
    "/people/me": "/people/me",
    "/events": "/events/get",
}
_ITEMS = {"/places/{id}": "pilothouse_msgs/Place", "/schedule/{id}": "pilothouse_msgs/ScheduledTask"}


def described(app: FastAPI, desk: Desk) -> Described:
    """The description, OpenAPI 3.1."""
    made = get_openapi(title=app.title, version=app.version, routes=app.routes, description=_ABOUT)
    about = _Description(desk)
    commands = {(each.path, each.method): each for each in COMMANDS}
    for path, methods in made["paths"].items():
        for method, operation in methods.items():
            _without_validation(operation)
            about.complete(path, method.upper(), operation, commands.get((path, method.upper())))
    made["components"] = {"schemas": about.schemas.components | {_REFUSAL: _refusal_schema()}}
    made["components"]["securitySchemes"] = {"token": {"type": "http", "scheme": "bearer"}}
    made["security"] = [{}, {"token": []}]
    made["servers"] = [{"url": "."}]
    return made


def _without_validation(operation: Described) -> None:
    operation["responses"] = {}
    operation.pop("operationId", None)


def _refusal_schema() -> Described:
    return {
        "type": "object",
        "properties": {
            "success": {"const": False},
            "message": {"type": "string"},
            "code": {"type": "string"},
        },
        "required": ["success", "message", "code"],
    }


class _Description:
    """Completes what is known of each operation."""

    def __init__(self, desk: Desk) -> None:
        self._desk = desk
        self.schemas = Schemas()

    def complete(self, path: str, method: str, operation: Described, command: Command | None) -> None:
        """Add the body, the headers and the answers."""
        operation["operationId"] = (
            f"{method.lower()}{path.replace('/', '_').replace('{', '').replace('}', '')}"
        )
        if command is not None:
            operation.pop("x-service", None)
            self._command(operation, command)
        elif path.startswith("/webhooks"):
            self._webhook(method, operation)
        elif method == "POST":
            self._doing(path, operation)
        else:
            self._reading(path, operation)
        refusals = dict(_REFUSALS)
        if path == "/stop":
            refusals = {"503": _REFUSALS["503"]}
        for status, what in refusals.items():
            operation["responses"][status] = _answer(what, {"$ref": f"#/components/schemas/{_REFUSAL}"})

    def _command(self, operation: Described, command: Command) -> None:
        service = self._desk.door.services.get(command.service)
        if (
            service is None
        ):  # this robot lacks it; what it would be asked is known nonetheless where its class is
            operation["responses"]["200"] = _answer("Done.", _ANY)
            if command.example:
                whole: Described = {"schema": {"type": "object"}, "example": json.loads(command.example)}
                operation["requestBody"] = {"content": {JSON: whole, XML: {}}}
            return
        request: type[Msg] = service.request
        if command.field:
            (request,) = (each.type for each in fields(request) if each.encode_name == command.field)
        if command.example or issubclass(request, CommandRequest):
            operation["requestBody"] = self._body(request, command.example)
        if issubclass(service.request, CommandRequest):
            _add_headers(operation, *_HEADERS)
        operation["responses"]["200"] = _answer("Done.", self.schemas.of(service.response))

    def _doing(self, path: str, operation: Described) -> None:
        if path == "/stop":
            operation["responses"]["200"] = _answer("STOP is pressed.", self.schemas.of(CommandResponse))
            return
        _add_headers(operation, *_HEADERS)
        message: Described = {"schema": {"type": "object"}}
        if path.startswith("/topics"):
            message["examples"] = self._messages()
        operation["requestBody"] = {
            "content": {JSON: message, XML: {}},
            "description": "A message of the topic, or the request of the service, in ROS's names.",
        }
        status = "202" if path.startswith("/topics") else "200"
        operation["responses"][status] = _answer("Taken.", _ANY)

    def _messages(self) -> Described:
        """A message of each topic that this robot listens to."""
        lines = [line for each in offered(self._desk.door, self._desk.keys) for line in each.lines]
        return {
            line.name.strip("/"): {"value": json.loads(line.example)}
            for line in lines
            if line.verb == PUBLISH and line.example
        }

    def _webhook(self, method: str, operation: Described) -> None:
        made, parts = msgspec.json.schema_components([Wish], ref_template="#/components/schemas/{name}")
        if method == "POST":
            self.schemas.components |= parts
            example = {"url": "https://192.0.2.7/robot", "levels": ["alarm"]}
            operation["requestBody"] = {
                "content": {JSON: {"schema": made[0], "example": example}},
                "required": True,
            }
        operation["responses"]["201" if method == "POST" else "200"] = _answer("Done.", _ANY)

    def _reading(self, path: str, operation: Described) -> None:
        door = self._desk.door
        if path in _SERVICES and _SERVICES[path] in door.services:
            schema = self.schemas.of(door.services[_SERVICES[path]].response)
        elif path in _TOPICS:
            schema = self.schemas.of(door.topics[_TOPICS[path]].type)
        elif path in _ITEMS:
            schema = self.schemas.of(TYPES[_ITEMS[path]])
        else:
            schema = self.schemas.of(GetTimeResponse) if path == "/time" else _ANY
        answer = _answer("Here it is.", schema)
        if path == "/docs":
            answer = {"description": "A page.", "content": {"text/html": {}}}
        if path.startswith("/topics/"):
            events = {"schema": {"type": "string"}}
            answer["content"] = (
                {EVENTS: events} if path.endswith("/stream") else answer["content"] | {EVENTS: events}
            )
        operation["responses"]["200"] = answer
        if path in ("/time", *_SERVICES):
            _add_headers(operation, CLIENT_ID, CLIENT_NAME)

    def _body(self, cls: type[Msg], example: str) -> Described:
        schema = self.schemas.of(cls)
        content: Described = {JSON: {"schema": schema}, XML: {}}
        if example:
            content[JSON]["example"] = json.loads(example)
        return {"content": content}


def _answer(what: str, schema: Described) -> Described:
    content: Described = {JSON: {"schema": schema} if schema else {}}
    return {"description": what, "content": content | {TEXT: {}, XML: {}}}


def _add_headers(operation: Described, *names: str) -> None:
    found = operation.setdefault("parameters", [])
    for name in names:
        schema: Described = {"type": "string", "maxLength": MAX_HEADER, "pattern": "^[ -~]*$"}
        if name == STAMP:
            schema = {"type": "number"}
        found.append({"name": name, "in": "header", "description": _HEADERS[name], "schema": schema})
