"""Operations in the pixels of a picture, the `png` compression of rosbridge.

The text's bytes are the red, green and blue of a nearly square picture, filled up with line breaks at the end. Pillow
reads the pictures, and only the robot side installs it: another client that asks for this compression needs it too.
"""

from __future__ import annotations

import binascii
import io
import math
import struct
import zlib

from bridge.core.errors import ProtocolError
from bridge.protocol.names import wrong
from bridge.protocol.ops import Png

__all__ = ["pixels", "to_png"]

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_HEADER = struct.Struct(">IIBBBBB")
_LENGTH_AND_NAME = struct.Struct(">I4s")
_RGB, _RGBA = 2, 6
"""Colour types; a browser's canvas writes RGBA."""
_MAX_SIDE = 1 << 20


def to_png(text: bytes) -> Png:
    """`text` as the pixels of a picture. Line breaks at its end do not come back."""
    needed = math.ceil(len(text) / 3)
    width = max(1, math.isqrt(needed))
    height = max(1, math.ceil(needed / width))
    stride = 3 * width
    padded = text.ljust(stride * height, b"\n")
    rows = b"".join(b"\0" + padded[start : start + stride] for start in range(0, len(padded), stride))
    picture = (
        _SIGNATURE
        + _chunk(b"IHDR", _HEADER.pack(width, height, 8, _RGB, 0, 0, 0))
        + _chunk(b"IDAT", zlib.compress(rows))
        + _chunk(b"IEND", b"")
    )
    return Png(data=binascii.b2a_base64(picture, newline=False).decode())


def pixels(op: Png, limit: int) -> bytes:
    """The text in a picture of 8-bit RGB or RGBA, with the line breaks that fill it up.

    `limit` is the largest text [byte]; nothing larger is ever unpacked. ProtocolError when it is larger or no such
    picture, or when Pillow is not installed.
    """
    try:
        picture = binascii.a2b_base64(op.data)
    except ValueError as error:
        raise _wrong(op, "data must be base64") from error
    _check(op, picture, limit)
    try:
        from PIL import Image
    except ImportError as error:
        raise _wrong(op, "Pillow is not installed here") from error
    try:
        with Image.open(io.BytesIO(picture), formats=["PNG"]) as image:
            return image.convert("RGB").tobytes()
    except Exception as error:  # Pillow raises errors of many kinds for a damaged file
        raise _wrong(op, "the picture is damaged or cut off") from error


def _chunk(name: bytes, content: bytes) -> bytes:
    crc = zlib.crc32(content, zlib.crc32(name))
    return _LENGTH_AND_NAME.pack(len(content), name) + content + crc.to_bytes(4, "big")


def _check(op: Png, picture: bytes, limit: int) -> None:
    """ProtocolError unless the header promises a picture that may be unpacked."""
    if not picture.startswith(_SIGNATURE):
        raise _wrong(op, "data must be a PNG file")
    start = len(_SIGNATURE) + _LENGTH_AND_NAME.size
    if len(picture) < start + _HEADER.size:
        raise _wrong(op, "the picture is cut off")
    if _LENGTH_AND_NAME.unpack_from(picture, len(_SIGNATURE)) != (_HEADER.size, b"IHDR"):
        raise _wrong(op, "the picture has no header")
    width, height, depth, colour, packing, filtering, interlace = _HEADER.unpack_from(picture, start)
    if depth != 8 or colour not in (_RGB, _RGBA) or packing or filtering or interlace:
        raise _wrong(op, "the picture must be RGB or RGBA with 8 bits each and not interlaced")
    if not 0 < width <= _MAX_SIDE or not 0 < height <= _MAX_SIDE:
        raise _wrong(op, f"the picture must have 1 to {_MAX_SIDE} pixels a side, not {width} x {height}")
    if 3 * width * height > limit:
        raise _wrong(op, f"the picture must hold at most {limit} bytes, not {3 * width * height}")


def _wrong(op: Png, reason: str) -> ProtocolError:
    return wrong(op, f"A png cannot be read: {reason}.")
