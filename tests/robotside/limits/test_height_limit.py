"""Floor and ceiling of a fence: slower towards them, back from beyond, and neither way while the height is unknown."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec import structs

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from robotside.core.config import LimitSettings
from robotside.core.notice import Notice
from robotside.core.pose2 import Pose2
from robotside.kinds.registry import kind_of
from robotside.limits.limits import LimitKeeper
from robotside.motion.measured import MeasuredState
from robotside.motion.stopping_path import REACTION_TIME

DRONE = RobotInfo(
    "D",
    "quadrotor",
    max_speed=2.0,
    max_yaw_rate=2.0,
    radius=0.3,
    manoeuvres=["twist", "course", "tilt", "hover", "take_off", "land"],
)
SINKS = structs.replace(DRONE, manoeuvres=[])
AQUA = RobotInfo("A", "hexapod", max_speed=0.8, max_yaw_rate=1.0, radius=0.3, manoeuvres=["hover", "surface"])
OVER_HEADS = LimitSettings(floor=2.5, ceiling=10.0)
UNDER_WATER = LimitSettings(floor=-6.0, ceiling=-1.0)


def at(height: float, *, spread: float = 0.0, landed: bool = False) -> MeasuredState:
    return MeasuredState(Pose2(0.0, 0.0, 0.0), height=height, height_spread=spread, landed=landed)


def rise(z: float, x: float = 0.0) -> Twist:
    return Twist(Vector3(x, 0.0, z))


def order(kind: str, height: float = math.nan) -> Manoeuvre:
    return Manoeuvre(kind=kind, height=height)


def kept_height(keeper: LimitKeeper, what: Manoeuvre, measured: MeasuredState) -> float:
    done = keeper.keep(what, measured).order
    assert isinstance(done, Manoeuvre)
    return done.height


def test_towards_floor_and_ceiling_it_gets_slower_and_rests_at_them_and_the_way_back_is_free() -> None:
    keeper = LimitKeeper(OVER_HEADS, DRONE)
    assert keeper.clamp(rise(-1.0), at(8.0)).twist.linear.z == -1.0
    assert -0.6 < keeper.clamp(rise(-1.0), at(2.7)).twist.linear.z < 0.0
    assert keeper.clamp(rise(-1.0), at(2.5)) == (rise(0.0), "The robot goes no deeper than 2.5 m.")
    assert keeper.clamp(rise(1.0), at(10.0)) == (rise(0.0), "The robot goes no higher than 10 m.")
    assert keeper.clamp(rise(1.0), at(1.0)).twist.linear.z == 1.0
    assert keeper.clamp(rise(-1.0), at(11.0)).twist.linear.z == -1.0
    assert keeper.clamp(rise(-1.0), at(1.0)).twist.linear.z >= 0.0
    assert keeper.clamp(rise(1.0), at(11.0)).twist.linear.z <= 0.0


def test_what_drifts_beyond_an_end_under_a_stick_at_rest_or_pushed_on_goes_back_the_faster_the_farther() -> (
    None
):
    keeper = LimitKeeper(UNDER_WATER, AQUA)
    for speed in (0.0, 0.3):
        assert keeper.clamp(rise(speed), at(-0.96)).twist.linear.z == pytest.approx(-0.06)
        assert keeper.clamp(rise(speed), at(-0.2)).twist.linear.z == -0.15
        assert keeper.clamp(rise(-speed), at(-7.0)).twist.linear.z == 0.15
    assert keeper.clamp(rise(0.0), at(-1.1)).twist.linear.z == 0.0
    assert LimitKeeper(OVER_HEADS, DRONE).clamp(rise(0.0), at(0.1, landed=True)).twist == rise(0.0)
    assert LimitKeeper(OVER_HEADS, SINKS).clamp(rise(0.0), at(1.0)).twist == rise(0.0)
    wheels = RobotInfo("W", "wheels", max_speed=1.0, max_yaw_rate=1.0, radius=0.2)
    assert LimitKeeper(UNDER_WATER, wheels).clamp(rise(0.0, x=0.3), at(0.0)).twist == rise(0.0, x=0.3)


def test_a_swimmer_has_both_below_the_surface() -> None:
    keeper = LimitKeeper(UNDER_WATER, AQUA)
    assert keeper.clamp(rise(0.3), at(-1.0)).why == "The robot goes no higher than 1 m of depth."
    assert keeper.clamp(rise(-0.3), at(-6.0)).why == "The robot goes no deeper than 6 m of depth."
    assert keeper.heights((-20.0, 0.0)) == (-6.0, -1.0)


def test_a_height_that_is_not_known_allows_no_way_that_has_an_end() -> None:
    for measured in (at(math.nan), at(5.0, spread=1.1)):
        both = LimitKeeper(OVER_HEADS, DRONE)
        for speed, word in ((1.0, "higher"), (-1.0, "deeper")):
            done = both.clamp(rise(speed, x=0.5), measured)
            assert done.twist == rise(0.0, x=0.5)
            assert isinstance(done.why, Notice)
            assert done.why.code == Code.FENCE_HEIGHT_UNKNOWN
            assert done.why == f"Height unknown: the robot goes no {word} because of its fence."
        above = LimitKeeper(LimitSettings(ceiling=10.0), DRONE)
        assert above.clamp(rise(-1.0), measured).twist.linear.z == -1.0
        assert above.clamp(rise(1.0), measured).twist.linear.z == 0.0
        assert LimitKeeper(LimitSettings(), DRONE).clamp(rise(1.0), measured).twist.linear.z == 1.0


def test_it_keeps_away_by_as_much_as_its_height_is_uncertain_and_says_so() -> None:
    keeper = LimitKeeper(OVER_HEADS, DRONE)
    assert keeper.clamp(rise(1.0), at(9.0, spread=0.0)).twist.linear.z > 0.5
    done = keeper.clamp(rise(1.0), at(9.2, spread=0.5))
    assert done.twist.linear.z == 0.0
    assert done.why == "The robot goes no higher than 10 m: it knows its height to 1.0 m only."
    assert kept_height(keeper, order("hover", 9.9), at(5.0, spread=0.5)) == pytest.approx(9.1)
    assert kept_height(keeper, order("hover", 9.9), at(5.0, spread=0.05)) == 9.9, "a tenth is kept anyway"


def test_between_ends_that_are_nearer_than_it_knows_its_height_it_keeps_to_the_middle() -> None:
    keeper = LimitKeeper(LimitSettings(floor=2.0, ceiling=3.0), DRONE)
    assert kept_height(keeper, order("hover", 2.9), at(2.2, spread=0.8)) == pytest.approx(2.5)
    assert keeper.clamp(rise(1.0), at(2.9, spread=0.8)).twist.linear.z == 0.0
    assert keeper.clamp(rise(-1.0), at(2.1, spread=0.8)).twist.linear.z == 0.0


def test_one_that_keeps_its_height_beyond_an_end_comes_back_by_itself() -> None:
    keeper = LimitKeeper(OVER_HEADS, DRONE)
    for kind in ("hover", "course"):
        assert kept_height(keeper, order(kind), at(12.0)) == 10.0
        assert kept_height(keeper, order(kind), at(1.0)) == 2.5
        assert math.isnan(kept_height(keeper, order(kind), at(5.0)))
    assert math.isnan(kept_height(keeper, order("hover"), at(0.1, landed=True))), "it stays on the ground"
    assert math.isnan(kept_height(keeper, order("hover"), at(12.0, spread=3.0))), (
        "it does not know where it is"
    )


def test_an_order_to_a_height_beyond_an_end_is_one_to_the_end() -> None:
    keeper = LimitKeeper(OVER_HEADS, DRONE)
    assert kept_height(keeper, order("course", 1.0), at(5.0)) == 2.5
    assert kept_height(keeper, order("take_off", 1.0), at(0.0, landed=True)) == 2.5
    assert keeper.keep(order("hover", 30.0), at(5.0)).why == "The robot goes no higher than 10 m."


def test_landing_passes_the_floor_also_of_one_that_can_only_sink() -> None:
    assert LimitKeeper(OVER_HEADS, DRONE).keep(order("land"), at(2.5)).order == order("land")
    assert LimitKeeper(OVER_HEADS, DRONE).clamp(rise(-0.5), at(2.5)).twist.linear.z == 0.0
    sinks = LimitKeeper(OVER_HEADS, SINKS)
    for measured in (at(2.5), at(0.5), at(math.nan)):
        assert sinks.clamp(rise(-0.5), measured) == (rise(-0.5), "")
    assert sinks.clamp(rise(-0.5, x=0.4), at(2.5)).twist.linear.z == 0.0


def test_a_swimmer_surfaces_no_higher_than_its_ceiling() -> None:
    done = LimitKeeper(UNDER_WATER, AQUA).keep(order("surface"), at(-3.0)).order
    assert isinstance(done, Manoeuvre)
    assert (done.kind, done.height) == ("hover", -1.0)


@pytest.mark.parametrize("info", [DRONE, AQUA])
def test_towards_an_end_it_has_room_to_brake_when_the_next_order_takes_effect(info: RobotInfo) -> None:
    """Through the reaction time it goes on as fast as it was allowed, then brakes: v t + v^2 / 2a is the room."""
    keeper, braking = (
        LimitKeeper(LimitSettings(floor=-10.0, ceiling=10.0), info),
        kind_of(info.kind).handling.levelling,
    )
    for room in (0.02, 0.05, 0.1, 0.2):
        for up, height in ((1.0, 10.0 - room), (-1.0, -10.0 + room)):
            allowed = up * keeper.clamp(rise(9.0 * up), at(height)).twist.linear.z
            assert allowed * REACTION_TIME + allowed**2 / (2.0 * braking) == pytest.approx(room)


@given(
    st.floats(2.5, 10.0),
    st.lists(st.floats(-2.0, 2.0), min_size=1, max_size=40),
    st.integers(0, 2**16),
    st.sampled_from([0.0, 0.05, 0.3, 0.9]),
)
def test_whatever_is_commanded_the_true_height_is_kept_where_the_measured_one_is_off_by_two_deviations(
    start: float, rates: list[float], seed: int, spread: float
) -> None:
    keeper, rng = LimitKeeper(OVER_HEADS, DRONE), np.random.default_rng(seed)
    off = float(rng.uniform(-2.0, 2.0)) * spread
    low, high = 2.5, 10.0
    z, speed = min(max(start, low + 2 * spread), high - 2 * spread), 0.0
    for rate in [*rates, *[0.0] * 60]:
        wanted = keeper.clamp(rise(rate), at(z + off, spread=spread)).twist.linear.z
        speed += max(-0.05, min(0.05, wanted - speed))
        z += speed * 0.05
        assert low - 0.2 <= z <= high + 0.2
