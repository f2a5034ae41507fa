"""Webhooks as a resource: list, add, remove."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Annotated

import msgspec
from fastapi import Path
from starlette.requests import Request
from starlette.responses import Response

from robotside.gateways.http.asker import operator_of
from robotside.gateways.rest.bodies import body_of
from robotside.gateways.rest.desk import Desk
from robotside.gateways.rest.forms import written
from robotside.gateways.rest.statuses import Rejected
from robotside.gateways.webhooks.hooks import Hooks

__all__ = ["WebhookPaths"]

Number = Annotated[int, Path(ge=0, le=2**31 - 1)]


class WebhookPaths:
    """What answers them."""

    def __init__(self, desk: Desk, hooks: Hooks) -> None:
        self._desk, self._hooks = desk, hooks

    def all(self) -> tuple[tuple[str, str, Callable[..., Awaitable[Response]], str], ...]:
        """Method, path, handler and what it does."""
        return (
            ("GET", "/webhooks", self.read, "Your webhooks; all of them for who manages the robot."),
            ("POST", "/webhooks", self.add, "Has events sent to a web server, each signed by the secret."),
            ("DELETE", "/webhooks/{id}", self.remove, "Ends a webhook."),
        )

    async def read(self, request: Request) -> Response:
        """List them."""
        form = self._desk.form(request)
        return written(form, msgspec.json.encode({"webhooks": self._hooks.shown(operator_of(request))}))

    async def add(self, request: Request) -> Response:
        """Make one."""
        form = self._desk.form(request)
        made = await self._hooks.add(operator_of(request), await body_of(request, None))
        return written(form, msgspec.json.encode(made), 201)

    async def remove(self, request: Request, id: Number) -> Response:
        """End one."""
        form = self._desk.form(request)
        if not self._hooks.remove(operator_of(request), id):
            raise Rejected(404, f"You have no webhook with the id {id}.")
        return written(form, b'{"success":true,"message":"Removed.","code":""}')
