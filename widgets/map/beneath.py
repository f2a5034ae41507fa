"""The place below a map's marks: a ground that is drawn there, and how plainly it is seen.

map.ground = TileGround(MBTiles(Path("town.mbtiles")), Datum(45.5069, -73.579))
map.ground_opacity = 0.6
"""

from __future__ import annotations

import math

from kivy.graphics import Color, Instruction, InstructionGroup, Rectangle
from kivy.metrics import dp, sp

from widgets.core.base import fitting_size, text_texture
from widgets.core.canvas_ink import Word, folded, tint
from widgets.core.geometry import View
from widgets.core.language import mark, tr
from widgets.core.theme import theme

__all__ = ["Beneath", "Box", "Ground", "attribution_words"]

HAZE = {"dark": 0.24, "sunlight": 0.52, "night": 0.70}
"""How much of the window's colour lies over the pictures at full opacity, so that marks stand out, 0 to 1."""
NARROW = 520
"""Where there is less room, the word about the pictures' origin and the legend stand one above the other [dp]."""

SHIPPED = mark("Drawn from the simulated world")
"""What the maps that come with the app say of themselves."""

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


def attribution_words(text: str, free_box: Box, foot: float, *, above: bool) -> list[Word]:
    """Whom the pictures are of, in the lower right corner of what is free; `above` a legend that is there too.

    On a small map, which has neither scale nor legend (`foot` is NaN), in the lower left one. Beside the scale, or above it
    where it has no room there, and in as many lines as it takes.
    """
    text = tr(text)
    x, y, wide, _ = free_box
    if math.isnan(foot):
        room = wide - dp(12)
        size = fitting_size([text], sp(11), room)
        return folded(Word(text, x + dp(6), y + dp(4), size, theme.text, anchor=(0, 0)), room)
    low = dp(8) + foot + (dp(24) if above and wide < dp(NARROW) else 0)
    room = wide - dp(26) - scale_room(wide)
    size = fitting_size([text], sp(11), room)
    if text_texture(text, size).width > room:
        low, room = max(low, foot + dp(22) + sp(20)), wide - dp(20)
        size = fitting_size([text], sp(11), room)
    return folded(Word(text, x + wide - dp(10), y + low, size, theme.text, anchor=(1, 0)), room)


def scale_room(wide: float) -> float:
    """How far a map of that width has its scale from its left edge on [px]."""
    return dp(16) + min(dp(140), wide / 3) + dp(6)
