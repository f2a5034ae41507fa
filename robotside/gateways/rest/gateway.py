"""The REST gateway of one robot."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from starlette.types import ASGIApp, Receive, Scope, Send

from bridge.core.async_tasks import cancel_all
from bridge.core.codes import Code
from bridge.core.errors import BridgeError, Refused
from bridge.core.identity import Role
from robotside.control.authority import MAX_NAME_LENGTH
from robotside.core.notice import Notice
from robotside.core.text import plain
from robotside.gateways.adapter import Surroundings
from robotside.gateways.gateway_url import GatewayUrl
from robotside.gateways.http.mounts import ONLY_STOP, OPERATOR, source
from robotside.gateways.http.presence import presence_of
from robotside.gateways.payloads.offered import offered
from robotside.gateways.rest.application import application
from robotside.gateways.rest.bodies import CLIENT_NAME
from robotside.gateways.rest.desk import Desk
from robotside.gateways.rest.forms import JSON, chosen_form, refused
from robotside.gateways.rest.guide import guide
from robotside.gateways.rest.statuses import Rejected, status_of
from robotside.gateways.rest.topic_stream import TopicStreams
from robotside.gateways.webhooks.hooks import Hooks

__all__ = ["RestGateway"]

_CHECK_PERIOD = 1.0
"""Between two looks for clients that are silent [s]."""


class RestGateway:
    """An `AdapterGateway`: the robot's resources at a path of its web site."""

    def __init__(self, robot: Surroundings, url: GatewayUrl) -> None:
        """Who shows no key has the role of the `url`; without one, what its address gives it. BridgeError without a web site."""
        if robot.site is None:
            raise BridgeError("REST needs the robot's web site, which this one has not.")
        self._door, self._say, self._url, self._site = robot.door, robot.say, url, robot.site
        self._turns, self._key = robot.turns, robot.key
        self._path = f"/{url.path}"
        self._desk = Desk(robot.door, url.keys)
        self._streams = TopicStreams(robot.door, url.rate)
        self._hooks = Hooks(robot.door, robot.say)
        self._app: ASGIApp = _absent
        self._unmount: Callable[[], None] | None = None
        self._tasks: list[asyncio.Task[Any]] = []

    async def start(self) -> None:
        """Begin to answer. BridgeError when the path is taken."""
        self._app = await self._built()
        self._unmount = self._site.mount(
            self._path,
            self._answer,
            way="rest",
            role=self._url.role,
            presses_stop=self._presses_stop,
            written=refused,
        )
        if self._url.role is not None and self._url.role > Role.WATCH:
            role = self._url.role.word
            said = f"Everybody who reaches the robot's web site may {role} by REST without a key."
            self._say("control", Notice(Code.GATEWAY_OPEN, said, gateway="rest", role=role), "warn")
        self._tasks = [asyncio.create_task(self._check())]

    async def _built(self) -> ASGIApp:
        """The application, built beside the loop, which drives the robot: FastAPI takes a twentieth of a second for its paths."""
        builder = ThreadPoolExecutor(1, "build REST")
        try:
            return await asyncio.get_running_loop().run_in_executor(
                builder, application, self._desk, self._streams, self._hooks, self.guide
            )
        finally:
            builder.shutdown(wait=False)

    async def stop(self) -> None:
        """End all answers and what clients have; nothing is left running."""
        if self._unmount is not None:
            self._unmount()
        self._desk.clients.leave_all()
        await self._hooks.close()
        await cancel_all(self._tasks)

    def endpoints(self) -> Mapping[str, str]:
        """The URL of the resources."""
        return {"rest": self._site.url(self._path)}

    def guide(self) -> str:
        """How a client uses it now."""
        where = self._site.url(self._path)
        return guide(where, offered(self._door, self._url.keys), self._url.role, self._key)

    def _presses_stop(self, scope: Scope) -> bool:
        path = scope["path"].rstrip("/")
        return scope["method"] == "POST" and path in (f"{self._path}/stop", f"{self._path}/services/stop")

    async def _answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request in its turn; STOP before all others, and before anything in it is read."""
        if not scope["state"].get(ONLY_STOP):
            try:
                await self._turns.take(source(scope))
                await presence_of(scope).confirm()
            except Refused as refusal:
                await refused(scope, status_of(refusal), refusal)(scope, receive, send)
                return
            await self._app(scope, receive, send)
            return
        name = plain(_header(scope, CLIENT_NAME), MAX_NAME_LENGTH)
        try:
            form = chosen_form(_header(scope, "accept"))
        except Rejected:
            form = JSON
        answer = await self._desk.stop(scope["state"][OPERATOR], name, form)
        await answer(scope, receive, send)

    async def _check(self) -> None:
        while True:
            await asyncio.sleep(_CHECK_PERIOD)
            self._desk.clients.leave_silent()


async def _absent(*_: object) -> None:
    """Nothing is mounted before the application is built."""


def _header(scope: Scope, name: str) -> str:
    key = name.lower().encode()
    return ", ".join(value.decode("latin-1") for found, value in scope["headers"] if found == key)
