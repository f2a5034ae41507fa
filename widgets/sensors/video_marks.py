"""Marks on a camera picture: boxes round what was recognised, and pointers to what is known to be somewhere."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from kivy.metrics import dp, sp

from widgets.core.base import text_texture
from widgets.core.canvas_ink import Word
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = ["Box", "box_role", "column", "draw_box", "draw_pointer"]

Box = tuple[float, float, float, float]
"""Left, bottom, right, top [px]."""


def column(angle: float, width: float, field_of_view: float) -> float:
    """Column of a picture `width` wide [pixel] that looks in a direction [rad]; far outside for what is behind.

    `field_of_view` is the camera's, horizontal [rad]; the direction is 0 ahead and positive to the left.
    """
    ahead = max(-1.5, min(1.5, angle))
    return width / 2 * (1 - math.tan(ahead) / math.tan(field_of_view / 2))


def box_role(left: float, width: float, found: Iterable[float]) -> str:
    """Role of what is boxed from `left` on, `width` wide [pixel]: `danger` where one of those that count is `found`, at a column of the picture.

    What is only recognised alarms nobody. As its place is measured from a moving robot, half a width beside the box is it as well.
    """
    near = any(left - width / 2 <= column <= left + 1.5 * width for column in found)
    return "danger" if near else "accent"


def draw_box(shapes: Shapes, box: Box, text: str, frame: Box, *, role: str, small: bool) -> Word:
    """A frame in the colour of a `role` round something, and its label on a tab that stays within the picture's `frame`."""
    colour, ink = theme.roles[role], theme.roles[f"ink_{role}"]
    left, bottom, right, top = box
    edge, size = (dp(1.6), sp(10)) if small else (dp(3), sp(15))
    corners = np.array([[left, bottom], [right, bottom], [right, top], [left, top], [left, bottom]])
    starts, ends = corners[:-1], corners[1:]
    along = ends - starts
    ahead = along / np.maximum(np.hypot(along[:, 0], along[:, 1]), 1e-9)[:, None] * edge / 2
    shapes.segments(starts - ahead, ends + ahead, edge, colour)
    wide, high = text_texture(text, round(size, 1), theme.font, bold=True).size
    x, y = min(left - edge / 2, frame[2] - wide - size), top if top + high < frame[3] else bottom - high
    tab = [(x, y), (x + wide + size * 0.7, y), (x + wide + size * 0.7, y + high), (x, y + high)]
    shapes.polygon(tab, colour)
    return Word(text, x + size * 0.35, y + high / 2, size, ink, bold=True, anchor=(0, 0.5))


def draw_pointer(
    shapes: Shapes, at: tuple[float, float], between: tuple[float, float], label: str, turn: float
) -> Word:
    """A triangle at a place [px] whose point looks to `turn` [rad], and its label over it, `between` two columns [px]."""
    (x, y), (left, right), size = at, between, sp(13)
    wide, high = text_texture(label, round(size, 1), theme.font, bold=True).size
    half = wide / 2 + dp(7)
    middle = min(max(x, left - dp(12) + half), right + dp(12) - half)
    text_y = y + dp(11) + high / 2
    shapes.line(np.array([[middle - half, text_y], [middle + half, text_y]]), high + dp(4), theme.danger)
    shapes.polygon(_triangle(x, y, turn, dp(15)), theme.surface)
    shapes.polygon(_triangle(x, y, turn, dp(11)), theme.danger)
    return Word(label, middle, text_y, size, theme.ink_danger, bold=True)


def _triangle(x: float, y: float, turn: float, size: float) -> list[tuple[float, float]]:
    """Corners of a triangle round (x, y) whose point looks to `turn` [rad]."""
    angles = (turn, turn + 2.4, turn - 2.4)
    return [(x + size * math.cos(angle), y + size * math.sin(angle)) for angle in angles]
