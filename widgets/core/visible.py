"""Instructions that draw only while their colour lets something be seen: what is clear most of the time costs nothing then.

<Tile>:
    canvas.after:
        Outline:
            rgba: theme.danger if root.alarmed else (0, 0, 0, 0)
            rounded_rectangle: self.pos + self.size + [theme.corner]
            width: theme.outline
"""

from __future__ import annotations

from collections.abc import Sequence

from kivy.graphics import Color, Instruction, InstructionGroup, Rectangle, SmoothLine
from kivy.graphics.texture import Texture

__all__ = ["Outline", "Tinted", "Visible"]


class Visible(InstructionGroup):
    """One shape in one colour."""

    def __init__(self, shape: Instruction, rgba: Sequence[float] = (1, 1, 1, 1)) -> None:
        """`shape` is in no canvas yet; a rule makes its instructions within its canvas, to which they would add themselves."""
        super().__init__()
        self._colour, self._shape = Color(*rgba, noadd=True), shape
        self.refresh()

    @property
    def rgba(self) -> list[float]:
        """Colour with its opacity, each 0 to 1."""
        return list(self._colour.rgba)

    @rgba.setter
    def rgba(self, value: Sequence[float]) -> None:
        if list(value) != self.rgba:
            self._colour.rgba = value
            self.refresh()

    @property
    def drawn(self) -> bool:
        """There is something to see."""
        return bool(self.children)

    @property
    def covers(self) -> bool:
        """The shape has an area."""
        return True

    def refresh(self) -> None:
        """Draw it, or draw it no longer, as its colour and its shape are now."""
        seen = self._colour.a > 0 and self.covers
        if seen == self.drawn:
            return
        for part in (self._colour, self._shape) if seen else (self._shape, self._colour):
            (self.add if seen else self.remove)(part)  # Kivy's `clear` leaves some


class Outline(Visible):
    """A smooth line round a box with round corners."""

    def __init__(self) -> None:
        self._line = SmoothLine(noadd=True)
        self._round: tuple[float, ...] = ()
        super().__init__(self._line, (0, 0, 0, 0))

    @property
    def rounded_rectangle(self) -> tuple[float, ...]:
        """Left, low, width, height and radius of the corners [px]; empty before any was given."""
        return self._round

    @rounded_rectangle.setter
    def rounded_rectangle(self, value: Sequence[float]) -> None:
        if tuple(value) != self._round:
            self._round = tuple(value)
            self._line.rounded_rectangle = self._round

    @property
    def width(self) -> float:
        """Of the line, on each side of the box's edge [px]."""
        return float(self._line.width)

    @width.setter
    def width(self, value: float) -> None:
        self._line.width = value


class Tinted(Visible):
    """A picture in one colour, as a text is."""

    def __init__(self) -> None:
        self._picture = Rectangle(size=(0, 0), noadd=True)
        super().__init__(self._picture, (0, 0, 0, 0))

    @property
    def pos(self) -> tuple[float, float]:
        """Lower left corner [px]."""
        x, y = self._picture.pos
        return x, y

    @pos.setter
    def pos(self, value: Sequence[float]) -> None:
        if tuple(value) != self.pos:
            self._picture.pos = value

    @property
    def size(self) -> tuple[float, float]:
        """[px]"""
        width, height = self._picture.size
        return width, height

    @size.setter
    def size(self, value: Sequence[float]) -> None:
        if tuple(value) != self.size:
            self._picture.size = value

    @property
    def texture(self) -> Texture | None:
        """The picture, in white; None for a box of its colour."""
        return self._picture.texture

    @texture.setter
    def texture(self, value: Texture | None) -> None:
        if value is not self._picture.texture:
            self._picture.texture = value
