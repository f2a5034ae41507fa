"""Tables of numbers that several vehicles, sensors and payloads share."""

from __future__ import annotations

from typing import Annotated

import msgspec

__all__ = ["CameraParameters", "Info", "Limits", "Part", "Positive", "Rate", "Table"]

Positive = Annotated[float, msgspec.Meta(gt=0, le=1e6)]
"""No figure of a vehicle is larger in our units."""
Part = Annotated[float, msgspec.Meta(gt=0, le=1)]


class Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One table of the file."""


class Info(Table, frozen=True, kw_only=True):
    """Names and description of a vehicle."""

    name: str
    model: str
    kind: str
    description: str
    on_the_ground: bool = False
    """It drives on the ground, so that it can look at it."""
    floats: bool = False
    """It floats on the water, where waves may break over it without sinking it."""
    dives: bool = False
    """It swims under water and may lie any way up."""


class Limits(Table, frozen=True, kw_only=True):
    """Limits of the drive."""

    speed: Positive
    """[m/s]"""
    yaw_rate: Positive
    """[rad/s]"""


class Rate(Table, frozen=True, kw_only=True):
    """A sensor that has nothing but a rate."""

    rate: Positive
    """[Hz]"""


class CameraParameters(Table, frozen=True, kw_only=True):
    """A camera."""

    name: str
    rate: Positive
    """[Hz]"""
    width: int
    """[px]"""
    height: int
    """[px]"""
    field_of_view: Positive
    """Horizontal [rad]."""
    position: tuple[float, float, float]
    """In `base_link` [m]."""
    yaw: float = 0.0
    """Direction of view, from straight ahead to the left [rad]."""
    pitch: float = 0.0
    """Direction of view below the horizontal [rad]."""
