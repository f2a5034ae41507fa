"""The numbers of a wheeled vehicle, read from its TOML file and checked."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Annotated

import msgspec

from sim.sensors.battery import BatteryParameters
from sim.sensors.gps import GpsParameters
from sim.sensors.imu import ImuParameters
from sim.sensors.laser import LaserParameters
from sim.sensors.line import LineParameters
from sim.sensors.odometry import OdometryParameters
from sim.sensors.ultrasound import UltrasoundParameters

__all__ = ["CameraParameters", "Limits", "Parameters", "load"]

Positive = Annotated[float, msgspec.Meta(gt=0)]


class _Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One table of the file."""


class Info(_Table, frozen=True):
    """What people and programs call it."""

    name: str
    model: str
    kind: str
    description: str


class Body(_Table, frozen=True):
    """The body without wheels, an upright cylinder."""

    mass: Positive
    """[kg]"""
    radius: Positive
    """[m]"""
    height: Positive
    """Of its top above the ground [m]."""
    clearance: Positive
    """Of its bottom above the ground [m]."""
    centre_of_mass: Positive
    """Above the ground [m]."""
    inertia: tuple[Positive, Positive, Positive]
    """About x, y and z through the centre of mass [kg m2]."""
    friction: Positive


class Wheels(_Table, frozen=True):
    """The two driven wheels."""

    base: Positive
    """Between their middles [m]."""
    radius: Positive
    """[m]"""
    mass: Positive
    """Of one [kg]."""
    friction: Positive
    torque: Positive
    """The most at one wheel [N m]."""
    ticks: Positive
    """Of the encoder in a turn."""


class Casters(_Table, frozen=True):
    """The two sliding supports."""

    radius: Positive
    """[m]"""
    offset: Positive
    """From the axle [m]."""
    mass: Positive
    """Of one [kg]."""


class Limits(_Table, frozen=True):
    """What the drive does at most."""

    speed: Positive
    """[m/s]"""
    yaw_rate: Positive
    """[rad/s]"""
    acceleration: Positive
    """[m/s2]"""
    yaw_acceleration: Positive
    """[rad/s2]"""
    braking: Positive
    """How fast it loses speed when it is told to stop [m/s2]."""
    yaw_braking: Positive
    """The same for turning [rad/s2]."""


class Rate(_Table, frozen=True):
    """A sensor that has nothing but a rate."""

    rate: Positive
    """[Hz]"""


class CameraParameters(_Table, frozen=True):
    """The camera, looking ahead."""

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


class Parameters(_Table, frozen=True):
    """The whole file."""

    info: Info
    body: Body
    wheels: Wheels
    casters: Casters
    limits: Limits
    odometry: OdometryParameters
    laser: LaserParameters
    imu: ImuParameters
    gps: GpsParameters
    bumper: Rate
    line: LineParameters
    ultrasound: UltrasoundParameters
    battery: BatteryParameters
    camera: CameraParameters
    truth: Rate


def load(path: Path) -> Parameters:
    """The numbers in the file at `path`; ValueError names the file, the key and what is wrong."""
    try:
        return msgspec.convert(tomllib.loads(path.read_text(encoding="utf-8")), Parameters)
    except (tomllib.TOMLDecodeError, msgspec.ValidationError) as fault:
        raise ValueError(f"{path.name}: {fault}.") from fault
