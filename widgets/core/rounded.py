"""Boxes with round corners and smooth edges, each drawn as one picture in nine parts, and only while there is something to see.

Kivy's own smooth box is drawn twice and once more along its edge as soon as its colour lets anything through, even all of it.

<Tile>:
    canvas.before:
        Rounded:
            rgba: theme.raised
            pos: self.pos
            size: self.size
            radius: [theme.corner]
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache

from kivy.graphics import BorderImage
from kivy.graphics.texture import Texture

from widgets.core.visible import Visible

__all__ = ["Rounded", "coverage"]

RIM = 1
"""Round the box in its picture, for edges between two pixels [px]."""
MAX_RADIUS = 512
"""Larger corners are drawn as if they had this radius [px]."""
MAX_TEXTURES = 64
"""So many pictures of boxes are kept; one that is drawn keeps its own."""

CORNERS = 4
Corners = tuple[int, int, int, int]
"""Radii [px]: upper left, upper right, lower right, lower left."""


def _border(corners: Corners) -> int:
    """Of the picture's parts that are not stretched [px]: what is stretched has full pixels round it, or its edges would fade."""
    return max(*corners, 1) + RIM


def coverage(corners: Corners) -> list[bytes]:
    """How much of each pixel the smallest box with such corners covers, 0 to 255, in rows from the lowest, with an empty rim of RIM."""
    upper_left, upper_right, lower_right, lower_left = corners
    side = 2 * _border(corners) + 1 - 2 * RIM
    rim = bytes(RIM)
    empty = bytes(side + 2 * RIM)
    rows = [empty] * RIM
    for low in range(side):
        left = _row(low, side, lower_left, upper_left)[::-1]
        right = _row(low, side, lower_right, upper_right)
        rows.append(rim + left + b"\xff" * (side - len(left) - len(right)) + right + rim)
    return rows + [empty] * RIM


def _row(low: int, side: int, lower: int, upper: int) -> bytes:
    """What the corners at one end of a row cover, from their middle outwards; `low` is the row, of `side` in all."""
    if low < lower:
        return _arc(lower)[lower - 1 - low]
    return _arc(upper)[low - side + upper] if low >= side - upper else b""


@lru_cache(MAX_TEXTURES)
def _arc(radius: int) -> tuple[bytes, ...]:
    """A quarter of a disc, from its middle to the right and upwards; in Python alone, for numpy would hold up the first frame."""
    return tuple(_arc_row(radius, each + 0.5) for each in range(radius))


def _arc_row(radius: int, away: float) -> bytes:
    """One row of it, `away` from the corner's middle [px]: only where the edge is has each pixel to be looked at."""
    full = max(0, int(math.sqrt(max((radius - 0.5) ** 2 - away**2, 0.0)) - 0.5))
    ends = min(radius, math.ceil(math.sqrt((radius + 0.5) ** 2 - away**2)) + 1)
    edge = (radius + 0.5 - math.hypot(each + 0.5, away) for each in range(full, ends))
    return b"\xff" * full + bytes(round(255 * min(max(one, 0.0), 1.0)) for one in edge) + bytes(radius - ends)


@lru_cache(MAX_TEXTURES)
def _texture(corners: Corners) -> Texture:
    rows = coverage(corners)
    pixels = bytearray(b"\xff" * (4 * len(rows) * len(rows[0])))
    pixels[3::4] = b"".join(rows)
    made = Texture.create(size=(len(rows[0]), len(rows)), colorfmt="rgba")

    def fill(texture: Texture) -> None:
        texture.blit_buffer(bytes(pixels), colorfmt="rgba", bufferfmt="ubyte")

    fill(made)
    made.add_reload_observer(fill)
    return made


class Rounded(Visible):
    """A box in one colour. What nobody could see, by its colour or by its size, is not drawn."""

    def __init__(
        self,
        rgba: Sequence[float] = (1, 1, 1, 1),
        pos: Sequence[float] = (0, 0),
        size: Sequence[float] = (0, 0),
        radius: Sequence[float] = (10,),
    ) -> None:
        """As the properties of the same names."""
        self._image = BorderImage(size=(0, 0), noadd=True)
        self._pos, self._size = (float(pos[0]), float(pos[1])), (float(size[0]), float(size[1]))
        self._radius = tuple(radius)
        self._corners: Corners | None = None
        super().__init__(self._image, rgba)
        self._place()

    @property
    def pos(self) -> tuple[float, float]:
        """Lower left corner [px]."""
        return self._pos

    @pos.setter
    def pos(self, value: Sequence[float]) -> None:
        placed = float(value[0]), float(value[1])
        if placed != self._pos:
            self._pos = placed
            self._image.pos = placed[0] - RIM, placed[1] - RIM

    @property
    def size(self) -> tuple[float, float]:
        """[px]"""
        return self._size

    @size.setter
    def size(self, value: Sequence[float]) -> None:
        sized = float(value[0]), float(value[1])
        if sized != self._size:
            self._size = sized
            self._place()

    @property
    def radius(self) -> tuple[float, ...]:
        """Of all corners, or of each: upper left, upper right, lower right, lower left [px]; less where the box is too small."""
        return self._radius

    @radius.setter
    def radius(self, value: Sequence[float]) -> None:
        if tuple(value) != self._radius:
            self._radius = tuple(value)
            self._place()

    @property
    def covers(self) -> bool:
        """It has a width and a height."""
        return min(self._size) > 0

    def _place(self) -> None:
        """Bring the picture to its size, with its corners."""
        room = int(min(self._size)) // 2
        each = self._radius if len(self._radius) == CORNERS else self._radius[:1] * CORNERS
        upper_left, upper_right, lower_right, lower_left = (
            max(0, min(round(radius), room, MAX_RADIUS)) for radius in each
        )
        corners = upper_left, upper_right, lower_right, lower_left
        if corners != self._corners:
            self._corners = corners
            self._image.texture = _texture(corners)
            self._image.border = [_border(corners)] * 4
        self._image.size = self._size[0] + 2 * RIM, self._size[1] + 2 * RIM
        self._image.pos = self._pos[0] - RIM, self._pos[1] - RIM
        self.refresh()
