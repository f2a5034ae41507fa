"""Web pages that may speak to a robot: the check of `Origin` and `Host`, for WebSockets and HTTP alike.

A browser lets every page open a WebSocket to any address, this machine's included, and send forms there; it says in
`Origin` whose page it is. A page can also have its own name resolved to the robot's address (DNS rebinding); then the
name is in `Host`. Programs send no `Origin`.
"""

from __future__ import annotations

import ipaddress
import logging
import re
import socket
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple
from urllib.parse import urlsplit

__all__ = ["PagePolicy", "Verdict", "read_origin"]

log = logging.getLogger(__name__)

MAX_LOGGED = 100
"""Refused pages and names that are logged, each once."""
_ORIGIN = re.compile(
    r"[a-z][a-z0-9+.-]*://[a-z0-9._~%-]+(?::\d{1,5})?|[a-z][a-z0-9+.-]*://\[[0-9a-f:.]+\](?::\d{1,5})?"
)
_DEFAULT_PORTS = {"http": 80, "https": 443}


class Verdict(NamedTuple):
    """What is thought of one request."""

    refusal: str
    """One sentence; empty when it is taken."""
    trusted: bool
    """It counts as a program: it is one, or a page of the robot itself or one that was allowed."""
    own: bool = False
    """It comes from a program or from a page of the robot itself, so that the robot's cookie counts."""


def read_origin(text: str) -> str:
    """An origin as browsers write it, as in `http://localhost:8000`; ValueError with one sentence for anything else."""
    origin = text.strip().lower().removesuffix("/")
    if origin == "null":
        raise ValueError(
            "The origin null is that of any sandboxed page; serve the page by HTTP, as with "
            "python -m http.server 8000, and allow http://localhost:8000."
        )
    if not _ORIGIN.fullmatch(origin):
        raise ValueError(f"An origin is written as http://localhost:8000, not {text[:100]!r}.")
    parts = urlsplit(origin)
    port = int(origin.rpartition(":")[2]) if re.search(r":\d+$", origin) else None
    if port is not None and not 0 < port < 65536:
        raise ValueError(f"A port is 1 to 65535, not {port}, in the origin {text[:100]!r}.")
    return origin.rpartition(":")[0] if port == _DEFAULT_PORTS.get(parts.scheme, -1) else origin


class PagePolicy:
    """Decides which pages may speak to one robot."""

    def __init__(
        self,
        allowed: Iterable[str] = (),
        names: Iterable[str] = (),
        web_port: Callable[[], int] = int,
    ) -> None:
        """`allowed` are origins of pages that may, `names` further names of this robot, as in its certificate.

        `web_port()` is the port of the robot's own pages, 0 when it has none. ValueError for an origin that is none.
        """
        self._allowed = {read_origin(each) for each in allowed}
        hosts = {urlsplit(origin).hostname or "" for origin in self._allowed}
        self._names = _machine_names() | {name.lower() for name in names} | hosts
        self._web_port = web_port
        self._logged: set[str] = set()

    @property
    def cookie_name(self) -> str:
        """Name of the cookie that holds a token; browsers do not tell ports apart, several robots of one machine do."""
        return f"pilothouse_{self._web_port()}"

    def judge(self, origins: Sequence[str], hosts: Sequence[str]) -> Verdict:
        """Judge a request by its `Origin` and `Host` headers."""
        if len(hosts) > 1 or len(origins) > 1:
            return Verdict("A request has one Host and one Origin.", trusted=False)
        host = _host(hosts[0]) if hosts else ""
        if hosts and not self._is_own(host):
            self._log_once(
                hosts[0], "Requests to the name %s were refused", f"http://{host}" if host else "", hosts[0]
            )
            return Verdict(
                "This robot does not go by that name; its log says how to allow it.", trusted=False
            )
        if not origins:
            return Verdict("", trusted=True, own=True)
        return self._judge_page(origins[0], host)

    def _judge_page(self, text: str, host: str) -> Verdict:
        try:
            origin = read_origin(text)
        except ValueError as problem:
            self._log_once(text, "A page was refused. %s", "", str(problem))
            return Verdict("Pages of this origin are refused; the robot's log says why.", trusted=False)
        if self._is_own_page(origin, host):
            return Verdict("", trusted=True, own=True)
        if origin in self._allowed:
            return Verdict("", trusted=True)
        self._log_once(origin, "A page of %s was refused", origin, origin)
        return Verdict(
            "Pages of this origin are refused; the robot's log says how to allow them.", trusted=False
        )

    def _is_own_page(self, origin: str, host: str) -> bool:
        """Whether it is the robot's own web site, which went by the same name as the request."""
        parts = urlsplit(origin)
        port = self._web_port()
        own = (parts.port or _DEFAULT_PORTS.get(parts.scheme)) == port
        page = _host(origin.partition("://")[2])
        same = page == host or (_is_loopback(page) and _is_loopback(host))
        return parts.scheme in _DEFAULT_PORTS and bool(port) and own and same and self._is_own(page)

    def _is_own(self, host: str) -> bool:
        """Whether a request to `host` was meant for this machine; an address cannot be another's name."""
        return _is_address(host) or _is_loopback(host) or host in self._names

    def _log_once(self, key: str, said: str, option: str, shown: str) -> None:
        if key in self._logged or len(self._logged) >= MAX_LOGGED:
            return
        self._logged.add(key)
        line = said % shown[:200].encode("ascii", "backslashreplace").decode()
        log.warning("%s; --allow-origin %s lets them in." if option else "%s%s", line, option)


def _host(text: str) -> str:
    """The host of a `Host` header or of an origin's end, without its port; empty when it is none."""
    found = re.fullmatch(r"(\[[0-9a-fA-F:.]+\]|[\w.~%-]+)(?::\d{1,5})?", text.strip(), re.ASCII)
    return found[1].lower().strip("[]").removesuffix(".") if found else ""


def _is_address(host: str) -> bool:
    try:
        ipaddress.ip_address(host)
    except ValueError:
        return False
    return True


def _is_loopback(host: str) -> bool:
    if host == "localhost" or host.endswith(".localhost"):
        return True
    return _is_address(host) and ipaddress.ip_address(host).is_loopback


def _machine_names() -> set[str]:
    """The names by which other machines know this one, as far as it knows without asking anybody."""
    name = socket.gethostname().lower()
    short = name.partition(".")[0]
    return {name, short, f"{short}.local"} - {""}
