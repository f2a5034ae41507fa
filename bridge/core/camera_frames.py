"""Camera frames on a WebSocket of their own: a 24-byte header, then the JPEG file.

Header, big-endian: `PHF1`, sequence number (uint32), stamp (float64), width (uint32), height (uint32). The receiver
answers each with the text `ack SEQ`.

A receiver whose path ends in `?same=1` takes a header alone, which begins with `PHS1`, for the picture before it on the same
connection: the camera took another one at that stamp, and it came out the same.

A picture that somebody else made is checked by `picture_size` before a decoder sees it: some kilobytes can ask for all memory.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

from bridge.core.errors import ProtocolError

__all__ = [
    "ASKS_FOR_SAME",
    "MAX_PIXELS",
    "MAX_SIDE",
    "Frame",
    "pack",
    "pack_same",
    "picture_size",
    "sequence",
    "unpack",
]

ASKS_FOR_SAME = "same=1"
"""In the query of a camera's path: the receiver knows the header that stands for the same picture."""

MAX_SIDE = 8192
"""Columns or rows of a picture that is decoded."""
MAX_PIXELS = 4096 * 4096
"""Pixels of a picture that is decoded: 64 MB in memory."""
MAX_SCANS = 100
"""Scans of a JPEG file that is decoded; each costs as much as the whole picture, and cameras make one to ten."""

_HEADER = struct.Struct(">4sIdII")
_MAGIC = b"PHF1"
_SAME = b"PHS1"


@dataclass(frozen=True, slots=True)
class Frame:
    """One picture of a camera."""

    seq: int
    """Sequence number, modulo 2**32; a gap means pictures that were left out."""
    stamp: float
    """Time of exposure [s], on the clock of `/rosapi/get_time`."""
    width: int
    """[pixel]; 0 where the sender could not read the picture."""
    height: int
    """[pixel]; 0 where the sender could not read the picture."""
    jpeg: bytes


def pack(seq: int, stamp: float, jpeg: bytes, width: int, height: int) -> bytes:
    """The bytes of a frame; `seq` is taken modulo 2**32."""
    return _HEADER.pack(_MAGIC, seq & 0xFFFFFFFF, stamp, width, height) + jpeg


def pack_same(frame: Frame) -> bytes:
    """The header that says that `frame` has the same picture as the one sent before it."""
    return _HEADER.pack(_SAME, frame.seq & 0xFFFFFFFF, frame.stamp, frame.width, frame.height)


def unpack(raw: bytes, before: Frame | None = None) -> Frame:
    """The frame in one binary message; ProtocolError for anything else.

    `before` is the newest frame of the same connection, whose very JPEG one with the same picture has. Without it, or with a
    stamp that is no later, such a message proves no new picture, and is refused.
    """
    if raw[:4] == _SAME and len(raw) == _HEADER.size:
        _, seq, stamp, width, height = _HEADER.unpack(raw)
        if before is None or not stamp > before.stamp:
            raise ProtocolError("The camera repeats a picture that it has not sent before.")
        return Frame(seq, stamp, width, height, before.jpeg)
    _check(raw)
    _, seq, stamp, width, height = _HEADER.unpack_from(raw)
    return Frame(seq, stamp, width, height, raw[_HEADER.size :])


def sequence(raw: bytes) -> int:
    """The sequence number of a packed frame, without copying its picture."""
    _check(raw)
    return int(_HEADER.unpack_from(raw)[1])


def _check(raw: bytes) -> None:
    if len(raw) < _HEADER.size or raw[:4] != _MAGIC:
        raise ProtocolError(f"A camera frame must begin with {_MAGIC!r} and a header, not {raw[:8]!r}.")


def picture_size(data: bytes) -> tuple[str, int, int]:
    """Format, `jpeg` or `png`, columns and rows of a picture by its header. ProtocolError, in one sentence, for one
    that is neither or is too large to be decoded."""
    if data[:3] == b"\xff\xd8\xff":
        kind, (columns, rows) = "jpeg", _jpeg_size(data)
        if data.count(b"\xff\xda") > MAX_SCANS:
            raise ProtocolError(f"A JPEG picture has at most {MAX_SCANS} scans.")
    elif data[:8] == b"\x89PNG\r\n\x1a\n" and data[12:16] == b"IHDR" and len(data) >= 24:
        kind, columns, rows = "png", int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")
    else:
        raise ProtocolError("The picture is neither JPEG nor PNG.")
    if not (0 < columns <= MAX_SIDE and 0 < rows <= MAX_SIDE and columns * rows <= MAX_PIXELS):
        limits = f"1 to {MAX_SIDE} px a side and {MAX_PIXELS // 10**6} megapixels at most"
        raise ProtocolError(f"A picture has {limits}, not {columns} x {rows}.")
    return kind, columns, rows


def _jpeg_size(jpeg: bytes) -> tuple[int, int]:
    """Columns and rows that the one frame header before the first scan says."""
    sizes, at = [], 2
    while at + 4 <= len(jpeg) and jpeg[at] == 0xFF:
        marker = jpeg[at + 1]
        if marker == 0xFF:  # a fill byte
            at += 1
            continue
        if marker == 0xDA:
            break
        if 0xC0 <= marker <= 0xCF and marker not in (0xC4, 0xC8, 0xCC):
            sizes.append(
                (int.from_bytes(jpeg[at + 7 : at + 9], "big"), int.from_bytes(jpeg[at + 5 : at + 7], "big"))
            )
        at += 2 + max(2, int.from_bytes(jpeg[at + 2 : at + 4], "big"))
    if len(sizes) != 1:
        raise ProtocolError("The picture is no whole JPEG file.")
    return sizes[0]
