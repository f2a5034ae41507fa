"""The measured state of a robot: pose, speed, attitude, height, contact."""

from __future__ import annotations

import math

import msgspec

from robotside.core.pose2 import Pose2
from robotside.motion.stopping_path import REST, PlanarVelocity

__all__ = ["MeasuredState"]


class MeasuredState(msgspec.Struct, frozen=True):
    """The newest measurements; NaN and None for what the robot does not measure."""

    pose: Pose2 | None = None
    """In `map`."""
    moving: PlanarVelocity = REST
    """By its odometry."""
    height: float = math.nan
    """Above the map's origin, which for boats is the water [m]."""
    roll: float = 0.0
    """[rad]"""
    pitch: float = 0.0
    """[rad], positive is nose down."""
    spread: float = 0.0
    """The uncertainty of the pose in the worst direction, one standard deviation [m]; NaN without a pose."""
    sure: bool = True
    """The robot holds the pose for right."""
    landed: bool = False
    """It says itself that it is on the ground, rotors off; False for one that does not fly."""
    charging: bool = False
    """It takes charge in a dock, or is full there."""
    overturned: bool = False
    """It says itself that it lies there on its back."""
    touched: float | None = None
    """Bearing in `base_link` of what its bumper touches [rad]; None for nothing, and where it is unknown."""
    height_spread: float = 0.0
    """The uncertainty of the height, one standard deviation [m]."""
