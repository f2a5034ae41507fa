"""The UDP socket of the CoAP gateway, as aiocoap's message layer wants one.

aiocoap's own sockets take one datagram in each step of the loop and all that come. Here a step takes many, and what is too
much is dropped before it costs anything, so that STOP is among what is heard whatever else comes.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import re
import socket
from typing import Any, NamedTuple

from aiocoap.message import Message
from aiocoap.numbers.codes import Code as CoapCode
from aiocoap.numbers.constants import TransportTuning
from aiocoap.numbers.types import ACK, CON, RST

from bridge.core.address import at_port
from bridge.server.reception.log_limit import STRANGERS
from robotside.gateways.coap.flood_guard import FloodGuard

__all__ = ["MAX_DATAGRAM", "DatagramSocket", "Endpoint", "Tuning", "is_stop"]

log = logging.getLogger(__name__)
log.addFilter(STRANGERS)

MAX_DATAGRAM = 2048
"""What is read of a datagram [byte]; CoAP puts longer messages into blocks of 1024 bytes."""
MAX_TOKEN = 8
"""Bytes of a token; CoAP has no longer ones, which aiocoap takes."""
MAX_BURST = 64
"""Datagrams that are read in one step of the loop."""
MAX_HEARD = 8
"""Those of them that are more than dropped: a request takes the robot half a millisecond, and others have their turn between."""
ACK_LIFETIME = 15.0
"""No acknowledgement comes later than this [s]: aiocoap has given up."""
STOP_PATH = ("stop",)
_LOOKS_LIKE_STOP = re.compile(rb"[\x04\x14\x24\x34\x44\x54\x64\x74\x84\x94\xa4\xb4]stop")
"""The option of a path of four characters, after any other option."""


class Tuning(TransportTuning):  # type: ignore[misc]  # aiocoap has no types
    """Times of messages of the robot: who does not acknowledge within some ten seconds is gone."""

    ACK_TIMEOUT = 1.0
    MAX_RETRANSMIT = 2
    EMPTY_ACK_DELAY = 1.5
    """An answer so soon after its request is one message with the acknowledgement [s]: a client repeats a request after 2 s at the
    earliest, and libcoap 4.3.1 cannot put blocks together that come apart from it."""
    EXCHANGE_LIFETIME = 50.0
    """A request is the same as one with its number before for so long [s]: a client repeats one for at most 45 s."""


class _Unanswered(NamedTuple):
    """A message that is to be acknowledged."""

    number: int
    at: float
    over: asyncio.Event


class Endpoint:
    """The other end, as aiocoap knows it."""

    scheme = "coap"
    is_multicast = False
    is_multicast_locally = False
    maximum_block_size_exp = 6
    maximum_payload_size = 1024
    authenticated_claims = ()

    def __init__(self, host: str, port: int, own: str, address: Any) -> None:
        """`own` is the robot's host and port, `address` that of the socket module."""
        self.host, self.port, self.address = host, port, address
        self.hostinfo, self.hostinfo_local = at_port(host, port), own
        self.uri_base, self.uri_base_local = f"coap://{self.hostinfo}", f"coap://{own}"
        self.blockwise_key = (host, port)

    def as_response_address(self) -> Endpoint:
        """Where answers go."""
        return self

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Endpoint) and self.blockwise_key == other.blockwise_key

    def __hash__(self) -> int:
        return hash(self.blockwise_key)

    def __repr__(self) -> str:
        return self.hostinfo


def is_stop(message: Any) -> bool:
    """Whether a request presses STOP; reading it does not."""
    return bool(
        message.code.is_request() and message.code != CoapCode.GET and message.opt.uri_path == STOP_PATH
    )


class DatagramSocket:
    """Fits aiocoap's `MessageInterface`."""

    def __init__(self, sock: socket.socket, manager: Any, guard: FloodGuard) -> None:
        """`sock` is bound and does not block; it is closed by `shutdown`."""
        self._sock, self._manager, self._guard = sock, manager, guard
        host, self.port = sock.getsockname()[:2]
        self._own = at_port(host, self.port)
        self._loop = asyncio.get_running_loop()
        self._unanswered: dict[Endpoint, _Unanswered] = {}
        self._loop.add_reader(sock, self._read)

    async def acknowledged(self, remote: Endpoint) -> None:
        """Wait until it has acknowledged what it was sent to be acknowledged."""
        while remote in self._unanswered:
            await self._unanswered[remote].over.wait()

    def forget(self, remote: Endpoint) -> None:
        """Nothing more is awaited from it."""
        unanswered = self._unanswered.pop(remote, None)
        if unanswered is not None:
            unanswered.over.set()

    def sweep(self) -> None:
        """Forget what will never be acknowledged; to be called every second or so."""
        now = self._loop.time()
        for remote, each in list(self._unanswered.items()):
            if now - each.at > ACK_LIFETIME:
                self.forget(remote)

    def send(self, message: Any) -> None:
        """Send a message; one that the network does not take at once is lost, as any datagram may be."""
        remote = message.remote
        if message.mtype is CON:
            before = self._unanswered.get(remote)
            if before is None or before.number != message.mid:
                self.forget(remote)
                self._unanswered[remote] = _Unanswered(message.mid, self._loop.time(), asyncio.Event())
        data = message.encode()
        if self._manager is not None and self._guard.sends(remote.host, len(data), self._loop.time()):
            with contextlib.suppress(OSError):
                self._sock.sendto(data, remote.address)

    async def shutdown(self) -> None:
        """Close the socket."""
        self._manager = None
        for remote in list(self._unanswered):
            self.forget(remote)
        self._loop.remove_reader(self._sock)
        self._sock.close()

    async def recognize_remote(self, remote: object) -> bool:
        """Whether an endpoint is of this socket."""
        return isinstance(remote, Endpoint)

    async def determine_remote(self, message: object) -> None:
        """The robot asks nobody."""

    def _read(self) -> None:
        heard = 0
        for _ in range(MAX_BURST):
            try:
                data, address = self._sock.recvfrom(MAX_DATAGRAM)
            except (BlockingIOError, InterruptedError):
                return
            except OSError as error:
                log.info("A datagram cannot be read: %s", error)
                return
            try:
                heard += self._hear(data, address)
            except Exception:
                log.exception("A datagram from %s was not understood", address[0])
            if self._manager is None or heard >= MAX_HEARD:
                return

    def _hear(self, data: bytes, address: Any) -> bool:
        """Handle a datagram; False for one that was dropped."""
        host, port = address[:2]
        now, message = self._loop.time(), None
        if _LOOKS_LIKE_STOP.search(data):
            message = _decoded(data, Endpoint(host, port, self._own, address))
            if message is not None and is_stop(message) and self._guard.hears_stop(now):
                self._dispatch(message)
                return True
        if not self._guard.hears(host, port, now):
            return False
        self._dispatch(message or _decoded(data, Endpoint(host, port, self._own, address)))
        return True

    def _dispatch(self, message: Any) -> None:
        if message is None or self._manager is None:
            return
        self._manager.dispatch_message(message)  # which ends the observation of who answers by a reset
        unanswered = self._unanswered.get(message.remote)
        if message.mtype in (ACK, RST) and unanswered is not None and unanswered.number == message.mid:
            self.forget(message.remote)


def _decoded(data: bytes, remote: Endpoint) -> Any:
    """The message in a datagram; None for one that is none, which CoAP passes over."""
    if not data or data[0] & 0x0F > MAX_TOKEN:
        return None
    try:
        message = Message.decode(data, remote=remote)
    except Exception as error:  # noqa: BLE001 - strangers send anything, and aiocoap raises many kinds
        log.info("A datagram of %s is no CoAP message: %s", remote, error)
        return None
    message.transport_tuning = Tuning()
    return message
