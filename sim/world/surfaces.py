"""Surfaces of the ground and their grip: the friction coefficient of a rubber tyre on each.

Sources: [N] R. K. Noon, Engineering Analysis of Vehicular Accidents, CRC Press 1994, averages for tyres;
[D] ASTM D2047: a polished floor counts as safe from a static coefficient of 0.5 on; [B] ANSI A326.3: a wet level floor inside
from a dynamic one of 0.42 on; [A] assumed.
"""

from __future__ import annotations

from typing import Literal

__all__ = ["GRIP", "LOOKS_LIKE", "Surface"]

Surface = Literal["asphalt", "wet_asphalt", "gravel", "grass", "wet_grass", "floor", "wet_floor"]

GRIP: dict[str, float] = {
    "asphalt": 0.65,  # [N]
    "wet_asphalt": 0.50,  # [N]
    "gravel": 0.35,  # [N] with dirt roads
    "grass": 0.35,  # [A] dry, as a dirt road; published values of turf vary widely
    "wet_grass": 0.20,  # [N] a wet, grassy field
    "floor": 0.50,  # [D] the least of a floor in use
    "wet_floor": 0.42,  # [B] likewise
}
"""Friction coefficient of rubber."""

LOOKS_LIKE: dict[str, Surface] = {
    "asphalt": "asphalt",
    "floor": "floor",
    "grass": "grass",
    "water": "gravel",
}
"""The surface of a ground of each look, where the world's file does not name it; under water, its bed."""
