"""Cells of an occupancy grid made ready to be looked at: pieces of a texture with softened edges, for any thread.

    for one in every_piece(cells):  # int8, shape (rows, columns): -1 unknown, 0 free to 100 occupied
        texture.blit_buffer(one.pixels, colorfmt="luminance_alpha", ...)

Luminance says how occupied a place is and alpha whether it is known. Both are blurred, so that an edge drawn where they
are a half runs smoothly past the corners of the cells; but no cell changes sides by that: a wall of one cell stays, and
so does a gap of one.
"""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

__all__ = ["MAX_SIDE", "OCCUPIED", "SHARED", "Piece", "bounds", "every_piece", "layout", "piece"]

MAX_SIDE = 1024
"""Columns or rows of a piece's texture [px]; any phone takes 2048."""
SHARED = 8
"""Cells that neighbouring pieces both have beyond their border, so that none is seen when the map is small."""
OCCUPIED = 50
"""From how much on a cell counts as occupied [%]."""
HALF, SURE = 127, 30
"""What divides the sides in a byte, and how far from it every cell stays."""
REACH = 2
"""Cells over which an edge is softened, either way."""
BAND = 64
"""Rows that are softened together: so many stay in the processor's cache from one step to the next."""
Bytes = NDArray[np.uint8]

_LEVEL = np.zeros(256, np.uint8)
_LEVEL[:101] = (np.arange(101) * 255 + 50) // 100
_LEVEL[101:128] = 255
_KNOWN = np.zeros(256, np.uint8)
_KNOWN[:128] = 255


@dataclass(frozen=True, slots=True)
class Piece:
    """One texture's part of a grid."""

    column: int
    """Of its first cell in the grid."""
    row: int
    columns: int
    """Cells that it shows; its texture has more around them."""
    rows: int
    left: int
    """Cells of its texture before the first that it shows."""
    low: int
    side: tuple[int, int]
    """Columns and rows of its texture, powers of two."""
    pixels: Bytes | None = None
    """Two bytes a cell of the texture, row by row; None before it is made ready."""
    digest: bytes = b""
    """Of the cells that it is made from: a piece that is as it was is neither made nor carried over again."""
    shaded: bool = False
    """Some of its cells are a little occupied."""


def layout(columns: int, rows: int) -> list[Piece]:
    """The pieces that a grid of that size is shown by, without their pixels."""
    across, up = _spans(columns), _spans(rows)
    return [
        Piece(
            x, y, wide, high, min(x, SHARED), min(y, SHARED), (_side(columns, x, wide), _side(rows, y, high))
        )
        for y, high in up
        for x, wide in across
    ]


def _spans(count: int) -> list[tuple[int, int]]:
    """First cell and length of each piece along one side."""
    step = MAX_SIDE - 2 * SHARED
    if count <= MAX_SIDE:
        return [(0, count)]
    return [(at, min(step, count - at)) for at in range(0, count, step)]


def _side(count: int, at: int, length: int) -> int:
    """The power of two that holds the cells and those shared with the neighbours."""
    held = min(at + length + SHARED, count) - max(at - SHARED, 0)
    return int(1 << max(0, held - 1).bit_length())


def piece(cells: NDArray[np.int8], place: Piece, drawn: Collection[bytes] = ()) -> Piece:
    """The piece at that place, its pixels made ready; without pixels where its digest is one of `drawn`, which it looks like."""
    part = _around(cells, place)
    shape = struct.pack("<2I", *place.side)
    digest = hashlib.blake2b(part.data, digest_size=16, salt=shape).digest()
    shaded = bool(((part > 0) & (part < OCCUPIED)).any())
    if digest in drawn:
        return replace(place, digest=digest, shaded=shaded)
    wide, high = place.side
    pixels = np.empty((high, wide, 2), np.uint8)
    for low in range(0, high, BAND):
        band = part[low : low + BAND + 2 * REACH]
        for channel, table in enumerate((_LEVEL, _KNOWN)):
            values = table[band]
            least = int(values.min())
            even = least == int(values.max())
            pixels[low : low + BAND, :, channel] = least if even else _softened(values)
    return replace(place, pixels=pixels.reshape(-1), digest=digest, shaded=shaded)


def _around(cells: NDArray[np.int8], place: Piece) -> Bytes:
    """The cells of a piece's texture and `REACH` more on each side, as bytes.

    Beyond the grid the cells of its border go on; so do they in the rest of the texture, which is never shown.
    """
    rows, columns = cells.shape
    wide, high = place.side
    low, left = place.row - place.low - REACH, place.column - place.left - REACH
    top, right = low + high + 2 * REACH, left + wide + 2 * REACH
    held = cells[max(low, 0) : min(top, rows), max(left, 0) : min(right, columns)]
    beyond = (max(-low, 0), max(top - rows, 0)), (max(-left, 0), max(right - columns, 0))
    part = np.pad(held, beyond, mode="edge") if any(map(any, beyond)) else np.ascontiguousarray(held)
    return part.view(np.uint8)


def _softened(levels: Bytes) -> Bytes:
    """Blurred, each cell kept on its side; without the `REACH` cells around, which only lend to the others."""
    inner = slice(REACH, -REACH)
    wide = levels.astype(np.uint16)
    lines = wide[:, :-4] + wide[:, 4:]
    near = wide[:, 1:-3] + wide[:, 3:-1]
    near <<= 2
    lines += near
    near = wide[:, 2:-2] * np.uint16(6)
    lines += near
    sums = lines[:-4] + lines[4:]
    near = lines[1:-3] + lines[3:-1]
    near <<= 2
    sums += near
    near = lines[2:-2] * np.uint16(6)
    sums += near
    sums >>= 8
    soft = sums.astype(np.uint8)
    sides = levels[inner, inner] > HALF
    return np.where(sides, np.maximum(soft, HALF + SURE), np.minimum(soft, HALF - SURE))


def bounds(cells: NDArray[np.int8]) -> tuple[int, int, int, int] | None:
    """First column and row of what is known, and those behind the last; None where nothing is."""
    known = cells >= 0
    columns, rows = np.flatnonzero(known.any(axis=0)), np.flatnonzero(known.any(axis=1))
    if not len(columns):
        return None
    return int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1


def every_piece(cells: NDArray[np.int8], drawn: Collection[bytes] = ()) -> Iterator[Piece]:
    """All pieces of a grid, made ready one by one; without pixels those with a digest of `drawn`."""
    for place in layout(cells.shape[1], cells.shape[0]):
        yield piece(cells, place, drawn)
