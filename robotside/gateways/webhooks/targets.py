"""Where a robot may send events: not wherever somebody wants it to knock in its own network.

Who drives may have them sent to the address that it asks from. Who manages the robot may have them sent elsewhere too, but
neither to this machine, unless it asks from there, nor to addresses that lead to no machine of a network.
"""

from __future__ import annotations

import ipaddress
from typing import NamedTuple
from urllib.parse import urlsplit

from bridge.core.codes import Code
from bridge.core.errors import ProtocolError, Refused
from bridge.core.identity import Role
from bridge.server.reception.reception import plain_host
from robotside.core.notice import Notice

__all__ = ["Asker", "Target", "check_address", "read_target"]

MAX_URL = 1000
"""Characters of a URL."""
_PORTS = {"http": 80, "https": 443}


class Target(NamedTuple):
    """Where events go."""

    secure: bool
    host: str
    port: int
    path: str
    """With its query."""

    @property
    def shown(self) -> str:
        """The server without the path, which may have a secret in it."""
        scheme = "https" if self.secure else "http"
        return (
            f"{scheme}://[{self.host}]:{self.port}"
            if ":" in self.host
            else f"{scheme}://{self.host}:{self.port}"
        )


class Asker(NamedTuple):
    """Who wants events to be sent."""

    address: str
    """The address that it asked from, without a port."""
    role: Role


def read_target(url: str) -> Target:
    """The parts of a URL; ProtocolError with one sentence for what is none that events can be sent to."""
    try:
        parts = urlsplit(url)
        port = parts.port
    except ValueError:
        parts, port = urlsplit(""), None
    plain = url.isascii() and url.isprintable() and " " not in url and len(url) <= MAX_URL
    if not plain or parts.scheme not in _PORTS or not parts.hostname or port == 0:
        raise ProtocolError(f"url must be http://HOST/PATH or https://HOST/PATH, not {url[:100]!r}.")
    if parts.username is not None or parts.password is not None or parts.fragment:
        raise ProtocolError(
            "url has neither a user and password nor a part behind #; the signature proves the sender."
        )
    path = (parts.path or "/") + (f"?{parts.query}" if parts.query else "")
    return Target(parts.scheme == "https", parts.hostname, port or _PORTS[parts.scheme], path)


def check_address(address: str, asker: Asker) -> None:
    """Raises Refused when the robot does not send to an address for who asks; to be asked before each connection."""
    found, own = ipaddress.ip_address(plain_host(address)), plain_host(asker.address)
    nowhere = found.is_multicast or found.is_unspecified or found.is_link_local or found.is_reserved
    if nowhere and not found.is_loopback:
        raise _refused(f"Events are not sent to {found}: it is no address of one machine in a network")
    if found.is_loopback and not _is_loopback(own):
        raise _refused("Events are not sent to the robot's own machine for who asks from elsewhere")
    if asker.role < Role.MANAGE and str(found) != own:
        said = f"Events are sent to the address that you ask from, {own}, and not to {found}; who manages the robot may choose"
        raise _refused(said)


def _refused(said: str) -> Refused:
    return Refused(Notice(Code.WEBHOOK_ADDRESS, f"{said}."))


def _is_loopback(host: str) -> bool:
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False
