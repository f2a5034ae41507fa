"""The bumper guard: while the bumper is pressed, a person's order does not push into the obstacle.

Pure: what the robot measures is passed in.
"""

from __future__ import annotations

import math

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.kinds.registry import kind_of
from robotside.motion.manoeuvres import Order, kept, leads_to
from robotside.motion.measured import MeasuredState

__all__ = ["CONTACT_TIME", "kept_off"]

CONTACT_TIME = 1.0
"""A touch within so long of the last one is the same contact, and not reported again [s]."""
MIN_COSINE = 0.25
"""An obstacle with less than this cosine of its bearing is beside a robot that goes ahead and astern only."""


def kept_off(order: Order, info: RobotInfo, measured: MeasuredState) -> Order:
    """`order` without the way into what is in touch; turning, going away and up and down stay as they are."""
    bearing = measured.touched
    if bearing is None:
        return order
    leads = order if isinstance(order, Twist) else leads_to(order, info, measured)
    v, (ahead, aside) = leads.linear, (math.cos(bearing), math.sin(bearing))
    flies = kind_of(info.kind).flies
    into = v.x * ahead + v.y * aside if flies else v.x * ahead
    if into <= 0 or not (flies or abs(ahead) > MIN_COSINE):
        return order
    left = Vector3(v.x - into * ahead, v.y - into * aside, v.z) if flies else Vector3(0.0, v.y, v.z)
    may = Twist(left, leads.angular)
    return may if isinstance(order, Twist) else kept(order, leads, may, info)
