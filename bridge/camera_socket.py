"""The server's side of one connection of somebody who watches a camera."""

from __future__ import annotations

import asyncio
from collections import deque

from bridge.frames import sequence
from bridge.sockets import Socket, end, wait

__all__ = ["CameraSocket"]

UNACKNOWLEDGED = 2
"""Frames on their way to one client; a third waits, so that a slow link shows the newest picture."""


class CameraSocket:
    """Somebody who watches one camera."""

    def __init__(self, socket: Socket) -> None:
        self._socket = socket
        self._newest: tuple[int, bytes] | None = None
        self._flying: deque[int] = deque()
        self._wake = asyncio.Event()

    async def run(self) -> None:
        """Serve until the connection ends; raises what the socket raises when it ends badly."""
        writer = asyncio.create_task(self._write())
        try:
            async for text in self._socket:
                self._acknowledge(text)
        finally:
            await end({writer})

    def offer(self, frame: bytes) -> None:
        """Have a frame sent as soon as there is room for it; a newer one replaces one that still waits.

        ProtocolError when it is no packed frame.
        """
        self._newest = sequence(frame), frame
        self._wake.set()

    def _acknowledge(self, text: str | bytes) -> None:
        word, _, number = str(text).partition(" ")
        seq = int(number) if word == "ack" and number.isdecimal() and len(number) < 11 else -1
        if seq in self._flying:
            while self._flying.popleft() != seq:
                pass
            self._wake.set()

    async def _write(self) -> None:
        while True:
            await wait(self._wake, None)
            while self._newest is not None and len(self._flying) < UNACKNOWLEDGED:
                (seq, frame), self._newest = self._newest, None
                self._flying.append(seq)
                await self._socket.send(frame)
