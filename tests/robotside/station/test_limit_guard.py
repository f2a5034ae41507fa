"""What is left of an order at the robot's port while the robot's own loop lags."""

from __future__ import annotations

import pytest

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from robotside.core.config import LimitSettings
from robotside.core.pose2 import Pose2
from robotside.limits.limits import LimitKeeper
from robotside.motion.manoeuvres import VERTICAL_KINDS
from robotside.motion.measured import MeasuredState
from robotside.station.limit_guard import LimitGuard
from robotside.station.remarks import Remarks

DRONE = RobotInfo(
    "D",
    "quadrotor",
    max_speed=2.0,
    max_yaw_rate=2.0,
    max_tilt=0.3,
    radius=0.3,
    manoeuvres=["twist", "course", "hover", "take_off", "land"],
)
SWIMMER = RobotInfo("A", "hexapod", max_speed=0.8, max_yaw_rate=1.0, manoeuvres=["hover", "surface"])


def guard(info: RobotInfo, pace: float) -> LimitGuard:
    measured = MeasuredState(Pose2(0.0, 0.0, 0.0), height=3.0)
    remarks = Remarks(lambda *_: None, lambda: 0.0)
    made = LimitGuard(LimitKeeper(LimitSettings(), info), lambda: measured, remarks, lambda *_: None)
    made.pace = pace
    return made


@pytest.mark.parametrize("pace", [0.0, 0.3])
@pytest.mark.parametrize("kind", VERTICAL_KINDS)
def test_a_loop_that_lags_does_not_keep_a_robot_in_the_air_or_under_water(kind: str, pace: float) -> None:
    order = Manoeuvre(kind=kind, speed=0.5, twist=Twist(Vector3(0.0, 0.0, -0.5)))
    assert guard(SWIMMER if kind == "surface" else DRONE, pace).clamp(order) == order


def test_all_else_is_as_slow_as_the_loop_allows() -> None:
    slow = guard(DRONE, 0.25)
    done = slow.clamp(Manoeuvre(kind="course", speed=2.0))
    assert isinstance(done, Manoeuvre)
    assert done.speed == pytest.approx(0.5)
    assert slow.clamp(Twist.planar(2.0, 2.0)) == Twist.planar(0.5, 0.5)
    assert guard(DRONE, 1.0).clamp(Twist.planar(2.0, 2.0)) == Twist.planar(2.0, 2.0)
