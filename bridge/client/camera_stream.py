"""The client's end of a camera's own WebSocket."""

from __future__ import annotations

import asyncio
import logging
import random
import time
from collections.abc import Callable

from bridge.client.connection import Connection, open_connection
from bridge.client.credentials import Credentials
from bridge.client.reconnecting import Reconnecting
from bridge.core.address import BadAddress, LinkLost
from bridge.core.camera_frames import ASKS_FOR_SAME, Frame, unpack
from bridge.core.errors import ProtocolError
from bridge.core.link_state import LinkFault

__all__ = ["CameraStream"]

log = logging.getLogger(__name__)
OPEN_TIMEOUT = 3.0
"""Longest time for looking up the name, and again for opening the connection [s]."""


class CameraStream(Reconnecting):
    """The pictures of one camera, over a WebSocket of their own that reconnects by itself."""

    def __init__(
        self,
        url: str,
        on_frame: Callable[[Frame, float], None],
        *,
        now: Callable[[], float] = time.monotonic,
        backoff: tuple[float, float] = (0.5, 5.0),
        rng: random.Random | None = None,
        credentials: Credentials | None = None,
    ) -> None:
        """`url` is `ws://HOST:PORT/camera/NAME`; `on_frame(frame, received)` is called for each picture, `received`
        by `now()` [s]; one that came out the same as the last has the same `jpeg` object. `credentials` are as in
        `bridge.client.connection.open_connection`."""
        super().__init__(url, now, backoff, rng)
        self._credentials = credentials
        self._on_frame = on_frame

    async def stay_connected(self) -> None:
        """Connect, and reconnect whenever the connection is lost; returns when the address can never work."""
        attempt = 0
        while True:
            attempt, fault = attempt + 1, LinkFault.NONE
            try:
                connection = await open_connection(
                    f"{self.url}?{ASKS_FOR_SAME}",
                    OPEN_TIMEOUT,
                    ping_interval=2.0,
                    credentials=self._credentials,
                )
                attempt = 0
                await self._watch(connection)
            except BadAddress as error:
                log.warning("No pictures: %s", error)
                return
            except LinkLost as error:
                fault = error.fault
                log.info("No pictures: %s", error)
            await asyncio.sleep(self.wait_before(max(1, attempt), fault))

    async def _watch(self, connection: Connection) -> None:
        frame: Frame | None = None
        try:
            async for raw in connection.messages():
                try:
                    frame = unpack(raw, frame)
                except ProtocolError as error:
                    frame = None  # a later header alone may stand for the picture that this was meant to be
                    log.debug("%s: %s", self.url, error)
                    continue
                connection.send(f"ack {frame.seq}")
                self._show(frame)
        finally:
            await connection.close()
        raise LinkLost(f"The pictures from {self.place} were cut off.")

    def _show(self, frame: Frame) -> None:
        try:
            self._on_frame(frame, self._now())
        except Exception:
            log.exception("Showing a picture of %s failed", self.url)
