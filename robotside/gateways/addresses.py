"""Listening sockets, and the addresses by which others reach them."""

from __future__ import annotations

import ipaddress
import socket

__all__ = ["EVERYWHERE", "is_here", "listening_socket", "url"]

EVERYWHERE = ("0.0.0.0", "::", "")  # noqa: S104 - compared with, not bound to
"""What a server listens on that is reached by all addresses of its machine."""


def listening_socket(host: str, port: int) -> socket.socket:
    """A TCP socket that listens there; port 0 takes a free one. OSError when that is not possible."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    # asyncio sends small answers at once (TCP_NODELAY) only where the socket says that it is of TCP
    listener = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((host, port))
        listener.listen()
    except OSError:
        listener.close()
        raise
    return listener


def url(scheme: str, host: str, port: int, *, tls: bool = False) -> str:
    """The URL by which other machines reach a server that listens on `host`; this machine's address for all hosts.

    With `tls` it is `wss` in place of `ws`, but on this machine, where programs need no encryption.
    """
    if tls and not is_here(host):
        scheme += "s"
    if host in EVERYWHERE:
        host = _own_address()
    return f"{scheme}://[{host}]:{port}" if ":" in host else f"{scheme}://{host}:{port}"


def is_here(host: str) -> bool:
    """Only this machine reaches what listens on `host`."""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def _own_address() -> str:
    """The address that this machine has towards others; nothing is sent to find it."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))
        except OSError:
            return "127.0.0.1"
        return str(probe.getsockname()[0])
