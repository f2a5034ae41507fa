"""A link that carries little, or nothing for a while: a TCP proxy with hardly any buffers."""

from __future__ import annotations

import asyncio
import contextlib
import math
import select
import socket
import struct
import threading
from collections.abc import AsyncIterator, Coroutine, Iterator
from typing import Any

__all__ = ["Wire", "wire", "wired"]

BUFFER = 4096
"""Buffer of the kernel on either side of the wire in each direction [byte]; it doubles that itself."""
AT_ONCE = struct.pack("ii", 1, 0)
"""Of SO_LINGER: discard unsent data and reset the connection by RST."""
PIECE = 1024
"""As much goes over the wire at a time [byte]."""


class Wire:
    """Passes on what comes to `port`, `rate` bytes a second in each direction of each connection."""

    def __init__(self, to: int, rate: float = math.inf) -> None:
        self.port = 0
        self._to = to
        self._rate = rate
        self._listening: socket.socket | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        self._sockets: set[socket.socket] = set()
        self._thawed = asyncio.Event()
        self._thawed_down = asyncio.Event()

    def open(self) -> None:
        """Take connections."""
        made = self._bare()
        made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        made.bind(("127.0.0.1", self.port))
        made.listen()
        self.port = made.getsockname()[1]
        self._listening = made
        self.thaw()
        self._begin(self._accept(made))

    def freeze(self, *, upward_only: bool = False) -> None:
        """Nothing passes any more and neither end is informed, as beyond the reach of a radio.

        With `upward_only` what `to` sends still passes, as where one end has the weaker radio.
        """
        self._thawed.clear()
        if not upward_only:
            self._thawed_down.clear()

    def thaw(self) -> None:
        """What still waits with those who have not given up passes, late."""
        self._thawed.set()
        self._thawed_down.set()

    async def reset(self) -> None:
        """Break every connection at once, by RST to either side, and take none until opened again."""
        for each in self._sockets:
            each.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, AT_ONCE)
        await self.cut()

    async def cut(self) -> None:
        """Break every connection and take none until opened again."""
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        self._tasks.clear()
        for each in (*self._sockets, self._listening):
            if each is not None:
                each.close()
        self._sockets.clear()
        self._listening = None

    async def _accept(self, listening: socket.socket) -> None:
        loop = asyncio.get_running_loop()
        while True:
            await self._thawed.wait()
            near, _ = await loop.sock_accept(listening)
            near.setblocking(False)
            near.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            far = self._bare()
            await loop.sock_connect(far, ("127.0.0.1", self._to))
            self._sockets |= {near, far}
            self._begin(self._pass(near, far, self._thawed))
            self._begin(self._pass(far, near, self._thawed_down))

    async def _pass(self, source: socket.socket, sink: socket.socket, thawed: asyncio.Event) -> None:
        loop = asyncio.get_running_loop()
        free = loop.time()
        try:
            while data := await loop.sock_recv(source, PIECE):
                await thawed.wait()
                if _given_up(source):
                    break
                free = max(free, loop.time()) + len(data) / self._rate
                await asyncio.sleep(free - loop.time())
                await loop.sock_sendall(sink, data)
        except OSError:
            pass
        finally:
            with contextlib.suppress(OSError):
                sink.shutdown(socket.SHUT_RDWR)

    def _bare(self) -> socket.socket:
        made = socket.socket()
        made.setblocking(False)
        made.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        if math.isfinite(self._rate):
            made.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER)
            made.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, BUFFER)
        return made

    def _begin(self, work: Coroutine[Any, Any, None]) -> None:
        self._tasks.add(asyncio.create_task(work))


def _given_up(source: socket.socket) -> bool:
    """Who sent has thrown away what was not delivered: over a real link it would not arrive either."""
    poll = select.poll()
    poll.register(source, select.POLLERR | select.POLLHUP)
    return bool(poll.poll(0))


@contextlib.asynccontextmanager
async def wire(to: int, rate: float = math.inf) -> AsyncIterator[Wire]:
    """One that is open; cut at the end."""
    made = Wire(to, rate)
    made.open()
    try:
        yield made
    finally:
        await made.cut()


@contextlib.contextmanager
def wired(to: int, rate: float = math.inf) -> Iterator[int]:
    """The port of one that runs in a thread of its own, for callers that are no coroutine."""
    loop, ended, ready = asyncio.new_event_loop(), asyncio.Event(), threading.Event()
    ports: list[int] = []

    async def live() -> None:
        async with wire(to, rate) as link:
            ports.append(link.port)
            ready.set()
            await ended.wait()

    thread = threading.Thread(target=loop.run_until_complete, args=(live(),), name="wire")
    thread.start()
    ready.wait(5.0)
    try:
        yield ports[0]
    finally:
        loop.call_soon_threadsafe(ended.set)
        thread.join()
        loop.close()
