"""A twist clamped to a limit, with the reason for the operator."""

from __future__ import annotations

from typing import NamedTuple

from bridge.msgs.geometry_msgs import Twist, Vector3
from robotside.core.notice import Problem
from robotside.kinds.vehicle_kind import Handling

__all__ = ["ClampedTwist", "scaled"]


class ClampedTwist(NamedTuple):
    """A drive command as it may be done."""

    twist: Twist
    why: Problem = ""
    """The reason, as one sentence, when it is held back by more than half; empty otherwise."""


def scaled(twist: Twist, part: float, handling: Handling) -> Twist:
    """`part` of the speed; one that steers stays on its arc."""
    v, w = twist.linear, twist.angular
    turn = part if handling.steers else 1.0
    return Twist(Vector3(part * v.x, part * v.y, v.z), Vector3(w.x, w.y, turn * w.z))
