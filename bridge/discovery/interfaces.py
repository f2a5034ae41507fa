"""The network interfaces of this machine that can broadcast."""

from __future__ import annotations

import socket
import struct
from dataclasses import dataclass

__all__ = ["LOOPBACK", "Interface", "broadcast_addresses", "interfaces"]

_SIOCGIFADDR = 0x8915
_SIOCGIFBRDADDR = 0x8919


@dataclass(frozen=True, slots=True)
class Interface:
    """One of them, with an IPv4 address."""

    address: str
    """This machine's address on it; empty to let the system choose."""
    broadcast: str
    """The address of all on its network."""


LOOPBACK = Interface("127.0.0.1", "127.255.255.255")
"""This machine alone."""


def interfaces() -> list[Interface]:
    """Loopback, then each other interface that is up; loopback alone where the system does not report them."""
    found = {LOOPBACK: None}
    for _, name in socket.if_nameindex():
        address, broadcast = _asked(name, _SIOCGIFADDR), _asked(name, _SIOCGIFBRDADDR)
        if address is not None and broadcast is not None and not address.startswith("127."):
            found[Interface(address, broadcast)] = None
    return list(found)


def broadcast_addresses() -> list[str]:
    """The broadcast addresses of all interfaces, loopback included."""
    return sorted({interface.broadcast for interface in interfaces()})


def _asked(interface: str, what: int) -> str | None:
    """One address of an interface; None when it has none or the system does not report it."""
    try:
        import fcntl
    except ImportError:
        return None
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        try:
            request = struct.pack("256s", interface.encode()[:15])
            answer = fcntl.ioctl(sock.fileno(), what, request)
        except OSError:
            return None
    return socket.inet_ntoa(answer[20:24]) if any(answer[20:24]) else None
