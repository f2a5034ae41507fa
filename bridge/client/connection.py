"""One open WebSocket to a robot, with its opening and closing."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import socket
import struct
from collections.abc import AsyncIterator, Callable
from functools import partial
from typing import Any, cast
from urllib.parse import urlsplit, urlunsplit

from websockets.asyncio.client import ClientConnection, connect
from websockets.asyncio.connection import broadcast
from websockets.exceptions import ConnectionClosed, InvalidHandshake, InvalidStatus
from websockets.http11 import Response
from websockets.protocol import State

from bridge.client import tls
from bridge.client.credentials import Credentials
from bridge.core.address import LinkLost, NotAccepted, NotProtected, WrongKey, cause, host_and_port, look_up
from bridge.protocol import MAX_CLIENT_FRAME

__all__ = ["Connection", "open_connection"]

OURS = "Pilothouse"
"""Beginning of our server's name in the `Server` header."""
_MAX_UNSENT_BYTES = 65536
"""A socket with more bytes than this waiting counts as full. TLS keeps what exceeds this in a buffer of its own."""
_MAX_SENTENCE = 200
"""Longest sentence that is taken from a server's refusal [characters]."""
_UNAUTHORIZED, _UPGRADE_REQUIRED = 401, 426
"""HTTP status of a refused token, and of a refused connection without TLS."""
_RETRANSMITS = 2
"""Offset of the retransmission count in Linux's `struct tcp_info` [byte]."""
_RESET = struct.pack("ii", 1, 0)
"""`struct linger` that discards unsent data when a socket is closed."""


class Connection:
    """One WebSocket, open from the start. Its owner ends it by `close`."""

    def __init__(self, ws: ClientConnection, address: tuple[str, int]) -> None:
        self.address = address
        """Numeric address and port of the other end."""
        self.fingerprint = tls.fingerprint(ws.transport)
        """Fingerprint of the other end's certificate; empty without TLS."""
        self._ws = ws
        self._max_unsent = 0 if self.fingerprint else _MAX_UNSENT_BYTES
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
        return self._ws.transport.get_write_buffer_size() > self._max_unsent

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


def _pinned(credentials: Credentials | None) -> type[ClientConnection]:
    """What makes the connection: the library only calls it, so that it may be more than a class."""
    make = partial(_PinnedConnection, pin=credentials.fingerprint if credentials else "")
    return cast("type[ClientConnection]", make)


class _PinnedConnection(ClientConnection):
    """A connection that goes on to the handshake only when the other end has the expected certificate.

    Its kernel acknowledges data as soon as it is read: a server with Nagle's algorithm holds back the short last piece
    of a message until all before it is acknowledged.
    """

    def __init__(self, *args: Any, pin: str, **options: Any) -> None:
        """`pin` is the fingerprint of the expected certificate; empty for any."""
        super().__init__(*args, **options)
        self._pin = pin
        self._wrong_key = False

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Compare the certificate and leave at once when it is another one."""
        super().connection_made(transport)
        self._wrong_key = bool(self._pin) and tls.fingerprint(transport) != self._pin
        if self._wrong_key:
            self.transport.abort()

    async def handshake(self, *args: Any, **options: Any) -> None:
        """Send the request, which holds the token; WrongKey instead when the certificate is another one."""
        if self._wrong_key:
            raise WrongKey
        await super().handshake(*args, **options)

    def data_received(self, data: bytes) -> None:
        """Handle data from the network."""
        _acknowledge_at_once(self.transport.get_extra_info("socket"))
        super().data_received(data)


class _Connect(connect):
    """An attempt that follows no redirect: the pin and the token are for one address."""

    def process_redirect(self, exc: Exception) -> Exception | str:
        """The redirect as a failure."""
        return exc


async def open_connection(
    url: str,
    open_timeout: float,
    *,
    ping_interval: float | None = None,
    credentials: Credentials | None = None,
) -> Connection:
    """Open a WebSocket; LinkLost or BadAddress with the reason when that fails.

    `open_timeout` [s] limits the look-up of the name, and again the opening of the connection. With `ping_interval`
    [s] the connection is closed when its other end no longer answers pings.

    With `credentials` it is by TLS whatever the address says, and the other end has to prove that it has that robot's key
    before one byte is sent to it: WrongKey where it does not, NotAccepted where it does not accept the token. A `wss://`
    address without credentials opens without proof, and `Connection.fingerprint` tells which key was seen.
    """
    host, port = host_and_port(url)
    place = f"{host}:{port}"
    parts = urlsplit(url)
    secure = credentials is not None or parts.scheme == "wss"
    try:
        address = await look_up(host, open_timeout)
        ws = await _Connect(
            urlunsplit(parts._replace(scheme="wss" if secure else "ws")),
            host=address,
            port=port,
            compression=None,
            proxy=None,
            create_connection=_pinned(credentials),
            open_timeout=open_timeout,
            ping_interval=ping_interval,
            ping_timeout=ping_interval and ping_interval * 2,
            close_timeout=0.2,
            max_size=MAX_CLIENT_FRAME,
            user_agent_header=None,
            logger=_quiet_log(),
            **_protection(credentials, secure=secure),
        )
    except WrongKey as error:
        name = (credentials and credentials.name) or "this robot"
        raise WrongKey(f"Another robot answers at {place}: its key is not the one of {name}.") from error
    except socket.gaierror as error:
        raise LinkLost(f"No machine called {host} is known on this network.") from error
    except TimeoutError as error:
        raise LinkLost(f"No robot answers at {place} (no reply within {open_timeout:g} s).") from error
    except InvalidStatus as error:
        raise _refusal(place, error.response) from error
    except tls.TlsError as error:
        raise LinkLost(f"What answers at {place} is no robot (it does not speak TLS).") from error
    except (InvalidHandshake, EOFError, ConnectionResetError) as error:
        raise LinkLost(f"What answers at {place} is no robot (it does not speak WebSocket).") from error
    except OSError as error:
        raise LinkLost(f"No robot answers at {place} ({cause(error)}).") from error
    return Connection(ws, (address, port))


def _protection(credentials: Credentials | None, *, secure: bool) -> dict[str, Any]:
    """Options of an attempt: TLS where it is `secure`, and the token."""
    token = credentials.token if credentials else ""
    headers = {"Authorization": f"Bearer {token}"} if token else None
    return {"additional_headers": headers} | ({"ssl": tls.context()} if secure else {})


def _refusal(place: str, response: Response) -> LinkLost:
    """Why a server answered the handshake with an HTTP status, in its own words where it has some."""
    if response.status_code == _UNAUTHORIZED:
        return NotAccepted("This robot does not know this handheld any more; pair again.")
    words = ""
    if response.headers.get("Content-Type", "").startswith("text/plain"):
        words = (response.body or b"")[:_MAX_SENTENCE].decode(errors="replace").partition("\n")[0].strip()
    if not words or not words.isprintable():
        return LinkLost(f"What answers at {place} is no robot (HTTP {response.status_code}).")
    kind = NotProtected if response.status_code == _UPGRADE_REQUIRED else LinkLost
    return kind(f"{place} refuses: {words}")


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
