"""A world: what its TOML file says, checked, and the things that stand in it."""

from __future__ import annotations

import math
from functools import cached_property
from pathlib import Path
from typing import Annotated, Literal

import msgspec

from sim.core.shapes import Shape
from sim.core.toml_tables import FileFault, fault, read, text_of
from sim.world.props import Prop, block, car, cone, lamp, tree, wall
from sim.world.props_people import fruit_tree, person, table
from sim.world.props_water import buoy, coral, diver
from sim.world.world_faults import faults

__all__ = ["WORLDS", "World", "WorldError", "load"]

_FOLDER = Path(__file__).parents[1] / "worlds"

WORLDS: tuple[str, ...] = tuple(sorted(path.stem for path in _FOLDER.glob("*.toml")))
"""The names of the worlds that come with the simulation."""

Positive = Annotated[float, msgspec.Meta(gt=0, le=300)]
Name = Annotated[str, msgspec.Meta(min_length=1, max_length=60)]
Finite = Annotated[float, msgspec.Meta(ge=-1000, le=1000)]
Part = Annotated[float, msgspec.Meta(ge=0, le=1)]


_LOOSE = ("cone", "person", "diver")
"""Kinds that are not always where they are."""


class WorldError(ValueError):
    """A world that is not there or whose file is wrong; the text names the file, the line, the key and the reason."""


class _Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One table of the file."""


class Datum(_Entry, frozen=True):
    """Where the map's origin lies on earth, WGS 84."""

    latitude: Annotated[float, msgspec.Meta(gt=-90, lt=90)]
    """[deg]"""
    longitude: Annotated[float, msgspec.Meta(ge=-180, le=180)]
    """[deg]"""
    altitude: Finite = 0.0
    """[m] above the ellipsoid."""


class Ground(_Entry, frozen=True):
    """The level ground, centred on the map's origin."""

    length: Positive
    """Along x [m]."""
    width: Positive
    """Along y [m]."""
    look: Literal["asphalt", "water", "floor", "grass"] = "asphalt"
    """Of what one sees at z = 0, for pictures."""


class Wall(_Entry, frozen=True):
    """The wall round the ground."""

    height: Positive
    """[m]"""
    thickness: Positive
    """[m]"""


class Spot(_Entry, frozen=True):
    """A place and a direction."""

    x: Finite
    """[m]"""
    y: Finite
    """[m]"""
    yaw: Finite = 0.0
    """[deg] from east, anticlockwise, as people write it in the file."""

    @property
    def angle(self) -> float:
        """`yaw` in [rad]."""
        return math.radians(self.yaw)


class Start(Spot, frozen=True):
    """Where a robot is at first."""

    z: Finite = 0.0
    """Of one that swims, its depth below 0 [m]; others stand on the ground or float."""


class Bays(_Entry, frozen=True):
    """A row of painted parking bays along x."""

    x: Finite
    """Western end [m]."""
    y: Finite
    """Southern edge [m]."""
    count: Annotated[int, msgspec.Meta(ge=1, le=200)]
    width: Positive
    """Of one bay, along x [m]."""
    depth: Positive
    """Along y [m]."""


class Line(_Entry, frozen=True, rename={"start": "from", "end": "to"}):
    """A painted line."""

    start: tuple[Finite, Finite]
    """[m]"""
    end: tuple[Finite, Finite]
    """[m]"""
    width: Positive = 0.12
    """[m]"""


class Car(Spot, frozen=True, kw_only=True):
    """A parked car; its middle stands on the spot and its nose points to `yaw`."""

    model: str
    colour: tuple[Part, Part, Part]


class Tall(Spot, frozen=True):
    """A thing with a height."""

    height: Positive = 1.0
    """[m]"""


class Lamp(Tall, frozen=True):
    """A lamp post, its arm towards `yaw`."""

    height: Positive = 5.0


class Cone(Tall, frozen=True):
    """A traffic cone: it is not on the robot's map."""

    height: Positive = 0.6


class Tree(Tall, frozen=True):
    """A tree."""

    height: Positive = 6.0


class Tinted(Spot, frozen=True):
    """A thing with a colour."""

    colour: tuple[Part, Part, Part] = (0.94, 0.72, 0.08)


class Block(Tinted, frozen=True, kw_only=True):
    """A plain box; with `z` above 0 it hangs there."""

    length: Positive
    """Along its own x [m]."""
    width: Positive
    """[m]"""
    height: Positive
    """[m]"""
    z: Finite = 0.0
    """Of its bottom [m]."""
    colour: tuple[Part, Part, Part] = (0.72, 0.71, 0.68)


class Diver(Spot, frozen=True):
    """A diver who swims towards `yaw`."""

    z: Finite = -2.0
    """[m]"""


class Coral(Tall, frozen=True):
    """A coral on the ground."""

    height: Positive = 0.7


class Person(Tinted, frozen=True):
    """Somebody who looks towards `yaw`, in a shirt of the colour: not on the robot's map."""

    colour: tuple[Part, Part, Part] = (0.24, 0.42, 0.66)


class Table(Spot, frozen=True):
    """A table."""

    length: Positive = 1.4
    """[m]"""
    width: Positive = 0.7
    """[m]"""
    height: Positive = 0.74
    """[m]"""


class FruitTree(Tall, frozen=True):
    """An orange tree, its fruit towards `yaw`."""

    height: Positive = 1.8
    fruits: Annotated[int, msgspec.Meta(ge=0, le=200)] = 12


class Partition(Line, frozen=True, rename={"start": "from", "end": "to"}):
    """A wall from one point to another."""

    width: Positive = 0.15
    height: Positive = 2.4
    """[m]"""
    colour: tuple[Part, Part, Part] = (0.86, 0.85, 0.81)


class Place(Spot, frozen=True, kw_only=True):
    """A place that has a name."""

    name: str
    kind: str = "place"
    """As in `bridge.msgs.additions.PLACE_KINDS`."""
    floor: str = "0"
    tag: str = ""
    """Of the card of who belongs here; empty when nobody has one."""
    note: str = ""
    """What to tell people who are led here."""


class Tag(_Entry, frozen=True):
    """A tag that a reader near it reads."""

    tag: str
    x: Finite
    """[m]"""
    y: Finite
    """[m]"""
    z: Finite = 0.5
    """[m]"""


class Wave(_Entry, frozen=True):
    """A train of regular waves in deep water."""

    height: Annotated[float, msgspec.Meta(gt=0, le=20)]
    """From trough to crest [m]."""
    period: Annotated[float, msgspec.Meta(ge=0.5, le=30)]
    """[s]"""
    direction: Finite = 0.0
    """Where it runs to [deg] from east, anticlockwise."""
    phase: Finite = 0.0
    """At the map's origin at the beginning [deg]."""


class Water(_Entry, frozen=True):
    """Water over all of the world; its surface lies at z = 0, the ground under it."""

    depth: Annotated[float, msgspec.Meta(ge=0.5, le=300)]
    """[m]"""
    density: Annotated[float, msgspec.Meta(ge=900, le=1200)] = 1000.0
    """[kg/m3]"""
    current: tuple[Finite, Finite] = (0.0, 0.0)
    """Along x and y [m/s]."""
    waves: tuple[Wave, ...] = ()


class Wind(_Entry, frozen=True):
    """The wind over all of the world."""

    speed: Annotated[float, msgspec.Meta(ge=0, le=60)]
    """[m/s]"""
    direction: Finite = 0.0
    """Where it blows to [deg] from east, anticlockwise."""
    gusts: Annotated[float, msgspec.Meta(ge=0, le=20)] = 0.0
    """Standard deviation of what comes and goes, along x and y; half of it upward [m/s]."""
    gust_time: Positive = 2.0
    """Over which a gust is correlated [s]."""


class World(_Entry, frozen=True, dict=True):
    """Everything the file says; x east, y north, z up from the ground [m]."""

    name: Name
    description: Annotated[str, msgspec.Meta(max_length=500)]
    datum: Datum
    ground: Ground
    start: Start
    """Where the robot starts."""
    wall: Wall | None = None
    bays: tuple[Bays, ...] = ()
    lines: tuple[Line, ...] = ()
    arrows: tuple[Spot, ...] = ()
    """Arrows painted on the ground."""
    cars: tuple[Car, ...] = ()
    lamps: tuple[Lamp, ...] = ()
    cones: tuple[Cone, ...] = ()
    trees: tuple[Tree, ...] = ()
    blocks: tuple[Block, ...] = ()
    partitions: tuple[Partition, ...] = ()
    tables: tuple[Table, ...] = ()
    people: tuple[Person, ...] = ()
    fruit_trees: tuple[FruitTree, ...] = ()
    tags: tuple[Tag, ...] = ()
    places: tuple[Place, ...] = ()
    """Names that people give to places in it."""
    buoys: tuple[Tinted, ...] = ()
    divers: tuple[Diver, ...] = ()
    corals: tuple[Coral, ...] = ()
    water: Water | None = None
    """None on dry land."""
    wind: Wind | None = None

    @property
    def bottom(self) -> float:
        """Height of the ground, which is under water where there is some [m]."""
        return -self.water.depth if self.water else 0.0

    @cached_property
    def props(self) -> tuple[Prop, ...]:
        """Everything that stands in the world, in the order of the file."""
        return (
            *self._walls(),
            *(car(entry.model, entry.colour).at(entry.x, entry.y, entry.angle) for entry in self.cars),
            *(lamp(entry.height).at(entry.x, entry.y, entry.angle) for entry in self.lamps),
            *(tree(entry.height).at(entry.x, entry.y, entry.angle) for entry in self.trees),
            *(
                block(entry.length, entry.width, entry.height, entry.colour).at(
                    entry.x, entry.y, entry.angle, entry.z
                )
                for entry in self.blocks
            ),
            *(_partition(entry) for entry in self.partitions),
            *(
                table(entry.length, entry.width, entry.height).at(entry.x, entry.y, entry.angle)
                for entry in self.tables
            ),
            *(
                fruit_tree(entry.height, entry.fruits).at(entry.x, entry.y, entry.angle)
                for entry in self.fruit_trees
            ),
            *(person(entry.colour).at(entry.x, entry.y, entry.angle) for entry in self.people),
            *(buoy(entry.colour).at(entry.x, entry.y, entry.angle) for entry in self.buoys),
            *(coral(entry.height).at(entry.x, entry.y, entry.angle, self.bottom) for entry in self.corals),
            *(diver().at(entry.x, entry.y, entry.angle, entry.z) for entry in self.divers),
            *(cone(entry.height).at(entry.x, entry.y, entry.angle) for entry in self.cones),
        )

    @property
    def solids(self) -> tuple[Shape, ...]:
        """What bodies bump into and lasers hit, apart from the ground."""
        return tuple(shape for prop in self.props for shape in prop.solids)

    @property
    def mapped(self) -> tuple[Shape, ...]:
        """The solids that the robot's map knows: all but those of cones, people and divers."""
        return tuple(shape for prop in self.props if prop.kind not in _LOOSE for shape in prop.solids)

    @property
    def visuals(self) -> tuple[Shape, ...]:
        """What cameras see, apart from ground and sky."""
        return tuple(shape for prop in self.props for shape in prop.visuals)

    def _walls(self) -> tuple[Prop, ...]:
        if self.wall is None:
            return ()
        length, width, thick = self.ground.length, self.ground.width, self.wall.thickness
        height, bottom = self.wall.height - self.bottom, self.bottom
        long, short = wall(length + 2 * thick, height, thick), wall(width, height, thick)
        north, east = (width + thick) / 2, (length + thick) / 2
        quarter = math.pi / 2
        return (
            long.at(0.0, north, 0.0, bottom),
            long.at(0.0, -north, 0.0, bottom),
            short.at(east, 0.0, quarter, bottom),
            short.at(-east, 0.0, quarter, bottom),
        )


def load(world: str | Path) -> World:
    """The world of that name, or of that TOML file.

    Raises WorldError when there is no such world, or naming the line, the key and the reason when its file is wrong.
    """
    path = Path(world) if str(world).endswith(".toml") else _FOLDER / f"{world}.toml"
    if path.parent != _FOLDER and Path(world).is_dir():
        raise WorldError(f"{world} is a directory; a world is one file, as in {Path(world, 'lake.toml')}.")
    if path.parent == _FOLDER and path.stem not in WORLDS:
        raise WorldError(f"There is no world {str(world)!r}; there is {', '.join(WORLDS)}.")
    try:
        return parse(text_of(path), path.name)
    except FileFault as problem:
        raise WorldError(str(problem)) from problem


def parse(text: str, source: str) -> World:
    """The world that a TOML `text` describes; `source` is what a fault calls it."""
    try:
        world = read(text, World, source)
    except FileFault as problem:
        raise WorldError(str(problem)) from problem
    for where, reason in faults(world):
        raise WorldError(fault(text, source, where, reason))
    return world


def _partition(entry: Partition) -> Prop:
    """The wall from one point to the other, its ends rounded off by half its thickness."""
    (x0, y0), (x1, y1) = entry.start, entry.end
    length = math.dist(entry.start, entry.end) + entry.width
    wall_ = block(length, entry.width, entry.height, entry.colour)
    return wall_.at((x0 + x1) / 2, (y0 + y1) / 2, math.atan2(y1 - y0, x1 - x0))
