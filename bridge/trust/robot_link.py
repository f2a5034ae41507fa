"""The link to a robot without a secret: what its QR code says while nobody is to be paired.

link = read_link("pilothouse://192.168.1.7:9090?n=Patrol-1")
"""

from __future__ import annotations

from dataclasses import dataclass
from urllib.parse import parse_qsl, quote, urlsplit

from bridge.trust.pairing import HOST, MAX_LINK, MAX_NAME, SCHEME, BadPairing, PairLink

__all__ = ["RobotLink", "read_link"]

_NO_LINK = "This is no link of a robot; one begins with pilothouse:// and is complete."
_YES = "1"


@dataclass(frozen=True, slots=True)
class RobotLink:
    """Where a robot is reached. It proves nothing: who connects checks the robot's certificate by its own keys."""

    host: str
    port: int
    """Of the rosbridge socket; 1 to 65535."""
    secure: bool = False
    """It is reached by TLS."""
    name: str = ""
    """Of the robot, for people."""

    @property
    def text(self) -> str:
        """The link, as in `pilothouse://192.168.1.7:9090?t=1&n=Patrol-1`."""
        tls = f"t={_YES}&" if self.secure else ""
        return f"{SCHEME}://{self._place}?{tls}n={quote(self.name[:MAX_NAME], safe='')}"

    @property
    def url(self) -> str:
        """The address of its rosbridge socket."""
        return f"{'wss' if self.secure else 'ws'}://{self._place}"

    @property
    def _place(self) -> str:
        return f"[{self.host}]:{self.port}" if ":" in self.host else f"{self.host}:{self.port}"

    @classmethod
    def of(cls, url: str, name: str) -> RobotLink:
        """The link to the robot of that `name` whose rosbridge socket has this URL."""
        parts = urlsplit(url)
        return cls(parts.hostname or "", parts.port or 0, parts.scheme == "wss", name)


def read_link(text: str) -> PairLink | RobotLink:
    """The link of a text, with a secret or without; BadPairing for any other text, which may come from any QR code."""
    try:
        parts = urlsplit(text.strip()) if len(text) <= MAX_LINK else None
        host, port = (parts.hostname or "", parts.port or 0) if parts else ("", 0)
        fields = parse_qsl(parts.query, keep_blank_values=True, max_num_fields=8) if parts else []
    except ValueError as error:
        raise BadPairing(_NO_LINK) from error
    said = dict(fields)
    if parts is None or parts.scheme != SCHEME or "s" in said or "c" in said:
        return PairLink.read(text)
    name = said.get("n", "")
    right = HOST.fullmatch(host) and port and not parts.path.strip("/") and len(said) == len(fields)
    if not right or set(said) - {"n", "t"} or said.get("t", _YES) != _YES:
        raise BadPairing(_NO_LINK)
    if len(name) > MAX_NAME or not name.isprintable():
        raise BadPairing(_NO_LINK)
    return RobotLink(host, port, "t" in said, name)
