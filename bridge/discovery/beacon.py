"""The beacon of a robot: twice a second it announces itself on the local network by UDP.

A hello is one JSON object in one datagram to port 48900, broadcast on each interface and on loopback.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import math
import socket
import struct
from collections.abc import Callable, Iterable
from typing import Any, ClassVar

from bridge.codec import from_json, to_json
from bridge.core.async_tasks import is_cancelled_from_outside
from bridge.core.errors import BridgeError, ProtocolError
from bridge.msgs import Msg

__all__ = ["PORT", "Beacon", "Hello", "Listener", "broadcast_addresses"]

log = logging.getLogger(__name__)

PORT = 48900
"""UDP port of the hellos."""
PERIOD = 0.5
"""Time between two hellos [s]."""
_SIOCGIFBRDADDR = 0x8919
_LOOPBACK = "127.255.255.255"


class Hello(Msg, frozen=True, gc=False):
    """A robot's announcement of itself."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Hello"
    name: str = ""
    """Its name for people, as in `Patrol-1`."""
    kind: str = ""
    """As in `RobotInfo.kind`."""
    model: str = ""
    description: str = ""
    """The kind in plain words."""
    icon: str = ""
    """As in `RobotInfo.icon`."""
    url: str = ""
    """URL of its bridge, as in `ws://192.168.1.7:9090`."""
    http: str = ""
    """URL of its web page; empty when it has none."""
    battery: float = math.nan
    """Charge, 0 empty to 1 full; NaN when it is not known."""
    driver: str = ""
    """Name of the client that has control; empty when control is free."""
    driver_id: str = ""
    """The `client_id` that has control; two handhelds may have one name, but not one id."""
    boot: str = ""
    """Identity of this run of the robot side."""


class Beacon:
    """Sends hellos until it is closed."""

    def __init__(
        self,
        hello: Callable[[], Hello],
        *,
        port: int = PORT,
        addresses: Callable[[], Iterable[str]] | None = None,
        period: float = PERIOD,
    ) -> None:
        """`hello` is called for each datagram. `addresses` returns the addresses to send to; by default all broadcast
        addresses."""
        self._hello = hello
        self._port = port
        self._addresses = addresses or broadcast_addresses
        self._period = period
        self._work: asyncio.Task[None] | None = None

    async def run(self) -> None:
        """Send a hello every `period` [s] until `close()`. A network that is down now is tried again next time."""
        self._work = asyncio.create_task(self._repeat())
        try:
            await self._work
        except asyncio.CancelledError:
            if is_cancelled_from_outside():
                raise

    async def close(self) -> None:
        """Stop sending; `run` returns."""
        if self._work is not None:
            self._work.cancel()
            await asyncio.wait({self._work})

    async def _repeat(self) -> None:
        reported = False
        while True:
            try:
                self._send(to_json(self._hello()))
                reported = False
            except OSError as fault:
                # being found is a convenience: its faults must never end the robot side
                if not reported:
                    log.warning("cannot say hello on the network: %s", fault.strerror or fault)
                reported = True
            await asyncio.sleep(self._period)

    def _send(self, datagram: bytes) -> None:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
            sock.setblocking(False)
            sock.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
            for address in self._addresses():
                with contextlib.suppress(OSError):
                    sock.sendto(datagram, (address, self._port))


class Listener:
    """Receives the hellos of all robots on the local network."""

    def __init__(
        self, on_hello: Callable[[Hello, tuple[str, int]], None], *, port: int = PORT, host: str = ""
    ) -> None:
        """`on_hello(hello, (host, port))` is called with each hello and the address that it came from."""
        self.port = port
        """UDP port; with 0 a free one, known after `start()`."""
        self._host = host
        self._on_hello = on_hello
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
            lambda: _HelloReceiver(self._on_hello, gone), sock=sock
        )

    async def close(self) -> None:
        """Stop listening."""
        if self._transport is not None and self._gone is not None:
            self._transport.close()
            await self._gone
            self._transport = None


class _HelloReceiver(asyncio.DatagramProtocol):
    def __init__(
        self, on_hello: Callable[[Hello, tuple[str, int]], None], gone: asyncio.Future[None]
    ) -> None:
        self._on_hello = on_hello
        self._gone = gone

    def datagram_received(self, data: bytes, addr: tuple[str | Any, int]) -> None:
        try:
            hello = from_json(data, Hello)
        except ProtocolError:
            return
        if hello.name and hello.url:
            self._on_hello(hello, (addr[0], addr[1]))

    def connection_lost(self, exc: Exception | None) -> None:
        if not self._gone.done():
            self._gone.set_result(None)


def broadcast_addresses() -> list[str]:
    """The broadcast addresses of all interfaces, loopback included."""
    found = {_LOOPBACK}
    for _, name in socket.if_nameindex():
        address = _broadcast_address(name)
        if address is not None:
            found.add(address)
    return sorted(found)


def _broadcast_address(interface: str) -> str | None:
    """The broadcast address of one interface; None when it has none or the system does not report it."""
    try:
        import fcntl
    except ImportError:
        return None
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        try:
            request = struct.pack("256s", interface.encode()[:15])
            answer = fcntl.ioctl(sock.fileno(), _SIOCGIFBRDADDR, request)
        except OSError:
            return None
    address = socket.inet_ntoa(answer[20:24])
    return address if any(answer[20:24]) else None
