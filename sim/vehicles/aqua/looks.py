"""Visible shapes of the aqua: a flat hull with a window in front and three fins on each side."""

from __future__ import annotations

from sim.core.shapes import Quat, Shape, Vec3
from sim.vehicles.aqua.parameters import AquaParameters

__all__ = ["looks"]

_HULL, _FIN, _GLASS, _TRIM = (0.93, 0.76, 0.12), (0.10, 0.10, 0.11), (0.10, 0.14, 0.19), (0.16, 0.17, 0.19)


def looks(parameters: AquaParameters, position: Vec3, rotation: Quat) -> tuple[Shape, ...]:
    """The shapes to draw of one at `position`, turned by `rotation`."""
    body, fins = parameters.body, parameters.fins
    shapes = [
        Shape("box", (body.length, body.width, body.height * 0.7), colour=_HULL, gloss=0.5),
        Shape(
            "box",
            (body.length * 0.9, body.width * 0.7, body.height * 0.3),
            (0.0, 0.0, body.height * 0.5),
            colour=_TRIM,
            taper=(0.8, 0.8),
        ),
        Shape(
            "box",
            (0.02, body.width * 0.7, body.height * 0.45),
            (body.length / 2, 0.0, 0.0),
            colour=_GLASS,
            gloss=1.0,
        ),
        *(
            Shape(
                "box",
                (fins.length, fins.tip * 0.6, 0.012),
                (x - fins.length / 3, side * (body.width / 2 + 0.04), 0.0),
                colour=_FIN,
            )
            for x in fins.places
            for side in (-1, 1)
        ),
    ]
    return tuple(shape.at(position, rotation) for shape in shapes)
