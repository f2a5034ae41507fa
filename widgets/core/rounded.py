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

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from kivy.graphics import BorderImage
from kivy.graphics.texture import Texture
from numpy.typing import NDArray

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


def coverage(corners: Corners) -> NDArray[np.float64]:
    """How much of each pixel the smallest box with such corners covers, 0 to 1, lowest row first, with an empty rim of RIM."""
    reach = _border(corners)
    side = 2 * reach + 1
    picture = np.zeros((side, side))
    picture[RIM:-RIM, RIM:-RIM] = 1.0
    for radius, (row, column) in zip(corners, ((-1, 0), (-1, -1), (0, -1), (0, 0)), strict=True):
        if not radius:
            continue
        offset = np.arange(radius) + 0.5  # from the corner's middle to the middles of its pixels
        inside = np.clip(radius + 0.5 - np.hypot(offset[:, None], offset[None, :]), 0.0, 1.0)
        rows = slice(RIM, RIM + radius) if row == 0 else slice(side - RIM - radius, side - RIM)
        columns = slice(RIM, RIM + radius) if column == 0 else slice(side - RIM - radius, side - RIM)
        picture[rows, columns] = inside[:: -1 if row == 0 else 1, :: -1 if column == 0 else 1]
    return picture


@lru_cache(MAX_TEXTURES)
def _texture(corners: Corners) -> Texture:
    picture = coverage(corners)
    pixels = np.full((*picture.shape, 4), 255, np.uint8)
    pixels[..., 3] = np.round(picture * 255)
    made = Texture.create(size=picture.shape[::-1], colorfmt="rgba")

    def fill(texture: Texture) -> None:
        texture.blit_buffer(pixels.tobytes(), colorfmt="rgba", bufferfmt="ubyte")

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
