"""Numbers for sample plots: two lines with a hole and a spike, eight waves, and what is told seldom. No Kivy."""

from __future__ import annotations

import numpy as np

from widgets.plots.history import Floats

__all__ = ["SELDOM", "TIMES", "motion", "voltage", "wave"]

TIMES: Floats = np.arange(0.0, 40.0, 0.05)
"""[s]"""
SELDOM = np.array([2.0, 5.0, 9.0, 26.0, 30.0]), np.array([1.0, 3.0, 2.0, 4.0, 3.5])
"""Times [s] and values of what is told seldom."""


def motion() -> tuple[tuple[str, str, Floats], ...]:
    """Name, unit and values of two lines: the first has a hole and a spike of one sample, the second edges."""
    speed = 0.62 + 0.2 * np.sin(TIMES / 3) + 0.03 * np.sin(TIMES * 9)
    speed[(TIMES > 17) & (TIMES < 20)] = np.nan
    speed[700] = 1.4
    turn = 0.3 * np.cos(TIMES / 2.1) * (np.abs(TIMES - 25) > 1.2)
    return ("linear.x", "m/s", speed), ("angular.z", "rad/s", turn)


def voltage() -> Floats:
    """Of a battery under a load [V]."""
    return 24.6 - TIMES / 40 - 1.5 * ((TIMES > 22) & (TIMES < 23))


def wave(number: int) -> Floats:
    """One of several waves that cross."""
    return np.asarray(np.sin(TIMES / (2 + number / 3)) + number / 4)
