"""Strength of what comes back to a laser: by the material that a beam meets and how askew it meets it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sim.core.shapes import Shape

__all__ = ["GROUND", "MOVING", "RETRO", "reflection", "strengths"]

Floats = NDArray[np.float64]

RETRO = 2.0
"""Reflection of what throws light straight back, to tell it from all that is matt, which has 0 to 1."""
GROUND, MOVING = 0.3, 0.35
"""Of the ground, and of what moves: dark shells."""
_MATT = 99.0
"""Strength from something white that a beam meets straight on."""
_RETRO_LEAST, _RETRO_MORE = 200.0, 55.0
"""Strength from what throws light back at its widest angle, and how much more straight on."""
_WIDEST = 0.5
"""Cosine of the angle up to which it throws light back, 60 degrees; beyond, it is white and matt."""


def reflection(shape: Shape) -> float:
    """Of a solid: how light its colour is, 0 to 1; `RETRO` for what throws light back."""
    red, green, blue = shape.colour
    return RETRO if shape.retro else 0.30 * red + 0.59 * green + 0.11 * blue


def strengths(reflections: Floats, facing: Floats) -> Floats:
    """Strengths of echoes, 0 to 255 in whole numbers, from reflections and cosines of the angles to the surfaces' normals."""
    matt = _MATT * np.minimum(reflections, 1.0) * facing
    back = (reflections > 1.0) & (facing >= _WIDEST)
    if not back.any():
        return np.rint(matt)
    thrown = _RETRO_LEAST + _RETRO_MORE * (facing - _WIDEST) / (1 - _WIDEST)
    return np.rint(np.where(back, thrown, matt))
