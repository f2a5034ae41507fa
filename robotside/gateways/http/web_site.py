"""The web site for browsers and curl: a page about the robot, STOP, its health, and its camera."""

from __future__ import annotations

import asyncio
import html
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import HTMLResponse, JSONResponse, PlainTextResponse, Response
from starlette.routing import Route

from bridge.core.errors import BridgeError, Refused
from bridge.core.identity import Role
from bridge.core.topics import TOPICS
from bridge.msgs.pilothouse_msgs import TaskStatus
from robotside.control.authority import MAX_NAME_LENGTH
from robotside.core.text import plain
from robotside.door.station_door import StationDoor
from robotside.gateways.http.asker import is_known, operator_of
from robotside.gateways.http.camera_pages import CameraPages, cameras_part
from robotside.gateways.http.camera_streams import CameraStreams
from robotside.gateways.http.pairing_part import pairing_part
from robotside.gateways.http.sessions import Sessions
from robotside.gateways.video.shared_encodings import FullError
from robotside.gateways.video.video_encoder import NoVideo
from robotside.trust.pairing import Pairing

__all__ = ["site"]

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
        if is_known(self._door, request):
            manages = operator_of(request).role(self._door.now()) >= Role.MANAGE
            part = pairing_part(self._pairing) if manages else ""
            bridge = self._bridge_url()
            cameras = cameras_part(self._door, bridge, self._streams.delays)
            return HTMLResponse(_page(self._door, bridge, cameras, part), headers=_PRIVATE)
        return _strangers_page(self._door, "Show the token that you were given to see more.")

    async def health(self, request: Request) -> Response:
        known = is_known(self._door, request)
        return JSONResponse({"ok": True, **(self._door.health._asdict() if known else {})}, headers=_FRESH)

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
        return PlainTextResponse(*await _stop(self._door, request))

    async def login(self, request: Request) -> Response:
        try:
            return await self._sessions.login(request)
        except Refused as refusal:
            return _strangers_page(self._door, str(refusal), 401)

    async def logout(self, request: Request) -> Response:
        return self._sessions.logout(request)


async def _stop(door: StationDoor, request: Request) -> tuple[str, int]:
    """Press STOP for any client; one sentence and the status."""
    name = plain(request.query_params.get("name", ""), MAX_NAME_LENGTH)
    answer = await door.stop(operator_of(request), name)
    return f"{answer.message}\n", 200 if answer.success else 503


def _strangers_page(door: StationDoor, said: str, status: int = 200) -> Response:
    """What a stranger sees: the robot's name, STOP, and where to show a token."""
    shown = _STRANGERS_PAGE.format(name=html.escape(door.info.name), said=html.escape(said))
    return HTMLResponse(shown, status, _PRIVATE)


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


def _page(door: StationDoor, bridge: str, cameras: str, pairing: str) -> str:
    info, status = door.info, door.last("/task/status")
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
