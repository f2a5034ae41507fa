"""Reception of one listening socket: every accepted connection gets a place, and TLS or not, before its protocol speaks."""

from __future__ import annotations

import asyncio
import contextlib
import ipaddress
import socket
import ssl
from collections.abc import Callable
from typing import Protocol, cast

from bridge.core.address import at_port
from bridge.core.async_tasks import cancel_all
from bridge.server.reception.places import Limits, Place, Places
from bridge.server.reception.tls import harden, upgrade

__all__ = ["FIRST_BYTE_TIMEOUT", "RESERVE_TIME", "Guest", "Reception", "anyone", "plain_host"]

FIRST_BYTE_TIMEOUT = 10.0
"""Time for a connection to say anything, where TLS and plain are told apart by that [s]."""
RESERVE_TIME = 5.0
"""A connection on the reserve, for STOP, is cut after this [s]."""
_LINGER_TIME = 2.0
"""Time for a client that is turned away to read why [s]."""
_MAX_IGNORED_BYTES = 65_536
"""What a client that is turned away may still send [byte]."""
_TLS_HANDSHAKE = 0x16
"""First byte of a TLS connection; HTTP begins with a letter."""


def anyone(_: str) -> bool:
    """Everybody may."""
    return True


class Guest(Protocol):
    """A protocol that is served by a reception: its place, and what is below its transport, are set before `connection_made`.

    It calls `Place.leave` in `connection_lost`.
    """

    place: Place | None
    below: asyncio.Transport | None
    """The socket's own transport under an encrypted one; None without TLS."""


class Reception:
    """Receives the connections of one listening socket. All methods belong to one event loop."""

    def __init__(
        self,
        limits: Limits,
        *,
        tls: ssl.SSLContext | None = None,
        plain_from: Callable[[str], bool] = anyone,
    ) -> None:
        """With `tls` connections may be encrypted; `plain_from(host)` says who may come without."""
        self.places = Places(limits)
        self.tls = None if tls is None else harden(tls)
        self.plain_from = plain_from
        self.closed = False
        self._arriving: set[asyncio.Transport] = set()
        self._tasks: set[asyncio.Task[None]] = set()

    def front(self, guest: Guest) -> asyncio.Protocol:
        """The protocol for a new connection that is to become `guest`'s, an `asyncio.Protocol`."""
        return _Arrival(self, guest)

    async def close(self) -> None:
        """Cut who has not come in yet, and everybody who still comes; to be called when the socket is closed."""
        self.closed = True
        for transport in list(self._arriving):
            transport.abort()
        await cancel_all(self._tasks)

    def keep(self, transport: asyncio.Transport) -> None:
        """A connection is on its way in."""
        self._arriving.add(transport)

    def release(self, transport: asyncio.Transport) -> None:
        """It came in, or is gone."""
        self._arriving.discard(transport)

    def run(self, work: asyncio.Task[None]) -> None:
        """Keep a task until it is done."""
        self._tasks.add(work)
        work.add_done_callback(self._tasks.discard)


class _Arrival(asyncio.Protocol):
    """A connection until its own protocol takes over."""

    def __init__(self, reception: Reception, guest: Guest) -> None:
        self._reception, self._guest = reception, guest
        self._loop = asyncio.get_running_loop()
        self._peeked: socket.socket | None = None
        self._timer: asyncio.TimerHandle | None = None
        self._ignored = 0
        self._transport: asyncio.Transport
        self._place: Place
        self._host = ""

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Take a place, and wait for the first byte where that tells TLS from plain."""
        self._transport = cast(asyncio.Transport, transport)
        peer = transport.get_extra_info("peername")
        self._host = plain_host(peer[0]) if isinstance(peer, tuple) else ""
        self._place = self._reception.places.arrive(neighbourhood(self._host), self._transport.abort)
        if self._reception.closed:
            self._transport.abort()
            return
        if self._place.only_stop:
            self._loop.call_later(RESERVE_TIME, self._end_of_reserve)
        self._reception.keep(self._transport)
        if self._reception.tls is None:
            self._come_in()
            return
        self._transport.pause_reading()
        self._timer = self._loop.call_later(FIRST_BYTE_TIMEOUT, self._transport.abort)
        try:
            self._peeked = transport.get_extra_info("socket").dup()
        except OSError:
            self._transport.abort()  # out of file descriptors
            return
        self._loop.add_reader(self._peeked, self._peek)

    def _end_of_reserve(self) -> None:
        if self._place.only_stop:
            self._transport.abort()

    def _peek(self) -> None:
        """Decide by the first byte, and leave it where it is."""
        if self._peeked is None:
            return
        try:
            first = self._peeked.recv(1, socket.MSG_PEEK)
        except (BlockingIOError, InterruptedError):
            return
        except OSError:
            first = b""
        self._end_peeking()
        self._place.hear()
        if not first or self._transport.is_closing():
            self._transport.abort()
        elif first[0] == _TLS_HANDSHAKE and self._reception.tls is not None:
            self._reception.run(asyncio.create_task(self._encrypt(self._reception.tls)))
        elif self._reception.plain_from(self._host):
            self._come_in()
        else:
            self._turn_away()

    def _end_peeking(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        if self._peeked is not None:
            self._loop.remove_reader(self._peeked)
            self._peeked.close()
            self._peeked = None

    def _come_in(self) -> None:
        """The guest takes over as it is."""
        guest, transport = self._take_over(None)
        transport.set_protocol(guest)
        guest.connection_made(transport)
        if not transport.is_closing():
            transport.resume_reading()

    def _take_over(self, below: asyncio.Transport | None) -> tuple[asyncio.Protocol, asyncio.Transport]:
        self._reception.release(self._transport)
        self._guest.place, self._guest.below = self._place, below
        return cast(asyncio.Protocol, self._guest), self._transport

    async def _encrypt(self, context: ssl.SSLContext) -> None:
        guest, transport = self._take_over(self._transport)
        self._reception.keep(transport)
        try:
            await upgrade(transport, guest, context)
        except OSError:
            self._place.leave()
        except BaseException:
            self._place.leave()
            raise
        finally:
            self._reception.release(transport)

    def _turn_away(self) -> None:
        """Say in one answer of HTTP that it has to come by TLS; what it sends is read, or it would not read the answer."""
        own = self._transport.get_extra_info("sockname")
        said = f"This robot speaks without TLS to its own machine only; use wss://{at_port(str(own[0]), own[1])}.\n"
        head = (
            "HTTP/1.1 426 Upgrade Required\r\nUpgrade: TLS/1.2, HTTP/1.1\r\nConnection: Upgrade, close\r\n"
            f"Content-Type: text/plain; charset=utf-8\r\nContent-Length: {len(said)}\r\n\r\n"
        )
        self._transport.write((head + said).encode())
        with contextlib.suppress(OSError):
            self._transport.write_eof()
        self._timer = self._loop.call_later(_LINGER_TIME, self._transport.abort)
        self._transport.resume_reading()

    def data_received(self, data: bytes) -> None:
        """Ignore what one who is turned away still sends."""
        self._ignored += len(data)
        if self._ignored > _MAX_IGNORED_BYTES:
            self._transport.abort()

    def connection_lost(self, exc: Exception | None) -> None:
        """It is gone before its protocol took over."""
        self._end_peeking()
        self._reception.release(self._transport)
        self._place.leave()


def plain_host(host: str) -> str:
    """An address without its zone, and as IPv4 where it is one written as IPv6."""
    try:
        address = ipaddress.ip_address(host.partition("%")[0])
    except ValueError:
        return host
    mapped = address.ipv4_mapped if isinstance(address, ipaddress.IPv6Address) else None
    return str(mapped or address)


def neighbourhood(host: str) -> str:
    """What counts as one address: an IPv4 address, or the network of an IPv6 one, of which one machine has any number."""
    try:
        address = ipaddress.ip_address(host)
    except ValueError:
        return host
    if isinstance(address, ipaddress.IPv4Address):
        return host
    return str(ipaddress.ip_network((address, 64), strict=False))
