"""A QR code, black on white in every theme, for the camera of another handheld."""

from __future__ import annotations

from typing import Any

import numpy as np
from kivy.graphics import Color, InstructionGroup, Rectangle
from kivy.graphics.texture import Texture
from kivy.properties import ListProperty
from kivy.uix.widget import Widget

__all__ = ["MAX_MODULES", "QUIET_ZONE", "QrCode"]

QUIET_ZONE = 4
"""Light modules around a code, as its standard wants them."""
MAX_MODULES = 177
"""Along a side of the largest code that there is."""


class QrCode(Widget):
    """Draws `rows` as large as whole pixels of each module allow, in the middle of a white field."""

    rows = ListProperty()
    """Rows from the top, each of 0 (light) and 1 (dark), without the quiet zone; empty for no code.

    What is no square of these, as a stranger may send it, is not drawn.
    """

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._code = InstructionGroup()
        self.canvas.add(self._code)
        self.bind(rows=self._draw, pos=self._draw, size=self._draw)
        self._draw()

    @property
    def modules(self) -> int:
        """Along a side, without the quiet zone; 0 where there is no code."""
        rows, count = self.rows, len(self.rows)
        whole = all(isinstance(row, str) and len(row) == count and not row.strip("01") for row in rows)
        return count if whole and count <= MAX_MODULES else 0

    def _draw(self, *_: object) -> None:
        self._code.clear()
        count = self.modules
        if not count:
            return
        across = count + 2 * QUIET_ZONE
        module = int(min(self.size) // across)
        if module < 1:
            return
        field, code = module * across, module * count
        # not from `center`: that is still the one of before when only the width or the height has changed
        left = round(self.x + (self.width - field) / 2)
        low = round(self.y + (self.height - field) / 2)
        inner = left + QUIET_ZONE * module, low + QUIET_ZONE * module
        self._code.add(Color(1, 1, 1, 1))
        self._code.add(Rectangle(pos=(left, low), size=(field, field)))
        self._code.add(Rectangle(pos=inner, size=(code, code), texture=self._texture(count)))

    def _texture(self, count: int) -> Texture:
        light = np.array([[letter == "0" for letter in row] for row in self.rows], np.uint8) * 255
        made = Texture.create(size=(count, count), colorfmt="rgb")
        made.mag_filter = made.min_filter = "nearest"
        made.blit_buffer(np.repeat(light[::-1, :, None], 3, 2).tobytes(), colorfmt="rgb", bufferfmt="ubyte")
        return made
