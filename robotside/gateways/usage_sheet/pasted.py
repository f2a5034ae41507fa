"""Lines for a shell that reach a robot by HTTP, with and without TLS."""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from urllib.parse import urlsplit

__all__ = ["PLAIN", "SHOWN", "RobotKey", "curl", "is_secure", "without_tls"]

SHOWN = "Authorization: Bearer TOKEN"
"""The header by which who reaches the robot by TLS shows a token, which takes the place of the word TOKEN."""


@dataclass(frozen=True, slots=True)
class RobotKey:
    """By what a client knows the robot behind TLS: no authority has signed for it."""

    pin: str = ""
    """SHA-256 of its public key in base64, as curl's `--pinnedpubkey` takes it; empty without TLS."""
    fingerprint: str = ""
    """SHA-256 of its certificate, 64 lower-case hex digits; empty without TLS."""


PLAIN = RobotKey()
"""Of a robot without TLS."""


def is_secure(url: str) -> bool:
    """Whether a URL is that of TLS."""
    return urlsplit(url).scheme == "https"


def without_tls(url: str) -> str:
    """The same without TLS, by which anyone presses STOP."""
    return urlsplit(url)._replace(scheme="http").geturl() if is_secure(url) else url


def curl(url: str, key: RobotKey) -> str:
    """The options of curl for `url`, each behind a space; behind TLS those by which the robot and its client are known."""
    if not is_secure(url):
        return ""
    known = f" -k --pinnedpubkey {shlex.quote(f'sha256//{key.pin}')}" if key.pin else ""
    return f"{known} -H {shlex.quote(SHOWN)}"
