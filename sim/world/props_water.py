"""The things that float, swim and grow in the worlds with water."""

from __future__ import annotations

import math

from sim.core.shapes import Colour, Quat, Shape, Vec3, compose, from_yaw
from sim.world.props import Prop

__all__ = ["buoy", "coral", "diver"]

BLACK: Colour = (0.08, 0.08, 0.09)
SKIN: Colour = (0.80, 0.62, 0.50)
TANK: Colour = (0.93, 0.78, 0.10)
SUIT: Colour = (0.10, 0.12, 0.16)
VEST: Colour = (0.20, 0.42, 0.62)
STEEL: Colour = (0.62, 0.64, 0.66)
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
    """A diver who swims along x, a little head up, one leg kicking: suit, vest, mask, regulator, bottle and fins."""
    chest = (
        Shape("sphere", (0.72, 0.40, 0.30), (0.10, 0.0, 0.0), colour=SUIT),
        Shape("box", (0.46, 0.39, 0.24), (0.12, 0.0, 0.02), colour=VEST, taper=(0.85, 0.85)),
        Shape("box", (0.08, 0.40, 0.25), (0.10, 0.0, 0.02), colour=WHITE),
        Shape("sphere", (0.46, 0.34, 0.27), (-0.26, 0.0, -0.01), colour=SUIT),
        Shape("box", (0.09, 0.35, 0.28), (-0.24, 0.0, 0.0), colour=BLACK),
    )
    bottle = (
        _limb((-0.30, 0.0, 0.25), (0.28, 0.0, 0.27), 0.19, TANK),
        Shape("sphere", (0.19, 0.19, 0.19), (0.28, 0.0, 0.27), colour=TANK),
        _limb((0.30, 0.0, 0.27), (0.42, 0.0, 0.27), 0.06, STEEL),
        Shape("box", (0.06, 0.22, 0.24), (-0.02, 0.0, 0.20), colour=BLACK),
    )
    head = (
        Shape("sphere", (0.27, 0.24, 0.26), (0.52, 0.0, 0.08), colour=SUIT),
        Shape("sphere", (0.17, 0.17, 0.19), (0.58, 0.0, 0.06), colour=SKIN),
        Shape("box", (0.07, 0.19, 0.11), (0.65, 0.0, 0.10), colour=BLACK),
        Shape("box", (0.02, 0.16, 0.08), (0.685, 0.0, 0.10), colour=(0.45, 0.66, 0.74), gloss=0.9),
        Shape("cylinder", (0.08, 0.08, 0.07), (0.67, 0.0, 0.0), _AHEAD, STEEL),
        _limb((0.40, 0.0, 0.26), (0.52, 0.16, 0.10), 0.035, BLACK),
        _limb((0.52, 0.16, 0.10), (0.68, 0.02, 0.0), 0.035, BLACK),
    )
    limbs = (
        *_arm((0.26, 0.22, 0.0), (0.30, 0.40, -0.16), (0.56, 0.30, -0.24)),
        *_arm((0.26, -0.22, 0.0), (0.06, -0.36, -0.16), (0.26, -0.26, -0.28)),
        *_leg((-0.42, 0.11, 0.0), (-0.80, 0.14, -0.12), (-1.18, 0.14, 0.02), 0.10),
        *_leg((-0.42, -0.11, 0.0), (-0.82, -0.13, 0.08), (-1.20, -0.14, 0.16), 0.02),
    )
    solid = Shape("box", (2.0, 0.5, 0.45), (-0.45, 0.0, 0.06))
    return Prop("diver", (solid,), (*chest, *bottle, *head, *limbs, *_bubbles()))


def _bubbles() -> tuple[Shape, ...]:
    """What a diver breathed out: larger and farther behind the higher it is."""
    sizes = (0.05, 0.04, 0.06, 0.05, 0.08, 0.06, 0.09, 0.07)
    behind = (0.0, 0.03, 0.02, 0.07, 0.05, 0.10, 0.08, 0.13)
    aside = (0.07, -0.05, 0.03, -0.03, 0.06, -0.05, 0.04, -0.02)
    above = (0.18, 0.30, 0.46, 0.62, 0.80, 1.02, 1.25, 1.52)
    return tuple(
        Shape("sphere", (size,) * 3, (0.62 - x, y, z), colour=(0.80, 0.92, 0.94), gloss=0.6, glow=0.3)
        for size, x, y, z in zip(sizes, behind, aside, above, strict=True)
    )


def _arm(shoulder: Vec3, elbow: Vec3, hand: Vec3) -> tuple[Shape, ...]:
    return (
        Shape("sphere", (0.15, 0.15, 0.15), shoulder, colour=SUIT),
        _limb(shoulder, elbow, 0.11, SUIT),
        Shape("sphere", (0.10, 0.10, 0.10), elbow, colour=SUIT),
        _limb(elbow, hand, 0.09, VEST),
        Shape("sphere", (0.13, 0.09, 0.08), hand, colour=BLACK),
    )


def _leg(hip: Vec3, knee: Vec3, ankle: Vec3, drop: float) -> tuple[Shape, ...]:
    """`drop` is how far the tip of the fin hangs below the ankle [m]."""
    x, y, z = ankle
    blade = (x - 0.56, y, z - drop)
    return (
        _limb(hip, knee, 0.17, SUIT),
        Shape("sphere", (0.15, 0.15, 0.15), knee, colour=BLACK),
        _limb(knee, ankle, 0.13, SUIT),
        Shape("sphere", (0.24, 0.12, 0.11), (x - 0.06, y, z - 0.01), colour=BLACK),
        _between((x - 0.12, y, z - 0.02), blade, (0.24, 0.03), TANK, "box", (0.6, 1.0)),
    )


def _limb(start: Vec3, end: Vec3, breadth: float, colour: Colour) -> Shape:
    """A round limb from one point to another."""
    return _between(start, end, (breadth, breadth), colour, "cylinder", (1.0, 1.0))


def _between(
    start: Vec3, end: Vec3, size: tuple[float, float], colour: Colour, kind: str, narrow: tuple[float, float]
) -> Shape:
    """A shape whose z runs from `end` to `start`, `narrow` times as broad there; its breadth lies level, across the way."""
    way = (start[0] - end[0], start[1] - end[1], start[2] - end[2])
    length = math.hypot(*way)
    tilt, yaw = math.acos(way[2] / length), math.atan2(way[1], way[0])
    rotation = compose(
        compose(from_yaw(yaw), (0.0, math.sin(tilt / 2), 0.0, math.cos(tilt / 2))), from_yaw(math.pi / 2)
    )
    middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2, (start[2] + end[2]) / 2)
    return Shape(kind, (size[0], size[1], length), middle, rotation, colour, narrow)
