"""The `/diagnostics` of one robot: position, battery and dropped drive commands."""

from __future__ import annotations

import math

from bridge.msgs.diagnostic_msgs import DiagnosticArray, DiagnosticStatus
from bridge.msgs.std_msgs import Header, Time
from robotside.autonomy.autonomy import Autonomy
from robotside.control.command_gate import CommandGate

__all__ = ["diagnostics"]


def diagnostics(autonomy: Autonomy, controls: CommandGate, now: float) -> DiagnosticArray:
    """How the robot is at `now` [s, robot clock]."""
    where, low = autonomy.pose_estimator, autonomy.low
    status = [
        DiagnosticStatus(0 if where.sure else 1, "position", _fit_sentence(where.fit)),
        DiagnosticStatus(1 if low else 0, "battery", "low" if low else "good"),
        DiagnosticStatus(0, "drive commands", f"{controls.dropped} dropped since the start"),
    ]
    return DiagnosticArray(Header(Time.at(now)), status)


def _fit_sentence(fit: float) -> str:
    return "not known yet" if math.isnan(fit) else f"{fit:.0%} of what the laser sees is on the map"
