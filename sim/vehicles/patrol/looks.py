"""Visible shapes of the patrol robot: a round base, three plates on poles, laser and camera on top."""

from __future__ import annotations

from sim.core.shapes import Quat, Shape, Vec3
from sim.vehicles.patrol.parameters import PatrolParameters

__all__ = ["looks"]

_BLACK, _PLATE, _STEEL = (0.10, 0.10, 0.11), (0.20, 0.21, 0.23), (0.70, 0.72, 0.74)
_ACCENT = (0.18, 0.62, 0.92)
_POLES = ((0.11, 0.10), (0.11, -0.10), (-0.12, 0.10), (-0.12, -0.10))


def looks(parameters: PatrolParameters, position: Vec3, rotation: Quat) -> tuple[Shape, ...]:
    """The shapes to draw of a robot at `position`, turned by `rotation`."""
    body = parameters.body
    across = 2 * body.radius
    middle = (0.12 + body.height) / 2
    shapes = [
        Shape("cylinder", (across, across, 0.10), (0.0, 0.0, 0.068), colour=_BLACK, gloss=0.4),
        *(_plate(across * 0.92, height) for height in (0.14, 0.24, body.height)),
        *(
            Shape("cylinder", (0.016, 0.016, body.height - 0.12), (x, y, middle), colour=_STEEL)
            for x, y in _POLES
        ),
        Shape(
            "cylinder", (0.075, 0.075, 0.05), (0.0, 0.0, parameters.laser.height), colour=_BLACK, gloss=0.6
        ),
        Shape("box", (0.03, 0.09, 0.03), parameters.camera.position, colour=_BLACK, gloss=0.6),
        Shape(
            "box",
            (0.13, 0.05, 0.012),
            (0.06, 0.0, body.height + 0.008),
            colour=_ACCENT,
            taper=(0.4, 0.3),
            glow=0.4,
        ),
    ]
    return tuple(shape.at(position, rotation) for shape in shapes)


def _plate(across: float, height: float) -> Shape:
    return Shape("cylinder", (across, across, 0.012), (0.0, 0.0, height), colour=_PLATE, gloss=0.2)
