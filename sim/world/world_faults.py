"""Faults of a world's file whose keys are all of their kind: names, places and things that do not go together."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bridge.msgs.additions import PLACE_KINDS
from sim.core.constants import GRAVITY, MAX_STEP_HEIGHT, ROBOT_HEIGHT
from sim.core.shapes import Shape, beside
from sim.parts.errors import PartError
from sim.parts.part import part
from sim.world.props import CAR_MODELS
from sim.world.props_docks import MAKERS
from sim.world.tables import Dock, DockKind
from sim.world.world import World

__all__ = ["faults"]

Fault = tuple[str, str]
"""Key and reason."""

MAX_AREA = 20_000.0
"""Greatest ground [m2]: a larger one takes a robot too much time and memory for its map at the start."""
SCENERY_MARGIN = 30.0
"""Distance beyond the ground within which trees may stand [m]."""
MAX_MODELS = 100
"""Things from files of other programs."""
MAX_STEEPNESS = 1 / 7
"""A wave in deep water that is higher than this part of its length breaks."""
_TOLERANCE = 1e-6
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
_OWN = {"dock", *MAKERS}
"""Kinds of the props that docks are."""


def faults(world: World) -> Iterator[Fault]:
    """Key and reason of each fault that the types alone cannot find."""
    area = world.ground.length * world.ground.width
    if area > MAX_AREA:
        yield (
            "ground",
            f"{area:g} m2 are too many, at most {MAX_AREA:g} can be: its map has a cell for each 10 cm",
        )
    yield from _places(world)
    yield from _models(world)
    for number, entry in enumerate(world.cars):
        if entry.model not in CAR_MODELS:
            yield f"cars[{number}].model", f"{entry.model!r} is not one of {', '.join(CAR_MODELS)}"
    for number, wall in enumerate(world.partitions):
        if wall.start == wall.end:
            yield f"partitions[{number}]", "begins where it ends"
    for number, wave in enumerate(world.water.waves if world.water else ()):
        highest = MAX_STEEPNESS * GRAVITY * wave.period**2 / (2 * math.pi)
        if wave.height > highest:
            said = f"must be at most {highest:.2g} m where the period is {wave.period:g} s, or it breaks, not {wave.height:g}"
            yield f"water.waves[{number}].height", said
    yield from _docks(world)
    yield from _off_the_ground(world)
    yield from _start(world)


def _places(world: World) -> Iterator[Fault]:
    names: set[str] = set()
    for number, place in enumerate(world.places):
        if place.kind not in PLACE_KINDS:
            yield f"places[{number}].kind", f"{place.kind!r} is not one of {', '.join(PLACE_KINDS)}"
        if not place.name.strip() or len(place.name) > MAX_NAME_LENGTH:
            yield (
                f"places[{number}].name",
                f"must have 1 to {MAX_NAME_LENGTH} characters, not {place.name[:80]!r}",
            )
        if place.name.casefold() in names:
            yield f"places[{number}].name", f"there is a place {place.name!r} already"
        names.add(place.name.casefold())


def _models(world: World) -> Iterator[Fault]:
    if len(world.models) > MAX_MODELS:
        yield "models", f"{len(world.models)} are too many, at most {MAX_MODELS} can be"
        return
    for number, entry in enumerate(world.models):
        try:
            part(Path(entry.file), entry.scale)
        except PartError as fault:
            yield f"models[{number}].file", str(fault)


def _docks(world: World) -> Iterator[Fault]:
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
        yield from _dock_height(world, dock, key)
        yield from _dock_within(world, dock, key)
    for (_, one), (number, other) in combinations(enumerate(world.docks), 2):
        if _overlap(one, other):
            yield (
                f"docks[{number}]",
                f"{_told(other)} is on the spot of {_told(one)}: no robot could stand at either",
            )


def _dock_height(world: World, dock: Dock, key: str) -> Iterator[Fault]:
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


def _dock_within(world: World, dock: Dock, key: str) -> Iterator[Fault]:
    """Where its robot would stand there is something else."""
    places = _spread(dock, _BERTHS[dock.kind])
    for prop in world.props:
        if prop.kind not in _OWN and any(_blocks(solid, places, dock) for solid in prop.solids):
            x, y, _ = prop.position
            what = prop.kind.replace("_", " ")
            yield key, f"{_told(dock)} is inside the {what} at ({x:g}, {y:g}), where its robot would stand"
            return


def _blocks(solid: Shape, places: Sequence[tuple[float, float]], dock: Dock) -> bool:
    bottom, top = (solid.position[2] + side * solid.size[2] / 2 for side in (-1, 1))
    if bottom >= dock.z + ROBOT_HEIGHT or top <= dock.z + MAX_STEP_HEIGHT:
        return False
    if beside(solid, dock.x, dock.y) > 1.0:
        return False  # farther than any berth reaches
    return any(beside(solid, x, y) < _SPACING / 2 for x, y in places)


def _overlap(one: Dock, other: Dock) -> bool:
    spot = _WHOLE[other.kind]
    for x, y in _spread(one, _WHOLE[one.kind]):
        dx, dy = x - other.x, y - other.y
        along = math.cos(other.angle) * dx + math.sin(other.angle) * dy
        across = math.cos(other.angle) * dy - math.sin(other.angle) * dx
        if spot.back <= along <= spot.front and abs(across) <= spot.half:
            return True
    return False


def _spread(dock: Dock, spot: _Spot) -> list[tuple[float, float]]:
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


def _off_the_ground(world: World) -> Iterator[Fault]:
    half_length, half_width = world.ground.length / 2, world.ground.width / 2
    ends = f"which ends at x = ±{half_length:g} and y = ±{half_width:g}"
    for key, x, y in _points(world):
        beyond = max(abs(x) - half_length, abs(y) - half_width)
        scenery = key.startswith("trees")
        if beyond > (SCENERY_MARGIN if scenery else _TOLERANCE):
            more = f"; trees may stand up to {SCENERY_MARGIN:g} m beyond it" if scenery else ""
            yield key, f"({x:g}, {y:g}) is off the ground, {ends}{more}"


def _points(world: World) -> Iterator[tuple[str, float, float]]:
    """Places of the things of the file, each with its key; the ends of a line are two."""
    yield "start", world.start.x, world.start.y
    for key in (
        *("cars", "lamps", "trees", "cones", "barrels", "blocks", "tables", "people", "fruit_trees"),
        *("doors", "windows", "shelves", "chairs", "sofas"),
        *("tags", "buoys", "divers", "corals", "places", "arrows", "docks", "models"),
    ):
        for number, spot in enumerate(getattr(world, key)):
            yield f"{key}[{number}]", spot.x, spot.y
    for key in ("lines", "partitions"):
        for number, line in enumerate(getattr(world, key)):
            yield f"{key}[{number}].from", *line.start
            yield f"{key}[{number}].to", *line.end
    for number, row in enumerate(world.bays):
        yield f"bays[{number}]", row.x, row.y
        yield f"bays[{number}]", row.x + row.count * row.width, row.y + row.depth


def _start(world: World) -> Iterator[Fault]:
    start, water = world.start, world.water
    if water is None and start.z:
        yield "start.z", f"must be left out or 0 where there is no water, not {start.z:g}"
    elif start.z > 0.0:
        yield "start.z", f"must be at most 0, the water's surface, not {start.z:g}"
    elif water is not None and start.z < -water.depth:
        yield "start.z", f"{start.z:g} is below the ground, which is {water.depth:g} m deep"
    for prop in world.props:
        if any(_holds(solid, start.x, start.y, start.z) for solid in prop.solids):
            x, y, _ = prop.position
            what = prop.kind.replace("_", " ")
            yield "start", f"({start.x:g}, {start.y:g}) is inside the {what} at ({x:g}, {y:g})"


def _holds(solid: Shape, x: float, y: float, z: float) -> bool:
    """Whether the middle of a robot that stands or swims there would be within `solid`."""
    bottom, top = (solid.position[2] + side * solid.size[2] / 2 for side in (-1, 1))
    return bottom < z + ROBOT_HEIGHT and top > z + MAX_STEP_HEIGHT and beside(solid, x, y) == 0.0
