"""Tables of a world's file: each thing that can stand in a world, with the bounds of its numbers."""

from __future__ import annotations

import math
from typing import Annotated, Literal

import msgspec

from sim.world.surfaces import GRIP, LOOKS_LIKE, Surface

__all__ = [
    "Barrel",
    "Bays",
    "Block",
    "Car",
    "Ceiling",
    "Cone",
    "Coral",
    "Datum",
    "Diver",
    "Dock",
    "DockKind",
    "Door",
    "Entry",
    "FruitTree",
    "Ground",
    "Lamp",
    "Line",
    "Model",
    "Partition",
    "Person",
    "Place",
    "Shelf",
    "Sofa",
    "Spot",
    "Start",
    "Table",
    "Tag",
    "Tinted",
    "Tree",
    "Wall",
    "Water",
    "Wave",
    "Wind",
    "Window",
]

Positive = Annotated[float, msgspec.Meta(gt=0, le=300)]
Finite = Annotated[float, msgspec.Meta(ge=-1000, le=1000)]
Part = Annotated[float, msgspec.Meta(ge=0, le=1)]


class Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One table of the file."""


class Datum(Entry, frozen=True):
    """Place of the map's origin on earth, WGS 84."""

    latitude: Annotated[float, msgspec.Meta(gt=-90, lt=90)]
    """[deg]"""
    longitude: Annotated[float, msgspec.Meta(ge=-180, le=180)]
    """[deg]"""
    altitude: Finite = 0.0
    """[m] above the ellipsoid."""


class Ground(Entry, frozen=True):
    """The level ground, centred on the map's origin."""

    length: Positive
    """Along x [m]."""
    width: Positive
    """Along y [m]."""
    look: Literal["asphalt", "water", "floor", "grass"] = "asphalt"
    """Appearance of the surface at z = 0, for pictures."""
    surface: Surface | None = None
    """What wheels roll on; None for what it looks like."""

    @property
    def grip(self) -> float:
        """Friction coefficient of a rubber tyre on it."""
        return GRIP[self.surface or LOOKS_LIKE[self.look]]


class Wall(Entry, frozen=True):
    """The wall round the ground."""

    height: Positive
    """[m]"""
    thickness: Positive
    """[m]"""


class Spot(Entry, frozen=True):
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
    """Start of a robot."""

    z: Finite = 0.0
    """Of one that swims, its depth below 0 [m]; others stand on the ground or float."""


class Bays(Entry, frozen=True):
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


class Line(Entry, frozen=True, rename={"start": "from", "end": "to"}):
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
    colour: tuple[Part, Part, Part] = (1.0, 0.36, 0.04)
    band: tuple[Part, Part, Part] = (0.95, 0.95, 0.93)
    """Colour of the band round it."""


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
    """A person who looks towards `yaw`, in a shirt of the colour: not on the robot's map."""

    colour: tuple[Part, Part, Part] = (0.24, 0.42, 0.66)
    trousers: tuple[Part, Part, Part] = (0.17, 0.20, 0.29)
    skin: tuple[Part, Part, Part] = (0.80, 0.62, 0.50)
    hair: tuple[Part, Part, Part] = (0.20, 0.15, 0.11)
    height: Annotated[float, msgspec.Meta(ge=0.8, le=2.3)] = 1.75
    """[m]"""
    posture: Literal["standing", "walking", "waving", "bending", "crouching"] = "standing"


class Barrel(Tinted, frozen=True):
    """A barrel: it is not on the robot's map."""

    height: Positive = 0.9
    """[m]"""
    colour: tuple[Part, Part, Part] = (0.16, 0.34, 0.62)


class Ceiling(Entry, frozen=True):
    """A ceiling over all of the ground, seen from below only: nothing bumps into it."""

    height: Positive
    """[m]"""
    lamps: tuple[tuple[Finite, Finite], ...] = ()
    """Where lamps hang on it: x, y [m]."""
    lamp_length: Positive = 1.2
    """Of a lamp, along x [m]."""
    lamp_width: Positive = 0.6
    """[m]"""


class Door(Spot, frozen=True):
    """An open doorway between two partitions, in a wall along its own x; its leaf has slid aside on the side towards y."""

    width: Positive = 1.1
    """From the end of one partition to the other's [m]."""
    height: Positive = 2.05
    """[m]"""


class Window(Entry, frozen=True):
    """A window in the wall round the ground that is nearest to its middle; lasers and bodies meet the wall."""

    x: Finite
    """[m]"""
    y: Finite
    """[m]"""
    width: Positive = 1.6
    """[m]"""
    sill: Positive = 0.9
    """Height of its lower edge [m]."""
    head: Positive = 2.1
    """Height of its upper edge [m]."""


class Shelf(Spot, frozen=True):
    """A bookcase, its back towards y."""

    length: Positive = 1.2
    """[m]"""
    width: Positive = 0.35
    """[m]"""
    height: Positive = 1.9
    """[m]"""


class Sofa(Spot, frozen=True):
    """A sofa that looks towards `yaw`."""

    length: Positive = 1.8
    """[m]"""


class Table(Spot, frozen=True):
    """A table."""

    screens: Annotated[int, msgspec.Meta(ge=0, le=4)] = 0
    """Computer screens on it, for one who sits on its side towards y."""

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
    """Of the card of the person who belongs here; empty when there is none."""
    note: str = ""
    """Message to the people who are led here."""


DockKind = Literal["contacts", "jetty", "pad", "cage"]
"""For robots on wheels, boats, drones, and what swims under water."""


class Dock(Spot, frozen=True, kw_only=True):
    """Where robots of one kind charge: its place is where their contacts meet its own, its yaw the way that they face then."""

    name: str
    """Of the place that it is, for the robots that it is for."""
    kind: DockKind
    z: Finite = 0.0
    """Of the top of a pad and of the middle of a cage's coil [m]; others stand on the ground or float."""
    tag: Annotated[int, msgspec.Meta(ge=0, le=29)] = 0
    """Number of the visible tag on it, of AprilTag 36h11."""
    power: Annotated[float, msgspec.Meta(gt=0, le=50_000)] = 500.0
    """Most that it gives [W]."""
    live: bool = True
    """False: it has no current to give."""


class Model(Spot, frozen=True, kw_only=True):
    """A thing from a file of another program."""

    file: str
    """In glTF or URDF, beside the world's file or at a whole path."""
    z: Finite = 0.0
    """Of the origin of its frame [m]."""
    scale: Annotated[float, msgspec.Meta(gt=0, le=1000)] = 1.0
    """So many times as large as in its file."""
    loose: bool = False
    """True: it was put there since the map was made, which does not show it."""


class Tag(Entry, frozen=True):
    """A tag that a reader near it reads."""

    tag: str
    x: Finite
    """[m]"""
    y: Finite
    """[m]"""
    z: Finite = 0.5
    """[m]"""


class Wave(Entry, frozen=True):
    """A train of regular waves in deep water."""

    height: Annotated[float, msgspec.Meta(gt=0, le=20)]
    """From trough to crest [m]."""
    period: Annotated[float, msgspec.Meta(ge=0.5, le=30)]
    """[s]"""
    direction: Finite = 0.0
    """Direction in which it runs [deg] from east, anticlockwise."""
    phase: Finite = 0.0
    """At the map's origin at the beginning [deg]."""


class Water(Entry, frozen=True):
    """Water over all of the world; its surface lies at z = 0, the ground under it."""

    depth: Annotated[float, msgspec.Meta(ge=0.5, le=300)]
    """[m]"""
    density: Annotated[float, msgspec.Meta(ge=900, le=1200)] = 1000.0
    """[kg/m3]"""
    current: tuple[Finite, Finite] = (0.0, 0.0)
    """Along x and y [m/s]."""
    waves: tuple[Wave, ...] = ()


class Wind(Entry, frozen=True):
    """The wind over all of the world."""

    speed: Annotated[float, msgspec.Meta(ge=0, le=60)]
    """[m/s]"""
    direction: Finite = 0.0
    """Direction in which it blows [deg] from east, anticlockwise."""
    gusts: Annotated[float, msgspec.Meta(ge=0, le=20)] = 0.0
    """Standard deviation of what comes and goes, along x and y; half of it upward [m/s]."""
    gust_time: Positive = 2.0
    """Over which a gust is correlated [s]."""
