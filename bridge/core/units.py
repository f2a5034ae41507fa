"""Conversion of angles between the robot's convention and people's, their wrapping, and the units of what a code names.

Inside, angles are REP-103 yaw [rad]: 0 east, anticlockwise. On the display they are headings [deg]: 0 north,
clockwise, in [0, 360).
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from bridge.core.codes import Code

__all__ = ["UNITS", "heading_from_yaw", "quantity_of", "wrap", "yaw_from_heading"]

UNITS: Mapping[str, str] = {
    "length": "m",
    "height": "m",
    "speed": "m/s",
    "turn": "rad/s",
    "angle": "rad",
    "duration": "s",
    "share": "1",
}
"""Each kind of quantity that a parameter can be, to the unit in which it travels; `share` is 0 to 1."""
_QUANTITIES: Mapping[str, str] = {
    "room": "length",
    "aside": "length",
    "height": "height",
    "reached": "height",
    "lowest": "height",
    "highest": "height",
    "speed": "speed",
    "seconds": "duration",
    "age": "duration",
    "dwell": "duration",
    "duration": "duration",
    "charge": "share",
}
"""Keys of parameters that mean the same in every code, to their kind."""
_OWN_QUANTITIES: Mapping[tuple[str, str], str] = {
    (Code.DWELL_INVALID, "max"): "duration",
    (Code.DURATION_INVALID, "max"): "duration",
    (Code.SPEED_INVALID, "max"): "speed",
    (Code.COMMAND_LATE, "allowed"): "duration",
    (Code.COMMAND_AHEAD, "allowed"): "duration",
    (Code.DRIVE_LATE, "allowed"): "duration",
    (Code.DRIVE_UNSTAMPED, "allowed"): "duration",
    (Code.ARM_LATE, "allowed"): "duration",
    (Code.BATTERY_TOO_LOW, "needed"): "share",
    (Code.CHECK_BATTERY_LOW, "needed"): "share",
    (Code.CHARGE_NEEDED, "needed"): "share",
    (Code.CHARGE_INVALID, "least"): "share",
    (Code.CHARGING, "until"): "share",
    (Code.TRUST_DURATION_INVALID, "duration"): "",
}
"""A code and a key that mean something particular in it, to the kind; empty for no quantity."""


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


def quantity_of(code: str, key: str, parameters: Mapping[str, str]) -> str:
    """What the parameter `key` of a `code` is, a key of `UNITS`; empty for a word, a name or a count.

    Where `parameters` has `quantity`, that says of which kind `asked` and `allowed` are.
    """
    if code == Code.DRIVE_EXCESSIVE and key in ("asked", "allowed"):
        named = parameters.get("quantity", "")
        return named if named in UNITS else ""
    return _OWN_QUANTITIES.get((code, key), _QUANTITIES.get(key, ""))
