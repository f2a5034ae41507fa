"""Where robots charge: a dock for wheels, a jetty for boats, a pad for drones and a cage for swimmers.

Each stands in a frame whose origin is where a robot's contacts meet its own, and whose x is the way that the robot faces then.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from sim.core.shapes import Colour, Quat, Shape, Vec3
from sim.world.props import Prop
from sim.world.tables import DockKind
from sim.world.tag_pattern import tag_plate

__all__ = [
    "CAGE_REACH",
    "MAKERS",
    "STRIP_SPACING",
    "STRIP_WIDTH",
    "TAG_HEIGHT",
    "cage",
    "dock",
    "jetty",
    "pad",
]

STRIP_WIDTH, STRIP_SPACING = 0.05, 0.30
"""Of the two upright strips that throw a laser's light straight back, and from the middle of one to the other's [m]."""
TAG_HEIGHT: dict[DockKind, float] = {"contacts": 0.76, "jetty": 0.50, "pad": 0.0, "cage": 0.24}
"""Of the middle of the tag above the contacts' origin [m]; on a pad the tag lies in the middle."""
CAGE_REACH = 0.55
"""From the cage's coil to its open front [m]."""

BODY: Colour = (0.16, 0.18, 0.20)
PANEL: Colour = (0.24, 0.27, 0.30)
COPPER: Colour = (0.80, 0.50, 0.26)
SILVER: Colour = (0.86, 0.88, 0.90)
LIGHT: Colour = (0.20, 0.86, 0.52)
WOOD: Colour = (0.56, 0.42, 0.28)
PLANK: Colour = (0.62, 0.48, 0.33)
PILE: Colour = (0.34, 0.25, 0.17)
FENDER: Colour = (0.10, 0.10, 0.11)
YELLOW: Colour = (0.93, 0.74, 0.10)
WHITE: Colour = (0.95, 0.95, 0.93)
SLATE: Colour = (0.20, 0.23, 0.27)

_SKIN = 0.002
"""Thickness of what is stuck or screwed on a front [m]."""
_UPWARD: Quat = (0.0, 0.7071067811865476, 0.0, 0.7071067811865476)
"""Turns what faces against x to face up, its top towards x."""
_AHEAD: Quat = (0.0, 0.7071067811865476, 0.0, 0.7071067811865476)
"""Lays a cylinder along x."""


def _box(low: Vec3, high: Vec3, colour: Colour, *, glow: float = 0.0, gloss: float = 0.0) -> Shape:
    """The box between two corners [m]."""
    size = (high[0] - low[0], high[1] - low[1], high[2] - low[2])
    middle = ((high[0] + low[0]) / 2, (high[1] + low[1]) / 2, (high[2] + low[2]) / 2)
    return Shape("box", size, middle, colour=colour, glow=glow, gloss=gloss)


def _strips(front: float, low: float, high: float) -> tuple[Shape, ...]:
    """The two strips on a front at x = `front` [m], from `low` to `high` [m]."""
    half = STRIP_WIDTH / 2
    return tuple(
        replace(_box((front - _SKIN, y - half, low), (front, y + half, high), SILVER, glow=0.5), retro=True)
        for y in (STRIP_SPACING / 2, -STRIP_SPACING / 2)
    )


def dock(tag: int) -> Prop:
    """A slim pillar with two contact rails below, the strips in their plane above them, and the tag on top."""
    half, depth, foot, height = 0.22, 0.14, 0.26, 0.90
    back = depth + _SKIN
    strips = _strips(_SKIN, 0.27, 0.62)
    solids = (
        _box((_SKIN, -half, 0.0), (back, half, height), BODY),
        _box((0.0, -half, 0.0), (back, half, foot), BODY),
        *strips,
    )
    visuals = (
        _box((_SKIN, -half, 0.02), (back, half, height - 0.03), BODY, gloss=0.2),
        _box((_SKIN - 0.006, -half - 0.01, height - 0.03), (back + 0.01, half + 0.01, height), PANEL),
        _box((0.0, -half - 0.015, 0.0), (back + 0.02, half + 0.015, 0.03), PANEL),
        _box((0.0, -half, 0.03), (back, half, foot), PANEL, gloss=0.2),
        *(_box((-_SKIN, y - 0.018, 0.05), (0.01, y + 0.018, 0.22), COPPER, gloss=0.8) for y in (0.07, -0.07)),
        _box((-_SKIN, -half + 0.03, foot - 0.025), (0.01, half - 0.03, foot - 0.015), LIGHT, glow=0.9),
        *strips,
        *(shape.at((_SKIN, 0.0, TAG_HEIGHT["contacts"]), (0.0, 0.0, 0.0, 1.0)) for shape in tag_plate(tag)),
    )
    return Prop("dock", solids, visuals)


def jetty(tag: int) -> Prop:
    """The head of a jetty with a berth between two fingers for the bow of a boat, and a charging post on it."""
    deck, half, reach, top, slot = 1.2, 1.1, 0.6, 0.30, 0.42
    head = _box((0.0, -half, -0.35), (deck, half, top), WOOD)
    fingers = tuple(_box((-reach, *low), (0.0, *high), WOOD) for low, high in _fingers(slot, half, top))
    post = _box((0.22, -0.22, top), (0.36, 0.22, 1.0), BODY)
    planks = tuple(
        _box((x, -half - 0.03, top - 0.06), (x + 0.135, half + 0.03, top), PLANK if number % 2 else WOOD)
        for number, x in enumerate(0.15 * step for step in range(round(deck / 0.15)))
    )
    piles = (
        *(_pile(deck - 0.1, side * (half - 0.1), top - 0.02) for side in (1, -1)),
        *(_pile(-reach + 0.13, side * (half + slot) / 2, top + 0.28) for side in (1, -1)),
    )
    visuals = (
        *planks,
        _box((0.03, -half, -0.05), (deck, half, top - 0.06), PILE),
        *(_box((-reach, *low), (0.0, *high), PLANK) for low, high in _fingers(slot, half, top)),
        *piles,
        _box((0.0, -slot, -0.10), (0.035, slot, top - 0.07), FENDER),
        *(_box((-_SKIN, y - 0.03, 0.02), (0.03, y + 0.03, 0.16), COPPER, gloss=0.8) for y in (0.12, -0.12)),
        _box((0.222, -0.22, top), (0.36, 0.22, 0.97), BODY, gloss=0.2),
        _box((0.212, -0.23, 0.97), (0.37, 0.23, 1.0), PANEL),
        _box((0.216, -0.19, 0.645), (0.23, 0.19, 0.655), LIGHT, glow=0.9),
        *_strips(0.222, 0.36, 0.63),
        *(shape.at((0.222, 0.0, TAG_HEIGHT["jetty"]), (0.0, 0.0, 0.0, 1.0)) for shape in tag_plate(tag)),
    )
    return Prop("jetty", (head, *fingers, post, *_strips(0.222, 0.36, 0.63)), visuals)


def _pile(x: float, y: float, top: float) -> Shape:
    """A round post that stands in the water."""
    return Shape("cylinder", (0.16, 0.16, top + 1.2), (x, y, (top - 1.2) / 2), colour=PILE)


def _fingers(
    slot: float, half: float, top: float
) -> tuple[tuple[tuple[float, float], tuple[float, float]], ...]:
    """Of both fingers, from the berth's side to the deck's edge: the lower and the upper corner's y and z [m]."""
    return (((slot, -0.35), (half, top)), ((-half, -0.35), (-slot, top)))


def pad(tag: int, top: float) -> Prop:
    """A round pad with an H and the tag in its crossbar; with its `top` above 0 [m] it is a platform that one lands on."""
    disc = Shape("cylinder", (1.2, 1.2, 0.008), (0.0, 0.0, 0.004), colour=SLATE)
    ring = (
        Shape("cylinder", (1.12, 1.12, 0.002), (0.0, 0.0, 0.009), colour=YELLOW, glow=0.15),
        Shape("cylinder", (1.02, 1.02, 0.002), (0.0, 0.0, 0.0102), colour=SLATE),
    )
    bars = tuple(
        _box((-0.32, y - 0.05, 0.009), (0.32, y + 0.05, 0.0125), WHITE, glow=0.15) for y in (0.22, -0.22)
    )
    cross = _box((-0.05, -0.20, 0.009), (0.05, 0.20, 0.0122), WHITE, glow=0.15)
    plate = tuple(shape.at((0.0, 0.0, 0.0125), _UPWARD) for shape in tag_plate(tag))
    marks = (disc, *ring, *bars, cross, *plate)
    if top <= 0:
        return Prop("pad", (), marks)
    side, deep = 1.5, 0.35
    block = _box((-side / 2, -side / 2, -deep), (side / 2, side / 2, 0.0), PANEL)
    edge = _box(
        (-side / 2 - 0.02, -side / 2 - 0.02, -0.12), (side / 2 + 0.02, side / 2 + 0.02, -0.05), YELLOW
    )
    return Prop("pad", (block,), (block, edge, *marks))


def cage(tag: int, depth: float) -> Prop:
    """An open-fronted cage that hangs from two floats, `depth` [m] above it; a coil in its back, the tag over that."""
    half, high, low = 0.42, 0.42, -0.34
    back = _box((0.0, -half, low), (0.10, half, high), PANEL)
    walls = (
        back,
        *(_box((-CAGE_REACH, y - 0.02, low), (0.0, y + 0.02, high), YELLOW) for y in (half, -half)),
        *(_box((-CAGE_REACH, -half, z - 0.02), (0.0, half, z + 0.02), YELLOW) for z in (low, high)),
    )
    bars = (
        *(_bar(-CAGE_REACH, 0.0, y, z) for z in (low, -0.09, 0.16, high) for y in (half, -half)),
        *(_bar(-CAGE_REACH, 0.0, y, z) for y in (0.21, 0.0, -0.21) for z in (low, high)),
        *(
            _box((x, y - 0.018, low), (x + 0.036, y + 0.018, high), YELLOW)
            for x in (-CAGE_REACH, -CAGE_REACH / 2)
            for y in (half, -half)
        ),
        *(
            _box((-CAGE_REACH, -half, z - 0.018), (-CAGE_REACH + 0.036, half, z + 0.018), YELLOW)
            for z in (low, high)
        ),
    )
    coil = (
        Shape("cylinder", (0.26, 0.26, 0.02), (-0.004, 0.0, 0.0), _AHEAD, BODY),
        Shape("cylinder", (0.22, 0.22, 0.02), (-0.006, 0.0, 0.0), _AHEAD, COPPER, gloss=0.5),
        Shape("cylinder", (0.13, 0.13, 0.02), (-0.008, 0.0, 0.0), _AHEAD, BODY),
        _box((-0.004, -0.30, -0.20), (0.01, 0.30, -0.18), LIGHT, glow=0.9),
    )
    floats = tuple(
        Shape("sphere", (0.30, 0.30, 0.30), (0.05, y, depth), colour=YELLOW) for y in (half, -half)
    )
    ropes = tuple(
        Shape("cylinder", (0.02, 0.02, depth - high), (0.05, y, (depth + high) / 2), colour=SILVER)
        for y in (half, -half)
    )
    plate = tuple(shape.at((0.0, 0.0, TAG_HEIGHT["cage"]), (0.0, 0.0, 0.0, 1.0)) for shape in tag_plate(tag))
    return Prop("cage", (*walls, *floats), (back, *bars, *coil, *plate, *ropes, *floats))


def _bar(start: float, end: float, y: float, z: float) -> Shape:
    """A round bar along x."""
    return Shape("cylinder", (0.036, 0.036, end - start), ((start + end) / 2, y, z), _AHEAD, YELLOW)


MAKERS: dict[DockKind, Callable[[int, float], Prop]] = {
    "contacts": lambda tag, _: dock(tag),
    "jetty": lambda tag, _: jetty(tag),
    "pad": pad,
    "cage": lambda tag, z: cage(tag, -z),
}
"""What each kind is made by, of its tag and its height [m]."""
