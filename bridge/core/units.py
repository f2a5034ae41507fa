"""Conversion of angles between the robot's convention and people's, and their wrapping.

Inside, angles are REP-103 yaw [rad]: 0 east, anticlockwise. On the display they are headings [deg]: 0 north,
clockwise, in [0, 360).
"""

from __future__ import annotations

import math

__all__ = ["heading_from_yaw", "wrap", "yaw_from_heading"]


def wrap(angle: float) -> float:
    """`angle` [rad] wrapped into [-pi, pi)."""
    return (angle + math.pi) % math.tau - math.pi


def heading_from_yaw(yaw: float) -> float:
    """Heading [deg] in [0, 360) of a `yaw` [rad]; NaN gives NaN."""
    heading = (90.0 - math.degrees(yaw)) % 360.0
    return 0.0 if heading == 360.0 else heading


def yaw_from_heading(heading: float) -> float:
    """Yaw [rad] in [-pi, pi) of a `heading` [deg]."""
    return wrap(math.radians(90.0 - heading))
