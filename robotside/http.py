"""What a browser or curl gets on the HTTP port: a page about the robot, its health, and a picture."""

from __future__ import annotations

import asyncio
import html
from collections.abc import Callable

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import HTMLResponse, JSONResponse, PlainTextResponse, Response
from starlette.routing import Route

from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.topics import TOPICS
from robotside.autonomy import CAMERA
from robotside.station import Station

__all__ = ["site"]

PICTURE_PATIENCE = 2.0
"""How long to wait for a picture [s]."""

_PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>{name}</title>
<style>body{{font-family:sans-serif;max-width:60em;margin:2em auto;padding:0 1em}}
td,th{{text-align:left;padding:.2em 1em .2em 0}}code{{background:#eee;padding:.1em .3em}}</style>
<h1>{name}</h1><p>{description}{world}. {state}</p>
<h2>How to reach it</h2><ul>
<li>rosbridge v2 (roslibjs, roslibpy, Pilothouse): <code>{bridge}</code></li>
{cameras}<li>health: <a href="/healthz">/healthz</a></li></ul>
<h2>Topics</h2><table><tr><th>topic</th><th>type</th><th>rate</th><th>what</th></tr>{topics}</table>
<h2>Services</h2><table><tr><th>service</th><th>type</th></tr>{services}</table></html>"""


def site(station: Station, bridge_url: Callable[[], str], services: dict[str, str]) -> Starlette:
    """The web site of one robot; `services` are types by name."""

    async def page(_: Request) -> Response:
        return HTMLResponse(_page(station, bridge_url(), services))

    async def health(_: Request) -> Response:
        return JSONResponse(_health(station))

    async def snapshot(request: Request) -> Response:
        names = {*station.info.cameras, "camera"} if station.info.cameras else set()
        if request.path_params["name"] not in names:
            return PlainTextResponse(_no_camera(station), 404)
        jpeg = await _picture(station, f"snapshot {id(request)}")
        if jpeg is None:
            return PlainTextResponse(f"No picture came within {PICTURE_PATIENCE} s.\n", 503)
        return Response(jpeg, media_type="image/jpeg", headers={"Cache-Control": "no-store"})

    return Starlette(
        routes=[
            Route("/", page),
            Route("/healthz", health),
            Route("/snapshot/{name}.jpg", snapshot),
        ]
    )


async def _picture(station: Station, asker: str) -> bytes | None:
    """The next picture; None when none comes in time."""
    coming: asyncio.Future[bytes] = asyncio.get_running_loop().create_future()
    old = station.bus.last(CAMERA)

    def take(_: str, msg: Msg) -> None:
        if isinstance(msg, CompressedImage) and msg is not old and not coming.done():
            coming.set_result(msg.data)

    leave = station.bus.subscribe(CAMERA, take)
    station.demand.set(CAMERA, asker, True)
    try:
        async with asyncio.timeout(PICTURE_PATIENCE):
            return await coming
    except TimeoutError:
        return None
    finally:
        station.demand.set(CAMERA, asker, False)
        leave()


def _health(station: Station) -> dict[str, object]:
    status = station.autonomy.engine.status
    return {
        "ok": True,
        "robot": station.info.name,
        "boot": station.events.boot,
        "task": status.task,
        "state": status.state,
        "position_sure": station.autonomy.whereabouts.sure,
    }


def _no_camera(station: Station) -> str:
    names = ", ".join(station.info.cameras) or "none"
    return f"This robot has no such camera; there is: {names}.\n"


def _page(station: Station, bridge: str, services: dict[str, str]) -> str:
    info, status = station.info, station.autonomy.engine.status
    cameras = "".join(
        f'<li>camera {name}: <code>{bridge}/camera/{name}</code>, <a href="/snapshot/{name}.jpg">a picture</a></li>\n'
        for name in map(html.escape, info.cameras)
    )
    topics = "".join(
        f"<tr><td>{t.name}</td><td>{t.type.MSGTYPE}</td>"
        f"<td>{f'{t.rate:g} Hz' if t.rate else 'on change'}</td><td>{html.escape(t.doc)}</td></tr>"
        for t in TOPICS
    )
    rows = "".join(f"<tr><td>{name}</td><td>{kind}</td></tr>" for name, kind in sorted(services.items()))
    return _PAGE.format(
        name=html.escape(info.name),
        description=html.escape(info.description),
        world=html.escape(f" in {info.world}" if info.world else ""),
        state=html.escape(status.reason or "It has no task."),
        bridge=html.escape(bridge),
        cameras=cameras,
        topics=topics,
        services=rows,
    )
