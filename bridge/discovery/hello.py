"""HELLO: what a robot announces of itself, and the one place where such a datagram is checked.

Anybody on the network can send one, so nothing in it is believed: it is small, each field has bounds, and it names no
other address than the one that it came from.
"""

from __future__ import annotations

import ipaddress
import math
import re
from typing import ClassVar
from urllib.parse import urlsplit

import msgspec

from bridge.codec import from_json, to_json
from bridge.core.errors import ProtocolError
from bridge.discovery.domain import DOMAIN
from bridge.msgs import Msg

__all__ = ["MAX_DATAGRAM", "Hello", "host_of", "is_loopback", "port_of", "read_hello", "tidy", "write_hello"]

MAX_DATAGRAM = 4096
"""A longer datagram is no HELLO [bytes]."""
MAX_BOOT = 64
"""Characters of `Hello.boot`."""
MAX_URL = 300
"""Characters of a URL."""
MAX_TEXT = {"name": 64, "driver": 64, "kind": 32, "model": 64, "icon": 48, "description": 160}
"""Characters of the fields that are words; longer ones are cut."""
NAMELESS = "somebody"
"""Who has control under a name in which there is nothing to read."""

_LABEL = r"[a-zA-Z0-9_](?:[a-zA-Z0-9_-]{0,61}[a-zA-Z0-9_])?"
_URL = re.compile(
    rf"(?P<scheme>[a-z]{{2,5}})://(?P<host>\[[0-9a-fA-F:.]{{2,45}}\]|{_LABEL}(?:\.{_LABEL}){{0,20}})"
    r"(?::(?P<port>[1-9][0-9]{0,4}))?(?P<path>(?:/[a-zA-Z0-9._~/-]{0,100})?)"
)
_KEY = re.compile(r"(?:[0-9a-f]{32})?")
_BOOT = re.compile(rf"[!-~]{{0,{MAX_BOOT}}}")


class Hello(Msg, frozen=True, gc=False):
    """A robot's announcement of itself. Everything in it is a claim."""

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
    """Empty; a robot tells who has control to nobody but its clients."""
    boot: str = ""
    """Identity of this run of the robot side."""
    reached: bool = True
    """Whoever says this hears the robot itself: a surveillance centre may have lost it."""
    key: str = ""
    """The first 32 hex digits of its certificate's SHA-256; empty when it has none. Only TLS proves it."""
    domain: str = ""
    """Its discovery domain; empty for that of everybody who names none."""


def read_hello(datagram: bytes, source: str) -> Hello:
    """The HELLO in a datagram from the address `source`. ProtocolError, in one sentence, for anything else.

    Words lose signs that cannot be seen and are cut to their bounds. An address has to be `source` itself; only this
    machine, by loopback, may name any.
    """
    if len(datagram) > MAX_DATAGRAM:
        raise ProtocolError(f"A HELLO has at most {MAX_DATAGRAM} bytes, not {len(datagram)}.")
    hello = tidy(from_json(datagram, Hello))
    if not hello.name:
        raise ProtocolError("A HELLO needs a name.")
    if not (math.isnan(hello.battery) or 0.0 <= hello.battery <= 1.0):
        raise ProtocolError(f"battery is 0 to 1, not {hello.battery}.")
    if not _BOOT.fullmatch(hello.boot):
        raise ProtocolError(f"boot has at most {MAX_BOOT} letters, digits and signs, and no spaces.")
    if not _KEY.fullmatch(hello.key):
        raise ProtocolError("key is empty or 32 hex digits.")
    if not DOMAIN.fullmatch(hello.domain):
        raise ProtocolError("domain has at most 32 letters, digits, _ and -.")
    url = _checked_url("url", hello.url, ("ws", "wss"), source)
    http = hello.http and _checked_url("http", hello.http, ("http", "https"), source)
    return msgspec.structs.replace(hello, url=url, http=http, driver_id="")


def write_hello(hello: Hello) -> bytes:
    """The datagram of a HELLO, its words within their bounds."""
    return to_json(tidy(hello))


def tidy(hello: Hello) -> Hello:
    """The HELLO with each of its words on one line, within bounds and without invisible signs."""
    words = {key: _plain(getattr(hello, key), most) for key, most in MAX_TEXT.items()}
    if hello.driver and not words["driver"]:
        words["driver"] = NAMELESS  # a driver without a name drives all the same
    return msgspec.structs.replace(hello, **words)


def host_of(url: str) -> str:
    """The host in a URL that was checked; of an IPv6 address without brackets."""
    return urlsplit(url).hostname or ""


def port_of(url: str) -> int | None:
    """The port in a URL that was checked; None where it names none."""
    return urlsplit(url).port


def is_loopback(host: str) -> bool:
    """Whether `host`, a name or an address, is this machine by loopback."""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def _plain(text: str, most: int) -> str:
    """`text` without control, format and direction signs, blanks made one each, cut to `most` characters."""
    words = "".join(
        sign if sign.isprintable() else " " if sign.isspace() else "" for sign in text[: 8 * most]
    )
    return " ".join(words.split())[:most].rstrip()


def _checked_url(field: str, url: str, schemes: tuple[str, ...], source: str) -> str:
    """The URL in its one spelling. ProtocolError when it is none, or names another address than `source`."""
    found = _URL.fullmatch(url) if len(url) <= MAX_URL else None
    if found is None or found["scheme"] not in schemes or int(found["port"] or 1) > 65535:
        raise ProtocolError(f"{field} is as in {schemes[0]}://192.168.1.7:9090, not {url[:60]!r}.")
    host = found["host"].lower()
    if host.startswith("["):
        host = f"[{_address(field, host[1:-1])}]"
    if host.strip("[]") != source and not is_loopback(source):
        raise ProtocolError(f"{field} names {host[:60]}, and the HELLO came from {source}.")
    port = f":{found['port']}" if found["port"] else ""
    return f"{found['scheme']}://{host}{port}{found['path'].rstrip('/')}"


def _address(field: str, text: str) -> str:
    try:
        return str(ipaddress.IPv6Address(text))
    except ValueError:
        raise ProtocolError(f"{field} has no valid address in brackets, but {text[:60]!r}.") from None
