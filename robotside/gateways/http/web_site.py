"""The web site for browsers and curl: a page about the robot, STOP, its health, and its camera."""

from __future__ import annotations

import asyncio
import html
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import HTMLResponse, JSONResponse, PlainTextResponse, Response
from starlette.routing import Route

from bridge.core.errors import BridgeError, Refused
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Operator
from bridge.core.topics import CAMERA, TOPICS, camera_topics
from bridge.msgs.pilothouse_msgs import TaskStatus
from robotside.control.authority import MAX_NAME_LENGTH
from robotside.core.text import plain
from robotside.door.station_door import StationDoor
from robotside.gateways.http.camera_streams import (
    MEDIA_TYPE,
    BadViewError,
    CameraStreams,
    FullError,
    View,
    view_of,
)
from robotside.gateways.http.doorkeeper import OPERATOR
from robotside.gateways.http.pairing_part import pairing_part
from robotside.gateways.http.sessions import Sessions
from robotside.trust.pairing import Pairing

__all__ = ["site"]

SNAPSHOT_TIMEOUT = 2.0
"""How long to wait for a picture [s]."""

_FRESH = {"Cache-Control": "no-store"}
_AS_FILE = _FRESH | {"Content-Disposition": 'attachment; filename="audit.csv"'}
_PRIVATE = {
    "Cache-Control": "no-store",
    "X-Frame-Options": "DENY",
    "Content-Security-Policy": "frame-ancestors 'none'",
    "Referrer-Policy": "no-referrer",
}
"""Pages are neither kept nor shown inside pages of others."""

_PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>{name}</title>
<style>body{{font-family:sans-serif;max-width:60em;margin:2em auto;padding:0 1em}}
td,th{{text-align:left;padding:.2em 1em .2em 0}}code{{background:#eee;padding:.1em .3em}}</style>
<h1>{name}</h1><form method="post" action="/stop"><button style="font-size:1.5em;color:#fff;background:#c00;
padding:.4em 2em;border:0">STOP</button></form><p>{description}{world}. {state}</p>{pairing}
<h2>How to reach it</h2><ul>
<li>rosbridge v2 (roslibjs, roslibpy, Pilothouse): <code>{bridge}</code></li>
{cameras}<li>STOP, from anywhere and by anyone: <code>curl -X POST</code> to <code>/stop</code></li>
<li>health: <a href="/healthz">/healthz</a></li></ul>
<h2>Topics</h2><table><tr><th>topic</th><th>type</th><th>rate</th><th>what</th></tr>{topics}</table>
<h2>Services</h2><table><tr><th>service</th><th>type</th></tr>{services}</table></html>"""

_STRANGERS_PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>{name}</title>
<style>body{{font-family:sans-serif;max-width:40em;margin:2em auto;padding:0 1em}}</style>
<h1>{name}</h1><form method="post" action="/stop"><button style="font-size:1.5em;color:#fff;background:#c00;
padding:.4em 2em;border:0">STOP</button></form><p>{said}</p>
<form method="post" action="/login"><label>Token <input name="token" type="password" autocomplete="off" size="50"></label>
<button>Log in</button></form></html>"""

_CAMERA = """<li>camera {name}: <code>{bridge}/camera/{name}</code>, <a href="/snapshot/{name}.jpg">a picture</a>,
<a href="/stream/{name}.mjpeg">moving pictures</a>; both take <code>?width=</code> [px] and <code>quality=</code>
(1 to 95), the moving ones <code>rate=</code> [Hz] as well<br>
<img src="/stream/{name}.mjpeg?width=480&amp;rate=10" width="480" alt="what the camera sees"></li>
"""


def site(
    door: StationDoor,
    bridge_url: Callable[[], str],
    streams: CameraStreams,
    sessions: Sessions,
    pairing: Pairing | None = None,
) -> Starlette:
    """The web site of one robot, behind its `Doorkeeper`; who manages the robot sees how to pair by `pairing`."""
    pages = _Pages(door, bridge_url, streams, sessions, pairing)
    return Starlette(
        routes=[
            Route("/", pages.page),
            Route("/stop", pages.stop, methods=["GET", "POST"]),
            Route("/login", pages.login, methods=["POST"]),
            Route("/logout", pages.logout, methods=["POST"]),
            Route("/healthz", pages.health),
            Route("/audit.csv", pages.audit),
            Route("/snapshot/{name}.jpg", pages.snapshot),
            Route("/stream/{name}.mjpeg", pages.stream),
        ],
        exception_handlers={HTTPException: _sentence, FullError: _full, BridgeError: _broken},
    )


class _Pages:
    """The answers to each path."""

    def __init__(
        self,
        door: StationDoor,
        bridge_url: Callable[[], str],
        streams: CameraStreams,
        sessions: Sessions,
        pairing: Pairing | None,
    ) -> None:
        self._door, self._bridge_url, self._pairing = door, bridge_url, pairing
        self._streams, self._sessions = streams, sessions
        self._reading = asyncio.Lock()  # one reader of the whole audit log at a time

    async def page(self, request: Request) -> Response:
        if _is_known(self._door, request):
            manages = _operator(request).role(self._door.now()) >= Role.MANAGE
            part = pairing_part(self._pairing) if manages else ""
            return HTMLResponse(_page(self._door, self._bridge_url(), part), headers=_PRIVATE)
        return _strangers_page(self._door, "Show the token that you were given to see more.")

    async def health(self, request: Request) -> Response:
        known = _is_known(self._door, request)
        return JSONResponse({"ok": True, **(self._door.health._asdict() if known else {})}, headers=_FRESH)

    async def audit(self, request: Request) -> Response:
        self._door.trail.did(_operator(request), "page /audit.csv")
        async with self._reading:
            reader = ThreadPoolExecutor(1, "audit")
            try:
                text = await asyncio.get_running_loop().run_in_executor(reader, self._audit)
            finally:
                reader.shutdown(wait=False)
        return Response(text, media_type="text/csv", headers=_AS_FILE)

    def _audit(self) -> str:
        return "".join(self._door.audit_lines())

    async def snapshot(self, request: Request) -> Response:
        view = _view(request, self._door)
        if request.method == "HEAD":
            return Response(headers=_FRESH, media_type="image/jpeg")
        jpeg = await self._streams.picture(view, SNAPSHOT_TIMEOUT)
        if jpeg is None:
            raise HTTPException(503, f"No picture came within {SNAPSHOT_TIMEOUT:g} s.")
        return Response(jpeg, media_type="image/jpeg", headers=_FRESH)

    async def stream(self, request: Request) -> Any:
        view = _view(request, self._door)
        if request.method == "HEAD":
            return Response(headers=_FRESH | {"Content-Type": MEDIA_TYPE})
        viewer = self._streams.viewer(view, lambda: _may_watch(self._door, request))
        _operator(request).on_expelled = viewer.end
        return viewer

    async def stop(self, request: Request) -> Response:
        if request.method != "POST":
            raise HTTPException(
                405, "STOP is pressed by POST, from anywhere and by anyone.", {"Allow": "POST"}
            )
        return PlainTextResponse(*await _stop(self._door, request))

    async def login(self, request: Request) -> Response:
        try:
            return await self._sessions.login(request)
        except Refused as refusal:
            return _strangers_page(self._door, str(refusal), 401)

    async def logout(self, request: Request) -> Response:
        return self._sessions.logout(request)


def _operator(request: Request) -> Operator:
    """Who asks, as the doorkeeper found out."""
    operator = getattr(request.state, OPERATOR)
    if not isinstance(operator, Operator):
        raise TypeError(f"The doorkeeper let {operator!r} in.")
    return operator


def _is_known(door: StationDoor, request: Request) -> bool:
    return _operator(request).role(door.now()) > Role.NONE


def _may_watch(door: StationDoor, request: Request) -> bool:
    try:
        door.check(_operator(request), "camera", request.path_params["name"])
    except Refused:
        return False
    return True


async def _stop(door: StationDoor, request: Request) -> tuple[str, int]:
    """Press STOP for any client; one sentence and the status."""
    name = plain(request.query_params.get("name", ""), MAX_NAME_LENGTH)
    answer = await door.stop(_operator(request), name)
    return f"{answer.message}\n", 200 if answer.success else 503


def _strangers_page(door: StationDoor, said: str, status: int = 200) -> Response:
    """What a stranger sees: the robot's name, STOP, and where to show a token."""
    shown = _STRANGERS_PAGE.format(name=html.escape(door.info.name), said=html.escape(said))
    return HTMLResponse(shown, status, _PRIVATE)


def _view(request: Request, door: StationDoor) -> View:
    """What of which camera is asked for; HTTPException with one sentence for what does not exist or may not be seen."""
    try:
        door.check(_operator(request), "camera", request.path_params["name"])
    except Refused as refusal:
        raise HTTPException(401 if not _is_known(door, request) else 403, str(refusal)) from refusal
    cameras = door.info.cameras
    if request.path_params["name"] not in ({*cameras, "camera"} if cameras else ()):
        names = ", ".join(cameras) or "none"
        raise HTTPException(404, f"This robot has no such camera; there is: {names}.")
    try:
        topic = camera_topics(cameras).get(request.path_params["name"], CAMERA)
        return view_of(request.query_params)._replace(topic=topic)
    except BadViewError as problem:
        raise HTTPException(422, str(problem)) from problem


async def _sentence(_: Request, problem: Exception) -> Response:
    if not isinstance(problem, HTTPException):
        return PlainTextResponse("\n", 500)
    return PlainTextResponse(f"{problem.detail}\n", problem.status_code, problem.headers)


async def _full(_: Request, problem: Exception) -> Response:
    return PlainTextResponse(f"{problem}\n", 503, {"Retry-After": "5"})


async def _broken(_: Request, problem: Exception) -> Response:
    return PlainTextResponse(f"{problem}\n", 502)


def _page(door: StationDoor, bridge: str, pairing: str) -> str:
    info, status = door.info, door.last("/task/status")
    cameras = "".join(
        _CAMERA.format(name=html.escape(name), bridge=html.escape(bridge)) for name in info.cameras
    )
    topics = "".join(
        f"<tr><td>{t.name}</td><td>{t.type.MSGTYPE}</td>"
        f"<td>{f'{t.rate:g} Hz' if t.rate else 'on change'}</td><td>{html.escape(t.doc)}</td></tr>"
        for t in TOPICS
    )
    rows = "".join(
        f"<tr><td>{name}</td><td>{service.type}</td></tr>" for name, service in sorted(door.services.items())
    )
    return _PAGE.format(
        name=html.escape(info.name),
        description=html.escape(info.description),
        world=html.escape(f" in {info.world}" if info.world else ""),
        state=html.escape((status.reason if isinstance(status, TaskStatus) else "") or "It has no task."),
        bridge=html.escape(bridge),
        pairing=pairing,
        cameras=cameras,
        topics=topics,
        services=rows,
    )
