"""Quality levels of a camera's picture, each made once for all watchers that need it."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable

from bridge.core.camera_frames import pack, pack_same, unpack
from bridge.core.errors import BridgeError
from bridge.server.flow.picture_quality import COARSEST

__all__ = ["QualityLevels", "Picture", "Shrink"]

Shrink = Callable[[bytes, int], Awaitable[bytes]]
"""Makes a JPEG file smaller, to a level from 1 to `picture_quality.COARSEST`; BridgeError when it cannot."""


class QualityLevels:
    """Makes the levels of all pictures."""

    def __init__(self, shrink: Shrink | None) -> None:
        """Without `shrink` every picture stays as it is."""
        self._shrink = shrink
        self._making: set[asyncio.Future[bytes]] = set()
        self.coarsest = COARSEST if shrink else 0
        """The highest level that can be made."""

    def picture(self, frame: bytes) -> Picture:
        """The packed `frame` as a picture with levels; ProtocolError when it is no frame."""
        return Picture(frame, self)

    def begin(self, jpeg: bytes, level: int) -> asyncio.Future[bytes] | None:
        """Begin to make `jpeg` smaller; None without a `shrink`."""
        if self._shrink is None or level == 0:
            return None
        making: asyncio.Future[bytes] = asyncio.ensure_future(self._shrink(jpeg, level))
        self._making.add(making)
        making.add_done_callback(self._done)
        return making

    async def close(self) -> None:
        """Cancel all work."""
        left = list(self._making)
        for making in left:
            making.cancel()
        await asyncio.gather(*left, return_exceptions=True)

    def _done(self, making: asyncio.Future[bytes]) -> None:
        self._making.discard(making)
        if not making.cancelled():
            making.exception()  # retrieved, so that asyncio does not report it when no watcher waits for it any more


class Picture:
    """One packed frame with its levels."""

    __slots__ = ("_frame", "_levels", "_made", "_making", "frame")

    def __init__(self, frame: bytes, levels: QualityLevels) -> None:
        self.frame = frame
        """The packed frame as it was taken."""
        self._frame = unpack(frame)
        self._levels = levels
        self._made = {0: frame}
        self._making: dict[int, asyncio.Future[bytes] | None] = {}

    @property
    def seq(self) -> int:
        """Sequence number."""
        return self._frame.seq

    def is_same_as(self, other: Picture) -> bool:
        """It was taken later than `other`, and came out the same."""
        mine, others = self._frame, other._frame
        return mine.stamp > others.stamp and mine.jpeg == others.jpeg

    @property
    def same(self) -> bytes:
        """The packed header that says that it is the same as the picture sent before."""
        return pack_same(self._frame)

    async def at(self, level: int) -> bytes:
        """The packed frame at `level`, with the header of the original; the original where no smaller one can be
        made.

        Made when first asked for, and once for all watchers.
        """
        if level not in self._made:
            if level not in self._making:
                self._making[level] = self._levels.begin(self._frame.jpeg, level)
            self._made[level] = await self._packed(self._making[level])
        return self._made[level]

    async def _packed(self, making: asyncio.Future[bytes] | None) -> bytes:
        if making is None:
            return self.frame
        try:
            # what one watcher asked for stays wanted by the others when that one leaves
            jpeg = await asyncio.shield(making)
        except BridgeError:
            return self.frame
        original = self._frame
        return pack(original.seq, original.stamp, jpeg, original.width, original.height)
