"""The web site's pages of the cameras: pictures, streams, and how they are reached."""

from __future__ import annotations

import html
from collections.abc import Iterable
from typing import Any

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from bridge.core.errors import Refused
from bridge.core.topics import CAMERA, camera_topics
from robotside.core.installing import how_to_install, is_installed
from robotside.door.station_door import StationDoor
from robotside.gateways.http.asker import is_known, operator_of
from robotside.gateways.http.camera_streams import MEDIA_TYPES, CameraStreams
from robotside.gateways.http.mounts import STAYS
from robotside.gateways.http.whep import MAX_OFFER, BadOffer
from robotside.gateways.video.delays import Delays
from robotside.gateways.video.views import BadViewError, View, view_of

__all__ = ["SNAPSHOT_TIMEOUT", "CameraPages", "cameras_part", "cameras_text", "delay_words"]

SNAPSHOT_TIMEOUT = 2.0
"""How long to wait for a picture [s]."""

_FILM_LIBRARY, _WEBRTC_LIBRARY = "av", "aiortc"
_SDP = "application/sdp"
_FRESH = {"Cache-Control": "no-store"}
_PICTURES = {"jpg": "image/jpeg", "png": "image/png"}

_CAMERA = """<li>camera {name}: <code>{bridge}/camera/{name}</code>, a picture as <a href="/snapshot/{name}.jpg">jpg</a> or
<a href="/snapshot/{name}.png">png</a>, moving pictures as {streams}. {film} All take <code>?width=</code> [px] and <code>quality=</code>
(1 to 95; not png), the moving ones <code>rate=</code> [Hz].<br>
<img src="/stream/{name}.mjpeg?width=480&amp;rate=10" width="480" alt="what the camera sees"></li>
"""
_FILM = """<code>codec=</code> is vp8 or vp9 of webm, h264 or vp8 of WebRTC. A browser's player keeps mp4 and webm back for 2 to 4 s more:
drive by mjpeg."""


class CameraPages:
    """The answers to each path of a camera."""

    def __init__(self, door: StationDoor, streams: CameraStreams) -> None:
        self._door, self._streams = door, streams

    def routes(self) -> list[Route]:
        """For the web site."""
        return [
            Route("/snapshot/{name}.{kind}", self.snapshot),
            Route("/stream/{name}.{kind}", self.stream),
            Route("/whep/{name}", self.whep, methods=["POST"]),
            Route("/whep/{name}/{session}", self.leave, methods=["DELETE"]),
        ]

    async def snapshot(self, request: Request) -> Response:
        """One picture."""
        view = self._view(request, _PICTURES)
        media_type = _PICTURES[request.path_params["kind"]]
        if request.method == "HEAD":
            return Response(headers=_FRESH, media_type=media_type)
        picture = await self._streams.picture(view, SNAPSHOT_TIMEOUT)
        if picture is None:
            raise HTTPException(503, f"No picture came within {SNAPSHOT_TIMEOUT:g} s.")
        return Response(picture, media_type=media_type, headers=_FRESH)

    async def stream(self, request: Request) -> Any:
        """One after the other."""
        view, kind = self._view(request, MEDIA_TYPES), request.path_params["kind"]
        if request.method == "HEAD":
            return Response(headers=_FRESH | {"Content-Type": MEDIA_TYPES[kind]})
        viewer = await self._streams.viewer(view, kind, lambda: self._may_watch(request))
        operator_of(request).on_expelled = viewer.end
        return viewer

    async def whep(self, request: Request) -> Response:
        """An answer to who offers to receive by WebRTC."""
        view = self._view(request, ("whep",), "whep")
        if request.headers.get("content-type", "").partition(";")[0].strip().lower() != _SDP:
            raise HTTPException(415, f"An offer is {_SDP}.")
        operator = operator_of(request)
        try:
            name, answer, end = await self._streams.whep.open(
                view,
                await _offer(request),
                request.client.host if request.client else "",
                lambda: self._may_watch(request),
                lambda: self._door.leave(operator),
            )
        except BadOffer as problem:
            raise HTTPException(400, str(problem)) from problem
        setattr(request.state, STAYS, True)  # until the session ends
        operator.on_expelled = end
        where = {"Location": f"/whep/{request.path_params['name']}/{name}"}
        return Response(answer, 201, _FRESH | where, media_type=_SDP)

    async def leave(self, request: Request) -> Response:
        """Who looked by WebRTC leaves."""
        if not self._streams.whep.end(request.path_params["session"]):
            raise HTTPException(404, "There is no such session.")
        return Response(headers=_FRESH)

    def _may_watch(self, request: Request) -> bool:
        try:
            self._door.check(operator_of(request), "camera", request.path_params["name"])
        except Refused:
            return False
        return True

    def _view(self, request: Request, kinds: Iterable[str], kind: str = "") -> View:
        """What of which camera is asked for; HTTPException with one sentence for what does not exist or may not be seen."""
        name, kind = request.path_params["name"], kind or request.path_params["kind"]
        try:
            self._door.check(operator_of(request), "camera", name)
        except Refused as refusal:
            raise HTTPException(403 if is_known(self._door, request) else 401, str(refusal)) from refusal
        cameras = self._door.info.cameras
        if name not in ({*cameras, "camera"} if cameras else ()):
            raise HTTPException(
                404, f"This robot has no such camera; there is: {', '.join(cameras) or 'none'}."
            )
        if kind not in kinds:
            raise HTTPException(404, f"A camera has no .{kind[:20]} here; there is: {', '.join(kinds)}.")
        try:
            topic = camera_topics(cameras).get(name, CAMERA)
            return view_of(request.query_params, kind)._replace(topic=topic)
        except BadViewError as problem:
            raise HTTPException(422, str(problem)) from problem


async def _offer(request: Request) -> str:
    """The body; HTTPException for what is too long or no text."""
    body = b""
    async for part in request.stream():
        body += part
        if len(body) > MAX_OFFER:
            raise HTTPException(413, f"An offer has at most {MAX_OFFER} bytes.")
    try:
        return body.decode()
    except UnicodeDecodeError as fault:
        raise HTTPException(400, "An offer is UTF-8.") from fault


def cameras_part(door: StationDoor, bridge_url: str, delays: Delays) -> str:
    """The items of the page's list that say how each camera is reached, each stream with its measured delay."""
    found = []
    for name, topic in _working(door):
        streams = [_stream(name, kind, delay_words(delays, topic, kind)) for kind in _kinds()]
        if _has_webrtc():
            streams.append(
                f"WebRTC by <code>POST /whep/{html.escape(name)}</code> ({delay_words(delays, topic, 'whep')})"
            )
        said = " ".join([_FILM] * is_installed(_FILM_LIBRARY) + _lacking())
        shown, bridge = html.escape(name), html.escape(bridge_url)
        found.append(_CAMERA.format(name=shown, bridge=bridge, streams=", ".join(streams), film=said))
    return "".join(found)


def cameras_text(door: StationDoor, site: str, bridge_url: str, delays: Delays) -> str:
    """The same for a terminal; empty for a robot without a camera. `site` is the URL of the web site."""
    lines = []
    for name, topic in _working(door):
        lines += [f"camera {name}:", f"  {bridge_url}/camera/{name}"]
        lines += [f"  {site}/stream/{name}.{kind} ({delay_words(delays, topic, kind)})" for kind in _kinds()]
        if _has_webrtc():
            lines.append(f"  WebRTC: POST {site}/whep/{name} ({delay_words(delays, topic, 'whep')})")
        lines += [f"  {said}" for said in _lacking()]
    return "\n".join(lines)


def _working(door: StationDoor) -> list[tuple[str, str]]:
    """Name and topic of each camera that is on."""
    topics = camera_topics(door.info.cameras)
    return [
        (name, topic) for name, topic in topics.items() if name in door.info.cameras and not door.is_off(name)
    ]


def _kinds() -> list[str]:
    """The kinds of streams that can be made with what is installed."""
    film = is_installed(_FILM_LIBRARY)
    return [kind for kind in MEDIA_TYPES if film or kind == "mjpeg"]


def _has_webrtc() -> bool:
    return is_installed(_FILM_LIBRARY, _WEBRTC_LIBRARY)


def _lacking() -> list[str]:
    """What is not offered and what brings it, as a sentence; none where nothing lacks."""
    if _has_webrtc():
        return []
    what = "WebRTC" if is_installed(_FILM_LIBRARY) else "mp4, webm and WebRTC"
    return [f"{how_to_install('video')} brings {what}, for which a library is not installed."]


def _stream(name: str, kind: str, delay: str) -> str:
    return f'<a href="/stream/{html.escape(name)}.{kind}">{kind}</a> ({delay})'


def delay_words(delays: Delays, topic: str, kind: str) -> str:
    """How late such a stream of that camera is, as was measured last, from the moment of the picture to the network."""
    delay = delays.of(topic, kind)
    if delay is None:
        return "delay: measured once somebody looks"
    return f"delay: half of the pictures up to {delay.median * 1e3:.0f} ms, 99 of 100 up to {delay.most * 1e3:.0f} ms"
