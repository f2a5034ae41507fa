"""The chip in the corner of a live picture: size, rate and latency in words."""

from __future__ import annotations

from kivy.metrics import dp, sp

from widgets.core.base import text_texture
from widgets.core.canvas_ink import Word, Words, tint
from widgets.core.rounded import Rounded
from widgets.core.theme import theme

__all__ = ["VideoChip", "chip_width"]

TYPE_SIZE = 12.5
"""[sp]"""


def chip_width(text: str) -> float:
    """How wide the chip with these words is [px]."""
    return float(text_texture(text, round(sp(TYPE_SIZE), 1), theme.font).width + dp(14))


class VideoChip:
    """It is drawn anew only where it says or looks something else."""

    def __init__(self) -> None:
        self.ground, self.words = Rounded(), Words()
        self._as_drawn: tuple[object, ...] = ()

    def draw(self, text: str, left: float, top: float, *, late: bool) -> None:
        """Say `text`, with nothing for an empty one, under `top` and right of `left` [px]; `late` warns."""
        drawn = text, late, left, top, tuple(theme.surface), tuple(theme.text)
        if drawn == self._as_drawn:
            return
        self._as_drawn = drawn
        if not text:
            self.ground.size = 0, 0
            self.words.write(())
            return
        size = sp(TYPE_SIZE)
        wide, high = text_texture(text, round(size, 1), theme.font).size
        self.ground.rgba = tint(theme.surface, 0.86)
        self.ground.pos, self.ground.size = (left, top - high - dp(5)), (wide + dp(14), high + dp(5))
        self.ground.radius = [dp(6)]
        middle = top - (high + dp(5)) / 2
        colour = theme.warn if late else theme.text
        self.words.write([Word(text, left + dp(7), middle, size, colour, anchor=(0, 0.5))])
