"""The motion of a hand out of an accelerometer: gravity taken off, turned so that up is up however the phone is held."""

from __future__ import annotations

import math

__all__ = ["GRAVITY", "GravityFilter", "Motion"]

GRAVITY = 9.80665
"""[m/s²]"""
Motion = tuple[float, float, float]
"""To the right, up, and forward: a quarter turn from both. All three change sign together on phones that measure gravity downward,
which nothing here minds. [m/s²]"""
SETTLING_TIME = 1.0
"""For so long gravity is the mean of what came [s]."""
SMOOTHING_TIME = 0.02
"""Time constant that takes the edge off a knock [s]."""
SIDEWAYS, UPRIGHT = (0.6, 1.7), (0.45, 1.2)
"""Held sideways, with a screen that does not turn along, is what has its x up by so much, and so many times its y; it is upright again
below the second."""


class GravityFilter:
    """Follows gravity with a low-pass that hesitates while the hand moves."""

    def __init__(self, settling: float) -> None:
        """`settling` is its time constant at rest [s]."""
        self._tau = settling
        self._age = 0.0
        self._gravity: list[float] | None = None
        self._smooth = [0.0, 0.0, 0.0]
        self._sideways = False
        self.upward: Motion = (0.0, 0.0, 0.0)
        """Gravity as it is followed, axes of the device, of length 1; zeros before the first sample."""

    def motion(self, dt: float, x: float, y: float, z: float) -> Motion:
        """What is left of a sample [m/s², axes of the device] that came `dt` after the one before [s, above 0]."""
        gravity = self._gravity
        if gravity is None:
            gravity = self._gravity = [x, y, z]
        self._age += dt
        beyond = (math.sqrt(x * x + y * y + z * z) - GRAVITY) / 2.0
        tau = self._tau * (1.0 + beyond * beyond)
        if self._age < SETTLING_TIME:
            tau = min(tau, self._age)
        share = dt / (tau + dt)
        gx = gravity[0] = gravity[0] + share * (x - gravity[0])
        gy = gravity[1] = gravity[1] + share * (y - gravity[1])
        gz = gravity[2] = gravity[2] + share * (z - gravity[2])
        share = dt / (SMOOTHING_TIME + dt)
        smooth = self._smooth
        ux = smooth[0] = smooth[0] + share * (x - gx - smooth[0])
        uy = smooth[1] = smooth[1] + share * (y - gy - smooth[1])
        uz = smooth[2] = smooth[2] + share * (z - gz - smooth[2])
        length = math.sqrt(gx * gx + gy * gy + gz * gz) or 1.0
        a, b, c = self.upward = (gx / length, gy / length, gz / length)
        least, times = UPRIGHT if self._sideways else SIDEWAYS
        self._sideways = abs(a) > max(least, times * abs(b))
        return turned(a, b, c, ux, uy, uz, self._sideways)


def turned(a: float, b: float, c: float, x: float, y: float, z: float, sideways: bool = False) -> Motion:
    """x, y, z of the device seen from where (a, b, c), of length 1, is up; its y is to the right where it is held sideways."""
    if not sideways:
        level = math.sqrt(b * b + c * c) or 1.0
        rx, ry, rz = level, -a * b / level, -a * c / level
    else:
        level = math.sqrt(a * a + c * c) or 1.0
        rx, ry, rz = -a * b / level, level, -b * c / level
    fx, fy, fz = b * rz - c * ry, c * rx - a * rz, a * ry - b * rx
    return rx * x + ry * y + rz * z, a * x + b * y + c * z, fx * x + fy * y + fz * z
