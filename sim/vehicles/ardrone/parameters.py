"""The numbers of the ardrone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Self

from msgspec.structs import replace

from sim.core.constants import GRAVITY
from sim.core.load import Load, mass_of, moments_about
from sim.core.parameters import CameraParameters
from sim.dynamics.quadrotor import QuadrotorBody, QuadrotorLimits, RotorParameters
from sim.sensors.height import HeightParameters
from sim.sensors.reckoning import ReckoningParameters
from sim.vehicles.parameters import Parameters, load, outline

__all__ = ["PARAMETERS", "ArdroneParameters"]


MAX_LOAD_FACTOR = 0.8
"""Greatest weight as a part of its greatest thrust: it steers and climbs by the rest."""


class ArdroneParameters(Parameters, frozen=True, kw_only=True):
    """The whole file of a quadrotor."""

    body: QuadrotorBody
    rotors: RotorParameters
    limits: QuadrotorLimits
    reckoning: ReckoningParameters
    range: HeightParameters
    front: CameraParameters
    down: CameraParameters

    @property
    def radius(self) -> float:
        """Of the circle that the body fits in [m]."""
        return self.body.width / math.sqrt(2)

    @property
    def footprint(self) -> tuple[tuple[float, float], ...]:
        """Of the hull of foam [m]."""
        return outline(self.body.width, self.body.width)

    @property
    def deck(self) -> tuple[float, float, float]:
        """Mounting place of payloads, in `base_link` [m]."""
        return (0.0, 0.0, self.body.height / 2)

    def laden(self, loads: Sequence[Load]) -> Self:
        """Heavier: its rotors turn faster to carry it, and it turns more slowly; what it carries hangs in balance."""
        body, rotors = self.body, self.rotors
        mass = body.mass + mass_of(loads)
        limit = MAX_LOAD_FACTOR * 4 * rotors.lift * rotors.speed**2 / GRAVITY
        if mass > limit:
            name, spare = self.info.name, limit - body.mass
            raise ValueError(
                f"{name} carries {spare:.2f} kg at most; the payload weighs {mass_of(loads):.2f} kg."
            )
        inertia = moments_about((0.0, 0.0, 0.0), body.inertia, loads)
        return replace(self, body=replace(body, mass=mass, inertia=inertia))

    @property
    def cameras(self) -> tuple[CameraParameters, ...]:
        """Ahead and down."""
        return (self.front, self.down)

    @property
    def max_climb(self) -> float:
        """Greatest speed up and down [m/s]."""
        return self.limits.climb

    @property
    def max_tilt(self) -> float:
        """Greatest roll and pitch that it holds by order [rad]."""
        return self.limits.tilt

    @property
    def hover(self) -> float:
        """Speed of the rotors that carries its weight [rad/s]."""
        return math.sqrt(self.body.mass * GRAVITY / 4 / self.rotors.lift)


PARAMETERS: ArdroneParameters = load(Path(__file__).parent / "ardrone.toml", ArdroneParameters)
"""The quadrotor's numbers."""
