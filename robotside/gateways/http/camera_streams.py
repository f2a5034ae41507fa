"""A camera for browsers: one picture, or one after the other in a response that does not end.

MJPEG shows every viewer the newest picture when it is ready for one, at its own width, quality and rate; what came meanwhile
is left out. MP4 and WebM are film, encoded once for all who want the same. The camera works only while somebody looks.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Iterator, MutableMapping
from contextlib import contextmanager
from typing import Any

from bridge.core.async_tasks import cancel_all
from bridge.core.errors import BridgeError
from bridge.core.robot_door import RobotDoor
from bridge.core.topics import CAMERA
from robotside.gateways.http.whep import WhepSessions
from robotside.gateways.scaling.picture_scaling import PictureScaler, Superseded
from robotside.gateways.video.delays import Delays
from robotside.gateways.video.film_file import FilmFile, Mp4File, WebmFile
from robotside.gateways.video.newest_picture import NewestPicture, Pace, Picture
from robotside.gateways.video.shared_encodings import FullError, SharedEncodings
from robotside.gateways.video.views import View

__all__ = ["MAX_VIEWERS", "MEDIA_TYPES", "CameraStreams", "StreamViewer"]

MAX_VIEWERS = 16
"""Who may look at streams at a time."""

BOUNDARY = "picture"
MEDIA_TYPES = {
    "mjpeg": f"multipart/x-mixed-replace; boundary={BOUNDARY}",
    "mp4": "video/mp4",
    "webm": "video/webm",
}
"""Of each kind of stream."""

_FILES: dict[str, Callable[[], FilmFile]] = {"mp4": Mp4File, "webm": WebmFile}

Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]


def _always() -> bool:
    return True


class CameraStreams:
    """The pictures of one robot's cameras for all who look by HTTP; belongs to who closes it."""

    def __init__(self, door: RobotDoor, pictures: PictureScaler, now: Callable[[], float]) -> None:
        """`now` is the clock of the pictures' stamps [s]."""
        self._door, self._pictures, self._now = door, pictures, now
        self.viewers: set[StreamViewer] = set()
        """Who looks at a stream now."""
        self.films = SharedEncodings(self.looking)
        """What MP4 and WebM show."""
        self.delays = Delays()
        """How old pictures are when they are written, by camera and kind of stream."""
        self.whep = WhepSessions(self.films, self.delays)
        """Who looks by WebRTC."""

    async def close(self) -> None:
        """End the films and who looks by WebRTC."""
        await self.whep.close()
        await self.films.close()

    async def picture(self, view: View, patience: float) -> bytes | None:
        """The next picture that is taken; None when none comes within `patience` [s]. BridgeError for a broken one."""
        with self.looking(view.topic) as newest:
            try:
                async with asyncio.timeout(patience):
                    return await self.made((await newest.next()).data, view, patient=True)
            except TimeoutError:
                return None

    async def viewer(self, view: View, kind: str, may_watch: Callable[[], bool] = _always) -> StreamViewer:
        """An ASGI application that sends a stream of that `kind`, a key of `MEDIA_TYPES`, for as long as pictures are taken
        and `may_watch()`. Raises FullError, and NoVideo for film that cannot be made."""
        if kind in _FILES:
            await self.films.load()
            self.films.check(view)
        if len(self.viewers) >= MAX_VIEWERS:
            raise FullError(f"{MAX_VIEWERS} look at the camera already; close one of them.")
        return StreamViewer(self, view, kind, may_watch)

    @contextmanager
    def looking(self, topic: str = CAMERA) -> Iterator[NewestPicture]:
        """Somebody looks: the camera of that topic works, and its newest picture is at hand."""
        newest = NewestPicture(self._now)
        self._door.subscribe(newest, topic, newest.on_picture)
        try:
            yield newest
        finally:
            self._door.leave(newest)

    async def made(self, jpeg: bytes, view: View, *, patient: bool = False) -> bytes:
        """`jpeg` as `view` wants it; fails as `PictureScaler.make` does, which `patient` is for."""
        if view.codec == "png":
            return await self._pictures.make(jpeg, view.width, form="PNG", patient=patient)
        if view.width is None and view.quality is None:
            return jpeg
        return await self._pictures.make(jpeg, view.width, view.quality, patient=patient)


class StreamViewer:
    """One response that does not end."""

    def __init__(self, streams: CameraStreams, view: View, kind: str, may_watch: Callable[[], bool]) -> None:
        self._streams, self._view, self._kind, self._may_watch = streams, view, kind, may_watch
        self._ended = asyncio.Event()

    def end(self) -> None:
        """Its viewer may not look any more."""
        self._ended.set()

    async def __call__(self, _: object, receive: Receive, send: Send) -> None:
        """Send pictures until the viewer is gone or none come any more."""
        self._streams.viewers.add(self)
        show = self._film if self._kind in _FILES else self._show
        work = (show(send), _gone(receive), self._ended.wait())
        tasks = [asyncio.create_task(each) for each in work]
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            self._streams.viewers.discard(self)
            await cancel_all(tasks)
        await _write(send, b"", last=True)

    async def _begin(self, send: Send) -> None:
        headers = [
            (b"content-type", MEDIA_TYPES[self._kind].encode()),
            (b"cache-control", b"no-store"),
            (b"connection", b"close"),
        ]
        await send({"type": "http.response.start", "status": 200, "headers": headers})

    async def _show(self, send: Send) -> None:
        await self._begin(send)
        # a browser shows a picture when it sees the boundary behind it
        await _write(send, f"--{BOUNDARY}\r\n".encode())
        pace = Pace(self._view.rate)
        with self._streams.looking(self._view.topic) as newest:
            while True:
                await pace.wait()
                try:
                    picture = await newest.soon()
                except TimeoutError:
                    return
                if not self._may_watch():
                    return
                await self._send(picture, send)

    async def _send(self, picture: Picture, send: Send) -> None:
        try:
            made = await self._streams.made(picture.data, self._view)
        except Superseded:
            return
        except BridgeError:
            made = picture.data
        head = f"Content-Type: image/jpeg\r\nContent-Length: {len(made)}\r\n\r\n".encode()
        await _write(send, b"".join((head, made, f"\r\n--{BOUNDARY}\r\n".encode())))
        self._note(picture.taken)

    async def _film(self, send: Send) -> None:
        await self._begin(send)
        with self._streams.films.watching(self._view) as film:
            file, begun = _FILES[self._kind](), False
            while (picture := await film.next()) is not None:
                if not self._may_watch():
                    return
                piece = file.add(picture)
                await _write(send, piece if begun else film.head + piece)
                begun = True
                self._note(picture.taken)

    def _note(self, taken: float) -> None:
        age = asyncio.get_running_loop().time() - taken
        self._streams.delays.note(self._view.topic, self._kind, age)


async def _write(send: Send, body: bytes, *, last: bool = False) -> None:
    await send({"type": "http.response.body", "body": body, "more_body": not last})


async def _gone(receive: Receive) -> None:
    """Until the viewer has left."""
    while (await receive())["type"] != "http.disconnect":
        pass
