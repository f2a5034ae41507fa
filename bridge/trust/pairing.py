"""Pairing: the link and the code by which a robot and a handheld come to know each other, as both ends read them.

The link is shown as a QR code; the code is for people without a camera. Both are for one use and run out.

With the link the handheld connects by TLS, compares the certificate with the link's before it sends anything, and calls
`/pair/scan` with the link's secret. With the code it connects by TLS to a robot that it does not know yet and runs SPAKE2
(library `spake2`) as side A, with the ids of `sides` made from the certificate that it sees: `/pair/begin` swaps the two
messages, `/pair/finish` the two confirmations of `confirmations`, the handheld's first. Somebody between the two has another
certificate, so both get other keys and no confirmation fits.
"""

from __future__ import annotations

import hashlib
import hmac
import re
from dataclasses import dataclass
from urllib.parse import parse_qsl, quote, urlsplit

__all__ = ["SCHEME", "BadPairing", "PairLink", "code_in_groups", "confirmations", "sides", "split_code"]

SCHEME = "pilothouse"
"""Scheme of the links."""
MAX_LINK = 600
"""Characters of a link."""
MAX_NAME = 40
"""Characters of a robot's name in a link."""
CODE_DIGITS = 6
"""Digits of a code; those of a guest have the digits of its tag before them."""
TAG_DIGITS = 2

_FINGERPRINT = re.compile("[0-9a-f]{64}")
_SECRET = re.compile("[A-Za-z0-9_-]{16,64}")
HOST = re.compile(r"[A-Za-z0-9._-]{1,253}|[0-9A-Fa-f:.]{2,45}")
"""A host in a link."""


class BadPairing(ValueError):
    """A link or a code that is none; the text is one sentence."""


@dataclass(frozen=True, slots=True)
class PairLink:
    """What a robot's QR code says."""

    host: str
    port: int
    """Of the rosbridge socket; 1 to 65535."""
    fingerprint: str
    """SHA-256 of the robot's certificate in DER, 64 lower-case hex digits."""
    secret: str
    """For one use, within the time for which pairing is open."""
    name: str = ""
    """Of the robot, for people; no proof of anything."""

    @property
    def text(self) -> str:
        """The link, as in `pilothouse://192.168.1.7:9090?c=…&s=…&n=Patrol-1`."""
        host = f"[{self.host}]" if ":" in self.host else self.host
        name = quote(self.name[:MAX_NAME], safe="")
        return f"{SCHEME}://{host}:{self.port}?c={self.fingerprint}&s={self.secret}&n={name}"

    @classmethod
    def read(cls, text: str) -> PairLink:
        """The link of a text; BadPairing for any other text, which may come from any QR code in the world."""
        try:
            parts = urlsplit(text.strip()) if len(text) <= MAX_LINK else None
            host, port = (parts.hostname or "", parts.port or 0) if parts else ("", 0)
            fields = parse_qsl(parts.query, strict_parsing=True, max_num_fields=8) if parts else []
        except ValueError as error:
            raise BadPairing(_NO_LINK) from error
        said = dict(fields)
        fingerprint, secret, name = (said.get(key, "") for key in "csn")
        if parts is None or parts.scheme != SCHEME or len(said) != len(fields):
            raise BadPairing(_NO_LINK)
        if not (HOST.fullmatch(host) and port):
            raise BadPairing(_NO_LINK)
        if not (_FINGERPRINT.fullmatch(fingerprint) and _SECRET.fullmatch(secret)):
            raise BadPairing(_NO_LINK)
        if len(name) > MAX_NAME or not name.isprintable():
            raise BadPairing(_NO_LINK)
        return cls(host, port, fingerprint, secret, name)


_NO_LINK = "This is no pairing link of a robot; one begins with pilothouse:// and is complete."


def split_code(text: str) -> tuple[str, str]:
    """Tag and digits of a code as people type it, with or without spaces and dashes; BadPairing for any other text.

    The tag is empty for the code that a robot shows, and two digits for the code of a guest; `/pair/begin` wants it, the
    digits are the password of SPAKE2, as ASCII.
    """
    digits = re.sub(r"[\s-]", "", text[:40])
    if not (digits.isascii() and digits.isdigit()) or len(digits) not in (
        CODE_DIGITS,
        TAG_DIGITS + CODE_DIGITS,
    ):
        raise BadPairing(f"A code has {CODE_DIGITS} digits, that of a guest {TAG_DIGITS + CODE_DIGITS}.")
    return digits[:-CODE_DIGITS], digits[-CODE_DIGITS:]


def code_in_groups(code: str) -> str:
    """A code as people read it aloud: `123 456`, that of a guest `42 123 456`."""
    return f"{code[:-6]} {code[-6:-3]} {code[-3:]}".strip()


def sides(fingerprint: str) -> tuple[bytes, bytes]:
    """SPAKE2's idA, the handheld, and idB, the robot, bound to the certificate between them."""
    return f"pilothouse handheld {fingerprint}".encode(), f"pilothouse robot {fingerprint}".encode()


def confirmations(key: bytes) -> tuple[str, str]:
    """What the handheld and what the robot shows to prove that it has SPAKE2's `key`, in hex; compare in constant time."""
    handheld, robot = (
        hmac.new(key, f"pilothouse {who} confirms".encode(), hashlib.sha256).hexdigest()
        for who in ("handheld", "robot")
    )
    return handheld, robot
