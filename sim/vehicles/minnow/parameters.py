"""The numbers of the minnow."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Self

from msgspec.structs import replace

from sim.core.load import Load, mass_of, with_loads
from sim.core.parameters import CameraParameters
from sim.dynamics.boat import Propeller, Rudder
from sim.dynamics.hull import HullParameters
from sim.sensors.compass import CompassParameters
from sim.sensors.gps import GpsParameters
from sim.sensors.reckoning import ReckoningParameters
from sim.vehicles.parameters import Parameters, load, outline

__all__ = ["PARAMETERS", "MinnowParameters"]


class MinnowParameters(Parameters, frozen=True, kw_only=True):
    """The whole file of a boat."""

    hull: HullParameters
    propeller: Propeller
    rudder: Rudder
    reckoning: ReckoningParameters
    compass: CompassParameters
    gps: GpsParameters
    camera: CameraParameters

    @property
    def radius(self) -> float:
        """Of the circle that the hull fits in [m]."""
        return math.hypot(self.hull.length, self.hull.beam) / 2

    @property
    def footprint(self) -> tuple[tuple[float, float], ...]:
        """Of its two floats [m]."""
        return outline(self.hull.length, self.hull.beam)

    @property
    def deck(self) -> tuple[float, float, float]:
        """Mounting place of payloads, in `base_link` [m]."""
        return (0.0, 0.0, self.hull.depth - self.hull.draft)

    def laden(self, loads: Sequence[Load]) -> Self:
        """Heavier: it lies deeper, drags more water, and heels towards what it carries."""
        hull = self.hull
        mass, centre, inertia = with_loads(hull.mass, hull.centre_of_mass, hull.inertia, loads)
        heavier = replace(hull, mass=mass, centre_of_mass=centre, inertia=inertia, load=mass_of(loads))
        middle = tuple(sum(load.mass * load.at[axis] for load in loads) / heavier.load for axis in range(3))
        return replace(self, hull=replace(heavier, load_at=middle))

    @property
    def cameras(self) -> tuple[CameraParameters, ...]:
        """It has one."""
        return (self.camera,)

    @property
    def max_steering(self) -> float:
        """Greatest angle of the rudder [rad]."""
        return self.rudder.limit

    @property
    def min_radius(self) -> float:
        """Of the tightest turn that it drives [m]."""
        return self.rudder.radius


PARAMETERS: MinnowParameters = load(Path(__file__).parent / "minnow.toml", MinnowParameters)
"""The boat's numbers."""
