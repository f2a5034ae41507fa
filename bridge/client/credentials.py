"""Credentials of a client: which robot it expects at the other end, and by what that robot knows it."""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass, field

__all__ = ["Credentials", "fingerprint_of"]

_FINGERPRINT = re.compile("[0-9a-f]{64}")
_TOKEN = re.compile("[!-~]{0,512}")


def fingerprint_of(certificate: bytes) -> str:
    """The fingerprint of a certificate in DER: its SHA-256 in 64 lower-case hex digits."""
    return hashlib.sha256(certificate).hexdigest()


@dataclass(frozen=True, slots=True)
class Credentials:
    """The key of one robot and a client's own key for it, as pairing left them; ValueError for malformed ones."""

    fingerprint: str
    """Fingerprint of the robot's certificate: nothing is sent to a robot with another one."""
    token: str = field(default="", repr=False)
    """A secret by which the robot knows this client; empty before pairing."""
    name: str = ""
    """The robot's name, for sentences; empty when it is not known."""

    @property
    def id(self) -> str:
        """The public id by which the robot knows this client; empty before pairing."""
        return self.token.partition(".")[0]

    def __post_init__(self) -> None:
        """Check the form: the token becomes part of an HTTP header."""
        if _FINGERPRINT.fullmatch(self.fingerprint) is None:
            raise ValueError(f"A fingerprint is 64 hex digits, not {self.fingerprint[:80]!r}.")
        if _TOKEN.fullmatch(self.token) is None:
            raise ValueError("A token is at most 512 printable ASCII characters without spaces.")
