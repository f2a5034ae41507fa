"""One socket that WebSockets come to: it has places, may speak TLS, and leaves nothing behind when it is closed."""

from __future__ import annotations

import asyncio
import contextlib
import errno
import logging
import socket
import ssl
from collections.abc import Awaitable, Callable
from typing import Any

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.http11 import Request, Response

from bridge.core.errors import BridgeError
from bridge.server.callback_connection import CallbackConnection
from bridge.server.reception.places import Limits
from bridge.server.reception.reception import Reception, anyone

__all__ = ["WebSocketListener", "tune"]

_MAX_UNSENT_BYTES = 65536
"""Most bytes that wait for one client in this process and again in the kernel; then newer messages replace older ones."""
_DEAD_TIMEOUT = 15_000
"""A client that leaves data unacknowledged for this long is disconnected by the kernel [ms]."""
_CLOSE_TIMEOUT = 0.5
"""Time for clients to close before they are cut off [s]."""


class WebSocketListener:
    """Listens; every connection is a `CallbackConnection` with a place. All methods belong to one event loop."""

    def __init__(
        self,
        limits: Limits,
        *,
        tls: ssl.SSLContext | None = None,
        plain_from: Callable[[str], bool] = anyone,
    ) -> None:
        """With `tls` clients may come encrypted, on the same port; `plain_from(host)` says who may come without."""
        self.port = 0
        """Port that it listens on; 0 until started."""
        self.reception = Reception(limits, tls=tls, plain_from=plain_from)
        self._server: Server | None = None

    async def start(
        self,
        host: str,
        port: int,
        on_connected: Callable[[ServerConnection], Awaitable[None]],
        *,
        admit: Callable[[ServerConnection, Request], Response | None],
        greet: Callable[[ServerConnection, Request, Response], Response | None],
        max_size: int,
    ) -> None:
        """Begin to listen; port 0 takes a free one. BridgeError in one sentence when that is not possible.

        `admit` may refuse a request, `greet` at the end of its handshake; `on_connected` serves the connection until it
        ends. A message has at most `max_size` bytes.
        """
        try:
            self._server = await serve(
                on_connected,
                host,
                port,
                process_request=admit,
                process_response=greet,
                compression=None,
                create_connection=self._connection,  # type: ignore[arg-type]  # it is only called
                open_timeout=5,
                ping_interval=5,
                ping_timeout=10,
                close_timeout=_CLOSE_TIMEOUT,
                max_size=max_size,
                write_limit=_MAX_UNSENT_BYTES,
                server_header="Pilothouse",
                logger=_quiet_log(),
            )
        except OSError as error:
            raise BridgeError(_cannot_listen(host, port, error)) from error
        self.port = next(iter(self._server.sockets)).getsockname()[1]

    async def close(self) -> None:
        """Close all connections and stop listening; nothing is left running. Takes a second at most."""
        server, self._server = self._server, None
        if server is None:
            return
        server.close()
        await self.reception.close()
        try:
            async with asyncio.timeout(_CLOSE_TIMEOUT):
                await server.wait_closed()
        except TimeoutError:
            self.reception.places.give_up_all()
            await server.wait_closed()

    def _connection(self, *args: Any, **options: Any) -> asyncio.Protocol:
        return self.reception.front(CallbackConnection(*args, **options))


def tune(ws: ServerConnection) -> None:
    """Limit the kernel's queue for a slow client, and its patience with a dead one."""
    sock = ws.transport.get_extra_info("socket")
    for option, value in (("TCP_NOTSENT_LOWAT", _MAX_UNSENT_BYTES), ("TCP_USER_TIMEOUT", _DEAD_TIMEOUT)):
        if hasattr(socket, option):
            with contextlib.suppress(OSError):
                sock.setsockopt(socket.IPPROTO_TCP, getattr(socket, option), value)


def _cannot_listen(host: str, port: int, error: OSError) -> str:
    if error.errno == errno.EADDRINUSE:
        return f"Port {port} on {host} is taken by another program; stop that one or choose another port."
    if error.errno == errno.EACCES:
        return f"Port {port} may be used by the system only; choose one above 1023."
    return f"Cannot listen on {host}:{port} ({error.strerror or error})."


def _quiet_log() -> logging.Logger:
    """A log for the WebSocket library, kept quiet: most of its errors are strangers that connect and leave."""
    quiet = logging.getLogger("bridge.server.server.websockets")
    quiet.setLevel(logging.CRITICAL)
    return quiet
