"""A camera for browsers: one picture, or one after the other in a response that does not end (MJPEG).

Every viewer gets the newest picture when it is ready for one, at its own width, quality and rate; what came
meanwhile is left out. The camera works only while somebody looks.
"""

from __future__ import annotations

import asyncio
import math
from collections.abc import Awaitable, Callable, Iterator, Mapping, MutableMapping
from contextlib import contextmanager
from typing import Any, NamedTuple

from bridge.core.async_tasks import cancel_all
from bridge.core.errors import BridgeError
from bridge.core.robot_door import RobotDoor
from bridge.core.topics import CAMERA
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage
from robotside.gateways.scaling.picture_scaling import PictureScaler, Superseded

__all__ = [
    "MEDIA_TYPE",
    "MAX_VIEWERS",
    "PICTURE_TIMEOUT",
    "BadViewError",
    "FullError",
    "CameraStreams",
    "View",
    "view_of",
]

MAX_VIEWERS = 8
"""Who may look at streams at a time."""

PICTURE_TIMEOUT = 10.0
"""A stream ends when no picture comes for this long [s]."""

BOUNDARY = "picture"
MEDIA_TYPE = f"multipart/x-mixed-replace; boundary={BOUNDARY}"
"""Of a stream."""

Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]


class BadViewError(ValueError):
    """What was asked for does not exist; the text is one sentence."""


class FullError(Exception):
    """There are as many viewers as there may be; the text is one sentence."""


class View(NamedTuple):
    """How somebody wants to see a camera."""

    width: int | None = None
    """At most so many columns [px]; None as many as there are."""
    quality: int | None = None
    """Of the JPEG, 1 to 95; None as it comes from the camera."""
    rate: float = math.inf
    """At most so many pictures a second [Hz]."""
    topic: str = CAMERA
    """Of the camera's pictures."""


_LIMITS = {"width": (16, 4096), "quality": (1, 95), "rate": (0.1, 60)}


def view_of(query: Mapping[str, str]) -> View:
    """The view that a URL's `width`, `quality` and `rate` ask for; other words are left alone. Raises BadViewError."""
    asked = {name: _number(name, query[name]) for name in _LIMITS if name in query}
    width, quality, rate = asked.get("width"), asked.get("quality"), asked.get("rate", math.inf)
    return View(None if width is None else int(width), None if quality is None else int(quality), rate)


def _number(name: str, text: str) -> float:
    least, most = _LIMITS[name]
    try:
        value = float(text) if name == "rate" else int(text)
    except ValueError:
        value = math.nan
    if not least <= value <= most:
        kind = "a number" if name == "rate" else "a whole number"
        raise BadViewError(f"The {name} must be {kind} from {least} to {most}, not {text[:20]!r}.")
    return value


def _always() -> bool:
    return True


class CameraStreams:
    """The pictures of one robot's camera for all who look by HTTP."""

    def __init__(self, door: RobotDoor, pictures: PictureScaler) -> None:
        self._door, self._pictures = door, pictures
        self.viewers: set[_Viewer] = set()
        """Who looks at a stream now."""

    async def picture(self, view: View, patience: float) -> bytes | None:
        """The next picture that is taken; None when none comes within `patience` [s]. BridgeError for a broken one."""
        with self.looking(view.topic) as newest:
            try:
                async with asyncio.timeout(patience):
                    return await self.made(await newest.next(), view, patient=True)
            except TimeoutError:
                return None

    def viewer(self, view: View, may_watch: Callable[[], bool] = _always) -> _Viewer:
        """An ASGI application that sends pictures for as long as they are taken and `may_watch()`. Raises FullError."""
        if len(self.viewers) >= MAX_VIEWERS:
            raise FullError(f"{MAX_VIEWERS} look at the camera already; close one of them.")
        return _Viewer(self, view, may_watch)

    @contextmanager
    def looking(self, topic: str = CAMERA) -> Iterator[_Newest]:
        """Somebody looks: the camera of that topic works, and its newest picture is at hand."""
        newest = _Newest()
        self._door.subscribe(newest, topic, newest.on_picture)
        try:
            yield newest
        finally:
            self._door.leave(newest)

    async def made(self, jpeg: bytes, view: View, *, patient: bool = False) -> bytes:
        """`jpeg` as `view` wants it; fails as `PictureScaler.make` does, which `patient` is for."""
        if view.width is None and view.quality is None:
            return jpeg
        return await self._pictures.make(jpeg, view.width, view.quality, patient=patient)


class _Newest:
    """The newest picture of a camera, for one who looks."""

    def __init__(self) -> None:
        self._jpeg: bytes | None = None
        self._came = asyncio.Event()

    def on_picture(self, _: str, msg: Msg) -> None:
        """A picture was taken."""
        if isinstance(msg, CompressedImage):
            self._jpeg = msg.data
            self._came.set()

    async def next(self) -> bytes:
        """The newest picture that was not given yet."""
        while self._jpeg is None:
            self._came.clear()
            await self._came.wait()
        jpeg, self._jpeg = self._jpeg, None
        return jpeg


class _Viewer:
    """One response that does not end."""

    def __init__(self, streams: CameraStreams, view: View, may_watch: Callable[[], bool]) -> None:
        self._streams, self._view, self._may_watch = streams, view, may_watch
        self._ended = asyncio.Event()

    def end(self) -> None:
        """Its viewer may not look any more."""
        self._ended.set()

    async def __call__(self, _: object, receive: Receive, send: Send) -> None:
        """Send pictures until the viewer is gone or none come any more."""
        self._streams.viewers.add(self)
        work = (self._show(send), _gone(receive), self._ended.wait())
        tasks = [asyncio.create_task(each) for each in work]
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            self._streams.viewers.discard(self)
            await cancel_all(tasks)
        await send({"type": "http.response.body", "body": b"", "more_body": False})

    async def _show(self, send: Send) -> None:
        headers = [
            (b"content-type", MEDIA_TYPE.encode()),
            (b"cache-control", b"no-store"),
            (b"connection", b"close"),
        ]
        await send({"type": "http.response.start", "status": 200, "headers": headers})
        # a browser shows a picture when it sees the boundary behind it
        await send({"type": "http.response.body", "body": f"--{BOUNDARY}\r\n".encode(), "more_body": True})
        clock, period = asyncio.get_running_loop().time, 1.0 / self._view.rate
        due = clock()
        with self._streams.looking(self._view.topic) as newest:
            while True:
                await asyncio.sleep(due - clock())
                due = max(due, clock() - period) + period
                try:
                    async with asyncio.timeout(PICTURE_TIMEOUT):
                        jpeg = await newest.next()
                except TimeoutError:
                    return
                if not self._may_watch():
                    return
                await self._send(jpeg, send)

    async def _send(self, jpeg: bytes, send: Send) -> None:
        try:
            made = await self._streams.made(jpeg, self._view)
        except Superseded:
            return
        except BridgeError:
            made = jpeg
        head = f"Content-Type: image/jpeg\r\nContent-Length: {len(made)}\r\n\r\n".encode()
        body = b"".join((head, made, f"\r\n--{BOUNDARY}\r\n".encode()))
        await send({"type": "http.response.body", "body": body, "more_body": True})


async def _gone(receive: Receive) -> None:
    """Until the viewer has left."""
    while (await receive())["type"] != "http.disconnect":
        pass
