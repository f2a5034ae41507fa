"""The numbers that every vehicle has, read from its TOML file and checked."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Self, TypeVar

from bridge.core.toml_files import read, text_of
from sim.core.load import Load
from sim.core.parameters import CameraParameters, Info, Limits, Rate, Table
from sim.physics.motors import MotorParameters
from sim.sensors.battery import BatteryParameters
from sim.sensors.imu import ImuParameters
from sim.vehicles.charging import ChargingParameters

__all__ = ["Parameters", "load", "outline"]


class Parameters(Table, frozen=True, kw_only=True):
    """Tables that the file of every vehicle has; each kind has a class with more."""

    info: Info
    limits: Limits
    motor: MotorParameters
    imu: ImuParameters
    bumper: Rate
    battery: BatteryParameters
    charging: ChargingParameters
    truth: Rate

    @property
    def radius(self) -> float:
        """Of the circle round `base_link` that the body fits in [m]."""
        raise NotImplementedError

    @property
    def footprint(self) -> tuple[tuple[float, float], ...]:
        """Corners of its outline in `base_link`, x ahead and y left, anticlockwise [m]; empty for a round one."""
        return ()

    @property
    def deck(self) -> tuple[float, float, float]:
        """Mounting place of payloads, in `base_link` [m]."""
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


def outline(length: float, width: float, ahead: float = 0.0) -> tuple[tuple[float, float], ...]:
    """Corners of a rectangle whose middle is `ahead` of `base_link` [m]."""
    front, back, side = ahead + length / 2, ahead - length / 2, width / 2
    return ((back, -side), (front, -side), (front, side), (back, side))


P = TypeVar("P", bound=Parameters)


def load(path: Path, kind: type[P]) -> P:
    """The numbers of a `kind` of vehicle in the file at `path`; ValueError names the file, the line, the key and the reason."""
    return read(text_of(path), kind, path.name)
