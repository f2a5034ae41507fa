"""Vehicles on driven wheels, which follow their drive until the battery is empty."""

from __future__ import annotations

from typing import Protocol, TypeVar

from sim.vehicles.chassis import Chassis
from sim.vehicles.parameters import Parameters

__all__ = ["Wheeled"]

P = TypeVar("P", bound=Parameters)


class Drive(Protocol):
    """The drive of the wheels."""

    def brake(self) -> None:
        """Come to rest."""

    def halt(self) -> None:
        """Stand still at once."""

    def step(self) -> None:
        """Come one physics step nearer to the target."""


class Wheeled(Chassis[P]):
    """A vehicle that a `Drive` moves; each kind has its own."""

    _drive: Drive

    def halt(self) -> None:
        """Let the wheels stand still at once."""
        self._drive.halt()

    def before_step(self) -> None:
        """Let the drive come a step nearer to its target."""
        if self.battery.empty:
            self._drive.brake()
        self._drive.step()
