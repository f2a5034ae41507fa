"""Consequences of STOP per kind: a drone hovers, a diver floats up, a boat drifts."""

from __future__ import annotations

from bridge.core.codes import Code
from robotside.core.notice import Notice, Problem
from robotside.kinds.registry import kind_of
from robotside.motion.measured import MeasuredState

__all__ = ["still_moves"]

MIN_DEPTH = 0.3
"""Deeper than this what swims has a way up [m]."""


def still_moves(name: str, kind: str, measured: MeasuredState) -> Problem:
    """What the robot called `name` goes on doing under STOP, and what to do then, in sentences; empty when it stays where it is."""
    is_a = kind_of(kind)
    if is_a.flies and not measured.landed:
        return _moves_on(name, "hovers, on its battery. Hold STOP to release it, then land.")
    if is_a.dives and measured.height < -MIN_DEPTH:
        return _moves_on(name, "floats up. Hold STOP to release it, then hold its depth.")
    if is_a.comes_about:
        return _moves_on(name, "drifts with wind and current. Hold STOP to release it, then hold its place.")
    return ""


def _moves_on(name: str, does: str) -> Notice:
    return Notice(Code.STOP_MOVES_ON, f"{name} {does}", robot=name)
