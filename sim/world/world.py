"""A world and the things that stand in it."""

from __future__ import annotations

import math
from functools import cached_property
from typing import Annotated

import msgspec

from sim.core.shapes import Shape
from sim.world.props import Prop, block, car, cone, lamp, tree, wall
from sim.world.props_people import fruit_tree, person, table
from sim.world.props_water import buoy, coral, diver
from sim.world.tables import (
    Bays,
    Block,
    Car,
    Cone,
    Coral,
    Datum,
    Diver,
    Entry,
    FruitTree,
    Ground,
    Lamp,
    Line,
    Partition,
    Person,
    Place,
    Spot,
    Start,
    Table,
    Tag,
    Tinted,
    Tree,
    Wall,
    Water,
    Wind,
)

__all__ = ["World"]


Name = Annotated[str, msgspec.Meta(min_length=1, max_length=60)]

_LOOSE = ("cone", "person", "diver")
"""Kinds of things that move about."""


class World(Entry, frozen=True, dict=True):
    """Everything the file says; x east, y north, z up from the ground [m]."""

    name: Name
    description: Annotated[str, msgspec.Meta(max_length=500)]
    datum: Datum
    ground: Ground
    start: Start
    """Start of the robot."""
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
        """Shapes that bodies and lasers hit, apart from the ground."""
        return tuple(shape for prop in self.props for shape in prop.solids)

    @property
    def mapped(self) -> tuple[Shape, ...]:
        """The solids that the robot's map knows: all but those of cones, people and divers."""
        return tuple(shape for prop in self.props if prop.kind not in _LOOSE for shape in prop.solids)

    @property
    def visuals(self) -> tuple[Shape, ...]:
        """Shapes that cameras see, apart from ground and sky."""
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


def _partition(entry: Partition) -> Prop:
    """The wall from one point to the other, its ends rounded off by half its thickness."""
    (x0, y0), (x1, y1) = entry.start, entry.end
    length = math.dist(entry.start, entry.end) + entry.width
    wall_ = block(length, entry.width, entry.height, entry.colour)
    return wall_.at((x0 + x1) / 2, (y0 + y1) / 2, math.atan2(y1 - y0, x1 - x0))
