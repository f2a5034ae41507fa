"""A profile as a link that one handheld shows as a QR code and another opens, and back again, whoever made the link.

The text of the file is packed by zlib and written in letters that stand in a link: `pilothouse://layout?v=1&d=…`.
"""

from __future__ import annotations

import base64
import binascii
import zlib
from urllib.parse import parse_qsl, urlsplit

from app.profiles.profile_store import MAX_BYTES
from widgets.core.language import tr

__all__ = [
    "HOST",
    "MAX_CODE",
    "MAX_LINK",
    "BadProfileLink",
    "fits_code",
    "is_profile_link",
    "link_of",
    "text_of_link",
]

SCHEME, HOST = "pilothouse", "layout"
VERSION = "1"
MAX_CODE = 2_300
"""Letters of a link that one QR code holds so that a camera still reads it."""
MAX_LINK = 100_000
"""Letters of a link that is read."""


class BadProfileLink(ValueError):
    """A text that is no link of a profile; one sentence says why."""


def link_of(text: str) -> str:
    """The link to the profile in the text of its file."""
    packed = base64.urlsafe_b64encode(zlib.compress(text.encode(), 9)).decode().rstrip("=")
    return f"{SCHEME}://{HOST}?v={VERSION}&d={packed}"


def fits_code(link: str) -> bool:
    """One QR code holds it."""
    return len(link) <= MAX_CODE


def is_profile_link(text: str) -> bool:
    """It begins as the link of a profile does."""
    return text.strip().lower().startswith(f"{SCHEME}://{HOST}")


def text_of_link(link: str) -> str:
    """The text of the file that a link brings; BadProfileLink for any other text, which a stranger may have made."""
    link = link.strip()
    if len(link) > MAX_LINK:
        raise BadProfileLink(
            tr("A link of a profile has at most {max_link} letters.").format(max_link=MAX_LINK)
        )
    try:
        parts = urlsplit(link)
        fields = parse_qsl(parts.query, keep_blank_values=True, strict_parsing=True, max_num_fields=4)
    except ValueError as error:
        raise BadProfileLink(
            tr("This is no link of a profile; one begins with pilothouse://layout.")
        ) from error
    said = dict(fields)
    if parts.scheme != SCHEME or parts.netloc != HOST or parts.path.strip("/") or set(said) != {"v", "d"}:
        raise BadProfileLink(tr("This is no link of a profile; one begins with pilothouse://layout."))
    if said["v"] != VERSION:
        raise BadProfileLink(tr("This profile was made by a newer app; update this one."))
    return _unpacked(said["d"])


def _unpacked(packed: str) -> str:
    cut = BadProfileLink(tr("This link of a profile is not complete; copy it again."))
    try:
        content = base64.b64decode(packed + "=" * (-len(packed) % 4), altchars=b"-_", validate=True)
        unpacker = zlib.decompressobj()
        text = unpacker.decompress(content, MAX_BYTES + 1)
    except (binascii.Error, ValueError, zlib.error) as error:
        raise cut from error
    if len(text) > MAX_BYTES:
        raise BadProfileLink(
            tr("This profile has more than {max_bytes} kB.").format(max_bytes=MAX_BYTES // 1000)
        )
    if not unpacker.eof:
        raise cut
    try:
        return text.decode("utf-8")
    except UnicodeDecodeError as error:
        raise cut from error
