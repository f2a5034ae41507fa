"""The URL of a gateway as a user writes it: where, with which credentials, and what is carried."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from urllib.parse import parse_qsl, unquote, urlsplit

from bridge.core.address import at_port
from bridge.core.identity import Role
from robotside.gateways.payloads.offered import chosen_keys
from robotside.gateways.payloads.table import KEYS

__all__ = ["MAX_RATE", "OWN", "SITE", "GatewayUrl", "read_url"]

OWN = "own"
"""The scheme of a broker that the robot brings itself."""
SITE = "site"
"""The scheme of a path of the robot's own web site, as in `site:/api`; it has no host and no port."""

MAX_RATE = 50.0
"""Most messages a second of one topic that a gateway sends [Hz]."""
_OPTIONS = ("role", "payloads", "rate")
_PATH = re.compile(r"(/(?!\.\.?(/|$))[\w.~-]+)+", re.ASCII)


@dataclass(frozen=True, slots=True)
class GatewayUrl:
    """Where a gateway listens, or the broker that it goes to."""

    scheme: str
    host: str
    port: int
    path: str = ""
    """Without slashes at its ends."""
    user: str = ""
    password: str = ""
    role: Role | None = None
    """Of who comes without a token; None where it was not said."""
    keys: frozenset[str] = KEYS
    """The payloads that are carried."""
    rate: float = 5.0
    """Most messages a second of each topic [Hz]."""

    @property
    def address(self) -> str:
        """Host and port; empty on the robot's own web site."""
        return "" if self.scheme == SITE else at_port(self.host, self.port)

    @property
    def shown(self) -> str:
        """The URL without credentials and options."""
        if self.scheme == SITE:
            return f"{SITE}:/{self.path}"
        return f"{self.scheme}://{self.address}" + (f"/{self.path}" if self.path else "")


def read_url(text: str, schemes: Mapping[str, int]) -> GatewayUrl:
    """The URL in `text`, of one of the `schemes` with their default ports; ValueError with one sentence for a mistake."""
    known = " or ".join(
        f"{SITE}:/PATH" if scheme == SITE else f"{scheme}://HOST:{port}" for scheme, port in schemes.items()
    )
    try:
        parts = urlsplit(text)
        port = parts.port
    except ValueError as error:
        raise ValueError(f"A URL is written as {known}, not {_safe(text)} ({error}).") from error
    is_whole = (
        bool(_PATH.fullmatch(parts.path)) and not parts.netloc if parts.scheme == SITE else parts.hostname
    )
    if parts.scheme not in schemes or not is_whole or parts.fragment:
        raise ValueError(f"A URL is written as {known}, not {_safe(text)}.")
    options = _options(parts.query)
    return GatewayUrl(
        parts.scheme,
        parts.hostname or "",
        schemes[parts.scheme] if port is None else port,
        unquote(parts.path).strip("/"),
        unquote(parts.username or ""),
        unquote(parts.password or ""),
        _role(options["role"]) if "role" in options else None,
        chosen_keys([word for word in options.get("payloads", "").split(",") if word]),
        _rate(options.get("rate", "5")),
    )


def _options(query: str) -> dict[str, str]:
    pairs = parse_qsl(query, keep_blank_values=True)
    options = dict(pairs)
    unknown = sorted(set(options) - set(_OPTIONS))
    if unknown or len(pairs) != len(options):
        said = f"not {', '.join(unknown)}" if unknown else "and each of them once"
        raise ValueError(f"The options of a URL are {', '.join(_OPTIONS)}, {said}.")
    return options


def _role(text: str) -> Role:
    """The role of who has no token; whoever manages the robot needs one."""
    role = Role.read(text)
    if role > Role.DRIVE:
        raise ValueError(f"The role of everybody is none, watch or drive, not {role.word}.")
    return role


def _rate(text: str) -> float:
    try:
        rate = float(text)
    except ValueError:
        rate = math.nan
    if not 0 < rate <= MAX_RATE:
        raise ValueError(f"The rate is above 0 and at most {MAX_RATE:g} Hz, not {text!r}.")
    return rate


def _safe(text: str) -> str:
    """`text` for a sentence: without what may be a password."""
    scheme, mark, rest = text.partition("://")
    return repr(f"{scheme}{mark}{rest.rpartition('@')[2]}"[:100])
