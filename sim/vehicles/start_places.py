"""Start places of robots without a place of their own: beside the world's start, with room round each."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import msgspec

from sim.core.shapes import Shape, beside
from sim.vehicles.model import Model
from sim.world.tables import Start
from sim.world.world import World

__all__ = ["places", "starts"]

SPACING = 2.0
"""From one to the next [m]."""
MARGIN = 0.25
"""Kept free round each [m]."""
SEARCH_RADIUS = 12.0
"""Distance from the start within which a place is searched, along and across [m]."""
HEIGHT_RANGE = 1.0
"""Things farther above or below a robot than this are not in its way [m]."""
PATH_STEP = 0.2
"""Step by which the path from the start to a place is checked [m]."""


def starts(world: World, models: Sequence[Model], given: Sequence[Start | None]) -> list[Start]:
    """A start for each of `models`, its own where one is `given`; ValueError when there is no room for one."""
    taken = [
        (start, model.parameters.radius)
        for start, model in zip(given, models, strict=True)
        if start is not None
    ]
    found: list[Start] = []
    for model, own in zip(models, given, strict=True):
        start = own or _free(world, model, taken)
        if own is None:
            taken.append((start, model.parameters.radius))
        found.append(start)
    return found


def places(world: World, start: Start, radius: float, height: float) -> Iterator[Start]:
    """Places for a robot of this `radius` [m] at this `height` [m] instead of its `start`, which is the first of them.

    Only the things of the world are considered, not other robots.
    """
    around = [solid for solid in world.solids if _height(solid, height)]
    for place in _candidates(start):
        if place is start or (_on_ground(world, place, radius) and _open(around, start, place, radius)):
            yield place


def _free(world: World, model: Model, taken: Sequence[tuple[Start, float]]) -> Start:
    radius = model.parameters.radius
    home = world.start
    for start in places(world, home, radius, home.z if model.element == "water" else 0.0):
        if all(
            math.dist((start.x, start.y), (other.x, other.y)) > radius + other_radius + 2 * MARGIN
            for other, other_radius in taken
        ):
            return start
    raise ValueError(f"There is no room for one more robot at the start of {world.name}.")


def _candidates(start: Start) -> Iterator[Start]:
    """The start itself, then to its right and left by turns, then the same behind it and ahead of it; closer at last."""
    yield start
    cosine, sine = math.cos(start.angle), math.sin(start.angle)
    for apart in (SPACING, SPACING / 2):
        for row in range(2 * round(SEARCH_RADIUS / apart) + 1):
            back = (row + 1) // 2 * apart * (1 if row % 2 else -1)
            for number in range(2 * round(SEARCH_RADIUS / apart) + 1):
                aside = (number + 1) // 2 * apart * (-1 if number % 2 else 1)
                x, y = start.x - back * cosine - aside * sine, start.y - back * sine + aside * cosine
                if row or number:
                    yield msgspec.structs.replace(start, x=x, y=y)


def _on_ground(world: World, start: Start, radius: float) -> bool:
    half_length, half_width = world.ground.length / 2, world.ground.width / 2
    return max(abs(start.x) - half_length, abs(start.y) - half_width) < -(radius + MARGIN)


def _open(solids: Sequence[Shape], home: Start, start: Start, radius: float) -> bool:
    """There is room at `start`, and no wall between it and `home`."""
    if any(beside(solid, start.x, start.y) < radius + MARGIN for solid in solids):
        return False
    count = math.ceil(math.dist((home.x, home.y), (start.x, start.y)) / PATH_STEP)
    parts = [number / count for number in range(1, count)]
    way = [(home.x + (start.x - home.x) * part, home.y + (start.y - home.y) * part) for part in parts]
    return all(beside(solid, x, y) > 0.0 for solid in solids for x, y in way)


def _height(solid: Shape, height: float) -> bool:
    return abs(solid.position[2] - height) < solid.size[2] / 2 + HEIGHT_RANGE
