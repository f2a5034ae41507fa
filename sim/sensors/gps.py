"""A satellite receiver."""

from __future__ import annotations

import msgspec

import bridge.core.geo
from bridge.msgs.sensor_msgs import NavSatFix, NavSatStatus
from bridge.msgs.std_msgs import Header, Time
from sim.core.noise import GaussMarkov, Noise
from sim.physics.backend_bullet import State
from sim.world.tables import Datum

__all__ = ["Gps", "GpsParameters"]

_DIAGONAL_KNOWN = 2
"""COVARIANCE_TYPE_DIAGONAL_KNOWN of sensor_msgs/NavSatFix."""


class GpsParameters(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The `[gps]` table of a vehicle's file."""

    rate: float
    noise: float
    wander_error: float
    wander: float


class Gps:
    """Position on earth; the height is half as good as the rest."""

    def __init__(self, parameters: GpsParameters, datum: Datum, noise: Noise) -> None:
        """A receiver in the world whose map's origin lies at `datum`."""
        self._parameters, self._noise = parameters, noise
        self._altitude = datum.altitude
        self._origin = bridge.core.geo.Datum(datum.latitude, datum.longitude)
        self._errors = tuple(
            GaussMarkov(noise, parameters.wander_error * worse, parameters.wander, 1 / parameters.rate)
            for worse in (1.0, 1.0, 2.0)
        )
        variance = parameters.noise**2 + parameters.wander_error**2
        self._covariance = [variance, 0.0, 0.0, 0.0, variance, 0.0, 0.0, 0.0, 4 * variance]

    def measure(self, state: State, stamp: float) -> NavSatFix:
        """The fix at `stamp` [s] of a body in `state`."""
        east, north, up = (
            true + error.step() + self._noise.normal(self._parameters.noise)
            for true, error in zip(state.position, self._errors, strict=True)
        )
        latitude, longitude = self._origin.to_geographic(east, north)
        return NavSatFix(
            Header(Time.at(stamp), "gps"),
            NavSatStatus(),
            latitude,
            longitude,
            self._altitude + up,
            self._covariance,
            _DIAGONAL_KNOWN,
        )
