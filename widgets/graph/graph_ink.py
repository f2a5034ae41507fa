"""Shapes and words of a graph that is laid out: boxes of topics, rounded ones of nodes, curved arrows between them."""

from __future__ import annotations

import itertools
import math
from collections.abc import Collection, Mapping, Sequence

import numpy as np
from kivy.metrics import dp, sp

from widgets.core.base import text_texture
from widgets.core.canvas_ink import Word, tint
from widgets.core.geometry import Points
from widgets.core.language import tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.graph.graph_layout import GraphLayout
from widgets.graph.graph_model import GROUP, NODE, Box, Shown

__all__ = ["drawn", "label_of", "size_of"]

MAX_LETTERS = 34
"""Of a name in a box; the end is kept, by which names differ."""
FADED = 0.16
"""Opacity of what is not looked at."""
MAX_CURVED = 700
"""Pieces of arrows that are curved; of more all are straight."""
MIN_TYPE = 5.5
"""Smaller words are not written: nobody can read them [sp]."""
TYPE = 13.0
"""Of the names at scale 1 [sp]."""

Point = tuple[float, float]


def label_of(box: Box) -> str:
    """What is written in a box."""
    name = box.topics[0] if box.kind == GROUP else box.name.partition(" ")[2]
    short = name if len(name) <= MAX_LETTERS else f"…{name[1 - MAX_LETTERS :]}"
    if box.kind != GROUP:
        return short
    return tr("{name} and {count} more").format(name=short, count=len(box.topics) - 1)


def size_of(box: Box) -> Point:
    """Width and height of a box at scale 1 [px]."""
    texture = text_texture(label_of(box), round(sp(TYPE), 1), theme.font, bold=box.kind == NODE)
    return texture.width + dp(30 if box.kind == NODE else 20), max(dp(34), texture.height + dp(14))


def drawn(
    shown: Shown,
    layout: GraphLayout,
    sizes: Mapping[str, Point],
    scale: float,
    lit: Collection[str] | None,
    selected: str,
) -> tuple[Shapes, list[Word]]:
    """Everything at that scale, the layout's origin at (0, 0) [px]; what is not `lit` is faded, None for all alike."""
    shapes, words = Shapes(), []
    curved = sum(len(way) - 1 for way in layout.ways.values()) <= MAX_CURVED
    for edge in sorted(layout.ways, key=lambda edge: lit is not None and _lit(edge, lit, selected)):
        bright = lit is None or _lit(edge, lit, selected)
        way = _way(layout, edge, sizes, curved=curved)
        _arrow(shapes, way * scale, scale, bright=bright, chosen=bright and lit is not None)
    for name, box in shown.boxes.items():
        strength = 1.0 if lit is None or name in lit else FADED
        middle = np.array(layout.places[name]) * scale
        size = np.array(sizes[name]) * scale
        _box(shapes, box, middle, size, strength, chosen=name == selected)
        if TYPE * scale >= MIN_TYPE:
            ink = tint(theme.text, max(strength, 0.35) if strength < 1 else 1.0)
            words.append(
                Word(
                    label_of(box),
                    float(middle[0]),
                    float(middle[1]),
                    sp(TYPE) * scale,
                    ink,
                    bold=box.kind == NODE,
                )
            )
    return shapes, words


def _lit(edge: tuple[str, str], lit: Collection[str], selected: str) -> bool:
    return selected in edge if selected else edge[0] in lit and edge[1] in lit


def _way(layout: GraphLayout, edge: tuple[str, str], sizes: Mapping[str, Point], *, curved: bool) -> Points:
    """Points of an arrow from edge to edge of its boxes."""
    points = np.array(layout.ways[edge])
    axis = 1 if layout.down else 0
    ahead = math.copysign(1.0, points[-1][axis] - points[0][axis])
    points[0][axis] += ahead * sizes[edge[0]][axis] / 2
    points[-1][axis] -= ahead * sizes[edge[1]][axis] / 2
    if not curved:
        return points
    pieces = [_curve(a, b, axis) for a, b in itertools.pairwise(points)]
    return np.concatenate(pieces)


def _curve(start: Points, end: Points, axis: int, count: int = 10) -> Points:
    """From `start` to `end`, leaving and arriving along the axis of the layers."""
    if abs(start[1 - axis] - end[1 - axis]) < 0.5:
        return np.array([start, end])
    bend = np.zeros(2)
    bend[axis] = (end[axis] - start[axis]) / 2
    t = np.linspace(0.0, 1.0, count)[:, None]
    return np.asarray(
        (1 - t) ** 3 * start
        + 3 * (1 - t) ** 2 * t * (start + bend)
        + 3 * (1 - t) * t**2 * (end - bend)
        + t**3 * end
    )


def _arrow(shapes: Shapes, way: Points, scale: float, *, bright: bool, chosen: bool) -> None:
    colour = tint(theme.accent if chosen else theme.muted, (1.0 if chosen else 0.75) if bright else FADED)
    width = max(dp(2.4 if chosen else 1.4) * min(scale, 1.0), dp(0.8))
    tip, before = way[-1], way[-2]
    length = float(np.hypot(*(tip - before)))
    if length < 1e-6:
        return
    ahead = (tip - before) / length
    head = max(dp(9) * min(scale, 1.2), dp(3.5))
    foot = tip - ahead * head
    aside = np.array([-ahead[1], ahead[0]]) * head * 0.5
    shapes.line(np.concatenate([way[:-1], [tip - ahead * min(head * 0.7, length * 0.9)]]), width, colour)
    shapes.polygon([tuple(tip), tuple(foot + aside), tuple(foot - aside)], colour)


def _box(shapes: Shapes, box: Box, middle: Points, size: Points, strength: float, *, chosen: bool) -> None:
    """A topic has corners, a node is round at its ends, a group lies on another box."""
    edge = dp(3.0 if chosen else 1.4)
    rim = theme.accent if chosen or box.kind == NODE else theme.muted
    form = _round if box.kind == NODE else _square
    if box.kind == GROUP:
        behind = middle + np.array([1.0, -1.0]) * max(size[1] * 0.12, dp(2))
        _square(shapes, behind, size, tint(rim, strength))
        _square(shapes, behind, size - 2 * edge, _over(theme.raised, theme.bg, strength))
    form(shapes, middle, size, _over(rim, theme.bg, strength))
    fill = _over(theme.accent, theme.surface, 0.2) if box.kind == NODE else theme.raised
    form(shapes, middle, size - 2 * edge, _over(fill, theme.bg, max(strength, 0.3)))


def _over(colour: Sequence[float], ground: Sequence[float], alpha: float) -> tuple[float, ...]:
    """A colour as it looks on an opaque ground: arrows beneath a box do not shine through."""
    return (
        *(alpha * one + (1 - alpha) * other for one, other in zip(colour[:3], ground[:3], strict=True)),
        1.0,
    )


def _square(shapes: Shapes, middle: Points, size: Points, colour: Sequence[float]) -> None:
    half = np.array([max(size[0] / 2, 0.5), 0.0])
    shapes.segments(np.array([middle - half]), np.array([middle + half]), max(float(size[1]), 1.0), colour)


def _round(shapes: Shapes, middle: Points, size: Points, colour: Sequence[float]) -> None:
    radius = max(float(size[1]) / 2, 0.5)
    half = np.array([max(float(size[0]) / 2 - radius, 0.0), 0.0])
    shapes.discs(np.array([middle - half, middle + half]), radius, colour)
    if half[0] > 0:
        shapes.segments(np.array([middle - half]), np.array([middle + half]), 2 * radius, colour)
