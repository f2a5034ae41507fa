"""Orders to move: the twist that a manoeuvre leads to, by which it is judged, and the order that is left where less is allowed.

Pure: what the robot measures is passed in.
"""

from __future__ import annotations

import math
from typing import TypeAlias

from msgspec.structs import replace

from bridge.core.units import wrap
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from robotside.kinds.registry import kind_of
from robotside.motion.measured import MeasuredState
from robotside.motion.speed_limit import slower, within
from robotside.motion.station_keeping import CREEP_SPEED

__all__ = [
    "VERTICAL_KINDS",
    "STREAMED_KINDS",
    "Order",
    "at_rest",
    "finite",
    "kept",
    "leads_to",
    "levelled",
    "paced",
    "settled",
]

Order: TypeAlias = Twist | Manoeuvre
"""The way to move until the next order."""

STREAMED_KINDS = ("twist", "steer", "tilt")
"""The kinds that a person gives as a stream."""
VERTICAL_KINDS = ("take_off", "land", "surface")
"""The kinds for which no twist stands: a robot knows them or cannot do it."""

GRAVITY = 9.81
LEAN_TIME = 0.3
"""A robot that leans goes on accelerating for so long until the next order takes effect [s]."""
COURSE_GAIN = 0.9
"""Turn rate for a heading that is off [1/s]."""
DEFAULT_HEIGHT = 1.0
"""Height above its place to which a robot takes off without a given height [m]."""
_TOLERANCE = 1e-9


def finite(order: Order) -> bool:
    """Everything in it that says something is a number."""
    if isinstance(order, Twist):
        return all(map(math.isfinite, _numbers(order)))
    needed = (*_numbers(order.twist), order.steering, order.roll, order.pitch)
    free = (order.speed, order.throttle, order.yaw, order.height)
    return all(map(math.isfinite, needed)) and not any(map(math.isinf, free))


def at_rest(order: Order) -> bool:
    """It is that of controls that were let go: nothing in it drives. A rudder that was left over does not by itself."""
    if isinstance(order, Twist):
        return not any(_numbers(order))
    drives = [value for value in (order.speed, order.throttle) if not math.isnan(value)]
    match order.kind:
        case "steer":
            return not any(drives)
        case "tilt":
            return not any((*drives, order.roll, order.pitch, *_numbers(order.twist)))
        case _:
            return not any(_numbers(order.twist))


def paced(order: Order, info: RobotInfo, share: float) -> Order:
    """`order` at no more than `share` of what the robot can do, 0 to 1: of its speeds, its throttle and how far it leans."""
    speed, turn = info.max_speed * share, info.max_yaw_rate * share
    if isinstance(order, Twist):
        return slower(order, speed, turn)
    tilt = (info.max_tilt or math.inf) * share
    lean = math.hypot(order.roll, order.pitch)
    part = tilt / lean if lean > tilt else 1.0
    return replace(
        order,
        twist=slower(order.twist, speed, turn),
        speed=_within(order.speed, speed),
        throttle=_within(order.throttle, share),
        steering=within(order.steering, info.max_steering or math.inf),
        roll=order.roll * part,
        pitch=order.pitch * part,
    )


def settled(order: Order, info: RobotInfo) -> Order:
    """The order that the robot gets for a person's `order`: one that flies and is to lean no more stays where it is.

    Level alone it would float on.
    """
    if isinstance(order, Manoeuvre) and order.kind == "twist":
        return order.twist
    if isinstance(order, Manoeuvre) and order.kind == "tilt" and _leans(info) and at_rest(order):
        return Manoeuvre(kind="hover")
    return order


def leads_to(order: Manoeuvre, info: RobotInfo, measured: MeasuredState) -> Twist:
    """The twist that comes of `order`, in `base_link`; `info` is of what the robot can do, not of its limits.

    Up and down it has only the order of a hand: a height is kept by `levelled`.
    """
    v, w = order.twist.linear, order.twist.angular
    match order.kind:
        case "twist":
            return order.twist
        case "steer":
            speed = _speed(order, info)
            turn = within(speed * _curvature(order.steering, info), info.max_yaw_rate)
            return Twist.planar(speed, turn)
        case "course":
            return Twist.planar(_speed(order, info), _turn(order.yaw, info, measured))
        case "hover":
            creeps = CREEP_SPEED if kind_of(info.kind).comes_about else 0.0
            return Twist.planar(creeps, _turn(order.yaw, info, measured))
        case "tilt" if _leans(info):
            x = measured.moving.x + LEAN_TIME * GRAVITY * math.tan(order.pitch)
            y = measured.moving.y - LEAN_TIME * GRAVITY * math.tan(order.roll)
            return Twist(Vector3(x, y, v.z), Vector3(0.0, 0.0, w.z))
        case "tilt":
            return Twist(Vector3(_speed(order, info), 0.0, v.z), Vector3(0.0, 0.0, w.z))
        case _:
            return Twist()


def kept(order: Manoeuvre, leads: Twist, may: Twist, info: RobotInfo) -> Order:
    """What is left of `order`, which `leads` to a twist of which no more than `may` is allowed.

    What is held back becomes a speed, which the robot keeps by braking too; less throttle or lean alone would let it float
    on.
    """
    if _same(leads, may):
        return order
    v, w = may.linear, may.angular
    climbing = Twist(Vector3(0.0, 0.0, v.z), Vector3(0.0, 0.0, w.z))
    match order.kind:
        case "twist":
            return may
        case "tilt" if _leans(info):
            moved = abs(v.x - leads.linear.x) > _TOLERANCE or abs(v.y - leads.linear.y) > _TOLERANCE
            return _leaning(may, order) if moved else replace(order, twist=climbing)
        case "tilt":
            held = replace(order, speed=v.x, throttle=math.nan, twist=climbing)
            # level, its fins carry it no farther than it may
            return replace(held, roll=0.0, pitch=0.0) if v.x == 0.0 != leads.linear.x else held
        case "steer":
            if at_rest(may):
                return may
            return replace(order, speed=v.x, throttle=math.nan, steering=_eased(order.steering, leads, may))
        case "course":
            return replace(order, speed=v.x, throttle=math.nan)
        case "hover" if v.x != leads.linear.x:
            return may
        case _:
            return order


def _leaning(may: Twist, order: Manoeuvre) -> Twist:
    """`may` without the way that it has where it does not lean to: ordered to keep that speed it would, and ever more of it."""
    v = may.linear
    return Twist(Vector3(v.x if order.pitch else 0.0, v.y if order.roll else 0.0, v.z), may.angular)


def levelled(order: Manoeuvre, lowest: float, highest: float, height: float) -> Manoeuvre:
    """`order` to no height above `highest` and below `lowest` [m]; `height` is the robot's now, NaN when not known."""
    if order.kind == "surface":
        return order if highest >= 0 else Manoeuvre(order.header, "hover", height=highest)
    wanted = order.height
    if order.kind == "take_off" and math.isnan(wanted) and highest < math.inf:
        wanted = height + DEFAULT_HEIGHT
    if order.kind not in ("course", "hover", "take_off") or math.isnan(wanted):
        return order
    allowed = max(min(wanted, highest), lowest)
    return order if allowed == order.height else replace(order, height=allowed)


def _leans(info: RobotInfo) -> bool:
    """It goes where it leans to."""
    return kind_of(info.kind).flies


def _speed(order: Manoeuvre, info: RobotInfo) -> float:
    """Ahead [m/s]."""
    if not math.isnan(order.speed):
        return order.speed
    return 0.0 if math.isnan(order.throttle) else within(order.throttle, 1.0) * info.max_speed


def _curvature(steering: float, info: RobotInfo) -> float:
    """Of the way that it drives, steered so [1/m]."""
    if not (info.max_steering and info.min_radius):
        return 0.0
    angle = within(steering, info.max_steering)
    return math.tan(angle) / math.tan(info.max_steering) / info.min_radius


def _eased(steering: float, leads: Twist, may: Twist) -> float:
    """The steering that turns as `may` does, for one that `leads` elsewhere [rad]."""
    if not (leads.linear.x and leads.angular.z and may.linear.x):
        return steering
    part = (may.angular.z / may.linear.x) / (leads.angular.z / leads.linear.x)
    return math.atan(math.tan(steering) * within(part, 1.0))


def _turn(yaw: float, info: RobotInfo, measured: MeasuredState) -> float:
    """Towards a heading [rad/s]; 0 for the present one, or while it is unknown."""
    if math.isnan(yaw) or measured.pose is None:
        return 0.0
    return within(COURSE_GAIN * wrap(yaw - measured.pose.yaw), info.max_yaw_rate)


def _within(value: float, most: float) -> float:
    return value if math.isnan(value) else within(value, most)


def _same(one: Twist, other: Twist) -> bool:
    return all(abs(a - b) <= _TOLERANCE for a, b in zip(_numbers(one), _numbers(other), strict=True))


def _numbers(twist: Twist) -> tuple[float, ...]:
    v, w = twist.linear, twist.angular
    return v.x, v.y, v.z, w.x, w.y, w.z
