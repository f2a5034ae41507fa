"""Marks on a map: robot, trail, plan, waypoints, home, intruders, laser points, scale bar.

Each function puts one kind of mark into `Shapes` or gives its `Word`s. Places are in `map` [m], sizes on
the screen do not depend on the zoom.
"""

from __future__ import annotations

import math
from collections.abc import Container, Iterator, Sequence

import numpy as np
from kivy.metrics import dp, sp

from widgets.core.base import text_texture
from widgets.core.canvas_ink import Word, ground, tint
from widgets.core.geometry import Points, View, nice_floor, thinned
from widgets.core.icons import icon
from widgets.core.language import tr
from widgets.core.quantities import round_length
from widgets.core.shapes import Shapes
from widgets.core.task_words import KINDS
from widgets.core.theme import theme

__all__ = [
    "ghost_mark",
    "grid_lines",
    "home_mark",
    "intruder_marks",
    "laser_dots",
    "north_mark",
    "outline_mark",
    "outlined",
    "handle_reach",
    "place_handle",
    "place_marks",
    "reasons",
    "plan_line",
    "robot_mark",
    "route_line",
    "scale_bar",
    "trail_line",
    "waypoint_marks",
]

Place = Sequence[float]
"""x and y in `map` [m]."""

HANDLE = 74
"""From the robot to the handle that turns it [dp]."""
RANGE = 4.5
"""How far the camera's view is drawn [robot disc radii]."""
ARROW = ((0.60, 0.0), (-0.42, 0.44), (-0.22, 0.0), (-0.42, -0.44))
"""Corners of the robot's arrow, which points along x, in disc radii."""
SHORT = 16
"""Letters of a place's name on the map."""
UPRIGHT = math.radians(0.5)
"""Of a map that is turned less, north is up."""
GAP = 1.0
"""Nothing drives so far between two poses [m]: it was carried, restarted, or not heard for a while."""
FARTHEST = 1e9
"""Squares of the map's paper from its origin to where no more of them are drawn."""


def trail_line(shapes: Shapes, view: View, trail: Points) -> None:
    """Where the robot has been, fainter the longer ago; broken where it jumped."""
    jumps = np.flatnonzero(np.hypot(*np.diff(trail, axis=0).T) > GAP) + 1
    strengths = np.split(np.linspace(0.35, 0.85, len(trail)), jumps)
    for piece, strength in zip(np.split(trail, jumps), strengths, strict=True):
        seen = thinned(view.many_to_screen(piece), dp(2.5))
        colours = np.tile(np.asarray(theme.accent, dtype=np.float32), (len(seen), 1))
        colours[:, 3] = np.linspace(strength[0], strength[-1], len(seen)) if len(seen) else 0.0
        shapes.line(seen, dp(7), tint(theme.bg, 0.35))
        shapes.line(seen, dp(4), colours)


def plan_line(shapes: Shapes, view: View, plan: Points) -> None:
    """The way the robot means to take."""
    if len(plan) > 1:
        seen = view.many_to_screen(plan)
        shapes.line(seen, dp(8), tint(theme.plan, 0.16))
        shapes.line(seen, dp(2.2), tint(theme.plan, 0.75))


def route_line(shapes: Shapes, view: View, waypoints: Sequence[Place], closed: bool) -> None:
    """The order of the waypoints, as round dashes."""
    corners = [*waypoints, waypoints[0]] if closed and len(waypoints) > 2 else list(waypoints)
    if len(corners) > 1:
        seen = view.many_to_screen(np.array([place[:2] for place in corners], dtype=np.float64))
        shapes.dashes(seen, dp(4.6), theme.plan, period=dp(12.5), dash=dp(3))


def waypoint_marks(
    shapes: Shapes,
    view: View,
    waypoints: Sequence[Place],
    radius: float,
    *,
    visited: int,
    coming: int,
    selected: int,
    refused: Container[tuple[float, float]] = (),
) -> Iterator[Word]:
    """Numbered discs: the first `visited` filled, the others open; `coming` and `selected` stand out, those at `refused` are red."""
    for index, place in enumerate(waypoints):
        x, y = view.to_screen(*place[:2])
        if index == selected:
            shapes.disc(x, y, radius + dp(11), tint(theme.accent, 0.28))
            shapes.ring(x, y, radius + dp(8), dp(2.5), theme.accent)
        elif index == coming:
            shapes.disc(x, y, radius + dp(10), tint(theme.plan, 0.25))
        filled = index < visited
        bad = theme.danger if tuple(place[:2]) in refused else theme.plan
        shapes.disc(x, y, radius, theme.plan if filled else theme.bg)
        if not filled:
            shapes.ring(x, y, radius - dp(1.8), dp(3.6), bad)
        ink = theme.ink_plan if filled else bad
        yield Word(str(index + 1), x, y, radius * 1.05, ink, bold=True)


def place_marks(
    shapes: Shapes, view: View, places: Sequence[tuple[float, float, str, str]], size: float
) -> Iterator[Word]:
    """Places that have names: the sign of their kind in a square, and the name under it; `places` are x, y, name, kind.

    A name that would lie on another one is left out until the map is larger.
    """
    named: list[tuple[float, float, float]] = []
    for x, y, name, kind in places:
        px, py = view.to_screen(x, y)
        corners = [
            (px - size, py - size),
            (px + size, py - size),
            (px + size, py + size),
            (px - size, py + size),
        ]
        shapes.polygon(corners, theme.accent)
        inner = [(px + (cx - px) * 0.84, py + (cy - py) * 0.84) for cx, cy in corners]
        shapes.polygon(inner, theme.bg)
        sign = KINDS.get(kind, KINDS["place"])[0]
        if kind:  # one without a kind has a waypoint's number over it
            yield Word(icon(sign), px, py, size * 1.35, theme.accent, font=theme.icons)
        label, low = name if len(name) <= SHORT else f"{name[: SHORT - 1]}…", py - size - dp(9)
        half = text_texture(label, round(sp(13), 1), bold=True).width / 2 + dp(3)
        if all(abs(px - ox) > half + wide or abs(low - oy) > dp(17) for ox, oy, wide in named):
            named.append((px, low, half))
            yield from outlined(Word(label, px, low, sp(13), theme.text, True))


def home_mark(shapes: Shapes, view: View, home: Place, radius: float) -> Word:
    """The place to return to."""
    x, y = view.to_screen(*home[:2])
    shapes.disc(x, y, radius, theme.ok)
    shapes.ring(x, y, radius + dp(3), dp(2), tint(theme.ok, 0.4))
    return Word(icon("home"), x, y, radius * 1.3, theme.bg, font=theme.icons)


def intruder_marks(
    shapes: Shapes,
    view: View,
    intruders: Sequence[tuple[float, float, str]],
    size: float,
    *,
    box: tuple[float, float, float, float],
    taken: Sequence[tuple[float, float]] = (),
    faded: bool = False,
) -> Iterator[Word]:
    """A red triangle in a dashed circle, with a word on a ground of its own beside it; grey where it is `faded`.

    The word stands on a side where it is inside `box` (x, y, width, height) [px] and off the marks at `taken` [px].
    """
    colour = theme.muted if faded else theme.danger
    places = [view.to_screen(x, y) for x, y, _ in intruders]
    for (px, py), (_, _, label) in zip(places, intruders, strict=True):
        shapes.disc(px, py, size * 1.3, tint(theme.bg, 0.6))
        shapes.disc(px, py, size * 1.3, tint(colour, 0.14))
        shapes.ring(px, py, size * 1.3, dp(2.6), colour, dashes=16)
        half, low, high = size * 0.62, size * 0.6, size * 0.75
        shapes.polygon([(px, py + high), (px - half, py - low), (px + half, py - low)], colour)
        others = [*taken, *(place for place in places if place != (px, py))]
        word = _beside((px, py), label, size, box, others)
        word.colour = colour
        ground(shapes, word, tint(theme.bg, 0.85))
        yield word


def reasons(
    shapes: Shapes,
    view: View,
    places: Sequence[tuple[float, float, str, float]],
    *,
    box: tuple[float, float, float, float],
    taken: Sequence[tuple[float, float]] = (),
) -> Iterator[Word]:
    """A few words beside each of `places`: x and y [m], the words, and the size of the mark there [px]; inside `box` and off `taken` [px]."""
    for x, y, words, size in places:
        at = view.to_screen(x, y)
        word = _beside(at, words, size, box, [one for one in taken if one != at])
        word.colour = theme.danger
        ground(shapes, word, tint(theme.bg, 0.85))
        yield word


def _beside(
    at: tuple[float, float],
    text: str,
    size: float,
    box: tuple[float, float, float, float],
    taken: Sequence[tuple[float, float]],
) -> Word:
    """The word right of a mark, left of it, above or below: on the first side that is free, else the freest."""
    type_size, edge, away = sp(13), dp(8), size * 1.3 + dp(8)
    wide, high = text_texture(text, round(type_size, 1), bold=True).size
    left, low = box[0] + edge + wide / 2, box[1] + edge + high / 2
    right, top = max(left, box[0] + box[2] - edge - wide / 2), max(low, box[1] + box[3] - edge - high / 2)
    inside = min(max(at[0], left), right)
    across, up = away + wide / 2, away + high / 2
    sides = [(at[0] + across, at[1]), (at[0] - across, at[1]), (inside, at[1] + up), (inside, at[1] - up)]

    def cost(x: float, y: float) -> float:
        out = abs(x - min(max(x, left), right)) + abs(y - min(max(y, low), top))
        gaps = (
            math.hypot(max(abs(tx - x) - wide / 2, 0.0), max(abs(ty - y) - high / 2, 0.0)) for tx, ty in taken
        )
        return 1e3 * out + sum(max(0.0, size * 1.8 - gap) for gap in gaps)

    return Word(text, *min(sides, key=lambda side: cost(*side)), type_size, theme.danger, True)


def outlined(word: Word) -> Iterator[Word]:
    """The word with the window's colour round it, so that it can be read on any map."""
    for dx, dy in ((-1, -1), (1, -1), (-1, 1), (1, 1)):
        x, y = word.x + dx * dp(1), word.y + dy * dp(1)
        yield Word(word.text, x, y, word.size, theme.bg, word.bold, word.font, word.anchor)
    yield word


def laser_dots(shapes: Shapes, view: View, points: Points) -> None:
    """What the laser hits."""
    if len(points):
        shapes.discs(view.many_to_screen(points), dp(1.8), tint(theme.warn, 0.9))


def robot_mark(
    shapes: Shapes,
    view: View,
    pose: tuple[float, float, float],
    radius: float,
    *,
    fov: float,
    faded: bool,
    alarm: bool,
) -> None:
    """A disc with an arrow, and the slice of the world that the camera sees; `pose` is x, y [m] and yaw [rad]."""
    x, y = view.to_screen(*pose[:2])
    yaw = pose[2] + view.turn
    if math.isfinite(fov):
        half = min(fov / 2, math.pi / 2)
        shapes.sector(x, y, radius * RANGE, yaw=yaw, half_angle=half, colour=tint(theme.accent, 0.18))
    shapes.disc(x, y, radius + dp(3), tint(theme.bg, 0.35))
    ring = theme.danger if alarm else theme.text
    shapes.disc(x, y, radius + dp(1), ring)
    shapes.disc(x, y, radius - dp(2), theme.muted if faded else theme.accent)
    shapes.polygon(arrow(x, y, yaw, radius), theme.ink_accent)


def outline_mark(shapes: Shapes, corners: Points, *, faded: bool, alarm: bool) -> None:
    """The outline of a robot to scale; `corners` on the glass [px]."""
    colour = theme.danger if alarm else theme.muted if faded else theme.accent
    around = np.concatenate([corners, corners[:1]])
    shapes.line(around, dp(6), tint(theme.bg, 0.5))
    shapes.polygon([(float(x), float(y)) for x, y in corners], tint(colour, 0.45))
    shapes.line(around, dp(2.4), colour)


def north_mark(shapes: Shapes, x: float, y: float, turn: float) -> Word:
    """Where north is on a map that is turned by `turn` [rad]: a needle round an upright letter."""
    radius, way = dp(19), math.pi / 2 + turn
    shapes.disc(x, y, radius, tint(theme.bg, 0.85))
    shapes.ring(x, y, radius, dp(1.4), theme.muted)
    cos, sin = math.cos(way), math.sin(way)
    tip, base, half = radius + dp(7), radius - dp(3), dp(6)
    corners = [(tip, 0.0), (base, half), (base, -half)]
    shapes.polygon([(x + cos * u - sin * v, y + sin * u + cos * v) for u, v in corners], theme.danger)
    return Word(tr("N", "compass"), x, y, sp(14), theme.text, bold=True)


def ghost_mark(shapes: Shapes, view: View, pose: tuple[float, float, float], radius: float) -> None:
    """The robot where it is being put: hollow, because it is not there; `pose` is x, y [m] and yaw [rad]."""
    x, y = view.to_screen(*pose[:2])
    shapes.disc(x, y, radius + dp(3), tint(theme.bg, 0.35))
    shapes.ring(x, y, radius, dp(2.6), theme.plan, dashes=12)
    shapes.polygon(arrow(x, y, pose[2] + view.turn, radius), theme.plan)


def arrow(x: float, y: float, yaw: float, radius: float) -> list[tuple[float, float]]:
    """Corners of the arrow on the screen, for a disc of `radius` [px]."""
    cos, sin = math.cos(yaw) * radius, math.sin(yaw) * radius
    return [(x + cos * u - sin * v, y + sin * u + cos * v) for u, v in ARROW]


def handle_reach(
    view: View, pose: tuple[float, float, float], box: tuple[float, float, float, float]
) -> float:
    """How far from a robot being placed its handle stands [px]: less where it would leave the screen's `box`."""
    x, y = view.to_screen(*pose[:2])
    yaw = pose[2] + view.turn
    left, low, width, height = box
    room = float(dp(HANDLE))
    for at, start, size, way in ((x, left, width, math.cos(yaw)), (y, low, height, math.sin(yaw))):
        edge = start + size - dp(20) - at if way > 0 else at - start - dp(20)
        if abs(way) > 1e-6:
            room = min(room, edge / abs(way))
    return max(room, float(dp(40)))


def place_handle(
    shapes: Shapes, view: View, pose: tuple[float, float, float], radius: float, reach: float
) -> tuple[Word, tuple[float, float]]:
    """The ring round a robot that is being put somewhere and the handle that turns it; gives the handle's place."""
    x, y = view.to_screen(*pose[:2])
    yaw = pose[2] + view.turn
    hx, hy = x + reach * math.cos(yaw), y + reach * math.sin(yaw)
    shapes.ring(x, y, reach, dp(2.4), tint(theme.plan, 0.8), dashes=36)
    shapes.disc(x, y, reach, tint(theme.plan, 0.10))
    shapes.line(np.array([[x, y], [hx, hy]]), dp(3), theme.plan)
    shapes.disc(hx, hy, radius * 0.86 + dp(2), theme.text)
    shapes.disc(hx, hy, radius * 0.86, theme.plan)
    return Word(icon("autorenew"), hx, hy, radius * 1.1, theme.ink_plan, font=theme.icons), (hx, hy)


def scale_bar(shapes: Shapes, view: View, left: float, bottom: float, longest: float) -> Iterator[Word]:
    """A round length at the scale of the map, with its text above."""
    metres, words = round_length(longest / view.scale)
    right, high = left + metres * view.scale, bottom + dp(6)
    corners = np.array([[left, high], [left, bottom], [right, bottom], [right, high]])
    edge, middle = dp(6), bottom + sp(9)
    behind = np.array([[left - edge, middle], [right + edge, middle]])
    shapes.line(behind, sp(26), tint(theme.bg, 0.85))  # a fence or a grid may run through it
    shapes.line(corners, dp(5), tint(theme.bg, 0.7))
    shapes.line(corners, dp(2), theme.text)
    yield from outlined(Word(words, (left + right) / 2, bottom + dp(4), sp(13), theme.text, anchor=(0.5, 0)))


def grid_lines(
    shapes: Shapes, view: View, box: tuple[float, float, float, float], colour: Sequence[float]
) -> None:
    """Lines of a round distance east and north, over the screen's `box` (x, y, width, height) [px]."""
    step = nice_floor(dp(150) / view.scale)
    x, y, width, height = box
    corners = np.array([view.to_world(x + dx, y + dy) for dx in (0, width) for dy in (0, height)])
    if not (np.abs(corners) < FARTHEST * step).all():
        return  # where a robot says that it is, numbers are too coarse to count lines by
    low, high = np.floor(corners.min(axis=0) / step) * step, corners.max(axis=0)
    easts, norths = np.arange(low[0], high[0] + step, step), np.arange(low[1], high[1] + step, step)
    starts = [(east, low[1]) for east in easts] + [(low[0], north) for north in norths]
    ends = [(east, high[1] + step) for east in easts] + [(high[0] + step, north) for north in norths]
    start, end = view.many_to_screen(np.array(starts)), view.many_to_screen(np.array(ends))
    shapes.segments(start, end, dp(1), colour)
