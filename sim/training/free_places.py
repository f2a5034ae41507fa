"""The places of a world where a robot has room, and which of them are reached from each other."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim.core.shapes import beside
from sim.world.occupancy import RESOLUTION, covered
from sim.world.world import World

__all__ = ["FreePlaces"]

MAX_TRIES = 2000
"""So many places are drawn before none counts as found."""

Mask = NDArray[np.bool_]


class FreePlaces:
    """Of one robot in one world: it has room to turn there, and a way that is wide enough leads there from the world's start."""

    def __init__(
        self, world: World, radius: float, half_width: float, height: float, tallness: float
    ) -> None:
        """The robot needs a circle of `radius` to turn, and a way twice its `half_width` broad; it is at `height`, `tallness` high [m].

        ValueError with one sentence when it has no room at the world's start.
        """
        self._world, self._radius, self._half_width = world, radius, half_width
        self._solids = [
            solid
            for solid in world.solids
            if abs(solid.position[2] - height) < (solid.size[2] + tallness) / 2
        ]
        self._open = self._reached(world)
        if not self._open.any():
            raise ValueError(f"No place of {world.name} has {radius:.2f} m of room round it.")

    def draw(self, random: np.random.Generator) -> tuple[float, float]:
        """One of the places, each as likely: x, y [m] in `map`."""
        rows, columns = np.nonzero(self._open)
        west, south = -self._world.ground.length / 2, -self._world.ground.width / 2
        for number in random.integers(len(rows), size=MAX_TRIES):
            x = float(west + (columns[number] + 0.5) * RESOLUTION)
            y = float(south + (rows[number] + 0.5) * RESOLUTION)
            if self.has_room(x, y):  # the corner of a thing may reach into the cell
                return x, y
        raise ValueError(f"No place of {self._world.name} has {self._radius:.2f} m of room round it.")

    def draw_apart(
        self, random: np.random.Generator, here: tuple[float, float], near: float, far: float
    ) -> tuple[float, float]:
        """One that is `near` to `far` [m] from `here`, in a straight line; ValueError with one sentence when there is none."""
        for _ in range(MAX_TRIES):
            place = self.draw(random)
            if near <= math.dist(place, here) <= far:
                return place
        raise ValueError(
            f"No place of {self._world.name} is {near:g} to {far:g} m from ({here[0]:.1f}, {here[1]:.1f})."
        )

    def has_room(self, x: float, y: float) -> bool:
        """Nothing is within the circle at that place of `map` [m]."""
        return all(beside(solid, x, y) > self._radius for solid in self._solids)

    def _reached(self, world: World) -> Mask:
        columns, rows = (round(extent / RESOLUTION) for extent in (world.ground.length, world.ground.width))
        x = -world.ground.length / 2 + (np.arange(columns) + 0.5) * RESOLUTION
        y = -world.ground.width / 2 + (np.arange(rows) + 0.5) * RESOLUTION
        full = covered(self._solids, x, y)
        full[0], full[-1], full[:, 0], full[:, -1] = True, True, True, True  # beyond it is nothing
        free = ~_grown(full, self._half_width / RESOLUTION)
        start = np.zeros_like(free)
        column = int((world.start.x + world.ground.length / 2) / RESOLUTION)
        row = int((world.start.y + world.ground.width / 2) / RESOLUTION)
        start[row, column] = free[row, column]
        if not start.any():
            raise ValueError(
                f"A robot {2 * self._half_width:.2f} m wide has no room at the start of {world.name}."
            )
        return _flooded(start, free) & ~_grown(full, self._radius / RESOLUTION)


def _grown(full: Mask, cells: float) -> Mask:
    """Every cell within so many cells of a `full` one."""
    reach = math.ceil(cells)
    grown = full.copy()
    for across in range(-reach, reach + 1):
        for along in range(-reach, reach + 1):
            if math.hypot(across, along) <= cells:
                grown |= _moved(full, across, along)
    return grown


def _moved(mask: Mask, rows: int, columns: int) -> Mask:
    moved = np.zeros_like(mask)
    height, width = mask.shape
    there: Any = (slice(max(rows, 0), height + min(rows, 0)), slice(max(columns, 0), width + min(columns, 0)))
    here: Any = (
        slice(max(-rows, 0), height - max(rows, 0)),
        slice(max(-columns, 0), width - max(columns, 0)),
    )
    moved[there] = mask[here]
    return moved


def _flooded(start: Mask, free: Mask) -> Mask:
    """What is reached from `start` through `free` cells that share an edge."""
    reached, front = start.copy(), np.argwhere(start)
    while len(front):
        around = np.concatenate([front + step for step in ((0, 1), (0, -1), (1, 0), (-1, 0))])
        inside = ((around >= 0) & (around < free.shape)).all(axis=1)
        around = around[inside]
        fresh = around[free[around[:, 0], around[:, 1]] & ~reached[around[:, 0], around[:, 1]]]
        reached[fresh[:, 0], fresh[:, 1]] = True
        front = np.unique(fresh, axis=0)
    return reached
