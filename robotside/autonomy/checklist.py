"""The checklist before the first motion: each line is good, bad with the reason, or not known."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Check
from robotside.core.notice import Notice, coded
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
        said = "The battery has not reported its charge yet."
        return _check("battery", "unknown", Notice(Code.CHECK_BATTERY_UNKNOWN, said))
    if looked.battery < looked.low_below:
        said = f"The battery is below {looked.low_below:.0%}; charge it first."
        return _check("battery", "bad", Notice(Code.CHECK_BATTERY_LOW, said, needed=looked.low_below))
    return _check("battery", "ok", Notice(Code.CHECK_BATTERY_GOOD, "The battery is charged."))


def _sensors(looked: CheckInputs) -> Check:
    if looked.trouble:
        return _check("sensors", "bad", looked.trouble)
    if looked.silent:
        names = ", ".join(looked.silent)
        silent = Notice(Code.CHECK_SENSORS_SILENT, f"No data from: {names}.", sensors=names)
        return _check("sensors", "bad", silent)
    return _check("sensors", "ok", Notice(Code.CHECK_SENSORS_GOOD, "All sensors are alive."))


def _position(looked: CheckInputs) -> Check:
    if not looked.placed:
        said = "The robot's position is unknown; place the robot on the map."
        return _check("position", "unknown", Notice(Code.CHECK_POSITION_UNKNOWN, said))
    if not looked.sure:
        said = "The robot is not sure of its place: choose where it is, or place it on the map."
        return _check("position", "bad", Notice(Code.CHECK_POSITION_UNSURE, said))
    return _check("position", "ok", Notice(Code.CHECK_POSITION_GOOD, "The robot knows where it is."))


def _stop(looked: CheckInputs) -> Check:
    if looked.stop_tested:
        return _check("stop", "ok", Notice(Code.CHECK_STOP_GOOD, "STOP was tested."))
    said = "STOP was not tested since the start; press it once."
    return _check("stop", "unknown", Notice(Code.CHECK_STOP_UNTESTED, said))


def _clock(looked: CheckInputs) -> Check:
    if math.isnan(looked.offset):
        said = "No handheld has sent its clock yet."
        return _check("clock", "unknown", Notice(Code.CHECK_CLOCK_UNKNOWN, said))
    off = abs(looked.offset)
    if off > MAX_OFFSET:
        ahead = looked.offset > 0
        code = Code.CHECK_CLOCK_AHEAD if ahead else Code.CHECK_CLOCK_BEHIND
        said = f"The handheld's clock is {number(off)} s {'ahead of' if ahead else 'behind'} the robot's"
        return _check(
            "clock", "bad", Notice(code, f"{said}; connect it anew, or check the link.", seconds=off)
        )
    return _check("clock", "ok", Notice(Code.CHECK_CLOCK_GOOD, "The clocks agree."))


def _check(name: str, state: str, said: str) -> Check:
    """A line with the code of its sentence, where that has one."""
    known = coded(said)
    return Check(name, state, str(said), known["code"], known["parameters"])
