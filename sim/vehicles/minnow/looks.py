"""Visible shapes of the minnow: two floats, a deck between them, a mast with camera and antenna, the rudder."""

from __future__ import annotations

from sim.core.shapes import Quat, Shape, Vec3
from sim.vehicles.minnow.parameters import MinnowParameters

__all__ = ["looks"]

_FLOAT, _DECK, _MAST, _BLACK = (0.93, 0.63, 0.10), (0.90, 0.91, 0.92), (0.60, 0.62, 0.65), (0.08, 0.08, 0.09)


def looks(parameters: MinnowParameters, position: Vec3, rotation: Quat) -> tuple[Shape, ...]:
    """The shapes to draw of one at `position`, turned by `rotation`."""
    hull = parameters.hull
    side = hull.beam / 2 - 0.055
    deck = hull.depth - hull.draft
    shapes = [
        *(
            Shape(
                "box",
                (hull.length, 0.11, hull.depth * 0.8),
                (0.0, place, hull.depth * 0.4 - hull.draft),
                colour=_FLOAT,
                gloss=0.5,
            )
            for place in (side, -side)
        ),
        Shape("box", (hull.length * 0.6, hull.beam * 0.92, 0.05), (0.0, 0.0, deck), colour=_DECK, gloss=0.4),
        Shape("cylinder", (0.02, 0.02, 0.36), (-0.1, 0.0, deck + 0.18), colour=_MAST),
        Shape("cylinder", (0.09, 0.09, 0.04), (-0.1, 0.0, deck + 0.38), colour=_DECK),
        Shape("box", (0.05, 0.08, 0.05), parameters.camera.position, colour=_BLACK, gloss=0.6),
        Shape("box", (0.06, 0.01, 0.14), (-hull.length / 2, 0.0, -hull.draft / 2), colour=_BLACK),
    ]
    return tuple(shape.at(position, rotation) for shape in shapes)
