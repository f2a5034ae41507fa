"""What may be asked of a robot: faulty orders are refused, excessive ones are cut and that is said."""

from __future__ import annotations

import math

import msgspec

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo

__all__ = ["check", "cut"]


def check(order: Manoeuvre) -> None:
    """Raise ValueError when a part of `order` that must be a number is none, or one that may be NaN is infinite."""
    linear, angular = order.twist.linear, order.twist.angular
    needed = {
        "twist": (linear.x, linear.y, linear.z, angular.x, angular.y, angular.z),
        "steering": (order.steering,),
        "roll": (order.roll,),
        "pitch": (order.pitch,),
    }
    free = {"speed": order.speed, "throttle": order.throttle, "yaw": order.yaw, "height": order.height}
    wrong = [name for name, values in needed.items() if not all(map(math.isfinite, values))]
    wrong += [name for name, value in free.items() if math.isinf(value)]
    if wrong:
        raise ValueError(f"The {wrong[0]} of an order must be a number; the robot goes on as before.")


def cut(order: Manoeuvre, info: RobotInfo) -> tuple[Manoeuvre, str]:
    """`order` within the greatest speed and turn rate of the robot, and one sentence where that makes a difference."""
    linear, angular = order.twist.linear, order.twist.angular
    asked = math.sqrt(linear.x**2 + linear.y**2 + linear.z**2)
    speed = max(asked, 0.0 if math.isnan(order.speed) else abs(order.speed))
    if speed <= info.max_speed * _EXACT and abs(angular.z) <= info.max_yaw_rate * _EXACT:
        return order, ""
    share = min(1.0, info.max_speed / asked) if asked else 1.0
    turn = max(-info.max_yaw_rate, min(info.max_yaw_rate, angular.z))
    twist = Twist(
        Vector3(linear.x * share, linear.y * share, linear.z * share), Vector3(angular.x, angular.y, turn)
    )
    held = max(-info.max_speed, min(info.max_speed, order.speed))
    if speed > info.max_speed * _EXACT:
        said = f"{info.name} goes at most {info.max_speed:.1f} m/s; {speed:.1f} m/s was asked for."
    else:
        said = f"{info.name} turns at most {info.max_yaw_rate:.1f} rad/s; {abs(angular.z):.1f} rad/s was asked for."
    held = order.speed if math.isnan(order.speed) else held
    return msgspec.structs.replace(order, twist=twist, speed=held), said


_EXACT = 1 + 1e-9
"""What is above a limit by rounding is not."""
