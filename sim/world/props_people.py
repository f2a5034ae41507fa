"""People, fruit trees and other things that stand in offices and orchards."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from sim.core.shapes import Colour, Quat, Shape
from sim.world.props import Prop, foliage, twigs
from sim.world.props_office import desk_things

__all__ = ["POSTURES", "Looks", "barrel", "fruit_tree", "person", "table"]

SKIN: Colour = (0.80, 0.62, 0.50)
HAIR: Colour = (0.20, 0.15, 0.11)
TROUSERS: Colour = (0.17, 0.20, 0.29)
SHOES: Colour = (0.12, 0.11, 0.11)
WOOD: Colour = (0.64, 0.50, 0.34)
METAL: Colour = (0.42, 0.44, 0.47)
BARK: Colour = (0.36, 0.26, 0.18)
LEAF: Colour = (0.24, 0.43, 0.16)
ORANGE: Colour = (0.95, 0.48, 0.05)

TALL = 1.75
"""Height of a person who is not told to be of another [m]."""
HIP, SHOULDER = 0.86, 1.38
"""Heights of the joints of one so tall [m]."""
UPRIGHT: Quat = (0.0, 0.0, 0.0, 1.0)
_POSES: dict[str, tuple[float, tuple[float, float], float, float]] = {
    "standing": (0.0, (0.0, 0.0), 0.0, 0.0),
    "walking": (0.42, (0.5, -0.5), 0.0, 0.0),
    "waving": (0.0, (0.0, -2.7), 0.0, 0.0),
    "bending": (0.0, (-0.7, -0.5), 0.7, 0.0),
    "crouching": (0.0, (-0.8, -0.6), 0.35, 0.40),
}
"""Of each posture: a leg's swing, the arms' swings, how far the trunk bends [rad], and how much lower it is [m]."""
POSTURES = tuple(_POSES)

ORANGE_RADIUS = 0.035
"""[m]"""


@dataclass(frozen=True, slots=True)
class Looks:
    """What a person wears and how they stand."""

    trousers: Colour = TROUSERS
    skin: Colour = SKIN
    hair: Colour = HAIR
    height: float = TALL
    """[m]"""
    posture: str = "standing"
    """One of `POSTURES`."""


def person(colour: Colour, looks: Looks = Looks()) -> Prop:
    """A person who looks along x, in a shirt of this colour."""
    stride, swing, bend, low = _POSES[looks.posture]
    legs = [
        part
        for side in (-1, 1)
        for part in (_folded(side, looks) if low else _swung(_leg(side, looks), HIP, side * stride))
    ]
    arms = [
        part
        for side, turn in zip((-1, 1), swing, strict=True)
        for part in _swung(_arm(side, colour, looks), SHOULDER, turn)
    ]
    upper = [part for each in (*_trunk(colour), *arms, *_head(looks)) for part in _swung((each,), HIP, bend)]
    sunk = [part.at((0.0, 0.0, -low), UPRIGHT) for part in upper] if low else upper
    scale = looks.height / TALL
    visuals = tuple(part if scale == 1.0 else _scaled(part, scale) for part in (*legs, *sunk))
    tall = (TALL - low) * scale
    solid = Shape("cylinder", (0.44, 0.44, tall), (0.0, 0.0, tall / 2))
    return Prop("person", (solid,), visuals)


def barrel(height: float, colour: Colour) -> Prop:
    """A barrel of `height` [m] with two hoops."""
    wide = height * 0.66
    body = Shape("cylinder", (wide, wide, height), (0.0, 0.0, height / 2), colour=colour, gloss=0.2)
    dark: Colour = (colour[0] * 0.7, colour[1] * 0.7, colour[2] * 0.7)
    hoops = tuple(
        Shape("cylinder", (wide * 1.04, wide * 1.04, 0.04), (0.0, 0.0, height * at), colour=dark)
        for at in (0.33, 0.67)
    )
    lid = Shape("cylinder", (wide * 0.9, wide * 0.9, 0.012), (0.0, 0.0, height + 0.006), colour=dark)
    return Prop("barrel", (Shape("cylinder", body.size, body.position),), (body, *hoops, lid))


def _leg(side: int, looks: Looks) -> tuple[Shape, ...]:
    return (
        Shape(
            "cylinder", (0.12, 0.12, 0.80), (0.0, side * 0.09, 0.46), colour=looks.trousers, taper=(1.4, 1.4)
        ),
        Shape("box", (0.27, 0.10, 0.09), (0.05, side * 0.09, 0.045), colour=SHOES, taper=(0.85, 0.9)),
    )


def _folded(side: int, looks: Looks) -> tuple[Shape, ...]:
    """A leg of one who crouches."""
    return (
        Shape("cylinder", (0.11, 0.11, 0.42), (0.20, side * 0.13, 0.28), colour=looks.trousers),
        Shape("cylinder", (0.17, 0.17, 0.44), (0.02, side * 0.12, 0.47), _pitched(1.45), looks.trousers),
        Shape("box", (0.27, 0.10, 0.09), (0.24, side * 0.13, 0.045), colour=SHOES, taper=(0.85, 0.9)),
    )


def _trunk(colour: Colour) -> tuple[Shape, ...]:
    return (
        Shape("box", (0.20, 0.34, 0.06), (0.0, 0.0, 0.86), colour=SHOES),
        Shape("box", (0.20, 0.34, 0.34), (0.0, 0.0, 1.04), colour=colour, taper=(1.08, 1.12)),
        Shape("box", (0.216, 0.38, 0.22), (0.0, 0.0, 1.32), colour=colour, taper=(0.75, 0.90)),
        Shape("sphere", (0.18, 0.38, 0.12), (0.0, 0.0, 1.42), colour=colour),
    )


def _arm(side: int, colour: Colour, looks: Looks) -> tuple[Shape, ...]:
    return (
        Shape("sphere", (0.13, 0.13, 0.15), (0.0, side * 0.20, 1.38), colour=colour),
        Shape("cylinder", (0.085, 0.085, 0.50), (0.0, side * 0.24, 1.13), colour=colour, taper=(1.3, 1.3)),
        Shape("sphere", (0.09, 0.07, 0.15), (0.02, side * 0.24, 0.82), colour=looks.skin),
    )


def _head(looks: Looks) -> tuple[Shape, ...]:
    return (
        Shape("cylinder", (0.11, 0.11, 0.12), (0.0, 0.0, 1.49), colour=looks.skin),
        Shape("sphere", (0.20, 0.165, 0.25), (0.02, 0.0, 1.62), colour=looks.skin),
        Shape("sphere", (0.05, 0.035, 0.05), (0.12, 0.0, 1.61), colour=looks.skin),
        Shape("sphere", (0.21, 0.185, 0.19), (-0.02, 0.0, 1.67), colour=looks.hair),
    )


def _pitched(turn: float) -> Quat:
    return (0.0, math.sin(turn / 2), 0.0, math.cos(turn / 2))


def _swung(parts: tuple[Shape, ...], pivot: float, turn: float) -> tuple[Shape, ...]:
    """The parts turned by `turn` [rad] round an axis along y at the height `pivot` [m]."""
    if turn == 0.0:
        return parts
    return tuple(part.at((0.0, 0.0, -pivot), UPRIGHT).at((0.0, 0.0, pivot), _pitched(turn)) for part in parts)


def _scaled(part: Shape, scale: float) -> Shape:
    x, y, z = part.position
    length, width, height = part.size
    return replace(
        part,
        position=(x * scale, y * scale, z * scale),
        size=(length * scale, width * scale, height * scale),
    )


def table(length: float, width: float, height: float, screens: int = 0) -> Prop:
    """A table on four legs, lengths in [m]; with `screens` somebody works there."""
    top = Shape("box", (length, width, 0.04), (0.0, 0.0, height - 0.02), colour=WOOD, gloss=0.2)
    legs = tuple(
        Shape(
            "box",
            (0.06, 0.06, height - 0.04),
            (x * (length / 2 - 0.05), y * (width / 2 - 0.05), (height - 0.04) / 2),
            colour=METAL,
        )
        for x in (-1, 1)
        for y in (-1, 1)
    )
    return Prop("table", (top, *legs), (top, *legs, *desk_things(length, width, height, screens)))


def fruit_tree(height: float, fruits: int) -> Prop:
    """An orange tree of `height` [m] with so many `fruits` on its side towards x, some low enough for an arm."""
    trunk = Shape(
        "cylinder", (0.14, 0.14, height * 0.5), (0.0, 0.0, height * 0.25), colour=BARK, taper=(0.7, 0.7)
    )
    lower = tuple(
        twigs((height * share, height * share, height * rise), (height * x, height * y, height * z), LEAF)
        for share, rise, x, y, z in (
            (0.48, 0.42, 0.13, 0.10, 0.47),
            (0.46, 0.40, -0.14, -0.14, 0.50),
        )
    )
    crown = (
        *foliage((height * 0.80, height * 0.80, height * 0.70), (0.0, 0.0, height * 0.64), LEAF),
        *lower,
    )
    oranges = tuple(_orange(number, fruits, height) for number in range(fruits))
    return Prop("fruit_tree", (trunk, *oranges), (trunk, *crown, *oranges))


def _orange(number: int, fruits: int, height: float) -> Shape:
    """Spread over the crown's front by the golden ratio, from low to high."""
    part = (number + 0.5) / fruits
    turn = ((number * 0.618034) % 1.0 - 0.5) * math.pi * 0.8
    rise = height * (0.30 + 0.5 * part)
    out = height * 0.37 * math.sqrt(max(0.05, 1 - ((rise / height - 0.62) / 0.36) ** 2)) + 0.04
    return Shape(
        "sphere",
        (2 * ORANGE_RADIUS,) * 3,
        (out * math.cos(turn), out * math.sin(turn), rise),
        colour=ORANGE,
        glow=0.15,
        gloss=0.2,
    )
