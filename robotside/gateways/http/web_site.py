"""The web site for browsers and curl: a page about the robot, STOP, its health, and its camera."""

from __future__ import annotations

import html
from collections.abc import Callable
from typing import Any

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import HTMLResponse, JSONResponse, PlainTextResponse, Response
from starlette.routing import Route

from bridge.core.errors import BridgeError
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

__all__ = ["site"]

SNAPSHOT_TIMEOUT = 2.0
"""How long to wait for a picture [s]."""

_FRESH = {"Cache-Control": "no-store"}

_PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>{name}</title>
<style>body{{font-family:sans-serif;max-width:60em;margin:2em auto;padding:0 1em}}
td,th{{text-align:left;padding:.2em 1em .2em 0}}code{{background:#eee;padding:.1em .3em}}</style>
<h1>{name}</h1><form method="post" action="/stop"><button style="font-size:1.5em;color:#fff;background:#c00;
padding:.4em 2em;border:0">STOP</button></form><p>{description}{world}. {state}</p>
<h2>How to reach it</h2><ul>
<li>rosbridge v2 (roslibjs, roslibpy, Pilothouse): <code>{bridge}</code></li>
{cameras}<li>STOP, from anywhere and by anyone: <code>curl -X POST</code> to <code>/stop</code></li>
<li>health: <a href="/healthz">/healthz</a></li></ul>
<h2>Topics</h2><table><tr><th>topic</th><th>type</th><th>rate</th><th>what</th></tr>{topics}</table>
<h2>Services</h2><table><tr><th>service</th><th>type</th></tr>{services}</table></html>"""

_CAMERA = """<li>camera {name}: <code>{bridge}/camera/{name}</code>, <a href="/snapshot/{name}.jpg">a picture</a>,
<a href="/stream/{name}.mjpeg">moving pictures</a>; both take <code>?width=</code> [px] and <code>quality=</code>
(1 to 95), the moving ones <code>rate=</code> [Hz] as well<br>
<img src="/stream/{name}.mjpeg?width=480&amp;rate=10" width="480" alt="what the camera sees"></li>
"""


def site(door: StationDoor, bridge_url: Callable[[], str], streams: CameraStreams) -> Starlette:
    """The web site of one robot."""

    async def page(_: Request) -> Response:
        return HTMLResponse(_page(door, bridge_url()))

    async def health(_: Request) -> Response:
        return JSONResponse({"ok": True, **door.health._asdict()})

    async def snapshot(request: Request) -> Response:
        view = _view(request, door)
        if request.method == "HEAD":
            return Response(headers=_FRESH, media_type="image/jpeg")
        jpeg = await streams.picture(view, SNAPSHOT_TIMEOUT)
        if jpeg is None:
            raise HTTPException(503, f"No picture came within {SNAPSHOT_TIMEOUT:g} s.")
        return Response(jpeg, media_type="image/jpeg", headers=_FRESH)

    async def stream(request: Request) -> Any:
        view = _view(request, door)
        if request.method == "HEAD":
            return Response(headers=_FRESH | {"Content-Type": MEDIA_TYPE})
        return streams.viewer(view)

    async def stop(request: Request) -> Response:
        if request.method != "POST":
            raise HTTPException(
                405, "STOP is pressed by POST, from anywhere and by anyone.", {"Allow": "POST"}
            )
        return PlainTextResponse(*await _stop(door, request))

    return Starlette(
        routes=[
            Route("/", page),
            Route("/stop", stop, methods=["GET", "POST"]),
            Route("/healthz", health),
            Route("/snapshot/{name}.jpg", snapshot),
            Route("/stream/{name}.mjpeg", stream),
        ],
        exception_handlers={HTTPException: _sentence, FullError: _full, BridgeError: _broken},
    )


async def _stop(door: StationDoor, request: Request) -> tuple[str, int]:
    """Press STOP for any client; one sentence and the status."""
    name = plain(request.query_params.get("name", ""), MAX_NAME_LENGTH)
    who = name or f"a browser at {request.client.host if request.client else 'an unknown address'}"
    answer = await door.stop(who)
    return f"{answer.message}\n", 200 if answer.success else 503


def _view(request: Request, door: StationDoor) -> View:
    """What of which camera is asked for; HTTPException with one sentence for what does not exist."""
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


def _page(door: StationDoor, bridge: str) -> str:
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
        cameras=cameras,
        topics=topics,
        services=rows,
    )
