"""Faults of the docks of a world's file: their names, tags and heights, and whether a robot can stand at them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from sim.core.constants import MAX_STEP_HEIGHT, ROBOT_HEIGHT
from sim.core.shapes import Shape, beside
from sim.world.props_docks import MAKERS
from sim.world.tables import Dock, DockKind
from sim.world.world import World

__all__ = ["MAX_NAME_LENGTH", "dock_faults"]

MAX_NAME_LENGTH = 60
"""Characters of a place's name."""
MIN_PLATFORM, MAX_PLATFORM = 0.1, 3.0
"""Heights of a pad over water, and of any [m]."""
CAGE_ROOM = 0.6
"""From the middle of a cage to the surface and to the ground [m]."""
_SPACING = 0.05
"""Between two points that are looked at [m]; what comes within half of it of one is in the way."""


class _Spot(NamedTuple):
    """A rectangle in a dock's frame [m]."""

    back: float
    front: float
    half: float


_BERTHS: dict[DockKind, _Spot] = {
    "contacts": _Spot(-0.30, -0.02, 0.20),
    "jetty": _Spot(-0.60, -0.02, 0.40),
    "pad": _Spot(-0.50, 0.50, 0.50),
    "cage": _Spot(-0.55, -0.02, 0.40),
}
"""What must be free for the smallest robot that charges there."""
_WHOLE: dict[DockKind, _Spot] = {
    "contacts": _Spot(-0.30, 0.14, 0.22),
    "jetty": _Spot(-0.60, 1.20, 1.10),
    "pad": _Spot(-0.60, 0.60, 0.60),
    "cage": _Spot(-0.55, 0.20, 0.57),
}
"""What a dock takes with its robot."""


def dock_faults(world: World) -> Iterator[tuple[str, str]]:
    """Key and reason of each fault of a dock."""
    names = {place.name.casefold() for place in world.places}
    tags: set[int] = set()
    for number, dock in enumerate(world.docks):
        key = f"docks[{number}]"
        if not dock.name.strip() or len(dock.name) > MAX_NAME_LENGTH:
            yield f"{key}.name", f"must have 1 to {MAX_NAME_LENGTH} characters, not {dock.name[:80]!r}"
        if dock.name.casefold() in names:
            yield f"{key}.name", f"there is a place {dock.name!r} already"
        names.add(dock.name.casefold())
        if dock.tag in tags:
            yield f"{key}.tag", f"another dock has {dock.tag} already: a camera would take one for the other"
        tags.add(dock.tag)
        yield from _height(world, dock, key)
        yield from _within(world, dock, key)
    for (_, one), (number, other) in combinations(enumerate(world.docks), 2):
        if _overlap(one, other):
            yield (
                f"docks[{number}]",
                f"{_told(other)} is on the spot of {_told(one)}: no robot could stand at either",
            )


def _height(world: World, dock: Dock, key: str) -> Iterator[tuple[str, str]]:
    """Each kind is in its own element, at a height that a robot of its kind can come to."""
    depth = world.water.depth if world.water else 0.0
    if dock.kind == "contacts" and world.water:
        yield (
            f"{key}.kind",
            "'contacts' are for wheels and need dry land; in water 'jetty', 'cage' or 'pad' can be",
        )
    elif dock.kind in ("jetty", "cage") and not world.water:
        yield f"{key}.kind", f"{dock.kind!r} needs water, and there is none; 'contacts' or 'pad' can be"
    lowest, highest = {
        "contacts": (0.0, 0.0),
        "jetty": (0.0, 0.0),
        "pad": (MIN_PLATFORM if world.water else 0.0, MAX_PLATFORM),
        "cage": (CAGE_ROOM - depth, -CAGE_ROOM),
    }[dock.kind]
    if not lowest <= dock.z <= highest:
        allowed = "be left out" if lowest == highest else f"be {lowest:g} to {highest:g} here"
        yield f"{key}.z", f"of a dock of the kind {dock.kind!r} must {allowed}, not {dock.z:g}"


def _within(world: World, dock: Dock, key: str) -> Iterator[tuple[str, str]]:
    """Where its robot would stand there is something else."""
    places = _points(dock, _BERTHS[dock.kind])
    for prop in world.props:
        if prop.kind not in _OWN and any(_blocks(solid, places, dock) for solid in prop.solids):
            x, y, _ = prop.position
            what = prop.kind.replace("_", " ")
            yield key, f"{_told(dock)} is inside the {what} at ({x:g}, {y:g}), where its robot would stand"
            return


_OWN = {"dock", *MAKERS}
"""Kinds of the props that docks are."""


def _blocks(solid: Shape, places: Sequence[tuple[float, float]], dock: Dock) -> bool:
    bottom, top = (solid.position[2] + side * solid.size[2] / 2 for side in (-1, 1))
    if bottom >= dock.z + ROBOT_HEIGHT or top <= dock.z + MAX_STEP_HEIGHT:
        return False
    if beside(solid, dock.x, dock.y) > 1.0:
        return False  # farther than any berth reaches
    return any(beside(solid, x, y) < _SPACING / 2 for x, y in places)


def _overlap(one: Dock, other: Dock) -> bool:
    spot = _WHOLE[other.kind]
    for x, y in _points(one, _WHOLE[one.kind]):
        dx, dy = x - other.x, y - other.y
        along = math.cos(other.angle) * dx + math.sin(other.angle) * dy
        across = math.cos(other.angle) * dy - math.sin(other.angle) * dx
        if spot.back <= along <= spot.front and abs(across) <= spot.half:
            return True
    return False


def _points(dock: Dock, spot: _Spot) -> list[tuple[float, float]]:
    """Points all over the rectangle, in the world's frame [m]."""
    along = np.linspace(spot.back, spot.front, math.ceil((spot.front - spot.back) / _SPACING) + 1)
    across = np.linspace(-spot.half, spot.half, math.ceil(2 * spot.half / _SPACING) + 1)
    cosine, sine = math.cos(dock.angle), math.sin(dock.angle)
    return [
        (dock.x + cosine * x - sine * y, dock.y + sine * x + cosine * y)
        for x in along.tolist()
        for y in across.tolist()
    ]


def _told(dock: Dock) -> str:
    return f"the dock {dock.name!r} at ({dock.x:g}, {dock.y:g})"
