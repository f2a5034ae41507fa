"""The interface of a payload to the vehicle that carries it, and the parameters of the simple payloads."""

from __future__ import annotations

from typing import Protocol

from bridge.msgs import Msg
from sim.core.load import Load
from sim.core.parameters import Positive, Table
from sim.core.shapes import Shape, Vec3
from sim.vehicles.parameters import Parameters

__all__ = [
    "CameraMount",
    "LaserMount",
    "LightsMount",
    "LineMount",
    "Mount",
    "Mounted",
    "SonarMount",
    "TagReaderMount",
    "UltrasoundMount",
]


class Mounted(Protocol):
    """A payload on its vehicle; it has put its sensors into the vehicle's suite."""

    accepts: type[Msg] | None
    """Type of the orders that it takes; None for one that takes none."""

    @property
    def power(self) -> float:
        """Power that it takes now [W]."""

    def command(self, order: Msg) -> None:
        """Do it; ValueError with one sentence when it cannot, which changes nothing."""

    def hold(self) -> None:
        """Move no more, if it moves."""

    def shapes(self) -> tuple[Shape, ...]:
        """Its visible shapes, in `base_link`."""


class Mount(Table, frozen=True, kw_only=True):
    """Parameters of every payload."""

    at: tuple[float, float, float]
    """On its vehicle's deck [m]."""
    mass: Positive
    """With cables and what holds it [kg]."""
    centre: Vec3 = (0.0, 0.0, 0.0)
    """Of its mass, from there [m]."""
    power: Positive
    """[W]"""

    def load(self, parameters: Parameters) -> Load:
        """Its load on a vehicle of these parameters."""
        x, y, z = (sum(parts) for parts in zip(parameters.deck, self.at, self.centre, strict=True))
        return Load(self.mass, (x, y, z))


class LaserMount(Mount, frozen=True, kw_only=True):
    """A laser that measures all round."""

    rate: Positive
    beams: int
    range_min: Positive
    range_max: Positive
    noise: float


class SonarMount(Mount, frozen=True, kw_only=True):
    """A ring of sonars, as wide as its vehicle."""

    rate: Positive
    count: int
    beams: int
    range_min: Positive
    range_max: Positive
    field_of_view: Positive
    noise: float
    step: Positive


class CameraMount(Mount, frozen=True, kw_only=True):
    """A camera more."""

    name: str
    rate: Positive
    width: int
    height: int
    field_of_view: Positive
    yaw: float = 0.0
    pitch: float = 0.0


class LightsMount(Mount, frozen=True, kw_only=True):
    """A pair of lamps that look ahead."""


class UltrasoundMount(Mount, frozen=True, kw_only=True):
    """Four rangers, ahead, to the sides and behind."""

    rate: Positive
    rays: int
    field_of_view: Positive
    range_min: Positive
    range_max: Positive
    noise: float


class LineMount(Mount, frozen=True, kw_only=True):
    """A row of cells that look at the ground under the bow; not for what swims, floats or flies."""

    rate: Positive
    cells: int
    spacing: Positive
    spot: Positive
    dark: float
    bright: float
    mismatch: float
    noise: float

    def load(self, parameters: Parameters) -> Load:
        """It hangs under the bow."""
        return Load(self.mass, (parameters.radius, 0.0, 0.0))


class TagReaderMount(Mount, frozen=True, kw_only=True):
    """A reader of tags that are held before it or that it comes near."""

    rate: Positive
    reach: Positive
    """[m]"""
