"""A drive command is clamped to the robot's own limits, and a goal outside of them is refused with the reason."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from msgspec import structs

from bridge.codec import from_json, to_json
from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Point32, Twist, Vector3
from bridge.msgs.pilothouse_msgs import Limits, Manoeuvre, RobotInfo
from robotside.core.config import LimitSettings
from robotside.core.pose2 import Pose2
from robotside.limits.limits import NOT_PLACED, LimitKeeper
from robotside.mapping.occupancy_grid import Grid
from robotside.motion.measured import MeasuredState
from robotside.motion.stopping_path import PlanarVelocity
from robotside.navigation.planner import Planner

WHEELS = RobotInfo("P", "wheels", max_speed=0.7, max_yaw_rate=1.9, radius=0.2)
DRONE = RobotInfo("D", "quadrotor", max_speed=2.0, max_yaw_rate=2.0, radius=0.3)
AQUA = RobotInfo("A", "hexapod", max_speed=0.8, max_yaw_rate=1.0, radius=0.3)
SQUARE = ((-4.0, -4.0), (4.0, -4.0), (4.0, 4.0), (-4.0, 4.0))
POST = ((1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0))
FENCED = LimitSettings(keep_in=(SQUARE,), keep_out=(POST,))
HOME = MeasuredState(Pose2(0.0, 0.0, 0.0))
AHEAD = Twist.planar(0.6, 0.2)


def twist(x: float = 0.0, y: float = 0.0, z: float = 0.0, turn: float = 0.0) -> Twist:
    return Twist(Vector3(x, y, z), Vector3(0.0, 0.0, turn))


# speeds


def test_without_limits_a_command_within_the_robots_own_is_left_as_it_is() -> None:
    keeper = LimitKeeper(LimitSettings(), WHEELS)
    assert keeper.clamp(AHEAD, MeasuredState()) == (AHEAD, "")
    assert keeper.info == WHEELS


def test_speed_and_turn_are_limited_and_the_robot_says_so_of_itself() -> None:
    keeper = LimitKeeper(LimitSettings(max_speed=0.3, max_yaw_rate=0.5), DRONE)
    done = keeper.clamp(twist(3.0, 4.0, 0.0, -1.0), HOME).twist
    assert (done.linear.x, done.linear.y) == pytest.approx((0.18, 0.24))
    assert done.angular.z == -0.5
    assert (keeper.info.max_speed, keeper.info.max_yaw_rate) == (0.3, 0.5)


def test_a_limit_above_what_the_robot_can_do_changes_nothing() -> None:
    assert LimitKeeper(LimitSettings(max_speed=9.0), WHEELS).info.max_speed == 0.7


# the fence


def test_towards_the_fence_a_command_is_slowed_and_said() -> None:
    keeper = LimitKeeper(FENCED, WHEELS)
    done, why = keeper.clamp(Twist.planar(0.7, 0.3), MeasuredState(Pose2(3.6, 0.0, 0.0)))
    assert 0.0 < done.linear.x < 0.35
    assert done.angular.z == 0.3
    assert why == "The robot's fence is 0.2 m away: it goes no nearer."


def test_along_the_fence_a_command_is_left_alone() -> None:
    keeper = LimitKeeper(FENCED, WHEELS)
    assert keeper.clamp(Twist.planar(0.7, 0.0), MeasuredState(Pose2(3.6, 0.0, math.pi / 2))).why == ""


def test_more_braking_lets_it_go_nearer_at_speed() -> None:
    near = MeasuredState(Pose2(3.4, 0.0, 0.0))
    usual = LimitKeeper(FENCED, WHEELS).clamp(Twist.planar(0.7, 0.0), near).twist
    better = (
        LimitKeeper(LimitSettings(keep_in=(SQUARE,), braking=4.0), WHEELS)
        .clamp(Twist.planar(0.7, 0.0), near)
        .twist
    )
    assert usual.linear.x < better.linear.x


def test_a_robot_that_does_not_know_where_it_is_keeps_to_its_fence_by_standing() -> None:
    done, why = LimitKeeper(FENCED, WHEELS).clamp(AHEAD, MeasuredState())
    assert (done.linear.x, done.angular.z) == (0.0, 0.2)
    assert why == NOT_PLACED
    assert LimitKeeper(LimitSettings(max_speed=0.3), WHEELS).clamp(AHEAD, MeasuredState()).why == ""


def test_rising_is_free_at_the_fence() -> None:
    done = LimitKeeper(FENCED, DRONE).clamp(twist(1.0, 0.0, 1.0), MeasuredState(Pose2(3.6, 0.0, 0.0))).twist
    assert done.linear.x < 0.3
    assert done.linear.z == 1.0


@pytest.mark.parametrize(
    ("place", "said"),
    [
        ((0.0, 0.0), ""),
        ((5.0, 0.0), "Point 3 at (5.0, 0.0) is outside the robot's fence."),
        ((1.5, 1.5), "Point 3 at (1.5, 1.5) is outside the robot's fence."),
        ((math.nan, 0.0), "Point 3 at (nan, 0.0) is outside the robot's fence."),
        ((3.8, 0.0), "Point 3 at (3.8, 0.0) is 0.20 m from the robot's fence; the robot needs 0.60 m."),
    ],
)
def test_a_goal_outside_or_too_near_is_refused_with_the_reason(place: tuple[float, float], said: str) -> None:
    assert LimitKeeper(FENCED, WHEELS).fault("Point 3", *place) == said


def test_without_a_fence_every_goal_will_do() -> None:
    assert LimitKeeper(LimitSettings(), WHEELS).fault("The goal", 1e6, 0.0) == ""


def test_a_robot_outside_its_fence_cannot_start_by_itself() -> None:
    keeper = LimitKeeper(FENCED, WHEELS)
    said = "The robot at (6.0, 0.0) is outside its fence; drive it back by hand first."
    assert keeper.outside(Pose2(6.0, 0.0, 0.0)) == said
    assert keeper.outside(Pose2(0.0, 0.0, 0.0)) == keeper.outside(None) == ""


def test_plans_are_made_within_the_fence() -> None:
    marked = LimitKeeper(FENCED, WHEELS).marked(Grid(np.zeros((100, 100), dtype=np.bool_), 0.1, -5.0, -5.0))
    assert marked.occupied[marked.cell(4.5, 0.0)]
    assert marked.occupied[marked.cell(3.9, 0.0)]
    assert not marked.occupied[marked.cell(3.7, 0.0)]


ROOMY = Planner(
    LimitKeeper(FENCED, WHEELS).marked(Grid(np.zeros((120, 120), dtype=np.bool_), 0.1, -6.0, -6.0)),
    WHEELS.radius,
)


@example(2.390625, 2.390625)
@given(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0))
def test_a_goal_that_is_allowed_is_one_that_can_be_planned_to(x: float, y: float) -> None:
    if not LimitKeeper(FENCED, WHEELS).fault("The goal", x, y):
        assert ROOMY.fault("The goal", x, y) == ""


# height and depth


def at(height: float, pitch: float = 0.0) -> MeasuredState:
    return MeasuredState(Pose2(0.0, 0.0, 0.0), height=height, pitch=pitch)


def test_up_to_the_greatest_height_it_gets_slower_and_down_is_free() -> None:
    keeper = LimitKeeper(LimitSettings(max_height=10.0), DRONE)
    assert keeper.clamp(twist(z=1.0), at(2.0)).twist.linear.z == 1.0
    assert 0.0 < keeper.clamp(twist(z=1.0), at(9.8)).twist.linear.z < 0.6
    assert keeper.clamp(twist(z=1.0), at(10.0)) == (twist(), "The robot goes no higher than 10 m.")
    assert keeper.clamp(twist(z=-1.0), at(11.0)).twist.linear.z == -1.0


def test_depth_has_two_ends() -> None:
    keeper = LimitKeeper(LimitSettings(min_depth=1.0, max_depth=20.0), AQUA)
    assert keeper.clamp(twist(z=-0.5), at(-20.0)).why == "The robot goes no deeper than 20 m of depth."
    assert keeper.clamp(twist(z=0.5), at(-1.0)).why == "The robot goes no higher than 1 m of depth."
    assert keeper.clamp(twist(z=0.5), at(-20.0)).why == ""


def test_a_bow_that_points_down_counts_as_going_down() -> None:
    keeper = LimitKeeper(LimitSettings(max_depth=20.0), AQUA)
    done, why = keeper.clamp(twist(x=0.5), at(-20.0, pitch=0.5))
    assert done.linear.z * math.cos(0.5) - done.linear.x * math.sin(0.5) == pytest.approx(0.0)
    assert why


def test_far_from_both_ends_a_command_is_left_as_it_is() -> None:
    keeper = LimitKeeper(LimitSettings(max_depth=20.0), AQUA)
    wanted = twist(x=0.37, z=0.11)
    assert keeper.clamp(wanted, at(-10.0, pitch=0.3)).twist == wanted


@given(st.floats(0.0, 10.0), st.lists(st.floats(-2.0, 2.0), min_size=1, max_size=60))
def test_whatever_is_commanded_the_height_is_kept(start: float, rates: list[float]) -> None:
    keeper, z, speed = LimitKeeper(LimitSettings(max_height=10.0), DRONE), start, 0.0
    for rate in [*rates, *[0.0] * 60]:
        wanted = keeper.clamp(twist(z=rate), at(z)).twist.linear.z
        speed += max(-0.05, min(0.05, wanted - speed))
        z += speed * 0.05
        assert z <= 10.1


def test_an_order_to_a_height_beyond_the_limits_is_one_to_the_limit() -> None:
    flier = structs.replace(DRONE, manoeuvres=["hover", "take_off"])
    keeper = LimitKeeper(LimitSettings(max_height=10.0), flier)
    kept = keeper.keep(Manoeuvre(kind="hover", height=12.0), at(2.0))
    assert isinstance(kept.order, Manoeuvre)
    assert (kept.order.height, kept.why) == (10.0, "The robot goes no higher than 10 m.")
    assert keeper.keep(Manoeuvre(kind="hover", height=8.0), at(2.0)) == (
        Manoeuvre(kind="hover", height=8.0),
        "",
    )


@pytest.mark.parametrize(("info", "drives"), [(WHEELS, False), (DRONE, False), (AQUA, True)])
def test_a_robot_that_lies_on_its_back_drives_only_if_it_swims(info: RobotInfo, drives: bool) -> None:
    done, why = LimitKeeper(LimitSettings(), info).clamp(AHEAD, MeasuredState(roll=math.pi))
    assert (done == AHEAD, why == "") == (drives, drives)
    assert drives or (done, why.code) == (Twist(), Code.ROBOT_OVERTURNED)


# slope


def tilted(degrees: float, forward: float = 0.3) -> MeasuredState:
    return MeasuredState(
        Pose2(0.0, 0.0, 0.0), PlanarVelocity(forward, 0.0, 0.0), pitch=-math.radians(degrees)
    )


def test_where_it_gets_steep_it_goes_slower_and_beyond_the_limit_only_back() -> None:
    keeper = LimitKeeper(LimitSettings(max_slope_degrees=10.0), WHEELS)
    assert keeper.clamp(AHEAD, tilted(5.0)).twist == AHEAD
    assert 0.2 < keeper.clamp(AHEAD, tilted(9.0)).twist.linear.x < 0.4
    done, why = keeper.clamp(AHEAD, tilted(12.0))
    assert done == Twist.planar(0.0, 0.2)
    assert why == "It is steeper here, 12 degrees, than the 10 allowed; drive back."
    assert keeper.clamp(Twist.planar(-0.6, 0.0), tilted(12.0, forward=-0.2)).twist.linear.x < -0.1
    assert keeper.clamp(AHEAD, tilted(2.0)).twist == AHEAD


def test_down_a_slope_it_goes_back_up() -> None:
    keeper = LimitKeeper(LimitSettings(max_slope_degrees=10.0), WHEELS)
    down = MeasuredState(Pose2(0.0, 0.0, 0.0), PlanarVelocity(0.3, 0.0, 0.0), pitch=math.radians(12.0))
    assert keeper.clamp(AHEAD, down).twist.linear.x == 0.0
    assert keeper.clamp(Twist.planar(-0.6, 0.0), down).twist.linear.x < 0.0


def test_started_on_a_slope_it_goes_only_down() -> None:
    keeper = LimitKeeper(LimitSettings(max_slope_degrees=10.0), WHEELS)
    assert keeper.clamp(AHEAD, tilted(12.0, forward=0.0)).twist.linear.x == 0.0
    assert keeper.clamp(Twist.planar(-0.6, 0.0), tilted(12.0, forward=0.0)).twist.linear.x < 0.0


# the message


def test_the_message_tells_all_and_nan_is_no_limit() -> None:
    settings = LimitSettings(
        max_speed=0.5, max_slope_degrees=90.0, clearance=0.1, keep_in=(SQUARE,), keep_out=(POST,)
    )
    told = from_json(to_json(LimitKeeper(settings, WHEELS).message), Limits)
    assert (told.max_speed, told.clearance) == (0.5, 0.1)
    assert told.max_slope == pytest.approx(math.pi / 2)
    assert math.isnan(told.max_depth)
    assert told.keep_out[0].points[1] == Point32(2.0, 1.0)
    assert len(told.keep_in) == 1
