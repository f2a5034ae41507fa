"""TLS on an accepted connection: what a server insists on, and the upgrade of a transport."""

from __future__ import annotations

import asyncio
import ssl

__all__ = ["HANDSHAKE_TIMEOUT", "harden", "unsent", "upgrade"]

HANDSHAKE_TIMEOUT = 5.0
"""Time for a TLS handshake [s]."""
SHUTDOWN_TIMEOUT = 2.0
"""Time for saying goodbye by TLS [s]."""
_NEVER = 2**62
"""Bytes that the TLS layer never holds."""


def harden(context: ssl.SSLContext) -> ssl.SSLContext:
    """`context`, which from now on takes TLS 1.2 or later, without compression and without renegotiation."""
    context.minimum_version = max(context.minimum_version, ssl.TLSVersion.TLSv1_2)
    context.options |= ssl.OP_NO_COMPRESSION | ssl.OP_NO_RENEGOTIATION
    return context


class _Waiting(asyncio.Protocol):
    """Stands for a protocol until the handshake is over: data may arrive with its last message."""

    def __init__(self) -> None:
        self._early: list[bytes] = []
        self._ended = False
        self._follower: asyncio.Protocol | None = None
        self.lost = False

    def data_received(self, data: bytes) -> None:
        """Keep data for the protocol that follows."""
        self._early.append(data)

    def eof_received(self) -> None:
        """The other end sends nothing more."""
        self._ended = True

    def connection_lost(self, exc: Exception | None) -> None:
        """The connection is gone; the one that followed meanwhile is told."""
        self.lost = True
        if self._follower is not None:
            self._follower.connection_lost(exc)

    def give_way(self, protocol: asyncio.Protocol, transport: asyncio.Transport) -> None:
        """`protocol` takes over, with what came until now."""
        self._follower = protocol
        transport.set_protocol(protocol)
        protocol.connection_made(transport)
        for data in self._early:
            protocol.data_received(data)
        self._early.clear()
        if self._ended:
            protocol.eof_received()


class _Drain(asyncio.BufferedProtocol):
    """Between a socket and its TLS: tells the protocol above when everything it wrote has left the process.

    The TLS layer reports its own buffer alone, and that is empty while the socket still holds what was encrypted.
    """

    def __init__(self, tls: asyncio.BufferedProtocol, above: asyncio.Protocol) -> None:
        self._tls, self._above = tls, above
        self._paused = self._told = False
        self.get_buffer = tls.get_buffer  # type: ignore[method-assign]
        self.buffer_updated = tls.buffer_updated  # type: ignore[method-assign]
        self.eof_received = tls.eof_received  # type: ignore[method-assign]
        self.connection_lost = tls.connection_lost  # type: ignore[method-assign]

    def pause_writing(self) -> None:
        """The socket takes no more."""
        self._paused = True
        self._tls.pause_writing()
        if not self._told:
            self._told = True
            self._above.pause_writing()

    def resume_writing(self) -> None:
        """The socket took everything; what was encrypted meanwhile goes there first."""
        self._paused = False
        self._tls.resume_writing()
        if self._told and not self._paused:
            self._told = False
            self._above.resume_writing()


async def upgrade(
    transport: asyncio.Transport, protocol: asyncio.Protocol, context: ssl.SSLContext
) -> asyncio.Transport:
    """Shake hands by TLS as the server, then hand `protocol` the encrypted transport; `connection_made` is called here.

    From then on `protocol.resume_writing` means that everything written has left the process; limits set on the
    encrypted transport have no effect. OSError when the handshake fails or takes over `HANDSHAKE_TIMEOUT`: then
    `protocol` is not called and the connection is cut.
    """
    transport.set_write_buffer_limits(0)
    waiting = _Waiting()
    try:
        secure = await asyncio.get_running_loop().start_tls(
            transport,
            waiting,
            context,
            server_side=True,
            ssl_handshake_timeout=HANDSHAKE_TIMEOUT,
            ssl_shutdown_timeout=SHUTDOWN_TIMEOUT,
        )
    except BaseException:
        transport.abort()
        raise
    if secure is None or waiting.lost or transport.is_closing():  # some Pythons say so by None
        transport.abort()
        raise ConnectionResetError("The connection was lost in its TLS handshake.")
    below = transport.get_protocol()
    if not isinstance(below, asyncio.BufferedProtocol):
        transport.abort()
        raise ConnectionAbortedError(
            f"TLS is a {type(below).__name__} here, which this program cannot serve."
        )
    transport.set_protocol(_Drain(below, protocol))
    waiting.give_way(protocol, secure)
    secure.set_write_buffer_limits(_NEVER)
    return secure


def unsent(transport: asyncio.Transport, below: asyncio.Transport | None) -> int:
    """Bytes that wait in this process; `below` is the socket's own transport under a TLS one."""
    return transport.get_write_buffer_size() + (below.get_write_buffer_size() if below is not None else 0)
