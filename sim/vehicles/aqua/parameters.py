"""The numbers of the aqua."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Self

from msgspec.structs import replace

from sim.core.load import Load, mass_of, moments_about
from sim.core.parameters import CameraParameters
from sim.dynamics.fins import FinParameters
from sim.dynamics.swimmer import SwimmerBody, SwimmerLimits
from sim.sensors.compass import CompassParameters
from sim.sensors.depth import DepthParameters
from sim.sensors.reckoning import ReckoningParameters
from sim.vehicles.parameters import Parameters, load, outline

__all__ = ["PARAMETERS", "AquaParameters"]


class AquaParameters(Parameters, frozen=True, kw_only=True):
    """The whole file of a swimmer."""

    body: SwimmerBody
    fins: FinParameters
    limits: SwimmerLimits
    reckoning: ReckoningParameters
    compass: CompassParameters
    depth: DepthParameters
    camera: CameraParameters

    @property
    def radius(self) -> float:
        """Of the circle that body and fins fit in [m]."""
        return math.hypot(self.body.length / 2, self.fins.aside + self.fins.length / 2)

    @property
    def footprint(self) -> tuple[tuple[float, float], ...]:
        """Of body and fins [m]."""
        return outline(self.body.length, 2 * self.fins.aside + self.fins.length)

    @property
    def deck(self) -> tuple[float, float, float]:
        """Mounting place of payloads, in `base_link` [m]."""
        return (0.0, 0.0, self.body.height / 2)

    def laden(self, loads: Sequence[Load]) -> Self:
        """Heavier, and as light in the water as before: a load under water is trimmed with as much foam beside it.

        So its weight bears on nothing, its middle stays the centre of mass, and what it costs is inertia.
        """
        body = self.body
        mass = body.mass + mass_of(loads)
        lift, arm = body.mass * body.buoyancy, body.mass * body.buoyancy * body.lift_arm
        buoyancy = (lift + mass_of(loads)) / mass
        inertia = moments_about((0.0, 0.0, 0.0), body.inertia, loads)
        heavier = replace(
            body, mass=mass, inertia=inertia, buoyancy=buoyancy, lift_arm=arm / (mass * buoyancy)
        )
        return replace(self, body=heavier)

    @property
    def cameras(self) -> tuple[CameraParameters, ...]:
        """It has one."""
        return (self.camera,)

    @property
    def max_climb(self) -> float:
        """Greatest speed up and down [m/s]."""
        return self.limits.climb

    @property
    def max_tilt(self) -> float:
        """Greatest roll and pitch that it holds by order [rad]."""
        return self.limits.tilt


PARAMETERS: AquaParameters = load(Path(__file__).parent / "aqua.toml", AquaParameters)
"""The swimmer's numbers."""
