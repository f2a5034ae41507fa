"""Operations in the pixels of a picture, as rosbridge's `png` compression has them; PNG by its specification (W3C).

The text's bytes are the red, green and blue of a nearly square picture, filled up with line breaks at the end.
"""

from __future__ import annotations

import binascii
import math
import struct
import zlib
from collections.abc import Iterator
from itertools import accumulate

from bridge.core.errors import ProtocolError
from bridge.protocol.names import wrong
from bridge.protocol.ops import Png

__all__ = ["MAX_FILTERED_BYTES", "pixels", "to_png"]

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_HEADER = struct.Struct(">IIBBBBB")
_LENGTH_AND_NAME = struct.Struct(">I4s")
_CHANNELS = {2: 3, 6: 4}
"""Bytes of a pixel by colour type: RGB and, as a browser's canvas writes it, RGBA."""
_MAX_SIDE = 1 << 20
MAX_FILTERED_BYTES = 32_768
"""So many bytes of rows may be filtered: each takes a step of Python to restore, those of other rows nothing [byte]."""


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
        + _chunk(b"IHDR", _HEADER.pack(width, height, 8, 2, 0, 0, 0))
        + _chunk(b"IDAT", zlib.compress(rows))
        + _chunk(b"IEND", b"")
    )
    return Png(data=binascii.b2a_base64(picture, newline=False).decode())


def pixels(op: Png, limit: int, filtered: int = MAX_FILTERED_BYTES) -> tuple[bytes, int]:
    """The text in a picture of 8-bit RGB or RGBA with the line breaks that fill it up, and what was filtered [byte].

    `limit` is how large the text may be [byte], `filtered` how much of the pixels; nothing larger is ever unpacked.
    ProtocolError when it is larger or no such picture.
    """
    try:
        picture = binascii.a2b_base64(op.data)
    except ValueError as error:
        raise _wrong(op, "data must be base64") from error
    if not picture.startswith(_SIGNATURE):
        raise _wrong(op, "data must be a PNG file")
    header, packed = b"", []
    for name, content in _chunks(op, picture):
        if name == b"IHDR":
            header = content
        elif name == b"IDAT":
            packed.append(content)
    width, height, channels = _shape(op, header, limit)
    rows = _inflate(op, b"".join(packed), (channels * width + 1) * height)
    stride = width * channels
    costs = stride * (height - rows[:: stride + 1].count(0))
    if costs > filtered:
        raise _wrong(op, f"at most {filtered} bytes of it may stand in filtered rows, not {costs}")
    return _unfiltered(op, rows, stride, channels), costs


def _chunk(name: bytes, content: bytes) -> bytes:
    crc = zlib.crc32(content, zlib.crc32(name))
    return _LENGTH_AND_NAME.pack(len(content), name) + content + crc.to_bytes(4, "big")


def _chunks(op: Png, picture: bytes) -> Iterator[tuple[bytes, bytes]]:
    place, name = len(_SIGNATURE), b""
    while name != b"IEND":
        if place + 12 > len(picture):
            raise _wrong(op, "the picture is cut off")
        length, name = _LENGTH_AND_NAME.unpack_from(picture, place)
        end = place + 8 + length
        content = picture[place + 8 : end]
        if int.from_bytes(picture[end : end + 4], "big") != zlib.crc32(content, zlib.crc32(name)):
            raise _wrong(op, "the picture is damaged or cut off")
        yield name, content
        place = end + 4


def _shape(op: Png, header: bytes, limit: int) -> tuple[int, int, int]:
    if len(header) != _HEADER.size:
        raise _wrong(op, "the picture has no header")
    width, height, depth, colour, packing, filtering, interlace = _HEADER.unpack(header)
    channels = _CHANNELS.get(colour)
    if depth != 8 or channels is None or packing or filtering or interlace:
        raise _wrong(op, "the picture must be RGB or RGBA with 8 bits each and not interlaced")
    if not 0 < width <= _MAX_SIDE or not 0 < height <= _MAX_SIDE:
        raise _wrong(op, f"the picture must have 1 to {_MAX_SIDE} pixels a side, not {width} x {height}")
    if 3 * width * height > limit:
        raise _wrong(op, f"the picture must hold at most {limit} bytes, not {3 * width * height}")
    return width, height, channels


def _inflate(op: Png, packed: bytes, expected: int) -> bytes:
    unpacker = zlib.decompressobj()
    try:
        rows = unpacker.decompress(packed, expected + 1)
    except zlib.error as error:
        raise _wrong(op, "the picture's pixels are damaged") from error
    if len(rows) != expected:
        raise _wrong(op, "the picture has more or fewer pixels than its header says")
    return rows


def _unfiltered(op: Png, rows: bytes, stride: int, channels: int) -> bytes:
    """What the filters of the rows hide; of RGBA without the A."""
    above = bytes(stride)
    found = []
    for start in range(0, len(rows), stride + 1):
        above = _restored(op, rows[start], rows[start + 1 : start + 1 + stride], above, channels)
        found.append(above)
    restored = b"".join(found)
    if channels == 3:
        return restored
    without = bytearray(len(restored) // 4 * 3)
    for channel in range(3):
        without[channel::3] = restored[channel::4]
    return bytes(without)


def _restored(op: Png, filter: int, row: bytes, above: bytes, channels: int) -> bytes:
    if filter == 0:
        return row
    if filter == 1:
        return _sub(row, channels)
    if filter == 2:
        return bytes((value + up) & 255 for value, up in zip(row, above, strict=True))
    if filter == 3:
        return _average(row, above, channels)
    if filter == 4:
        return _paeth(row, above, channels)
    raise _wrong(op, f"a row's filter must be 0 to 4, not {filter}")


def _sub(row: bytes, channels: int) -> bytes:
    restored = bytearray(len(row))
    for channel in range(channels):
        restored[channel::channels] = bytes(value & 255 for value in accumulate(row[channel::channels]))
    return bytes(restored)


def _average(row: bytes, above: bytes, channels: int) -> bytes:
    restored = bytearray(channels) + row
    for place, up in enumerate(above):
        restored[place + channels] = (restored[place + channels] + (restored[place] + up) // 2) & 255
    return bytes(restored[channels:])


def _paeth(row: bytes, above: bytes, channels: int) -> bytes:
    """The neighbour that is nearest to left + up - upper left; in doubt left, then up."""
    restored = bytearray(channels) + row
    corners = bytes(channels) + above
    for place, up in enumerate(above):
        left, corner = restored[place], corners[place]
        to_left, to_up, to_corner = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
        near = corner
        if to_left <= to_up and to_left <= to_corner:
            near = left
        elif to_up <= to_corner:
            near = up
        restored[place + channels] = (restored[place + channels] + near) & 255
    return bytes(restored[channels:])


def _wrong(op: Png, reason: str) -> ProtocolError:
    return wrong(op, f"A png cannot be read: {reason}.")
