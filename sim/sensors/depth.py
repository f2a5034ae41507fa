"""A pressure gauge, which measures the depth of a vehicle."""

from __future__ import annotations

import msgspec

from bridge.msgs.sensor_msgs import FluidPressure
from bridge.msgs.std_msgs import Header, Time
from sim.core.constants import GRAVITY
from sim.core.noise import Noise
from sim.physics.backend_bullet import State
from sim.world.weather import Weather

__all__ = ["AIR_PRESSURE", "DepthGauge", "DepthParameters"]

AIR_PRESSURE = 101_325.0
"""On the water [Pa]."""


class DepthParameters(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The `[depth]` table of a vehicle's file."""

    rate: float
    """[Hz]"""
    noise: float
    """Standard deviation [Pa]."""


class DepthGauge:
    """In `base_link`; waves over it count for half, as they do a little below them."""

    def __init__(self, parameters: DepthParameters, weather: Weather, noise: Noise) -> None:
        """A gauge in the water of `weather`."""
        self._parameters, self._weather, self._noise = parameters, weather, noise

    def measure(self, state: State, stamp: float) -> FluidPressure:
        """The pressure at `stamp` [s], air and water together."""
        x, y, z = state.position
        depth = max(0.0, self._weather.surface(x, y) / 2 - z)
        noise = self._parameters.noise
        pressure = AIR_PRESSURE + self._weather.density * GRAVITY * depth + self._noise.normal(noise)
        return FluidPressure(Header(Time.at(stamp), "base_link"), pressure, noise**2)
