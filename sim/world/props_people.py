"""People, fruit trees and other things that stand in offices and orchards."""

from __future__ import annotations

import math

from sim.core.shapes import Colour, Shape
from sim.world.props import Prop

__all__ = ["fruit_tree", "person", "table"]

SKIN: Colour = (0.80, 0.62, 0.50)
HAIR: Colour = (0.20, 0.15, 0.11)
TROUSERS: Colour = (0.17, 0.20, 0.29)
WOOD: Colour = (0.64, 0.50, 0.34)
METAL: Colour = (0.42, 0.44, 0.47)
BARK: Colour = (0.36, 0.26, 0.18)
LEAF: Colour = (0.20, 0.36, 0.15)
ORANGE: Colour = (0.95, 0.48, 0.05)

ORANGE_RADIUS = 0.035
"""[m]"""


def person(colour: Colour) -> Prop:
    """A person who stands and looks along x, in a shirt of this colour, 1.75 m tall."""
    legs = tuple(
        Shape("cylinder", (0.15, 0.15, 0.82), (0.0, side * 0.09, 0.41), colour=TROUSERS) for side in (-1, 1)
    )
    trunk = Shape("box", (0.22, 0.40, 0.62), (0.0, 0.0, 1.13), colour=colour, taper=(1.0, 0.88))
    arms = tuple(
        Shape("cylinder", (0.09, 0.09, 0.62), (0.02, side * 0.25, 1.10), colour=colour) for side in (-1, 1)
    )
    head = Shape("sphere", (0.20, 0.17, 0.24), (0.02, 0.0, 1.60), colour=SKIN)
    hair = Shape("sphere", (0.20, 0.18, 0.16), (-0.02, 0.0, 1.67), colour=HAIR)
    solid = Shape("cylinder", (0.44, 0.44, 1.75), (0.0, 0.0, 0.875))
    return Prop("person", (solid,), (*legs, trunk, *arms, head, hair))


def table(length: float, width: float, height: float) -> Prop:
    """A table on four legs, lengths in [m]."""
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
    return Prop("table", (top, *legs), (top, *legs))


def fruit_tree(height: float, fruits: int) -> Prop:
    """An orange tree of `height` [m] with so many `fruits` on its side towards x, some low enough for an arm."""
    trunk = Shape(
        "cylinder", (0.14, 0.14, height * 0.5), (0.0, 0.0, height * 0.25), colour=BARK, taper=(0.7, 0.7)
    )
    crown = (
        Shape(
            "sphere", (height * 0.72, height * 0.72, height * 0.66), (0.0, 0.0, height * 0.66), colour=LEAF
        ),
        Shape(
            "sphere",
            (height * 0.42,) * 3,
            (height * 0.16, height * 0.1, height * 0.45),
            colour=(0.24, 0.42, 0.19),
        ),
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
