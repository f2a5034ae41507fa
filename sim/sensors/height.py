"""An ultrasonic ranger that points down and measures the height above the surface."""

from __future__ import annotations

import math

import msgspec

from bridge.msgs.sensor_msgs import Range
from bridge.msgs.std_msgs import Header, Time
from sim.core.noise import Noise
from sim.core.shapes import rotate
from sim.physics.backend_bullet import Bullet, State
from sim.world.weather import Weather

__all__ = ["HeightParameters", "HeightRanger"]


class HeightParameters(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The `[range]` table of a vehicle's file."""

    rate: float
    """[Hz]"""
    range_min: float
    """[m]"""
    range_max: float
    """[m]"""
    field_of_view: float
    """Width of the cone [rad]."""
    noise: float
    """Standard deviation [m]."""


class HeightRanger:
    """Four beams round the edge of its cone and one in the middle; the nearest thing counts, and water is one."""

    def __init__(
        self, parameters: HeightParameters, backend: Bullet, body: int, weather: Weather, noise: Noise
    ) -> None:
        """On `body`, in its middle."""
        self._parameters, self._backend, self._body = parameters, backend, body
        self._weather, self._noise = weather, noise
        reach, half = parameters.range_max, parameters.field_of_view / 2
        aside, down = reach * math.sin(half), -reach * math.cos(half)
        ends = [
            (0.0, 0.0, -reach),
            *((aside * x, aside * y, down) for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))),
        ]
        self._from = backend.ray_points(body, [(0.0, 0.0, 0.0)] * len(ends))
        self._to = backend.ray_points(body, ends)
        self.last = math.nan
        """Last measurement [m]; NaN when nothing was in reach."""

    def measure(self, state: State, stamp: float) -> Range:
        """The distance at `stamp` [s]; +inf nothing in range, -inf too close (REP-117)."""
        parameters = self._parameters
        part = min(self._backend.rays(self._body, self._from, self._to).tolist())
        distance = part * parameters.range_max if part < 1.0 else math.inf
        if self._weather.wet:
            x, y, z = state.position
            down = max(rotate(state.rotation, (0.0, 0.0, 1.0))[2], 0.1)
            distance = min(distance, max(0.0, z - self._weather.surface(x, y)) / down)
        distance += self._noise.normal(parameters.noise)
        self.last = distance if distance <= parameters.range_max else math.nan
        if distance < parameters.range_min:
            distance = -math.inf
        elif distance > parameters.range_max:
            distance = math.inf
        return Range(
            Header(Time.at(stamp), "range_down"),
            Range.ULTRASOUND,
            parameters.field_of_view,
            parameters.range_min,
            parameters.range_max,
            distance,
        )
