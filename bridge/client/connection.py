"""One open WebSocket to a robot, with its opening and closing."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import socket
import struct
from collections.abc import AsyncIterator, Callable

from websockets.asyncio.client import ClientConnection, connect
from websockets.asyncio.connection import broadcast
from websockets.exceptions import ConnectionClosed, InvalidHandshake, InvalidStatus
from websockets.protocol import State

from bridge.core.address import LinkLost, cause, host_and_port, look_up
from bridge.protocol import MAX_CLIENT_FRAME

__all__ = ["Connection", "open_connection"]

OURS = "Pilothouse"
"""Beginning of our server's name in the `Server` header."""
_MAX_UNSENT_BYTES = 65536
"""A socket with more bytes than this waiting counts as full."""
_RETRANSMITS = 2
"""Offset of the retransmission count in Linux's `struct tcp_info` [byte]."""
_RESET = struct.pack("ii", 1, 0)
"""`struct linger` that discards unsent data when a socket is closed."""


class Connection:
    """One WebSocket, open from the start. Its owner ends it by `close`."""

    def __init__(self, ws: ClientConnection, address: tuple[str, int]) -> None:
        self.address = address
        """Numeric address and port of the other end."""
        self._ws = ws
        self._socket: socket.socket = ws.transport.get_extra_info("socket")
        self._pinging: asyncio.Task[None] | None = None
        self._probe: asyncio.Task[None] | None = None
        self._probed = 0.0

    @property
    def ours(self) -> bool:
        """Whether the other end identifies itself as a Pilothouse server."""
        response = self._ws.response
        return response is not None and response.headers.get("Server", "").startswith(OURS)

    @property
    def local(self) -> str:
        """The numeric address of this machine that it uses; empty where the system does not report it."""
        name = self._ws.transport.get_extra_info("sockname")
        return str(name[0]) if name else ""

    @property
    def stuck(self) -> bool:
        """Whether the data sent last does not get through, so that anything more would wait and arrive late.

        The system reports it when the other end did not acknowledge in time, 0.2 s at least; where it does not report
        that, only a full buffer is noticed.
        """
        return self.full or _sent_again(self._socket)

    @property
    def full(self) -> bool:
        """Whether so much waits in the socket that nothing more should be queued behind it."""
        return self._ws.transport.get_write_buffer_size() > _MAX_UNSENT_BYTES

    def send(self, text: str) -> bool:
        """Send a text now; False when the connection is closed."""
        if self._ws.state is not State.OPEN:
            return False
        broadcast([self._ws], text)
        return True

    def ping(self, answered: Callable[[], object]) -> None:
        """Send a WebSocket ping and call `answered` at its pong; does nothing while the last one is unanswered."""
        if self._pinging is None or self._pinging.done():
            self._pinging = asyncio.create_task(self._ping(answered))

    def probe(self, now: float) -> None:
        """Ask the other end, at `now` [s], for a sign of having read what was sent; does nothing while the last probe
        is unanswered."""
        if self._probe is None or self._probe.done():
            self._probed = now
            self._probe = asyncio.create_task(self._ping(lambda: None))

    def unread_time(self, now: float) -> float:
        """How long the last probe has been unanswered [s]; 0 when none is."""
        owes = self._probe is not None and not self._probe.done()
        return now - self._probed if owes else 0.0

    async def _ping(self, answered: Callable[[], object]) -> None:
        with contextlib.suppress(ConnectionClosed):
            await (await self._ws.ping())
            answered()

    async def messages(self) -> AsyncIterator[bytes]:
        """All messages, text and binary alike as bytes, until the connection ends for any reason."""
        with contextlib.suppress(ConnectionClosed):
            while True:
                yield await self._ws.recv(decode=False)

    async def close(self, *, lost: bool = False) -> None:
        """Close the connection, in 0.2 s at most, even when nothing listens at the other end.

        When it is `lost` the system discards the data that it could not deliver yet: it would arrive late.
        """
        asked = [task for task in (self._pinging, self._probe) if task is not None]
        for task in asked:
            task.cancel()
        await asyncio.gather(*asked, return_exceptions=True)
        try:
            async with asyncio.timeout(0.2):
                await self._ws.close()
        except TimeoutError:
            log.debug("%s did not say goodbye", self.address)
            # Only then: after a goodbye the other end may still be reading what was sent last, and a reset would take it away.
            if lost:
                with contextlib.suppress(OSError):
                    self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, _RESET)
        finally:
            self._ws.transport.abort()


class _Acknowledging(ClientConnection):
    """A connection whose data the kernel acknowledges as soon as it is read.

    A server with Nagle's algorithm holds back the short last piece of a message until all before it is acknowledged.
    """

    def data_received(self, data: bytes) -> None:
        """Handle data from the network."""
        _acknowledge_at_once(self.transport.get_extra_info("socket"))
        super().data_received(data)


async def open_connection(url: str, open_timeout: float, *, ping_interval: float | None = None) -> Connection:
    """Open a WebSocket; LinkLost or BadAddress with the reason when that fails.

    `open_timeout` [s] limits the look-up of the name, and again the opening of the connection. With `ping_interval`
    [s] the connection is closed when its other end no longer answers pings.
    """
    host, port = host_and_port(url)
    place = f"{host}:{port}"
    try:
        address = await look_up(host, open_timeout)
        ws = await connect(
            url,
            host=address,
            port=port,
            compression=None,
            proxy=None,
            create_connection=_Acknowledging,
            open_timeout=open_timeout,
            ping_interval=ping_interval,
            ping_timeout=ping_interval and ping_interval * 2,
            close_timeout=0.2,
            max_size=MAX_CLIENT_FRAME,
            user_agent_header=None,
            logger=_quiet_log(),
        )
    except socket.gaierror as error:
        raise LinkLost(f"No machine called {host} is known on this network.") from error
    except TimeoutError as error:
        raise LinkLost(f"No robot answers at {place} (no reply within {open_timeout:g} s).") from error
    except InvalidStatus as error:
        status = error.response.status_code
        raise LinkLost(f"What answers at {place} is no robot (HTTP {status}).") from error
    except (InvalidHandshake, EOFError, ConnectionResetError) as error:
        raise LinkLost(f"What answers at {place} is no robot (it does not speak WebSocket).") from error
    except OSError as error:
        raise LinkLost(f"No robot answers at {place} ({cause(error)}).") from error
    return Connection(ws, (address, port))


def _acknowledge_at_once(sock: socket.socket) -> None:
    """Have the kernel acknowledge at once: a ROS 1 server waits for acknowledgements, up to 40 ms."""
    if hasattr(socket, "TCP_QUICKACK"):
        with contextlib.suppress(OSError):
            sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_QUICKACK, 1)


def _sent_again(sock: socket.socket) -> bool:
    """Whether the system is retransmitting; False where it does not report that."""
    if not hasattr(socket, "TCP_INFO"):
        return False
    try:
        return sock.getsockopt(socket.IPPROTO_TCP, socket.TCP_INFO, 8)[_RETRANSMITS] > 0
    except (OSError, IndexError):
        return False


def _quiet_log() -> logging.Logger:
    """A log for the WebSocket library, kept quiet: the link reports the same in plain words."""
    quiet = logging.getLogger("bridge.client.connection.websockets")
    quiet.setLevel(logging.CRITICAL)
    return quiet


log = logging.getLogger(__name__)
