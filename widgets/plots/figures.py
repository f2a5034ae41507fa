"""Figures that change often, written letter by letter from pictures that are made once. For figures of one width."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from kivy.graphics import Color, InstructionGroup, Rectangle

from widgets.core.base import text_texture
from widgets.core.theme import theme

__all__ = ["Figure", "Figures"]


@dataclass(slots=True)
class Figure:
    """A figure on the canvas."""

    text: str
    right: float
    """Where it ends [px]."""
    y: float
    """Its middle [px]."""
    role: str


class Figures:
    """A set of figures, rewritten as a whole; no picture is made of a whole figure, of which there are too many."""

    def __init__(self) -> None:
        self.canvas = InstructionGroup()
        self._letters: list[tuple[Color, Rectangle]] = []
        self._shown = 0
        self.texts: list[str] = []
        """What is written now."""

    def write(self, figures: Iterable[Figure], size: float) -> None:
        """Show these instead of those before, in type of `size` [px]."""
        count, self.texts = 0, []
        for figure in figures:
            self.texts.append(figure.text)
            colour, x = theme.roles[figure.role], figure.right
            for letter in reversed(figure.text):
                x -= self._put(count, letter, (x, figure.y), size, colour)
                count += 1
        for _, rectangle in self._letters[count : self._shown]:
            rectangle.size = 0, 0
        self._shown = count

    def _put(
        self, index: int, letter: str, end: tuple[float, float], size: float, colour: list[float]
    ) -> float:
        """Write a letter that ends at `end`; gives its width [px]."""
        if index == len(self._letters):
            self._letters.append((Color(), Rectangle()))
            for instruction in self._letters[index]:
                self.canvas.add(instruction)
        ink, rectangle = self._letters[index]
        texture = text_texture(letter, size, theme.font, bold=True)
        if rectangle.texture is not texture:
            rectangle.texture = texture
        if tuple(rectangle.size) != texture.size:
            rectangle.size = texture.size
        if ink.rgba != colour:
            ink.rgba = colour
        width, height = texture.size
        place = (round(end[0] - width), round(end[1] - height / 2))
        if tuple(rectangle.pos) != place:
            rectangle.pos = place
        return float(width)
