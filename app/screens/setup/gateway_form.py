"""The form of a gateway's URL: what is typed into it becomes the URL, or a sentence of what is wrong."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from urllib.parse import parse_qs, quote, unquote, urlencode, urlsplit

from app.core.robot_docs import ROLES as ROLE_WORDS
from widgets.core.language import brief_figure, mark, tr

__all__ = ["MAX_RATE", "OWN", "ROLES", "SITE", "BadForm", "GatewayForm"]

SITE, OWN = "site", "own"
"""Schemes of the robot's own web site, which has its address, and of a broker of its own."""
ROLES = (("", mark("usual", "role")), *((role, ROLE_WORDS[role]) for role in ("none", "watch", "drive")))
"""What everybody may who shows no token, with words for it."""
MAX_RATE = 50.0
"""Most messages a second of a topic [Hz], as docs/gateways.md says."""


class BadForm(ValueError):
    """What is typed makes no URL; its text is one sentence."""

    def __init__(self, field: str, sentence: str) -> None:
        super().__init__(sentence)
        self.field = field
        """Name of the field that is wrong."""


@dataclass(frozen=True, slots=True)
class GatewayForm:
    """Texts as they were typed."""

    scheme: str = ""
    host: str = ""
    port: str = ""
    path: str = ""
    user: str = ""
    password: str = ""
    role: str = ""
    """Of `ROLES`."""
    rate: str = ""
    """Messages a second of each topic; empty for the usual."""
    payloads: str = ""
    """Keys with commas between; empty for all."""

    @classmethod
    def of(cls, usual: str) -> GatewayForm:
        """What a URL says, such as the usual one; an empty form for one that cannot be read."""
        try:
            parts = urlsplit(usual)
            port = "" if parts.port is None else str(parts.port)
        except ValueError:
            return cls()
        options = {name: values[0] for name, values in parse_qs(parts.query).items()}
        return cls(
            parts.scheme,
            parts.hostname or "",
            port,
            unquote(parts.path).strip("/"),
            role=options.get("role", ""),
            rate=options.get("rate", ""),
            payloads=options.get("payloads", ""),
        )

    def url(self, ports: dict[str, str]) -> str:
        """The URL of this form; `ports` are the usual ones by scheme. BadForm for what makes none."""
        path = "/".join(quote(part) for part in self.path.strip().strip("/").split("/"))
        query = urlencode(dict(self._options()), safe=",")
        if self.scheme == SITE:
            if not path:
                raise BadForm("path", tr("A path of the robot's web site is needed, as in api."))
            return f"{SITE}:/{path}" + (f"?{query}" if query else "")
        host = self.host.strip()
        if not host or any(letter in host for letter in "/@?# "):
            raise BadForm(
                "host",
                tr("An address is a name or numbers, as in 192.168.1.7, not {host!r}.").format(host=host),
            )
        port = self.port.strip() or ports.get(self.scheme, "")
        if not (port.isascii() and port.isdigit() and int(port[:6]) <= 65535):
            raise BadForm("port", tr("A port is 0 to 65535, not {port!r}.").format(port=port))
        whose = quote(self.user.strip(), safe="")
        if self.password:
            whose += f":{quote(self.password, safe='')}"
        where = f"[{host}]" if ":" in host and not host.startswith("[") else host
        url = f"{self.scheme}://{whose}{'@' if whose else ''}{where}:{port}"
        return url + (f"/{path}" if path else "") + (f"?{query}" if query else "")

    def _options(self) -> Iterable[tuple[str, str]]:
        if self.role:
            yield "role", self.role
        rate = self.rate.strip()
        if rate:
            try:
                given = float(rate)
            except ValueError:
                given = 0.0
            if not 0 < given <= MAX_RATE:
                raise BadForm(
                    "rate",
                    tr("The rate is above 0 and at most {max_rate} Hz, not {rate!r}.").format(
                        max_rate=brief_figure(MAX_RATE), rate=rate
                    ),
                )
            yield "rate", rate
        keys = [key for key in (each.strip() for each in self.payloads.split(",")) if key]
        if keys:
            yield "payloads", ",".join(keys)
