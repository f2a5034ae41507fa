"""One open WebSocket to a robot, and how it is opened and ended."""

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
"""What our server calls itself."""
_MAX_UNSENT_BYTES = 65536
"""With more bytes than this waiting in the socket it is stuck."""
_RETRANSMITS = 2
"""Place in Linux's `struct tcp_info` of how often the oldest bytes under way were sent again [byte]."""
_RESET = struct.pack("ii", 1, 0)
"""`struct linger`: what was not sent when a socket is closed is thrown away."""


class Connection:
    """One WebSocket, open from the start. Owned by whoever dialled; `close` ends it."""

    def __init__(self, ws: ClientConnection, address: tuple[str, int]) -> None:
        self.address = address
        """The other end: numeric address and port."""
        self._ws = ws
        self._socket: socket.socket = ws.transport.get_extra_info("socket")
        self._pinging: asyncio.Task[None] | None = None
        self._probe: asyncio.Task[None] | None = None
        self._probed = 0.0

    @property
    def ours(self) -> bool:
        """The other end says that it is a Pilothouse server."""
        response = self._ws.response
        return response is not None and response.headers.get("Server", "").startswith(OURS)

    @property
    def local(self) -> str:
        """The numeric address of this machine that it uses; empty where the system does not tell."""
        name = self._ws.transport.get_extra_info("sockname")
        return str(name[0]) if name else ""

    @property
    def stuck(self) -> bool:
        """What was sent last does not get through, so that anything more would wait and arrive late.

        The system tells when the other end did not acknowledge in time, which takes 0.2 s at least; where it does not tell,
        only a full buffer is noticed.
        """
        return self.full or _sent_again(self._socket)

    @property
    def full(self) -> bool:
        """So much waits in the socket that nothing more is to be put behind it."""
        return self._ws.transport.get_write_buffer_size() > _MAX_UNSENT_BYTES

    def send(self, text: str) -> bool:
        """Send a text now; False when it is closed."""
        if self._ws.state is not State.OPEN:
            return False
        broadcast([self._ws], text)
        return True

    def ping(self, answered: Callable[[], object]) -> None:
        """Send a WebSocket ping; does nothing while the last one is not answered."""
        if self._pinging is None or self._pinging.done():
            self._pinging = asyncio.create_task(self._ping(answered))

    def probe(self, now: float) -> None:
        """Ask the other end, at `now` [s], to answer when it has read what was sent; does nothing while it owes an answer."""
        if self._probe is None or self._probe.done():
            self._probed = now
            self._probe = asyncio.create_task(self._ping(lambda: None))

    def unread_time(self, now: float) -> float:
        """For how long it has owed that answer [s]; 0 when it owes none."""
        owes = self._probe is not None and not self._probe.done()
        return now - self._probed if owes else 0.0

    async def _ping(self, answered: Callable[[], object]) -> None:
        with contextlib.suppress(ConnectionClosed):
            await (await self._ws.ping())
            answered()

    async def messages(self) -> AsyncIterator[bytes]:
        """What comes, text and binary alike as bytes, until the connection ends, however it ends."""
        with contextlib.suppress(ConnectionClosed):
            while True:
                yield await self._ws.recv(decode=False)

    async def close(self, *, lost: bool = False) -> None:
        """Close it; 0.2 s at most, even when nothing listens at its other end any more.

        When it is `lost` the system is told to throw away what it could not deliver yet: it would arrive late.
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
    """Has the kernel acknowledge what came as soon as it is read, not only with the last piece of a message.

    A server with Nagle's algorithm holds back the short last piece of what it sends until all before it is acknowledged.
    """

    def data_received(self, data: bytes) -> None:
        """Take what came from the network."""
        _acknowledge_at_once(self.transport.get_extra_info("socket"))
        super().data_received(data)


async def open_connection(url: str, open_timeout: float, *, ping_interval: float | None = None) -> Connection:
    """Open a WebSocket; LinkLost or BadAddress with the reason when that fails.

    `open_timeout` is how long looking up the name may take, and then opening the connection [s]. With `ping_interval` [s] it
    is closed when its other end no longer answers pings.
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
    """Ask the kernel not to sit on acknowledgements: a ROS 1 server holds data back for them, up to 40 ms."""
    if hasattr(socket, "TCP_QUICKACK"):
        with contextlib.suppress(OSError):
            sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_QUICKACK, 1)


def _sent_again(sock: socket.socket) -> bool:
    """The system is sending again what it sent before; False where it does not tell."""
    if not hasattr(socket, "TCP_INFO"):
        return False
    try:
        return sock.getsockopt(socket.IPPROTO_TCP, socket.TCP_INFO, 8)[_RETRANSMITS] > 0
    except (OSError, IndexError):
        return False


def _quiet_log() -> logging.Logger:
    """A log for the WebSocket library: what it reports, the link reports in plain words."""
    quiet = logging.getLogger("bridge.client.connection.websockets")
    quiet.setLevel(logging.CRITICAL)
    return quiet


log = logging.getLogger(__name__)
