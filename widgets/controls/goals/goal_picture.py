"""Robot, goal and way from above, north up, in a box of a few fingers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from kivy.metrics import dp, sp

from widgets.core.base import fitting_size
from widgets.core.canvas_ink import Word, tint
from widgets.core.geometry import Points, View, nice_floor, rounded
from widgets.core.language import figure, tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map.map_marks import arrow

__all__ = ["Box", "draw", "ground"]

Box = tuple[float, float, float, float]
"""Left, low, width, height [px]."""


def ground(shapes: Shapes, box: Box, fill: Any, border: Any) -> None:
    """A filled box with round corners and a border."""
    rim = rounded(*box, dp(9))
    shapes.polygon([(x, y) for x, y in rim], fill)
    shapes.line(np.array([*rim, rim[0]]), dp(1.2), border)


def draw(
    shapes: Shapes,
    box: Box,
    actual: Sequence[float],
    wanted: Sequence[float],
    way: Points,
    step: float,
    *,
    sent: bool,
    followed: Sequence[float] = (),
) -> Iterator[Word]:
    """Where the robot is and where it is to go, each x, y [m], yaw [rad] or empty, the way between [m], and lines of at least
    `step` [m] between them; `sent`: the robot has the goal; `followed`
    is where it goes until then, like `wanted`."""
    left, low, width, height = box
    ground(shapes, box, theme.bg, theme.line)
    places = [place for place in (actual, wanted, followed) if place]
    if not places:
        yield Word(tr("robot position unknown"), left + width / 2, low + height / 2, sp(11), theme.muted)
        return
    inner = left + dp(20), low + dp(20), width - dp(40), height - dp(40)
    view = View.fitting(np.array([place[:2] for place in places]), box=inner, most=dp(70))
    _grid(shapes, view, box, step)
    if wanted and actual:
        ends = view.many_to_screen(np.array([actual[:2], wanted[:2]]))
        shapes.dashes(ends, dp(3.4), tint(theme.plan, 0.8), period=dp(9), dash=dp(3))
    if len(way) > 1:
        for start, end in _within(view.many_to_screen(way), box):
            shapes.line(np.array([start, end]), dp(2.4), theme.plan)
    if followed:
        x, y = view.to_screen(*followed[:2])
        shapes.disc(x, y, dp(9), theme.plan)
        shapes.polygon(arrow(x, y, followed[2], dp(8)), theme.ink_plan)
        told = tr("going to {followed} / {followed2}").format(
            followed=figure(followed[0], 2), followed2=figure(followed[1], 2)
        )
        size = fitting_size([told], sp(12), width - dp(12), bold=True)
        yield Word(told, left + width / 2, low + height - dp(10), size, theme.plan, bold=True)
    if actual:
        x, y = view.to_screen(*actual[:2])
        shapes.disc(x, y, dp(10), theme.accent)
        shapes.polygon(arrow(x, y, actual[2], dp(10)), theme.ink_accent)
    if wanted:
        x, y = view.to_screen(*wanted[:2])
        if sent:
            shapes.disc(x, y, dp(10), tint(theme.plan, 0.35))
        shapes.ring(x, y, dp(10), dp(2.4), theme.plan)
        shapes.polygon(arrow(x, y, wanted[2], dp(13)), theme.plan)


def _grid(shapes: Shapes, view: View, box: Box, step: float) -> None:
    """Lines of a round distance, inside the box."""
    left, low, width, height = box
    gap = max(nice_floor(dp(48) / view.scale), step)
    (first_x, first_y), (last_x, last_y) = view.to_world(left, low), view.to_world(left + width, low + height)
    easts = np.arange(math.ceil(first_x / gap), math.floor(last_x / gap) + 1) * gap
    norths = np.arange(math.ceil(first_y / gap), math.floor(last_y / gap) + 1) * gap
    columns = [view.to_screen(east, 0.0)[0] for east in easts]
    rows = [view.to_screen(0.0, north)[1] for north in norths]
    starts = [(x, low) for x in columns] + [(left, y) for y in rows]
    ends = [(x, low + height) for x in columns] + [(left + width, y) for y in rows]
    shapes.segments(np.array(starts), np.array(ends), dp(1), tint(theme.muted, 0.3))


def _within(points: Points, box: Box) -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """The pieces of a line whose ends are both inside the box."""
    left, low, width, height = box
    kept = [left <= x <= left + width and low <= y <= low + height for x, y in points]
    pairs = zip(points[:-1], points[1:], kept[:-1], kept[1:], strict=True)
    return [((a[0], a[1]), (b[0], b[1])) for a, b, first, second in pairs if first and second]
