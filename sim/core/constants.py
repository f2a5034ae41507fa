"""Constants of the simulated world."""

from __future__ import annotations

__all__ = ["GRAVITY", "MAX_STEP_HEIGHT", "ROBOT_HEIGHT", "STEPS_PER_SECOND"]

STEPS_PER_SECOND = 240
"""Fixed physics steps in a second of simulated time."""
GRAVITY = 9.81
"""[m/s2]"""
ROBOT_HEIGHT = 0.3
"""Height of the lowest robots: things that hang higher are in no robot's way [m]."""
MAX_STEP_HEIGHT = 0.02
"""Things that are lower can be driven over [m]."""
