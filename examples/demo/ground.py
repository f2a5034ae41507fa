"""The parking lot of the demo: where to patrol, and the things that do not belong there."""

from __future__ import annotations

import tomllib
from pathlib import Path

import sim

__all__ = ["EXTRA", "HOME", "MISPLACED", "PATROL", "cones"]

PATROL = ((-17.5, -2.0), (-16.5, 7.5), (0.0, 7.5), (17.0, 7.5), (17.0, -7.5), (-4.0, -7.2))
"""Round the aisles, past every cone: where the points shall be in the end, (x, y) in `map` [m]."""

MISPLACED = (1, (-10.0, 7.5))
"""The point that is first tapped somewhere else, to be dragged: its index in PATROL and where it is tapped."""

EXTRA = (12.0, -7.5)
"""A point that is tapped and taken out again."""

HOME = (-17.5, -10.5)


def cones() -> list[tuple[float, float]]:
    """Where the traffic cones stand, (x, y) in `map` [m]."""
    worlds = Path(sim.__file__).parent / "worlds"
    world = tomllib.loads((worlds / "parking_lot.toml").read_text())
    return [(cone["x"], cone["y"]) for cone in world["cones"]]
