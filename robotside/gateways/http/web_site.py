"""The web site for browsers and curl: a page about the robot, STOP, its health, and its camera."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import JSONResponse, PlainTextResponse, RedirectResponse, Response
from starlette.routing import Route

from bridge.core.errors import BridgeError, Refused
from bridge.server.reception.places import Place
from robotside.control.authority import MAX_NAME_LENGTH
from robotside.core.text import plain
from robotside.door.station_door import StationDoor
from robotside.gateways.http.asker import is_known, operator_of
from robotside.gateways.http.browser_connection import PLACE
from robotside.gateways.http.camera_pages import CameraPages
from robotside.gateways.http.camera_streams import CameraStreams
from robotside.gateways.http.sessions import Sessions
from robotside.gateways.http.usage_pages import NOTHING_BESIDE, Usage, UsagePages, strangers
from robotside.gateways.video.shared_encodings import FullError
from robotside.gateways.video.video_encoder import NoVideo
from robotside.trust.pairing import Pairing

__all__ = ["site"]

_FRESH = {"Cache-Control": "no-store"}
_AS_FILE = _FRESH | {"Content-Disposition": 'attachment; filename="audit.csv"'}


def site(
    door: StationDoor,
    bridge_url: Callable[[], str],
    streams: CameraStreams,
    sessions: Sessions,
    pairing: Pairing | None = None,
    usage: Usage = NOTHING_BESIDE,
) -> Starlette:
    """The web site of one robot, behind its `Doorkeeper`; who manages the robot sees how to pair by `pairing`.

    `usage` is what its usage sheet says beside what the door knows.
    """
    pages, sheet = _Pages(door, sessions), UsagePages(door, bridge_url, streams, pairing, usage)
    return Starlette(
        routes=[
            Route("/", sheet.page),
            Route("/usage.txt", sheet.text),
            Route("/stop", pages.stop, methods=["GET", "POST"]),
            Route("/login", pages.login, methods=["POST"]),
            Route("/logout", pages.logout, methods=["POST"]),
            Route("/healthz", pages.health),
            Route("/audit.csv", pages.audit),
            *CameraPages(door, streams).routes(),
        ],
        exception_handlers={
            HTTPException: _sentence,
            FullError: _full,
            NoVideo: _no_video,
            BridgeError: _broken,
        },
    )


class _Pages:
    """The answers to each path."""

    def __init__(self, door: StationDoor, sessions: Sessions) -> None:
        self._door, self._sessions = door, sessions
        self._reading = asyncio.Lock()  # one reader of the whole audit log at a time

    async def health(self, request: Request) -> Response:
        known = is_known(self._door, request)
        health = self._door.health
        told = {"ok": health.reached, **(health._asdict() if known else {})}
        return JSONResponse(told, headers=_FRESH)

    async def audit(self, request: Request) -> Response:
        self._door.trail.did(operator_of(request), "page /audit.csv")
        async with self._reading:
            reader = ThreadPoolExecutor(1, "audit")
            try:
                text = await asyncio.get_running_loop().run_in_executor(reader, self._audit)
            finally:
                reader.shutdown(wait=False)
        return Response(text, media_type="text/csv", headers=_AS_FILE)

    def _audit(self) -> str:
        return "".join(self._door.audit_lines())

    async def stop(self, request: Request) -> Response:
        if request.method != "POST":
            raise HTTPException(
                405, "STOP is pressed by POST, from anywhere and by anyone.", {"Allow": "POST"}
            )
        said, status = await _stop(self._door, request)
        if status == 200 and _shows_pages(request):
            return RedirectResponse("/", 303, _FRESH)  # to the page, which says that the robot is stopped
        return PlainTextResponse(said, status)

    async def login(self, request: Request) -> Response:
        try:
            return await self._sessions.login(request)
        except Refused as refusal:
            return strangers(self._door, str(refusal), 401)

    async def logout(self, request: Request) -> Response:
        return self._sessions.logout(request)


async def _stop(door: StationDoor, request: Request) -> tuple[str, int]:
    """Press STOP for any client; one sentence and the status."""
    name = plain(request.query_params.get("name", ""), MAX_NAME_LENGTH)
    answer = await door.stop(operator_of(request), name)
    return f"{answer.message}\n", 200 if answer.success else 503


def _shows_pages(request: Request) -> bool:
    """A browser asks, in which somebody looks; not where the site is full, which would have no page for it."""
    place: Place | None = request.scope.get("state", {}).get(PLACE)
    return "text/html" in request.headers.get("accept", "") and not (place is not None and place.only_stop)


async def _sentence(_: Request, problem: Exception) -> Response:
    if not isinstance(problem, HTTPException):
        return PlainTextResponse("\n", 500)
    return PlainTextResponse(f"{problem.detail}\n", problem.status_code, problem.headers)


async def _full(_: Request, problem: Exception) -> Response:
    return PlainTextResponse(f"{problem}\n", 503, {"Retry-After": "5"})


async def _no_video(_: Request, problem: Exception) -> Response:
    return PlainTextResponse(f"{problem}\n", 501)


async def _broken(_: Request, problem: Exception) -> Response:
    return PlainTextResponse(f"{problem}\n", 502)
