"""The checklist before the first motion: each line is good, bad with the reason, or not known."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from bridge.msgs.pilothouse_msgs import Check
from robotside.core.text import number

__all__ = ["MAX_OFFSET", "CheckInputs", "checks"]

MAX_OFFSET = 1.0
"""As far a handheld's clock may be from the robot's, the way included [s]."""


@dataclass(frozen=True, slots=True)
class CheckInputs:
    """The inputs of the checks."""

    battery: float
    """0 empty to 1 full; NaN while not known."""
    low_below: float
    """A battery with less is low, 0 to 1."""
    silent: Sequence[str]
    """Names of the sensors that are not alive."""
    placed: bool
    """It has a pose in `map`."""
    sure: bool
    """The laser agrees with the map."""
    stop_tested: bool
    """STOP was pressed since the start, and brought the robot to rest."""
    offset: float
    """Lead of the last handheld's clock over the robot's [s]; NaN while not known."""
    trouble: str = ""
    """Why the robot cannot be reached, as one sentence; empty when it can."""


def checks(looked: CheckInputs) -> list[Check]:
    """The list, always the same lines in the same order."""
    return [_battery(looked), _sensors(looked), _position(looked), _stop(looked), _clock(looked)]


def _battery(looked: CheckInputs) -> Check:
    if math.isnan(looked.battery):
        return Check("battery", "unknown", "The battery has not reported its charge yet.")
    if looked.battery < looked.low_below:
        said = f"The battery is below {looked.low_below:.0%}; charge it first."
        return Check("battery", "bad", said)
    return Check("battery", "ok", "The battery is charged.")


def _sensors(looked: CheckInputs) -> Check:
    if looked.trouble:
        return Check("sensors", "bad", looked.trouble)
    if looked.silent:
        return Check("sensors", "bad", f"No data from: {', '.join(looked.silent)}.")
    return Check("sensors", "ok", "All sensors are alive.")


def _position(looked: CheckInputs) -> Check:
    if not looked.placed:
        return Check("position", "unknown", "The robot's position is unknown; place the robot on the map.")
    if not looked.sure:
        said = "The laser does not match the map; place the robot on the map."
        return Check("position", "bad", said)
    return Check("position", "ok", "The robot knows where it is.")


def _stop(looked: CheckInputs) -> Check:
    if looked.stop_tested:
        return Check("stop", "ok", "STOP was tested.")
    return Check("stop", "unknown", "STOP was not tested since the start; press it once.")


def _clock(looked: CheckInputs) -> Check:
    if math.isnan(looked.offset):
        return Check("clock", "unknown", "No handheld has sent its clock yet.")
    if abs(looked.offset) > MAX_OFFSET:
        side = "ahead of" if looked.offset > 0 else "behind"
        said = f"The handheld's clock is {number(abs(looked.offset))} s {side} the robot's"
        return Check("clock", "bad", f"{said}; connect it anew, or check the link.")
    return Check("clock", "ok", "The clocks agree.")
