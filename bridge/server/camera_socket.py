"""The server's end of a camera's own WebSocket."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from typing import Protocol

from bridge.core.async_tasks import cancel_all, wait
from bridge.server.flow.picture_quality import COARSEST, PictureQuality
from bridge.server.flow.quality_levels import Picture

__all__ = ["CameraSocket", "Socket"]


class Socket(Protocol):
    """A WebSocket; iterating and sending raise when the connection ends badly."""

    @property
    def transport(self) -> asyncio.Transport:
        """The connection below."""

    def __aiter__(self) -> AsyncIterator[str | bytes]:
        """Messages as they come."""

    async def send(self, message: bytes, *, text: bool | None = None) -> None:
        """Send one message; waits while too much is on its way."""


class CameraSocket:
    """One watcher of one camera; gets the newest picture, as good and as often as the link carries it."""

    def __init__(
        self,
        socket: Socket,
        clock: Callable[[], float] | None = None,
        *,
        coarsest: int = COARSEST,
        knows_same: bool = False,
    ) -> None:
        """`clock` measures the acknowledgements [s], None is the loop's; `coarsest` as in PictureQuality.

        A watcher that `knows_same` gets a header alone for a picture that is the same as the last one that it got.
        """
        self._socket = socket
        self._newest: Picture | None = None
        self._clock = clock or asyncio.get_running_loop().time
        self.quality = PictureQuality(coarsest)
        """Decides the level and the time of the next picture."""
        self._wake = asyncio.Event()
        self._knows_same = knows_same
        self._sent: tuple[Picture, int] | None = None
        """The picture whose bytes went out last, and its level."""

    async def run(self) -> None:
        """Serve until the connection ends; raises the socket's error when it ends badly."""
        writer = asyncio.create_task(self._write())
        try:
            async for text in self._socket:
                self._acknowledge(text)
        finally:
            await cancel_all([writer])

    def offer(self, picture: Picture) -> None:
        """Send a picture as soon as there is room for it; a newer one replaces one that still waits."""
        self._newest = picture
        self._wake.set()

    def _acknowledge(self, text: str | bytes) -> None:
        word, _, number = str(text).partition(" ")
        if word == "ack" and number.isdecimal() and len(number) < 11:
            self.quality.on_ack(int(number), self._clock())
            self._wake.set()

    async def _write(self) -> None:
        while True:
            delay = self.quality.delay(self._clock()) if self._newest else None
            if delay != 0.0:
                await wait(self._wake, delay)
                continue
            picture, level = self._pop(), self.quality.level
            if picture is None:
                continue
            if self._has(picture, level):
                await self._send_same(picture)
                continue
            frame = await picture.at(level)
            if level and frame is picture.frame and self._newest is not None:
                continue  # it could not be made smaller in time, and a newer one can
            self.quality.on_sent(picture.seq, len(frame), level, self._clock())
            self._sent = picture, level
            await self._socket.send(frame)

    def _has(self, picture: Picture, level: int) -> bool:
        """The watcher has the same picture already, as good as `level` or better."""
        if not self._knows_same or self._sent is None:
            return False
        last, its = self._sent
        return level >= its and picture.is_same_as(last)

    async def _send_same(self, picture: Picture) -> None:
        if self._sent is None:
            return
        _, level = self._sent
        self._sent = picture, level
        self.quality.on_same_sent(picture.seq, level, self._clock())
        await self._socket.send(picture.same)

    def _pop(self) -> Picture | None:
        picture, self._newest = self._newest, None
        return picture
