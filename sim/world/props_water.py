"""The things that float, swim and grow in the worlds with water."""

from __future__ import annotations

from sim.core.shapes import Colour, Quat, Shape
from sim.world.props import Prop

__all__ = ["buoy", "coral", "diver"]

BLACK: Colour = (0.08, 0.08, 0.09)
SKIN: Colour = (0.80, 0.62, 0.50)
TANK: Colour = (0.93, 0.78, 0.10)
WHITE: Colour = (0.95, 0.95, 0.93)
CORALS: tuple[Colour, ...] = ((0.86, 0.36, 0.30), (0.90, 0.56, 0.34), (0.72, 0.30, 0.46))

_AHEAD: Quat = (0.0, 0.7071067811865476, 0.0, 0.7071067811865476)
"""Lays a cylinder along x."""


def buoy(colour: Colour) -> Prop:
    """A buoy of 0.6 m on a short chain: to what bumps into it, it stands firm."""
    float_ = Shape("cylinder", (0.6, 0.6, 0.5), (0.0, 0.0, 0.0), colour=colour, glow=0.15)
    cone = Shape(
        "cylinder", (0.36, 0.36, 0.6), (0.0, 0.0, 0.55), colour=colour, taper=(0.25, 0.25), glow=0.15
    )
    band = Shape("cylinder", (0.30, 0.30, 0.12), (0.0, 0.0, 0.52), colour=WHITE, taper=(0.8, 0.8), glow=0.15)
    solid = Shape("cylinder", (0.6, 0.6, 1.1), (0.0, 0.0, 0.3))
    return Prop("buoy", (solid,), (float_, cone, band))


def coral(height: float) -> Prop:
    """A coral of `height` [m] on its rock, standing on the ground."""
    rock = Shape(
        "sphere", (height * 1.1, height * 1.1, height * 0.5), (0.0, 0.0, 0.0), colour=(0.40, 0.38, 0.36)
    )
    branches = tuple(
        Shape(
            "cylinder",
            (height * 0.16, height * 0.16, height * share),
            (height * x, height * y, height * (0.1 + share / 2)),
            colour=CORALS[number % len(CORALS)],
            taper=(0.5, 0.5),
        )
        for number, (x, y, share) in enumerate(
            ((0.0, 0.0, 0.9), (0.2, 0.1, 0.7), (-0.2, 0.12, 0.6), (0.08, -0.22, 0.75), (-0.14, -0.18, 0.5))
        )
    )
    solid = Shape("cylinder", (height * 0.7, height * 0.7, height), (0.0, 0.0, height / 2))
    return Prop("coral", (solid,), (rock, *branches))


def diver() -> Prop:
    """A diver who lies in the water, head along x."""
    body = Shape("cylinder", (0.36, 0.36, 0.62), (0.0, 0.0, 0.0), _AHEAD, BLACK)
    head = Shape("sphere", (0.24, 0.24, 0.24), (0.44, 0.0, 0.02), colour=SKIN)
    mask = Shape("box", (0.06, 0.16, 0.10), (0.55, 0.0, 0.02), colour=(0.10, 0.14, 0.19), gloss=0.8)
    bottle = Shape("cylinder", (0.18, 0.18, 0.52), (-0.02, 0.0, 0.24), _AHEAD, TANK, gloss=0.5)
    legs = tuple(
        Shape("cylinder", (0.15, 0.15, 0.85), (-0.72, side * 0.11, 0.0), _AHEAD, BLACK) for side in (-1, 1)
    )
    fins = tuple(Shape("box", (0.45, 0.20, 0.03), (-1.32, side * 0.12, 0.0), colour=TANK) for side in (-1, 1))
    solid = Shape("box", (2.0, 0.5, 0.45), (-0.45, 0.0, 0.06))
    return Prop("diver", (solid,), (body, head, mask, bottle, *legs, *fins))
