"""Which way a tag is turned that is seen from afar: its picture tells how far it is turned off the line of sight, hardly to which side.

Pure. In simulated pictures of 640 x 480 that amount errs by 0.08 rad at 5 m as at 2 m; the side is wrong in 2 of 5 at 5 m, in 1 of 10 at 2 m, and never within 1.5 m.
"""

from __future__ import annotations

import math
from dataclasses import replace

from bridge.core.units import wrap
from robotside.perception.cage_finder import CageSighting

__all__ = ["NEAR_TURN", "TURN", "unmirrored"]

MIRRORED_FROM = 1.5
"""From so far away the side may be the wrong one [m]."""

TURN, NEAR_TURN = 0.12, 0.04
"""Standard deviation of the direction, from afar and from nearer than that [rad]."""


def unmirrored(seen: CageSighting, ahead: float, expected: float) -> CageSighting:
    """The sighting with its direction on the side of the line of sight that fits better to what is `expected` [rad].

    The camera is `ahead` of `base_link` [m].
    """
    away, sight = math.hypot(seen.pose.x - ahead, seen.pose.y), math.atan2(seen.pose.y, seen.pose.x - ahead)
    yaw = seen.pose.yaw
    if away > MIRRORED_FROM:
        yaw = min((yaw, wrap(2 * sight - yaw)), key=lambda side: abs(wrap(side - expected)))
    turn = TURN if away > MIRRORED_FROM else NEAR_TURN
    return replace(seen, pose=seen.pose._replace(yaw=yaw), turn=min(seen.turn, turn))
