"""The view of a camera: the matrices between the world and its picture."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim.core.shapes import Quat, Vec3, rotate

__all__ = ["View"]

NEAR, FAR = 0.05, 400.0
"""Nearest and farthest that is drawn [m]."""

Matrix = NDArray[np.floating[Any]]


@dataclass(frozen=True, slots=True)
class View:
    """A camera's frame has x ahead, y left and z up, as a body's."""

    eye: Vec3
    """[m] in the world."""
    rotation: Quat
    size: tuple[int, int]
    """Width and height of the picture [px]."""
    field_of_view: float
    """Horizontal [rad]; of a map, the breadth of the view [m]."""
    flat: bool = False
    """Draw a map, by parallel rays, instead of a perspective."""
    time: float = 0.0
    """Moment of what moves by itself, the light under water [s]."""

    @classmethod
    def from_above(cls, length: float, width: float, pixels: int) -> View:
        """A map of the ground, north up, `length` by `width` [m] round the origin, `pixels` broad."""
        down = (-0.5, 0.5, 0.5, 0.5)
        return cls((0.0, 0.0, 60.0), down, (pixels, round(pixels * width / length)), length, flat=True)

    @property
    def half_extent(self) -> tuple[float, float]:
        """Half of the view, along x and y: tangents, or [m] on a map."""
        width, height = self.size
        half = self.field_of_view / 2 if self.flat else math.tan(self.field_of_view / 2)
        return half, half * height / width

    @property
    def axes(self) -> Matrix:
        """Columns: the picture's right, up and the way back, in the world."""
        right = rotate(self.rotation, (0.0, -1.0, 0.0))
        up = rotate(self.rotation, (0.0, 0.0, 1.0))
        back = rotate(self.rotation, (-1.0, 0.0, 0.0))
        return np.array([right, up, back]).T

    @property
    def round(self) -> tuple[float, float]:
        """The yaw that it looks towards, and how far to each side it sees at most [rad]."""
        half_x, half_y = self.half_extent
        axes = self.axes
        ahead = -axes[:, 2]
        corner = math.hypot(half_x, half_y)
        if math.hypot(ahead[0], ahead[1]) <= corner / math.hypot(1.0, corner):
            return 0.0, math.pi  # things right above or below it may be in the picture
        yaw = math.atan2(ahead[1], ahead[0])
        rays = [axes @ (x, y, -1.0) for x in (-half_x, half_x) for y in (-half_y, half_y)]
        return yaw, max(abs(math.remainder(math.atan2(y, x) - yaw, math.tau)) for x, y, _ in rays)

    def matrix(self) -> Matrix:
        """From the world to OpenGL's clip space, upside down: row 0 of the drawing is the picture's top."""
        view = np.eye(4)
        view[:3, :3] = self.axes.T
        view[:3, 3] = -self.axes.T @ np.array(self.eye)
        half_x, half_y = self.half_extent
        projection = np.zeros((4, 4))
        projection[0, 0], projection[1, 1] = 1 / half_x, -1 / half_y
        if self.flat:
            projection[2, 2], projection[2, 3], projection[3, 3] = -2 / FAR, -1.0, 1.0
        else:
            projection[2, 2] = -(FAR + NEAR) / (FAR - NEAR)
            projection[2, 3] = -2 * FAR * NEAR / (FAR - NEAR)
            projection[3, 2] = -1.0
        return projection @ view
