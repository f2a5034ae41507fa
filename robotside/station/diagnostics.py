"""The `/diagnostics` of one robot: position, battery, dropped drive commands and the timing of its loop."""

from __future__ import annotations

import math

from bridge.msgs.diagnostic_msgs import DiagnosticArray, DiagnosticStatus
from bridge.msgs.sensor_msgs import BatteryState
from bridge.msgs.std_msgs import Header, Time
from robotside.autonomy.autonomy import Autonomy
from robotside.control.command_gate import CommandGate
from robotside.station.loop_watch import LoopWatch

__all__ = ["diagnostics"]


def diagnostics(autonomy: Autonomy, controls: CommandGate, loop: LoopWatch, now: float) -> DiagnosticArray:
    """How the robot is at `now` [s, robot clock]."""
    where = autonomy.pose_estimator
    status = [
        DiagnosticStatus(0 if where.sure else 1, "position", _fit_sentence(where.fit)),
        _battery(autonomy),
        DiagnosticStatus(0, "drive commands", f"{controls.dropped} dropped since the start"),
        loop.status(),
    ]
    return DiagnosticArray(Header(Time.at(now)), status)


_POWER = {
    BatteryState.POWER_SUPPLY_STATUS_CHARGING: ", charging",
    BatteryState.POWER_SUPPLY_STATUS_FULL: ", full at the dock",
    BatteryState.POWER_SUPPLY_STATUS_NOT_CHARGING: ", at a dock that gives no charge",
}


def _battery(autonomy: Autonomy) -> DiagnosticStatus:
    """Low or good, and what a dock does about it."""
    power = autonomy.situation.power
    trouble = autonomy.low or power == BatteryState.POWER_SUPPLY_STATUS_NOT_CHARGING
    said = ("low" if autonomy.low else "good") + _POWER.get(power, "")
    return DiagnosticStatus(1 if trouble else 0, "battery", said)


def _fit_sentence(fit: float) -> str:
    return "not known yet" if math.isnan(fit) else f"{fit:.0%} of what the laser sees is on the map"
