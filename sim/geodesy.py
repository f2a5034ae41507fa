"""From metres round a datum to latitude and longitude."""

from __future__ import annotations

import math

from sim.world import Datum

__all__ = ["to_geographic"]

_AXIS = 6378137.0
"""Semi-major axis of WGS 84 [m]."""
_E2 = 6.69437999014e-3
"""Square of its first eccentricity."""


def to_geographic(datum: Datum, east: float, north: float) -> tuple[float, float]:
    """Latitude and longitude [deg] of the place `east` and `north` [m] of the datum, in its tangent plane."""
    latitude = math.radians(datum.latitude)
    shrink = 1 - _E2 * math.sin(latitude) ** 2
    meridian, prime = _AXIS * (1 - _E2) / shrink**1.5, _AXIS / math.sqrt(shrink)
    return (
        datum.latitude + math.degrees(north / meridian),
        datum.longitude + math.degrees(east / (prime * math.cos(latitude))),
    )
