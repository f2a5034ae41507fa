"""The place below a map's marks: a ground that is drawn there, and how plainly it is seen.

map.ground = TileGround(MBTiles(Path("town.mbtiles")), Datum(45.5069, -73.579))
map.ground_opacity = 0.6
"""

from __future__ import annotations

import math

from kivy.graphics import Color, Instruction, InstructionGroup, Rectangle
from kivy.metrics import dp, sp

from widgets.core.canvas_ink import Word, tint
from widgets.core.geometry import View
from widgets.core.theme import theme

__all__ = ["Beneath", "Box", "Ground", "attribution_word"]

HAZE = {"dark": 0.24, "sunlight": 0.52, "night": 0.70}
"""How much of the window's colour lies over the pictures at full opacity, so that marks stand out, 0 to 1."""
NARROW = 520
"""Where there is less room, the word about the pictures' origin and the legend stand one above the other [dp]."""

Box = tuple[float, float, float, float]
"""x, y, width, height [px]."""


class Ground:
    """One picture of the world below the marks; it has an owner, who closes it."""

    attribution = ""
    """Whom the pictures are of, in words that must be shown with them."""

    def __init__(self) -> None:
        self.canvas = InstructionGroup()

    def place(self, view: View, box: Box) -> bool:
        """Bring it to where the view has it; False where there is nothing of it to be seen."""
        raise NotImplementedError(f"{type(self).__name__} is not placed")

    def finish(self) -> None:
        """Wait until all in sight is there: for whoever draws a picture of a map and not for a screen."""

    def close(self) -> None:
        """Let go of what it is read from."""


class Beneath:
    """The place below a map's marks where a ground is drawn, and the haze that dims it."""

    def __init__(self) -> None:
        self.canvas = InstructionGroup()
        self.ground: Ground | None = None
        self.shown = False
        """There is something of a ground in sight."""
        self._colour, self._haze = Color(0, 0, 0, 0), Rectangle(size=(0, 0))
        self._drawn: list[Instruction] = []

    def lay(self, ground: Ground | None) -> None:
        """Have that one drawn, or none."""
        self.ground, self.shown = ground, False
        self._fill()

    def draw(self, view: View, box: Box, opacity: float) -> None:
        """Bring it up to date; `opacity` is 0 to 1."""
        shown = self.ground is not None and opacity > 0.0 and self.ground.place(view, box)
        if shown != self.shown:
            self.shown = shown
            self._fill()
        if shown:
            self._haze.pos, self._haze.size = box[:2], box[2:]
            self._colour.rgba = tint(theme.bg, 1.0 - opacity * (1.0 - HAZE[theme.name]))

    def _fill(self) -> None:
        for part in self._drawn:
            self.canvas.remove(part)
        self._drawn = []
        if self.shown and self.ground is not None:
            self._drawn = [self.ground.canvas, self._colour, self._haze]
        for part in self._drawn:
            self.canvas.add(part)


def attribution_word(text: str, free_box: Box, foot: float, *, above: bool) -> Word:
    """Whom the pictures are of, in the lower right corner of what is free; `above` a legend that is there too.

    On a small map, which has neither scale nor legend (`foot` is NaN), in the lower left one.
    """
    x, y, wide, _ = free_box
    if math.isnan(foot):
        return Word(text, x + dp(6), y + dp(4), sp(11), theme.text, anchor=(0, 0))
    low = dp(8) + foot + (dp(24) if above and wide < dp(NARROW) else 0)
    return Word(text, x + wide - dp(10), y + low, sp(11), theme.text, anchor=(1, 0))
