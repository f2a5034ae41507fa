"""A ring of ultrasonic rangers."""

from __future__ import annotations

import math

import msgspec
import numpy as np

from bridge.msgs.arrays import Float32Array, Float64Array
from bridge.msgs.pilothouse_msgs import SonarRing
from bridge.msgs.std_msgs import Header, Time
from sim.core.noise import Noise
from sim.physics.backend_bullet import Bullet

__all__ = ["Sonar", "SonarParameters"]


class SonarParameters(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The `[sonar]` table of a vehicle's file."""

    rate: float
    """[Hz]"""
    count: int
    """Of the sonars, evenly round the body, the first one ahead, then anticlockwise."""
    beams: int
    """By which a cone is felt; the nearest counts."""
    height: float
    """Above the ground [m]."""
    radius: float
    """Of the ring [m]."""
    range_min: float
    """[m]"""
    range_max: float
    """[m]"""
    field_of_view: float
    """Width of a cone [rad]."""
    noise: float
    """Standard deviation, as a part of the range."""
    step: float
    """The ranges come in steps of this [m]."""


class Sonar:
    """All of the ring at once; a real one fires one after the other."""

    def __init__(self, parameters: SonarParameters, backend: Bullet, body: int, noise: Noise) -> None:
        """The ring on `body`."""
        self._parameters, self._backend, self._body, self._noise = parameters, backend, body, noise
        self._bearings = [
            math.remainder(math.tau * i / parameters.count, math.tau) for i in range(parameters.count)
        ]
        half = parameters.field_of_view / 2
        spread = [half * (2 * i / max(parameters.beams - 1, 1) - 1) for i in range(parameters.beams)]
        start, end = [], []
        for bearing in self._bearings:
            x, y = parameters.radius * math.cos(bearing), parameters.radius * math.sin(bearing)
            for aside in spread:
                angle = bearing + aside
                start.append((x, y, parameters.height))
                reach = parameters.range_max
                end.append((x + reach * math.cos(angle), y + reach * math.sin(angle), parameters.height))
        self._from, self._to = backend.ray_points(body, start), backend.ray_points(body, end)
        self._blank = SonarRing(
            bearings=Float64Array(self._bearings),
            field_of_view=parameters.field_of_view,
            radius=parameters.radius,
            range_min=parameters.range_min,
            range_max=parameters.range_max,
        )

    def measure(self, stamp: float) -> SonarRing:
        """The ring at `stamp` [s]; +inf where nothing is in range, -inf where it is too near (REP-117)."""
        parameters = self._parameters
        hits = self._backend.rays(self._body, self._from, self._to)
        nearest = hits.reshape(parameters.count, parameters.beams).min(axis=1)
        ranges = (
            nearest * parameters.range_max * (1 + self._noise.normals(parameters.noise, parameters.count))
        )
        ranges = np.round(ranges / parameters.step) * parameters.step
        ranges[ranges < parameters.range_min] = -np.inf
        ranges[(nearest >= 1.0) | (ranges > parameters.range_max)] = np.inf
        measured = Float32Array(ranges.astype("<f4").tobytes())
        header = Header(Time.at(stamp), "base_link")
        return msgspec.structs.replace(self._blank, header=header, ranges=measured)
