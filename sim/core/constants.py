"""Constants of the simulated world."""

from __future__ import annotations

__all__ = ["GRAVITY", "STEPS_PER_SECOND"]

STEPS_PER_SECOND = 240
"""Fixed physics steps in a second of simulated time."""
GRAVITY = 9.81
"""[m/s2]"""
