"""The beacon of a robot: twice a second it announces itself on the local network by UDP.

A hello is one JSON object in one datagram to port 48900. It leaves by the interfaces that the robot listens on, and names
the robot's address on that interface; a robot that listens on this machine alone announces itself to nobody else.
"""

from __future__ import annotations

import asyncio
import contextlib
import ipaddress
import logging
import math
import socket
import time
from collections.abc import Callable, Iterable
from typing import Any
from urllib.parse import urlsplit, urlunsplit

import msgspec

from bridge.core.address import at_port
from bridge.core.async_tasks import UntilClosed
from bridge.core.errors import BridgeError, ProtocolError
from bridge.discovery.hello import Hello, is_loopback, read_hello, write_hello
from bridge.discovery.interfaces import LOOPBACK, Interface, interfaces

__all__ = ["PORT", "Beacon", "Hello", "Listener", "named"]

log = logging.getLogger(__name__)

PORT = 48900
"""UDP port of the hellos."""
PERIOD = 0.5
"""Time between two hellos [s]."""
LOG_PERIOD = 60.0
"""Between two log lines about datagrams that are no HELLO [s]: strangers cause them."""
EVERYWHERE = ("", "0.0.0.0", "::")  # noqa: S104 - compared with, not bound to
"""Hosts that stand for every interface."""
_PLAIN = {"wss": "ws", "https": "http"}
"""What a robot speaks on loopback, by what it speaks elsewhere."""


class Beacon:
    """Sends hellos until it is closed."""

    def __init__(
        self,
        hello: Callable[[], Hello],
        *,
        host: str = "",
        port: int = PORT,
        addresses: Callable[[], Iterable[str]] | None = None,
        networks: Callable[[], Iterable[Interface]] = interfaces,
        period: float = PERIOD,
    ) -> None:
        """`hello` is called for each time. `host` is what the robot listens on: a name, an address or empty for all.

        `addresses` returns the addresses to send to instead, by any interface and with the hello as it is.
        `networks` are this machine's interfaces.
        """
        self._hello = hello
        self._host, self._port = host, port
        self._addresses, self._networks = addresses, networks
        self._period = period
        self._work = UntilClosed(self._repeat)

    async def run(self) -> None:
        """Send a hello every `period` [s] until `close()`. A network that is down now is tried again next time."""
        await self._work.run()

    async def close(self) -> None:
        """Stop sending, also before the first; `run` returns."""
        await self._work.close()

    async def _repeat(self) -> None:
        reported = False
        while True:
            try:
                self._send(self._hello(), await self._ways())
                reported = False
            except OSError as fault:
                # being found is a convenience: its faults must never end the robot side
                if not reported:
                    log.warning("cannot say hello on the network: %s", fault.strerror or fault)
                reported = True
            await asyncio.sleep(self._period)

    async def _ways(self) -> list[Interface]:
        """The interfaces to announce the robot on, looked up each time: networks come and go."""
        if self._addresses is not None:
            return [Interface("", address) for address in self._addresses()]
        if self._host in EVERYWHERE:
            return list(self._networks())
        nearby = Interface("", LOOPBACK.broadcast)
        if ":" in self._host or is_loopback(self._host):
            return [nearby]  # an IPv6 address: nobody who hears an IPv4 broadcast can be told of it
        address = await _resolved(self._host)
        if is_loopback(address):
            return [nearby]
        mine = [network for network in self._networks() if network.address == address]
        return mine or [Interface(address, "255.255.255.255")]

    def _send(self, hello: Hello, ways: Iterable[Interface]) -> None:
        for way in ways:
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock, contextlib.suppress(OSError):
                sock.setblocking(False)
                sock.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
                sock.bind((way.address, 0))
                sock.sendto(write_hello(named(hello, way.address)), (way.broadcast, self._port))


async def _resolved(host: str) -> str:
    """The IPv4 address of `host`. OSError when it has none."""
    try:
        return str(ipaddress.IPv4Address(host))
    except ValueError:
        found = await asyncio.get_running_loop().getaddrinfo(host, None, family=socket.AF_INET)
        return str(found[0][4][0])


def named(hello: Hello, address: str) -> Hello:
    """The hello with `address` as the host of its URLs, plain on loopback; as it is where `address` is empty."""
    if not address:
        return hello
    return msgspec.structs.replace(
        hello, url=_at(hello.url, address), http=hello.http and _at(hello.http, address)
    )


def _at(url: str, address: str) -> str:
    parts = urlsplit(url)
    scheme = _PLAIN.get(parts.scheme, parts.scheme) if is_loopback(address) else parts.scheme
    place = address if parts.port is None else at_port(address, parts.port)
    return urlunsplit(parts._replace(scheme=scheme, netloc=place))


class Listener:
    """Receives the hellos of all robots of one discovery domain on the local network."""

    def __init__(
        self,
        on_hello: Callable[[Hello, tuple[str, int]], None],
        *,
        port: int = PORT,
        host: str = "",
        domain: str = "",
    ) -> None:
        """`on_hello(hello, (host, port))` is called with each hello of this `domain` and the address that it came from."""
        self.port = port
        """UDP port; with 0 a free one, known after `start()`."""
        self._host, self._domain = host, domain
        self._on_hello = on_hello
        self.refused = 0
        """Datagrams that were no HELLO."""
        self._said_at = -math.inf
        self._transport: asyncio.DatagramTransport | None = None
        self._gone: asyncio.Future[None] | None = None

    async def start(self) -> None:
        """Begin to listen, beside other listeners on this machine; BridgeError when that is not possible."""
        loop = asyncio.get_running_loop()
        self._gone = loop.create_future()
        sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            sock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            sock.bind((self._host, self.port))
        except OSError as error:
            sock.close()
            raise BridgeError(f"Cannot listen for robots on port {self.port} ({error.strerror}).") from error
        self.port = sock.getsockname()[1]
        gone = self._gone
        self._transport, _ = await loop.create_datagram_endpoint(
            lambda: _HelloReceiver(self._receive, gone), sock=sock
        )

    async def close(self) -> None:
        """Stop listening."""
        if self._transport is not None and self._gone is not None:
            self._transport.close()
            await self._gone
            self._transport = None

    def _receive(self, datagram: bytes, host: str, port: int) -> None:
        try:
            hello = read_hello(datagram, host)
        except ProtocolError as fault:
            self.refused += 1
            now = time.monotonic()
            if now - self._said_at >= LOG_PERIOD:
                self._said_at = now
                log.info("%d datagrams were no HELLO; the last, from %s: %s", self.refused, host, fault)
            return
        if hello.domain == self._domain:
            self._on_hello(hello, (host, port))


class _HelloReceiver(asyncio.DatagramProtocol):
    def __init__(self, on_datagram: Callable[[bytes, str, int], None], gone: asyncio.Future[None]) -> None:
        self._on_datagram = on_datagram
        self._gone = gone

    def datagram_received(self, data: bytes, addr: tuple[str | Any, int]) -> None:
        self._on_datagram(data, str(addr[0]), addr[1])

    def connection_lost(self, exc: Exception | None) -> None:
        if not self._gone.done():
            self._gone.set_result(None)
