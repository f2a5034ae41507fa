"""Visible shapes of the scout: a drum with a ring of sonars, a bumper round its foot, a camera on top."""

from __future__ import annotations

import math

from sim.core.shapes import Quat, Shape, Vec3, from_yaw
from sim.vehicles.scout.parameters import ScoutParameters

__all__ = ["looks"]

_DRUM, _RUBBER, _GOLD, _TRIM = (0.72, 0.16, 0.14), (0.08, 0.08, 0.09), (0.80, 0.66, 0.30), (0.18, 0.19, 0.21)


def looks(parameters: ScoutParameters, position: Vec3, rotation: Quat) -> tuple[Shape, ...]:
    """The shapes to draw of one at `position`, turned by `rotation`."""
    body, sonar = parameters.body, parameters.sonar
    across = 2 * body.radius
    turns = [math.tau * number / sonar.count for number in range(sonar.count)]
    shapes = [
        Shape("cylinder", (across, across, 0.07), (0.0, 0.0, 0.07), colour=_RUBBER),
        Shape("cylinder", (across * 0.95, across * 0.95, 0.14), (0.0, 0.0, 0.17), colour=_DRUM, gloss=0.4),
        Shape("cylinder", (across, across, 0.09), (0.0, 0.0, sonar.height), colour=_TRIM, gloss=0.3),
        Shape("cylinder", (across * 0.9, across * 0.9, 0.02), (0.0, 0.0, body.height - 0.01), colour=_DRUM),
        *(
            Shape(
                "box",
                (0.02, 0.045, 0.045),
                (body.radius * math.cos(turn), body.radius * math.sin(turn), sonar.height),
                from_yaw(turn),
                _GOLD,
                gloss=0.6,
            )
            for turn in turns
        ),
        Shape("box", (0.05, 0.10, 0.06), parameters.camera.position, colour=_TRIM, gloss=0.5),
    ]
    return tuple(shape.at(position, rotation) for shape in shapes)
