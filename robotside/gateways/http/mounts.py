"""Further applications on a robot's web site, each below a path of its own: same port, same TLS, same doorkeeper.

They come and go while the site runs. A request reaches one after the doorkeeper has judged TLS, origin, token and place,
with its `Operator` in the state of the scope; what that operator may do there, the application asks the door.
"""

from __future__ import annotations

import asyncio
import re
from collections.abc import Callable, Iterable, MutableMapping
from typing import Any

from starlette.responses import PlainTextResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send

from bridge.core.errors import BridgeError
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Operator

__all__ = ["LONG", "ONLY_STOP", "OPERATOR", "STAYS", "Mount", "Mounts", "Written", "source"]

OPERATOR = "pilothouse.operator"
"""Key of who asks in the state of a request's scope, an `Operator` for as long as the answer takes."""
ONLY_STOP = "pilothouse.only_stop"
"""Key in the state of a request that was let in because it presses STOP: it must press STOP and do nothing else."""
STAYS = "pilothouse.stays"
"""An application sets this key in the state when it keeps the request's operator, and has it leave the door itself."""
LONG = "pilothouse.long"
"""An application sets this key in the state when its answer goes on for as long as it is read."""

Written = Callable[[Scope, int, BridgeError], Response]
"""Writes the answer to a request that is refused with a status, in the application's own form."""

_PATH = re.compile(r"(/(?!\.\.?(/|$))[\w.~-]+)+", re.ASCII)


def _never(_: Scope) -> bool:
    return False


def _sentence(_: Scope, status: int, refusal: BridgeError) -> Response:
    return PlainTextResponse(f"{refusal}\n", status)


def source(scope: Scope) -> tuple[str, str]:
    """Who has its turn among all who ask: a computer, by one application."""
    operator: Operator = scope["state"][OPERATOR]
    return operator.way, operator.address.rpartition(":")[0]


class Mount:
    """One application on the site."""

    def __init__(
        self,
        path: str,
        app: ASGIApp,
        way: str,
        role: Role | None,
        presses_stop: Callable[[Scope], bool],
        written: Written,
    ) -> None:
        """As of `Mounts.mount`."""
        self.path, self.way, self.role = path, way, role
        self.presses_stop, self.written = presses_stop, written
        self._app = app
        self._answering: set[asyncio.Task[Any]] = set()
        self._is_over = False

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request; when the application is un-mounted meanwhile the answer ends."""
        task, progress = asyncio.current_task(), _Progress(send)
        if task is None:
            raise RuntimeError("A request is answered in a task.")
        self._answering.add(task)
        try:
            await self._app(self._inner(scope), receive, progress.send)
        except asyncio.CancelledError:
            if not self._is_over or task.uncancel():
                raise
            await progress.end(self.written(scope, 503, BridgeError("This gateway was brought down.")), scope)
        finally:
            self._answering.discard(task)

    def _inner(self, scope: Scope) -> Scope:
        """The scope as the application sees it: its own path is `/` to it."""
        path = f"{self.path}/" if scope["path"] == self.path else scope["path"]
        return {**scope, "root_path": scope.get("root_path", "") + self.path, "path": path}

    def end(self) -> None:
        """Give up all answers, but one that this is part of."""
        self._is_over = True
        for task in self._answering - {asyncio.current_task()}:
            task.cancel()


class _Progress:
    """How far an answer came."""

    def __init__(self, send: Send) -> None:
        self._send = send
        self._last: MutableMapping[str, Any] = {}

    async def send(self, message: MutableMapping[str, Any]) -> None:
        self._last = message
        await self._send(message)

    async def end(self, instead: Response, scope: Scope) -> None:
        """Bring it to its end: by the answer `instead` where none was begun."""
        if not self._last:
            await instead(scope, _nothing, self._send)
        elif self._last["type"] == "http.response.start" or self._last.get("more_body"):
            await self._send({"type": "http.response.body", "body": b"", "more_body": False})


async def _nothing() -> MutableMapping[str, Any]:
    return {"type": "http.disconnect"}


class Mounts:
    """The applications on one web site, beside its own pages."""

    def __init__(self, url: Callable[[], str]) -> None:
        """`url()` is that of the site, known once it listens."""
        self._url = url
        self._mounted: dict[str, Mount] = {}
        self._own: frozenset[str] = frozenset()

    def reserve(self, paths: Iterable[str]) -> None:
        """These paths, and all below them, are the site's own."""
        self._own = frozenset(_first(path) for path in paths)

    def mount(
        self,
        path: str,
        app: ASGIApp,
        *,
        way: str,
        role: Role | None = None,
        presses_stop: Callable[[Scope], bool] = _never,
        written: Written = _sentence,
    ) -> Callable[[], None]:
        """Have `app` answer at `path`, as in `/api`, and below it; the call that ends it, and with it all its answers.

        Its clients are known at the door as those who come by `way`, with `role` where they show no token, None where their
        address decides. `presses_stop(scope)` says which requests press STOP: those come in from anywhere, by anyone, and do
        nothing else. `written` writes the doorkeeper's refusals. BridgeError with one sentence when the path is taken.
        """
        if not _PATH.fullmatch(path):
            raise BridgeError(f"A path of the web site is written as /api, not {path[:100]!r}.")
        if _first(path) in self._own or any(_overlap(path, each) for each in self._mounted):
            raise BridgeError(
                f"The path {path} of the web site is taken; another one is chosen as site:/PATH."
            )
        mount = self._mounted[path] = Mount(path, app, way, role, presses_stop, written)

        def end() -> None:
            if self._mounted.get(path) is mount:
                del self._mounted[path]
                mount.end()

        return end

    def close(self) -> None:
        """End all of them, with all their answers."""
        while self._mounted:
            self._mounted.popitem()[1].end()

    def at(self, path: str) -> Mount | None:
        """The application that answers at a path; None where the site itself does."""
        for mounted, mount in self._mounted.items():
            if path == mounted or path.startswith(f"{mounted}/"):
                return mount
        return None

    def url(self, path: str) -> str:
        """The URL of a path of the site."""
        return self._url() + path


def _first(path: str) -> str:
    return path.split("/")[1]


def _overlap(one: str, other: str) -> bool:
    return f"{one}/".startswith(f"{other}/") or f"{other}/".startswith(f"{one}/")
