"""The fence as a limit: what is left of a command near it, outside of it and where the place is unsure."""

from __future__ import annotations

import pytest

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.core.pose2 import Pose2
from robotside.kinds.registry import kind_of
from robotside.limits.fence import Fence
from robotside.limits.fence_limit import NOT_PLACED, UNSURE_SHARE, FenceLimit
from robotside.motion.measured import MeasuredState
from robotside.motion.stopping_path import PlanarVelocity

YARD = Fence([((-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0))])
AHEAD = Twist.planar(1.0, 0.0)


def limit(kind: str = "wheels", fence: Fence = YARD) -> FenceLimit:
    info = RobotInfo(name="Rover-1", kind=kind, radius=0.3, max_speed=2.0, max_yaw_rate=1.0)
    return FenceLimit(fence, info, kind_of(kind).handling, 2.0)


def at(x: float, **measured: object) -> MeasuredState:
    return MeasuredState(pose=Pose2(x, 0.0, 0.0), **measured)  # type: ignore[arg-type]


def test_far_from_the_fence_and_without_one_a_command_stays_what_it_is() -> None:
    assert limit().clamp(AHEAD, at(0.0)) == (AHEAD, "")
    assert limit(fence=Fence()).clamp(AHEAD, MeasuredState()) == (AHEAD, "")


def test_near_it_a_command_is_slowed_with_the_reason_and_one_away_from_it_is_not() -> None:
    slowed = limit().clamp(AHEAD, at(4.55))
    assert slowed.twist.linear.x < 0.5
    assert "The robot's fence is" in slowed.why
    away = Twist.planar(-1.0, 0.0)
    assert limit().clamp(away, at(4.55)) == (away, "")


def test_without_a_pose_it_stands_and_says_why() -> None:
    clamped = limit().clamp(AHEAD, MeasuredState())
    assert (clamped.twist.linear.x, clamped.why) == (0.0, NOT_PLACED)


def test_with_an_unsure_pose_it_goes_slowly() -> None:
    clamped = limit().clamp(AHEAD, at(0.0, sure=False))
    assert clamped.twist.linear.x == pytest.approx(UNSURE_SHARE * 2.0)
    assert "goes slowly" in clamped.why


def test_a_boat_that_is_carried_out_returns_and_says_so_once() -> None:
    boat, outside = limit("boat"), at(5.2, moving=PlanarVelocity(0.2, 0.0, 0.0))
    assert not boat.returning
    twist, _ = boat.clamp(Twist(), outside)
    assert boat.returning
    assert twist.linear.x < 0.0  # the inside is astern of it
    assert boat.adrift(outside, judged=True) == "Rover-1 drifts towards its fence; it goes back by itself."
    assert boat.adrift(outside, judged=True) == ""


def test_a_return_ends_inside() -> None:
    boat = limit("boat")
    boat.clamp(Twist(), at(5.2, moving=PlanarVelocity(0.2, 0.0, 0.0)))
    boat.clamp(Twist(), at(0.0))
    assert not boat.returning
