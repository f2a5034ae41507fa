"""A world and the things that stand in it."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import Annotated

import msgspec

from sim.core.shapes import Shape
from sim.parts.part import part
from sim.world.props import Prop, block, car, cone, lamp, tree
from sim.world.props_docks import MAKERS
from sim.world.props_office import chair, door, lamp_panel, shelf, sofa
from sim.world.props_people import Looks, barrel, fruit_tree, person, table
from sim.world.props_water import buoy, coral, diver
from sim.world.room_walls import outer_walls, partition
from sim.world.tables import (
    Barrel,
    Bays,
    Block,
    Car,
    Ceiling,
    Cone,
    Coral,
    Datum,
    Diver,
    Dock,
    Door,
    Entry,
    FruitTree,
    Ground,
    Lamp,
    Line,
    Model,
    Partition,
    Person,
    Place,
    Shelf,
    Sofa,
    Spot,
    Start,
    Table,
    Tag,
    Tinted,
    Tree,
    Wall,
    Water,
    Wind,
    Window,
)

__all__ = ["World"]


Name = Annotated[str, msgspec.Meta(min_length=1, max_length=60)]

_LOOSE = ("cone", "person", "diver", "barrel", "loose_model")
"""Kinds of things that move about or were put there since the map was made."""


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
    barrels: tuple[Barrel, ...] = ()
    trees: tuple[Tree, ...] = ()
    blocks: tuple[Block, ...] = ()
    partitions: tuple[Partition, ...] = ()
    tables: tuple[Table, ...] = ()
    doors: tuple[Door, ...] = ()
    windows: tuple[Window, ...] = ()
    shelves: tuple[Shelf, ...] = ()
    chairs: tuple[Spot, ...] = ()
    sofas: tuple[Sofa, ...] = ()
    people: tuple[Person, ...] = ()
    fruit_trees: tuple[FruitTree, ...] = ()
    tags: tuple[Tag, ...] = ()
    places: tuple[Place, ...] = ()
    """Names that people give to places in it."""
    docks: tuple[Dock, ...] = ()
    """Where robots charge."""
    buoys: tuple[Tinted, ...] = ()
    divers: tuple[Diver, ...] = ()
    corals: tuple[Coral, ...] = ()
    models: tuple[Model, ...] = ()
    """Things from files of other programs."""
    water: Water | None = None
    """None on dry land."""
    ceiling: Ceiling | None = None
    """None under the sky."""
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
            *(partition(entry, self.ceiling) for entry in self.partitions),
            *(
                table(entry.length, entry.width, entry.height, entry.screens).at(
                    entry.x, entry.y, entry.angle
                )
                for entry in self.tables
            ),
            *self._furniture(),
            *(
                fruit_tree(entry.height, entry.fruits).at(entry.x, entry.y, entry.angle)
                for entry in self.fruit_trees
            ),
            *(person(entry.colour, _looks(entry)).at(entry.x, entry.y, entry.angle) for entry in self.people),
            *(buoy(entry.colour).at(entry.x, entry.y, entry.angle) for entry in self.buoys),
            *(coral(entry.height).at(entry.x, entry.y, entry.angle, self.bottom) for entry in self.corals),
            *(diver().at(entry.x, entry.y, entry.angle, entry.z) for entry in self.divers),
            *(
                cone(entry.height, entry.colour, entry.band).at(entry.x, entry.y, entry.angle)
                for entry in self.cones
            ),
            *(barrel(entry.height, entry.colour).at(entry.x, entry.y, entry.angle) for entry in self.barrels),
            *(
                MAKERS[entry.kind](entry.tag, entry.z).at(entry.x, entry.y, entry.angle, entry.z)
                for entry in self.docks
            ),
            *(_model(entry) for entry in self.models),
        )

    @property
    def solids(self) -> tuple[Shape, ...]:
        """Shapes that bodies and lasers hit, apart from the ground."""
        return tuple(shape for prop in self.props for shape in prop.solids)

    @property
    def mapped(self) -> tuple[Shape, ...]:
        """The solids that the robot's map knows: all but those of what moves about."""
        return tuple(shape for prop in self.props if prop.kind not in _LOOSE for shape in prop.solids)

    @property
    def visuals(self) -> tuple[Shape, ...]:
        """Shapes that cameras see, apart from ground and sky."""
        return tuple(shape for prop in self.props for shape in prop.visuals)

    @cached_property
    def overhead(self) -> tuple[Shape, ...]:
        """What hangs on the ceiling: cameras see it from below, and nothing bumps into it."""
        ceiling = self.ceiling
        if ceiling is None:
            return ()
        upright = (0.0, 0.0, 0.0, 1.0)
        return tuple(
            shape.at((x, y, ceiling.height), upright)
            for x, y in ceiling.lamps
            for shape in lamp_panel(ceiling.lamp_length, ceiling.lamp_width)
        )

    def _walls(self) -> tuple[Prop, ...]:
        if self.wall is None:
            return ()
        return outer_walls(self.ground, self.wall, self.bottom, self.ceiling, self.windows)

    def _furniture(self) -> tuple[Prop, ...]:
        thickness = self.partitions[0].width if self.partitions else 0.15
        highest = self.ceiling.height if self.ceiling else 2.4
        return (
            *(
                door(entry.width, entry.height, highest, thickness).at(entry.x, entry.y, entry.angle)
                for entry in self.doors
            ),
            *(
                shelf(entry.length, entry.width, entry.height).at(entry.x, entry.y, entry.angle)
                for entry in self.shelves
            ),
            *(chair().at(entry.x, entry.y, entry.angle) for entry in self.chairs),
            *(sofa(entry.length).at(entry.x, entry.y, entry.angle) for entry in self.sofas),
        )


def _model(entry: Model) -> Prop:
    """The thing of a file where `entry` puts it; PartError when there is none."""
    read = part(Path(entry.file), entry.scale)
    made = Prop("loose_model" if entry.loose else "model", read.solids, read.visuals)
    return made.at(entry.x, entry.y, entry.angle, entry.z)


def _looks(entry: Person) -> Looks:
    return Looks(entry.trousers, entry.skin, entry.hair, entry.height, entry.posture)
