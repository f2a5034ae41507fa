"""People, fruit trees and other things that stand in offices and orchards."""

from __future__ import annotations

import math

from sim.core.shapes import Colour, Shape
from sim.world.props import Prop, foliage, twigs
from sim.world.props_office import desk_things

__all__ = ["fruit_tree", "person", "table"]

SKIN: Colour = (0.80, 0.62, 0.50)
HAIR: Colour = (0.20, 0.15, 0.11)
TROUSERS: Colour = (0.17, 0.20, 0.29)
SHOES: Colour = (0.12, 0.11, 0.11)
WOOD: Colour = (0.64, 0.50, 0.34)
METAL: Colour = (0.42, 0.44, 0.47)
BARK: Colour = (0.36, 0.26, 0.18)
LEAF: Colour = (0.24, 0.43, 0.16)
ORANGE: Colour = (0.95, 0.48, 0.05)

ORANGE_RADIUS = 0.035
"""[m]"""


def person(colour: Colour) -> Prop:
    """A person who stands and looks along x, in a shirt of this colour, 1.75 m tall."""
    legs = tuple(
        shape
        for side in (-1, 1)
        for shape in (
            Shape(
                "cylinder", (0.12, 0.12, 0.80), (0.0, side * 0.09, 0.46), colour=TROUSERS, taper=(1.4, 1.4)
            ),
            Shape("box", (0.27, 0.10, 0.09), (0.05, side * 0.09, 0.045), colour=SHOES, taper=(0.85, 0.9)),
        )
    )
    belt = Shape("box", (0.20, 0.34, 0.06), (0.0, 0.0, 0.86), colour=SHOES)
    trunk = (
        Shape("box", (0.20, 0.34, 0.34), (0.0, 0.0, 1.04), colour=colour, taper=(1.08, 1.12)),
        Shape("box", (0.216, 0.38, 0.22), (0.0, 0.0, 1.32), colour=colour, taper=(0.75, 0.90)),
        Shape("sphere", (0.18, 0.38, 0.12), (0.0, 0.0, 1.42), colour=colour),
    )
    arms = tuple(
        shape
        for side in (-1, 1)
        for shape in (
            Shape("sphere", (0.13, 0.13, 0.15), (0.0, side * 0.20, 1.38), colour=colour),
            Shape(
                "cylinder", (0.085, 0.085, 0.50), (0.0, side * 0.24, 1.13), colour=colour, taper=(1.3, 1.3)
            ),
            Shape("sphere", (0.09, 0.07, 0.15), (0.02, side * 0.24, 0.82), colour=SKIN),
        )
    )
    neck = Shape("cylinder", (0.11, 0.11, 0.12), (0.0, 0.0, 1.49), colour=SKIN)
    head = Shape("sphere", (0.20, 0.165, 0.25), (0.02, 0.0, 1.62), colour=SKIN)
    nose = Shape("sphere", (0.05, 0.035, 0.05), (0.12, 0.0, 1.61), colour=SKIN)
    hair = Shape("sphere", (0.21, 0.185, 0.19), (-0.02, 0.0, 1.67), colour=HAIR)
    solid = Shape("cylinder", (0.44, 0.44, 1.75), (0.0, 0.0, 0.875))
    return Prop("person", (solid,), (*legs, belt, *trunk, *arms, neck, head, nose, hair))


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
