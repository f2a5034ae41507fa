"""Drawing of a fence: an edge with teeth towards where the robot never goes, hatching where it never enters.

Shape tells the two apart and not colour, in every theme. Sizes on the screen do not depend on the zoom.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from kivy.metrics import dp, sp

from widgets.core.base import text_texture
from widgets.core.canvas_ink import Word, ground, tint
from widgets.core.geometry import Points, View
from widgets.core.icons import icon
from widgets.core.language import mark, tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map.fence import Border, Fence
from widgets.map.map_heights import between_words

__all__ = ["LEGEND_ROW", "fence_lines", "hatching", "legend", "legend_width", "refused_mark", "teeth"]

Box = tuple[float, float, float, float]
"""x, y, width, height on the screen [px]."""

BETWEEN, TOOTH, APART = 9, 7, 14
"""Between two lines of the hatching; length of a tooth, and from one to the next [dp]."""
MAX_LINES = 3000
"""Lines of a hatching or teeth of an edge; of more every other one is left out."""
LEGEND_ROW = 20
"""Height of a line of the legend [dp]."""
SWATCH = 22
"""Width of a sign of the legend [dp]."""
FARTHEST = 1e12
"""No corner of a fence lies so far from the glass [px]."""
STAYS, NEVER = mark("Stays in"), mark("Keeps out")


def fence_lines(shapes: Shapes, view: View, fence: Fence, box: Box) -> None:
    """The whole fence, as much of it as is in `box`."""
    _hatched(shapes, view, fence.keep_out, box)
    for border in (fence.edge, fence.holes):
        starts, ends = view.many_to_screen(border.starts), view.many_to_screen(border.ends)
        shapes.segments(starts, ends, dp(6), tint(theme.bg, 0.55))
        shapes.segments(starts, ends, dp(2.4), theme.warn)
    shapes.segments(*teeth(view, fence.edge, box), dp(2.0), theme.warn)


def _hatched(shapes: Shapes, view: View, areas: list[Points], box: Box) -> None:
    lines = [hatching(view.many_to_screen(area), view.to_screen(0.0, 0.0), box) for area in areas]
    starts, ends = (np.concatenate([line[side] for line in lines] or [np.zeros((0, 2))]) for side in (0, 1))
    step = len(starts) // MAX_LINES + 1
    shapes.segments(starts[::step], ends[::step], dp(5), tint(theme.bg, 0.35))
    shapes.segments(starts[::step], ends[::step], dp(1.7), tint(theme.warn, 0.85))


def hatching(area: Points, anchor: tuple[float, float], box: Box) -> tuple[Points, Points]:
    """Slanting lines inside `area` [px], their starts and ends; the one through `anchor` is among them.

    None in one whose corners are no places.
    """
    if not (np.abs(area) < FARTHEST).all():
        return np.zeros((0, 2)), np.zeros((0, 2))
    if (area.max(axis=0) < box[:2]).any() or (area.min(axis=0) > np.add(box[:2], box[2:])).any():
        return np.zeros((0, 2)), np.zeros((0, 2))
    side = math.sqrt(0.5)
    rising, falling = np.array([side, side]), np.array([-side, side])
    corners = np.array([[box[0] + dx, box[1] + dy] for dx in (0.0, box[2]) for dy in (0.0, box[3])])
    across, through = area @ falling, np.array(anchor) @ falling
    low = max(float(across.min()), float((corners @ falling).min()))
    high = min(float(across.max()), float((corners @ falling).max()))
    gap = float(dp(BETWEEN))
    lines = (
        np.arange(math.ceil((low - through) / gap), math.floor((high - through) / gap) + 1) * gap + through
    )
    if not len(lines):
        return np.zeros((0, 2)), np.zeros((0, 2))
    up, last_up, last = area @ rising, np.roll(area @ rising, -1), np.roll(across, -1)
    spans = (across > lines[:, None]) != (last > lines[:, None])
    with np.errstate(divide="ignore", invalid="ignore"):
        meets = up + (lines[:, None] - across) / (last - across) * (last_up - up)
    meets = np.sort(np.where(spans, meets, math.inf), axis=1)
    meets = meets[:, : meets.shape[1] // 2 * 2]
    inside = np.isfinite(meets[:, 1::2])
    where = np.broadcast_to(lines[:, None], inside.shape)[inside][:, None] * falling
    return where + meets[:, ::2][inside][:, None] * rising, where + meets[:, 1::2][inside][:, None] * rising


def teeth(view: View, border: Border, box: Box) -> tuple[Points, Points]:
    """Short lines from a border to the side where the robot never is, their starts and ends [px]."""
    starts, ends = view.many_to_screen(border.starts), view.many_to_screen(border.ends)
    length = np.hypot(*(ends - starts).T)
    ahead = (ends - starts) / np.maximum(length, 1e-9)[:, None]
    middle = np.array([box[0] + box[2] / 2, box[1] + box[3] / 2])
    reach, at = math.hypot(box[2], box[3]) / 2, ((middle - starts) * ahead).sum(axis=1)
    low, high = np.clip(at - reach, 0.0, length), np.clip(at + reach, 0.0, length)
    gap = max(float(dp(APART)), float((high - low).sum()) / MAX_LINES)
    first = np.ceil(low / gap)
    count = np.maximum(np.floor(high / gap) - first + 1, 0).astype(np.int64)
    which = np.repeat(np.arange(len(starts)), count)
    number = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
    feet = starts[which] + ((first[which] + number) * gap)[:, None] * ahead[which]
    right = np.stack([ahead[:, 1], -ahead[:, 0]], axis=1)[which]
    return feet, feet + right * dp(TOOTH)


def refused_mark(shapes: Shapes, view: View, x: float, y: float, size: float) -> Word:
    """Round a mark of `size` [px] where the robot would not go: a ring and, above it, a sign on a ground of its own."""
    px, py = view.to_screen(x, y)
    shapes.ring(px, py, size + dp(4), dp(3), theme.danger)
    high, low = py + size + dp(4), dp(10)
    shapes.disc(px + size * 0.75, high - dp(2), low + dp(2), theme.danger)
    shapes.disc(px + size * 0.75, high - dp(2), low, theme.bg)
    return Word(icon("block"), px + size * 0.75, high - dp(2), dp(19), theme.danger, font=theme.icons)


def legend(shapes: Shapes, fence: Fence, left: float, bottom: float, room: float) -> Iterator[Word]:
    """What the lines mean, side by side where `room` [px] is enough for that, else upwards from `bottom` [px]."""
    if fence.too_large:
        word = Word(
            tr("The fence is too large to draw."), left, bottom + dp(9), sp(13), theme.warn, anchor=(0, 0.5)
        )
        ground(shapes, word, tint(theme.bg, 0.85))
        yield word
    names = _names(fence)
    beside = room >= legend_width(fence)
    x, y = left, bottom + dp(LEGEND_ROW) / 2
    for name in reversed(names) if beside else names:
        yield _entry(shapes, name, x, y)
        x, y = (x + _entry_width(name), y) if beside else (x, y + dp(LEGEND_ROW))


def legend_width(fence: Fence) -> float:
    """Of the legend where all of it stands side by side [px]; 0 without one."""
    return sum(map(_entry_width, _names(fence)))


def _names(fence: Fence) -> list[str]:
    """What the legend says, its last entry first: of the areas, and between which floor and ceiling it stays."""
    levels = between_words(fence.floor, fence.ceiling)
    return [
        name for name, found in ((levels, levels), (NEVER, fence.keep_out), (STAYS, fence.keep_in)) if found
    ]


def _entry_width(name: str) -> float:
    return float(dp(SWATCH) + dp(5) + text_texture(tr(name), round(sp(13), 1)).width + dp(12))


def _entry(shapes: Shapes, name: str, left: float, y: float) -> Word:
    """A sign, drawn as on the map, and its word on a ground of their own."""
    wide, high = dp(SWATCH), dp(12)
    middle = np.array([[left - dp(4), y], [left + _entry_width(name) - dp(8), y]])
    shapes.line(middle, dp(LEGEND_ROW), tint(theme.bg, 0.8))
    if name == NEVER:
        shape = np.array([[0, -high], [2 * wide, -high], [2 * wide, high], [0, high]]) / 2
        corners = shape + np.array([left, y])
        starts, ends = hatching(corners, (left, y), (left, y - high, wide, 2 * high))
        shapes.segments(starts, ends, dp(1.7), theme.warn)
        shapes.line(np.concatenate([corners, corners[:1]]), dp(1.6), theme.warn)
    elif name != STAYS:
        bars = np.array([[left, y - dp(5)], [left, y + dp(5)]])
        shapes.segments(bars, bars + np.array([wide, 0.0]), dp(2.4), theme.warn)
        post = np.array([[left + wide / 2, y - dp(5)]])
        shapes.segments(post, post + np.array([0.0, dp(10)]), dp(1.6), theme.warn)
    else:
        line = Border(np.array([[left, y + dp(3)]]), np.array([[left + wide, y + dp(3)]]))
        shapes.segments(line.starts, line.ends, dp(2.4), theme.warn)
        shapes.segments(*teeth(View(1 + 0j), line, (left, y, wide, high)), dp(2.0), theme.warn)
    return Word(tr(name), left + wide + dp(5), y, sp(13), theme.text, anchor=(0, 0.5))
