"""Visible shapes of the ardrone: a hull, a cross of arms, four rotors in their guards."""

from __future__ import annotations

import math

from sim.core.shapes import Quat, Shape, Vec3, from_yaw
from sim.vehicles.ardrone.parameters import ArdroneParameters

__all__ = ["looks"]

_HULL, _ARM, _GUARD, _EYE = (0.92, 0.45, 0.10), (0.10, 0.10, 0.11), (0.22, 0.23, 0.25), (0.05, 0.05, 0.06)


def looks(parameters: ArdroneParameters, position: Vec3, rotation: Quat) -> tuple[Shape, ...]:
    """The shapes to draw of one at `position`, turned by `rotation`."""
    arm = parameters.rotors.arm
    reach = arm / math.sqrt(2)
    shapes = [
        Shape("box", (0.26, 0.11, 0.06), colour=_HULL, taper=(0.8, 0.7), gloss=0.5),
        *(
            Shape("box", (2 * arm, 0.02, 0.015), (0.0, 0.0, -0.005), from_yaw(turn), _ARM)
            for turn in (math.pi / 4, -math.pi / 4)
        ),
        *(
            Shape("cylinder", (0.21, 0.21, 0.012), (x * reach, y * reach, 0.02), colour=_GUARD)
            for x in (-1, 1)
            for y in (-1, 1)
        ),
        Shape("sphere", (0.03, 0.03, 0.03), (0.13, 0.0, 0.0), colour=_EYE, gloss=0.8),
    ]
    return tuple(shape.at(position, rotation) for shape in shapes)
