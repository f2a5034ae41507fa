"""The light of the lamps on a ceiling, worked out once: how bright each place of the floor is, as a small picture."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim.world.world import World

__all__ = ["CELL", "lamp_light"]

CELL = 0.2
"""Edge of a cell [m]."""

_REST = 0.36
"""Of full light, what comes to every corner from walls and ceiling."""
_STRENGTH = 0.62
"""Of full light, what a lamp gives to the floor right under it."""
_REACH = 6.0
"""Farther from a lamp its light is not looked for [m]."""

Grid = NDArray[np.floating[Any]]


@lru_cache(maxsize=4)
def lamp_light(world: World) -> tuple[tuple[int, int], bytes]:
    """Columns and rows, and a byte a cell row by row from the south-west corner: 255 is full light. Walls throw shadows.

    Where there is no ceiling all is as bright.
    """
    ceiling = world.ceiling
    if ceiling is None:
        return (1, 1), b"\xff"
    columns, rows = (max(1, round(extent / CELL)) for extent in (world.ground.length, world.ground.width))
    x, y = np.meshgrid(
        ((np.arange(columns) + 0.5) / columns - 0.5) * world.ground.length,
        ((np.arange(rows) + 0.5) / rows - 0.5) * world.ground.width,
    )
    walls = np.array([(*wall.start, *wall.end) for wall in world.partitions], dtype=float).reshape(-1, 4)
    light = np.zeros((rows, columns))
    for lamp in ceiling.lamps:
        away = (x - lamp[0]) ** 2 + (y - lamp[1]) ** 2
        near = away < _REACH**2
        fall = ceiling.height**2 / (ceiling.height**2 + away[near])
        light[near] += fall**1.5 * _STRENGTH * ~_shaded(lamp, x[near], y[near], walls)
    full = np.clip(_REST + 0.64 * (1 - np.exp(-1.5 * light)), 0.0, 1.0)
    return (columns, rows), (_soft(full) * 255).astype(np.uint8).tobytes()


def _shaded(lamp: tuple[float, float], x: Grid, y: Grid, walls: Grid) -> NDArray[np.bool_]:
    """Which of the places a wall hides from the lamp."""
    shaded = np.zeros(len(x), dtype=np.bool_)
    dx, dy = x - lamp[0], y - lamp[1]
    for ax, ay, bx, by in walls:
        ux, uy, wx, wy = bx - ax, by - ay, ax - lamp[0], ay - lamp[1]
        across = dx * uy - dy * ux
        across = np.where(np.abs(across) < 1e-9, 1e-9, across)
        along, beside = (wx * uy - wy * ux) / across, (wx * dy - wy * dx) / across
        shaded |= (along > 0) & (along < 1) & (beside >= 0) & (beside <= 1)
    return shaded


def _soft(light: Grid) -> Grid:
    """A little blurred, as the shadows of long lamps are."""
    padded = np.pad(light, 1, mode="edge")
    return np.asarray(
        sum(padded[i : i + light.shape[0], j : j + light.shape[1]] for i in range(3) for j in range(3)) / 9
    )
