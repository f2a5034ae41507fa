"""A compass whose magnetometer is turned level by an accelerometer."""

from __future__ import annotations

import math

import msgspec

from bridge.core.units import heading_from_yaw
from bridge.msgs.pilothouse_msgs import Compass as Told
from bridge.msgs.std_msgs import Header, Time
from sim.core.constants import GRAVITY
from sim.core.noise import Noise
from sim.core.shapes import Vec3, rotate_back
from sim.physics.backend_bullet import State

__all__ = ["Compass", "CompassParameters", "levelled"]


class CompassParameters(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The `[compass]` table of a vehicle's file."""

    rate: float
    """[Hz]"""
    dip: float
    """Dip of the magnetic field below the horizontal [rad]."""
    noise: float
    """Standard deviation of each part of the field, as a part of its strength."""
    hard_iron: float
    """Standard deviation of what the vehicle's own iron adds to it, one draw a run."""
    accelerometer_noise: float
    """Standard deviation [m/s2]."""


def levelled(field: Vec3, force: Vec3) -> tuple[float, float, float]:
    """Yaw, roll and pitch [rad] of a body that feels a magnetic `field` and a specific `force` along its axes.

    Yaw is 0 where x points east of magnetic north by a right angle, as everywhere; NaN when there is no force.
    """
    fx, fy, fz = force
    if math.hypot(fx, fy, fz) < 1e-6 * GRAVITY:
        return math.nan, math.nan, math.nan
    roll, pitch = math.atan2(fy, fz), math.atan2(-fx, math.hypot(fy, fz))
    mx, my, mz = field
    down = my * math.sin(roll) + mz * math.cos(roll)
    ahead, left = mx * math.cos(pitch) + down * math.sin(pitch), my * math.cos(roll) - mz * math.sin(roll)
    return math.atan2(ahead, left), roll, pitch


class Compass:
    """In `base_link`. An acceleration that lasts tilts its level, as in any such compass."""

    def __init__(self, parameters: CompassParameters, noise: Noise) -> None:
        """A compass at rest."""
        self._parameters, self._noise = parameters, noise
        self._iron = [noise.normal(parameters.hard_iron) for _ in range(3)]
        self._field = (0.0, math.cos(parameters.dip), -math.sin(parameters.dip))
        self._last: tuple[Vec3, float] | None = None

    def measure(self, state: State, stamp: float) -> Told:
        """Measurement at `stamp` [s]; the acceleration is the mean since the last call."""
        parameters, noise = self._parameters, self._noise
        mx, my, mz = (
            part + iron + noise.normal(parameters.noise)
            for part, iron in zip(rotate_back(state.rotation, self._field), self._iron, strict=True)
        )
        fx, fy, fz = (
            part + noise.normal(parameters.accelerometer_noise) for part in self._force(state, stamp)
        )
        yaw, roll, pitch = levelled((mx, my, mz), (fx, fy, fz))
        return Told(Header(Time.at(stamp), "base_link"), heading_from_yaw(yaw), roll, pitch)

    def _force(self, state: State, stamp: float) -> Vec3:
        before, earlier = self._last or (state.velocity, stamp)
        self._last = (state.velocity, stamp)
        period = stamp - earlier
        if period <= 0:
            return rotate_back(state.rotation, (0.0, 0.0, GRAVITY))
        ax, ay, az = ((now - then) / period for now, then in zip(state.velocity, before, strict=True))
        return rotate_back(state.rotation, (ax, ay, az + GRAVITY))
