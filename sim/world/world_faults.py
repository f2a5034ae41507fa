"""Faults of a world's file whose keys are all of their kind: names, places and things that do not go together."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

from bridge.msgs.additions import PLACE_KINDS
from sim.core.constants import GRAVITY, MAX_STEP_HEIGHT, ROBOT_HEIGHT
from sim.core.shapes import Shape, beside
from sim.parts.errors import PartError
from sim.parts.part import part
from sim.world.dock_faults import MAX_NAME_LENGTH, dock_faults
from sim.world.props import CAR_MODELS
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
    yield from dock_faults(world)
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
