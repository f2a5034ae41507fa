"""Visible tags of the family AprilTag 36h11, as a camera reads them: black and white cells, and the solids that they are drawn of.

Each tag is a square of 8 x 8 cells in a white border of one more: a black edge round 6 x 6 cells of code. The codes are those that
the family's authors published (E. Olson, AprilTag, 2011), highest bit first, row by row from the upper left; a bit that is set is white.
"""

from __future__ import annotations

from collections.abc import Iterator

from sim.core.shapes import Colour, Shape

__all__ = ["CELLS", "CODES", "TAG_SIZE", "cells", "tag_plate"]

CODES = (
    *(0xD5D628584, 0xD97F18B49, 0xDD280910E, 0xE479E9C98, 0xEBCBCA822, 0xF31DAB3AC),
    *(0x056A5D085, 0x10652E1D4, 0x22B1DFEAD, 0x265AD0472, 0x34FE91B86, 0x3FF962CD5),
    *(0x43A25329A, 0x474B4385F, 0x4E9D243E9, 0x5246149AE, 0x5997F5538, 0x683BB6C4C),
    *(0x6BE4A7211, 0x7E3158EEA, 0x81DA494AF, 0x858339A74, 0x8CD51A5FE, 0x9F21CC2D7),
    *(0xA2CABC89C, 0xADC58D9EB, 0xB16E7DFB0, 0xB8C05EB3A, 0xD25EF139D, 0xD607E1962),
)
"""Of the first tags of the family, by their numbers."""
CELLS = 8
"""Along an edge of the black square."""
TAG_SIZE = 0.16
"""Edge of the black square [m]."""

_WHITE: Colour = (0.97, 0.97, 0.97)
_BLACK: Colour = (0.02, 0.02, 0.02)
_PITCH = TAG_SIZE / CELLS
_RELIEF = 0.0015
"""By so much each layer stands before the one behind it [m]: a camera's depth still tells them apart from 20 m."""
_ROOT = 0.08
"""A cell reaches so far back into what bears the tag, unseen [m]: a shape as small as it looks would be left out of pictures from afar."""


def cells(tag: int) -> tuple[tuple[bool, ...], ...]:
    """Which cells of this tag are white: 8 rows from the top of 8 from the left, as one sees them who faces it."""
    code, inner = CODES[tag], CELLS - 2
    rows = [(False,) * CELLS]
    for row in range(inner):
        bits = (code >> (inner * inner - 1 - row * inner - column) & 1 for column in range(inner))
        rows.append((False, *(bool(bit) for bit in bits), False))
    return (*rows, (False,) * CELLS)


def tag_plate(tag: int) -> tuple[Shape, ...]:
    """The tag, facing against x, its top upward, in a frame with its middle at the origin; it is 3 mm thick, and 8 cm with its roots."""
    border = TAG_SIZE + 2 * _PITCH
    return (
        _layer((0.0, 0.0), (border, border), 1, _WHITE),
        _layer((0.0, 0.0), (TAG_SIZE, TAG_SIZE), 2, _BLACK),
        *(
            _layer(
                (TAG_SIZE / 2 - (first + count / 2) * _PITCH, TAG_SIZE / 2 - (row + 0.5) * _PITCH),
                (count * _PITCH, _PITCH),
                3,
                _WHITE,
            )
            for row, first, count in _runs(tag)
        ),
    )


def _runs(tag: int) -> Iterator[tuple[int, int, int]]:
    """White cells side by side: their row, the first one's column, and how many there are."""
    for row, line in enumerate(cells(tag)):
        column = 0
        while column < CELLS:
            count = 0
            while column + count < CELLS and line[column + count]:
                count += 1
            if count:
                yield row, column, count
            column += count + 1


def _layer(middle: tuple[float, float], size: tuple[float, float], number: int, colour: Colour) -> Shape:
    """A plate with its middle at `middle`, left of it and above it [m], `number` reliefs before the origin."""
    front = -number * _RELIEF
    return Shape(
        "box",
        (_ROOT, *size),
        (front + _ROOT / 2, middle[0], middle[1]),
        colour=colour,
        glow=0.35 if colour is _WHITE else 0.0,
    )
