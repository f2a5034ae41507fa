"""The numbers of the commander."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Self

from msgspec.structs import replace

from sim.core.load import Load, with_loads
from sim.core.parameters import CameraParameters
from sim.dynamics.ackermann import AckermannBody, AckermannLimits, Axles
from sim.dynamics.tyres import TyreParameters
from sim.sensors.gps import GpsParameters
from sim.sensors.laser import LaserParameters
from sim.sensors.odometry import OdometryParameters
from sim.vehicles.parameters import Parameters, load, outline

__all__ = ["PARAMETERS", "CommanderParameters"]


class CommanderParameters(Parameters, frozen=True, kw_only=True):
    """The whole file."""

    body: AckermannBody
    axles: Axles
    tyres: TyreParameters
    limits: AckermannLimits
    odometry: OdometryParameters
    laser: LaserParameters
    gps: GpsParameters
    front: CameraParameters
    rear: CameraParameters

    @property
    def radius(self) -> float:
        """From the middle of the rear axle to the farthest corner [m]."""
        return math.hypot(self.body.length / 2 + abs(self.body.ahead), self.body.width / 2)

    @property
    def footprint(self) -> tuple[tuple[float, float], ...]:
        """Of the body [m]."""
        return outline(self.body.length, self.body.width, ahead=self.body.ahead)

    @property
    def mass(self) -> float:
        """Of body and wheels [kg]."""
        return self.body.mass + 4 * self.axles.mass

    @property
    def deck(self) -> tuple[float, float, float]:
        """Mounting place of payloads, in `base_link` [m]."""
        return (self.body.ahead - self.body.length * 0.33, 0.0, self.body.height)

    def laden(self, loads: Sequence[Load]) -> Self:
        """Heavier, and higher in its balance."""
        mass, centre, inertia = with_loads(self.body.mass, self.body.centre_of_mass, self.body.inertia, loads)
        return replace(self, body=replace(self.body, mass=mass, centre_of_mass=centre, inertia=inertia))

    @property
    def cameras(self) -> tuple[CameraParameters, ...]:
        """Front and rear."""
        return (self.front, self.rear)

    @property
    def max_steering(self) -> float:
        """Greatest angle of a wheel in the middle of the front axle [rad]."""
        return self.limits.steering

    @property
    def min_radius(self) -> float:
        """Of the tightest turn of the middle of the rear axle [m]."""
        return self.axles.base / math.tan(self.limits.steering)


PARAMETERS: CommanderParameters = load(Path(__file__).parent / "commander.toml", CommanderParameters)
"""The truck's numbers."""
