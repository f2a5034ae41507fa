"""Loads that a vehicle carries: point masses at a place, small beside the vehicle."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from sim.core.shapes import Vec3

__all__ = ["Load", "MassProperties", "mass_of", "moments_about", "with_loads"]


class Load(NamedTuple):
    """One thing."""

    mass: float
    """[kg]"""
    at: Vec3
    """Place of its mass, in `base_link` [m]."""


class MassProperties(NamedTuple):
    """A body with what it carries."""

    mass: float
    """[kg]"""
    centre: Vec3
    """Of mass, in `base_link` [m]."""
    moments: Vec3
    """About the axes through that [kg m2]; what turning about one axis does to another is left out."""


def mass_of(loads: Sequence[Load]) -> float:
    """Of all together [kg]."""
    return sum(load.mass for load in loads)


def with_loads(mass: float, centre: Vec3, moments: Vec3, loads: Sequence[Load]) -> MassProperties:
    """A body of its own `mass` [kg], `centre` of mass [m] and `moments` of inertia about that [kg m2], carrying `loads`.

    By the parallel axis theorem; each load is a point.
    """
    parts = [Load(mass, centre), *loads]
    total = mass_of(parts)
    x, y, z = (sum(part.mass * part.at[axis] for part in parts) / total for axis in range(3))
    return MassProperties(total, (x, y, z), moments_about((x, y, z), moments, parts))


def moments_about(point: Vec3, moments: Vec3, parts: Sequence[Load]) -> Vec3:
    """`moments` and those of points of mass about the axes through a `point` [kg m2]."""
    ix, iy, iz = moments
    for mass, (px, py, pz) in parts:
        x, y, z = px - point[0], py - point[1], pz - point[2]
        ix, iy, iz = ix + mass * (y * y + z * z), iy + mass * (x * x + z * z), iz + mass * (x * x + y * y)
    return ix, iy, iz
