"""The paths of the REST gateway: resources of the robot, each with what is done by which method."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Annotated, Any

import msgspec
from fastapi import Depends, FastAPI, Path, Query
from fastapi.exceptions import RequestValidationError
from fastapi.routing import APIRoute
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import HTMLResponse, Response

from bridge.core.errors import BridgeError, ProtocolError
from robotside.gateways.gateway_url import MAX_RATE
from robotside.gateways.http.asker import operator_of
from robotside.gateways.rest.bodies import CLIENT_NAME
from robotside.gateways.rest.commands import COMMANDS, Command
from robotside.gateways.rest.desk import Desk
from robotside.gateways.rest.docs_page import docs_page
from robotside.gateways.rest.forms import EVENTS, FORMS, TEXT, chosen_form, refused, written
from robotside.gateways.rest.openapi import described
from robotside.gateways.rest.payload_list import payload_list, payload_state
from robotside.gateways.rest.statuses import Rejected, status_of
from robotside.gateways.rest.topic_stream import TopicStreams
from robotside.gateways.rest.webhook_paths import WebhookPaths
from robotside.gateways.webhooks.hooks import Hooks

__all__ = ["application"]

MAX_NUMBER = 2**31 - 1
MAX_WORD = 256
"""Characters of a name in a path."""

Number = Annotated[int, Path(ge=0, le=MAX_NUMBER)]
Word = Annotated[str, Path(min_length=1, max_length=MAX_WORD)]
Count = Annotated[int, Query(ge=0, le=MAX_NUMBER)]
Limit = Annotated[int, Query(ge=1, le=200)]
Rate = Annotated[float, Query(gt=0, le=MAX_RATE, allow_inf_nan=False)]
Handler = Callable[..., Awaitable[Response]]


def application(desk: Desk, streams: TopicStreams, hooks: Hooks, guide: Callable[[], str]) -> FastAPI:
    """The application; `guide()` is how it is used now."""
    app = FastAPI(
        title=f"{desk.door.info.name}",
        version="1",
        openapi_url=None,
        docs_url=None,
        redoc_url=None,
        redirect_slashes=False,
        dependencies=[Depends(_strict_query)],
        exception_handlers={
            BridgeError: _refusal,
            HTTPException: _http_refusal,
            RequestValidationError: _wrong_parameter,
        },
    )
    paths = _Paths(desk, streams, guide, lambda: described(app, desk))
    for path, handler, what in paths.reading():
        app.add_api_route(path, handler, methods=["GET"], name=what, summary=what, response_model=None)
    for path, handler, what in paths.doing():
        app.add_api_route(path, handler, methods=["POST"], name=what, summary=what, response_model=None)
    for method, path, handler, what in WebhookPaths(desk, hooks).all():
        app.add_api_route(path, handler, methods=[method], name=what, summary=what, response_model=None)
    for command in COMMANDS:
        app.add_api_route(
            command.path,
            _handler(desk, command),
            methods=[command.method],
            name=command.doc,
            summary=command.doc,
            response_model=None,
            openapi_extra={"x-service": command.service},
        )
    return app


def _handler(desk: Desk, command: Command) -> Handler:
    """What answers a command, with what its path names."""

    async def plain(request: Request) -> Response:
        return await desk.command(request, command, {})

    async def numbered(request: Request, id: Number) -> Response:
        return await desk.command(request, command, {"id": id})

    async def named(request: Request, name: Word) -> Response:
        return await desk.command(request, command, {"name": name})

    async def known(request: Request, id: Word) -> Response:
        return await desk.command(request, command, {"id": id})

    if command.part == "name":
        return named
    if not command.part:
        return plain
    return numbered if command.carried else known


class _Paths:
    """What answers all that is no command of a resource."""

    def __init__(
        self,
        desk: Desk,
        streams: TopicStreams,
        guide: Callable[[], str],
        openapi: Callable[[], dict[str, Any]],
    ) -> None:
        self._desk, self._streams, self._guide, self._openapi = desk, streams, guide, openapi
        self._described: bytes = b""

    def reading(self) -> tuple[tuple[str, Handler, str], ...]:
        """The paths that are read, those with a fixed name before those that take any."""
        return (
            ("/", self.index, "The guide as text, or the paths."),
            ("/guide", self.guide, "How the robot is used, with lines that can be pasted."),
            ("/openapi.json", self.openapi, "This description."),
            ("/docs", self.docs, "This description as a page."),
            ("/time", self.time, "The robot's time, by which a client stamps its drive commands."),
            ("/robot", self.robot, "Who the robot is, and how it is."),
            ("/control", self.control, "Who drives, the mode, and STOP."),
            ("/tasks", self.tasks, "The running task, its progress, and those that wait."),
            ("/tasks/queue", self.queue, "The tasks that wait."),
            ("/tasks/history", self.history, "Past tasks, the newest first."),
            ("/missions", self.missions, "The names of all missions that are kept."),
            ("/missions/current", self.mission, "The stored mission."),
            ("/places", self.places, "All places."),
            ("/places/{id}", self.place, "One place."),
            ("/schedule", self.schedule, "All scheduled tasks."),
            ("/schedule/{id}", self.scheduled, "One scheduled task."),
            ("/people", self.people, "Everybody whom the robot knows."),
            ("/people/me", self.me, "Who asks."),
            ("/payloads", self.payloads, "What the robot carries, with topics, services and examples."),
            ("/payloads/{name}", self.payload, "The newest message of each topic of a payload."),
            ("/events", self.events, "The events after a number."),
            ("/topics", self.topics, "All topics."),
            ("/topics/{name:path}/stream", self.stream, "A topic as server-sent events."),
            ("/topics/{name:path}", self.topic, "The newest message of a topic."),
            ("/services", self.services, "All services."),
        )

    def doing(self) -> tuple[tuple[str, Handler, str], ...]:
        """The paths that do something, beside the commands of resources."""
        return (
            (
                "/stop",
                self.stop,
                "Presses STOP, for anyone, whatever else is said; Client-Name may say by whom.",
            ),
            ("/topics/{name:path}", self.publish, "Publishes a message."),
            ("/services/{name:path}", self.call, "Calls a service."),
        )

    # about the gateway itself

    async def index(self, request: Request) -> Response:
        found = sorted({route.path for route in request.app.routes if isinstance(route, APIRoute)})
        return written(self._desk.form(request), msgspec.json.encode({"paths": found}))

    async def guide(self, request: Request) -> Response:
        form = chosen_form(", ".join(request.headers.getlist("accept")), (TEXT, *FORMS))
        if form == TEXT:
            return Response(self._guide() + "\n", headers={"Cache-Control": "no-store"}, media_type=TEXT)
        return written(form, msgspec.json.encode({"guide": self._guide()}))

    async def openapi(self, _: Request) -> Response:
        self._described = self._described or msgspec.json.encode(self._openapi())
        return Response(self._described, headers={"Cache-Control": "no-store"}, media_type="application/json")

    async def docs(self, request: Request) -> Response:
        page = docs_page(self._openapi(), request.scope.get("root_path", ""))
        policy = "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'"
        return HTMLResponse(page, headers={"Cache-Control": "no-store", "Content-Security-Policy": policy})

    # resources

    async def time(self, request: Request) -> Response:
        return await self._desk.time(request)

    async def robot(self, request: Request) -> Response:
        return self._desk.parts(
            request,
            info="/robot/info",
            battery="/battery_state",
            control="/control/status",
            task="/task/status",
            diagnostics="/diagnostics",
        )

    async def control(self, request: Request) -> Response:
        return await self._desk.newest(request, "/control/status")

    async def tasks(self, request: Request) -> Response:
        return self._desk.parts(
            request, status="/task/status", progress="/task/progress", queue="/task/queue"
        )

    async def queue(self, request: Request) -> Response:
        return await self._desk.newest(request, "/task/queue")

    async def history(self, request: Request, before: Count = 0, limit: Limit = 50) -> Response:
        return await self._desk.ask(request, "/history/get", {"before": before, "limit": limit})

    async def missions(self, request: Request) -> Response:
        return await self._desk.ask(request, "/missions/get", {})

    async def mission(self, request: Request) -> Response:
        return await self._desk.ask(request, "/mission/get", {})

    async def places(self, request: Request) -> Response:
        return await self._desk.newest(request, "/places")

    async def place(self, request: Request, id: Number) -> Response:
        return self._desk.one(request, "/places", "places", id)

    async def schedule(self, request: Request) -> Response:
        return await self._desk.newest(request, "/schedule")

    async def scheduled(self, request: Request, id: Number) -> Response:
        return self._desk.one(request, "/schedule", "tasks", id)

    async def people(self, request: Request) -> Response:
        return await self._desk.ask(request, "/people/list", {}, carried=False)

    async def me(self, request: Request) -> Response:
        return await self._desk.ask(request, "/people/me", {}, carried=False)

    async def payloads(self, request: Request) -> Response:
        form = self._desk.form(request)
        return written(form, msgspec.json.encode(payload_list(self._desk.door, self._desk.keys)))

    async def payload(self, request: Request, name: Word) -> Response:
        form = self._desk.form(request)
        return written(form, payload_state(self._desk.door, self._desk.keys, operator_of(request), name))

    async def events(
        self,
        request: Request,
        since: Count = 0,
        most: Count = 0,
        boot: Annotated[str, Query(max_length=64)] = "",
    ) -> Response:
        body = {"since": since, "most": most, "boot": boot}
        return await self._desk.ask(request, "/events/get", body)

    # topics and services by their names

    async def topics(self, request: Request) -> Response:
        return self._desk.topics(request)

    async def topic(self, request: Request, name: Word, rate: Rate = MAX_RATE) -> Response:
        form = chosen_form(", ".join(request.headers.getlist("accept")), (*FORMS, EVENTS))
        if form == EVENTS:
            return await self.stream(request, name, rate)
        return await self._desk.newest(request, f"/{name}")

    async def stream(self, request: Request, name: Word, rate: Rate = MAX_RATE) -> Response:
        chosen_form(", ".join(request.headers.getlist("accept")), (EVENTS,))
        topic = self._desk.topic(request, f"/{name}")
        return self._streams.stream(operator_of(request), topic, rate)

    async def publish(self, request: Request, name: Word) -> Response:
        return await self._desk.publish(request, f"/{name}")

    async def services(self, request: Request) -> Response:
        return self._desk.services(request)

    async def call(self, request: Request, name: Word) -> Response:
        return await self._desk.call(request, f"/{name}")

    async def stop(self, request: Request) -> Response:
        """Only the description names it: the gateway presses STOP before any path is looked at."""
        name = request.headers.get(CLIENT_NAME, "")
        return await self._desk.stop(operator_of(request), name, FORMS[0])


async def _strict_query(request: Request) -> None:
    """Raises ProtocolError for a parameter that the path has not, or that is given twice."""
    route = request.scope["route"]
    known = [field.alias for field in route.dependant.query_params]
    for name in request.query_params:
        if name not in known:
            there = f"it has {', '.join(known)}" if known else "it has none"
            raise ProtocolError(f"There is no parameter {name[:60]!r} here; {there}.")
        if len(request.query_params.getlist(name)) > 1:
            raise ProtocolError(f"The parameter {name} is given twice.")


async def _refusal(request: Request, error: Exception) -> Response:
    known = error if isinstance(error, BridgeError) else ProtocolError(str(error))
    return refused(request.scope, status_of(known), known)


async def _http_refusal(request: Request, error: Exception) -> Response:
    """A path or a method that there is not."""
    status = error.status_code if isinstance(error, HTTPException) else 500
    headers = dict((isinstance(error, HTTPException) and error.headers) or {})
    if status == 405:
        headers["Allow"] = ", ".join(_methods(request)) or headers.get("Allow", "")
    said = {404: "There is no such path; GET the guide.", 405: f"{request.method} is not done here."}
    sentence = said.get(status, "The request cannot be answered.")
    return refused(request.scope, status, Rejected(status, sentence, headers))


def _methods(request: Request) -> list[str]:
    """The methods that the path of a request has."""
    fitting = [
        route
        for route in request.app.routes
        if isinstance(route, APIRoute) and route.matches(request.scope)[0].value > 0
    ]
    path = min(fitting, key=lambda route: "{" in route.path).path if fitting else ""
    return sorted({method for route in fitting if route.path == path for method in route.methods or ()})


async def _wrong_parameter(request: Request, error: Exception) -> Response:
    """A parameter of a path or query that is not what it must be; without the value, which may be anything."""
    faults = error.errors() if isinstance(error, RequestValidationError) else []
    said = "; ".join(f"{each['loc'][-1]}: {each['msg']}" for each in faults[:5])
    return refused(request.scope, 422, ProtocolError(f"A parameter is wrong. {said}."))
