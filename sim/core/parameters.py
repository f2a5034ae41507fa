"""The numbers of a vehicle, read from its TOML file and checked: what all kinds have in common."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Self, TypeVar

import msgspec

from sim.core.load import Load
from sim.core.toml_tables import read, text_of
from sim.sensors.battery import BatteryParameters
from sim.sensors.imu import ImuParameters

__all__ = [
    "CameraParameters",
    "Info",
    "Limits",
    "Motor",
    "Parameters",
    "Part",
    "Positive",
    "Rate",
    "Table",
    "load",
]

Positive = Annotated[float, msgspec.Meta(gt=0, le=1e6)]
"""No figure of a vehicle is larger in our units."""
Part = Annotated[float, msgspec.Meta(gt=0, le=1)]


class Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One table of the file."""


class Info(Table, frozen=True, kw_only=True):
    """What people and programs call it."""

    name: str
    model: str
    kind: str
    description: str


class Limits(Table, frozen=True, kw_only=True):
    """What the drive does at most."""

    speed: Positive
    """[m/s]"""
    yaw_rate: Positive
    """[rad/s]"""


class Rate(Table, frozen=True, kw_only=True):
    """A sensor that has nothing but a rate."""

    rate: Positive
    """[Hz]"""


class CameraParameters(Table, frozen=True, kw_only=True):
    """A camera."""

    name: str
    rate: Positive
    """[Hz]"""
    width: int
    """[px]"""
    height: int
    """[px]"""
    field_of_view: Positive
    """Horizontal [rad]."""
    position: tuple[float, float, float]
    """In `base_link` [m]."""
    yaw: float = 0.0
    """Where it looks, from straight ahead to the left [rad]."""
    pitch: float = 0.0
    """How far it looks down [rad]."""


class Motor(Table, frozen=True, kw_only=True):
    """One of the motors with its gear, all alike."""

    efficiency: Part
    """Of motor and gear, without the losses in the winding."""
    copper: Positive
    """What the winding loses at 1 N m of what the motor turns, growing with the torque's square [W/(N m)2]."""
    heat_capacity: Positive
    """[J/K]"""
    cooling: Positive
    """To the surroundings [W/K]."""


class Parameters(Table, frozen=True, kw_only=True):
    """What the file of every vehicle says; each kind has a class with more."""

    info: Info
    limits: Limits
    motor: Motor
    imu: ImuParameters
    bumper: Rate
    battery: BatteryParameters
    truth: Rate

    @property
    def radius(self) -> float:
        """Of the circle round `base_link` that the body fits in [m]."""
        raise NotImplementedError

    @property
    def deck(self) -> tuple[float, float, float]:
        """Where payloads are mounted, in `base_link` [m]."""
        raise NotImplementedError

    def laden(self, loads: Sequence[Load]) -> Self:
        """The numbers of the same vehicle carrying `loads`; ValueError with one sentence when that is too much for it."""
        raise NotImplementedError

    @property
    def cameras(self) -> tuple[CameraParameters, ...]:
        """Its cameras, the first one is the main one."""
        return ()

    @property
    def max_climb(self) -> float:
        """Greatest speed up and down [m/s]; 0 for what stays on the ground or the water."""
        return 0.0

    @property
    def max_tilt(self) -> float:
        """Greatest roll and pitch that it holds by order [rad]; 0 for what takes no such order."""
        return 0.0

    @property
    def max_steering(self) -> float:
        """Greatest angle of front wheels or rudder [rad]; 0 for what has none."""
        return 0.0

    @property
    def min_radius(self) -> float:
        """Of the tightest turn that it drives [m]; 0 for what turns where it stands."""
        return 0.0


P = TypeVar("P", bound=Parameters)


def load(path: Path, kind: type[P]) -> P:
    """The numbers of a `kind` of vehicle in the file at `path`; ValueError names the file, the line, the key and what is wrong."""
    return read(text_of(path), kind, path.name)
