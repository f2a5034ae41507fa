"""What is carried over its fence says so, and the way back."""

from __future__ import annotations

import math

import pytest

from robotside.core.config import LimitSettings
from robotside.core.pose2 import Pose2
from robotside.limits.fence_guard import MAX_UNCERTAINTY
from robotside.limits.limits import LimitKeeper
from robotside.motion.measured import MeasuredState
from robotside.motion.station_keeping import RETURN_SPEED, DriftMonitor, back, way_back
from robotside.motion.stopping_path import PlanarVelocity
from tests.robotside.limits.test_limits import AQUA, SQUARE, WHEELS, twist
from tests.robotside.motion.test_manoeuvres import BOAT

FENCED = LimitSettings(keep_in=(SQUARE,))


@pytest.mark.parametrize("bearing", [0.0, 1.0, 1.7, -1.0, 2.5, -2.5, math.pi])
def test_ahead_or_astern_it_goes_to_the_inside_and_turns_its_bow_or_stern_there(bearing: float) -> None:
    inward = (math.cos(bearing), math.sin(bearing))
    way = way_back(inward, 0.0)
    done = back(inward, way)
    assert done.linear.x == way * RETURN_SPEED
    assert done.linear.x * inward[0] > -0.1
    later = bearing - 0.1 * done.angular.z
    assert way * math.cos(later) >= way * math.cos(bearing) - 1e-9


def test_it_does_not_change_its_mind_at_every_wave() -> None:
    assert way_back((-0.1, 1.0), 1.0) == way_back((-0.1, 1.0), 0.0) == 1.0
    assert way_back((0.1, 1.0), -1.0) == -1.0
    assert way_back((0.8, 0.6), -1.0) == 1.0


def test_one_that_turns_where_it_is_looks_inside_before_it_goes() -> None:
    assert back((-1.0, 0.1), 0.0).linear.x == 0.0
    assert back((1.0, 0.0), 0.0).linear.x == RETURN_SPEED


def test_a_drift_is_told_once_until_it_was_back() -> None:
    drift = DriftMonitor()
    assert drift.check("M", 0.1, 0.1) == ""
    assert drift.check("M", -0.1, 0.1) == "M drifts over its fence."
    assert drift.check("M", -0.2, 0.1) == ""
    assert drift.check("M", 0.6, -0.1) == ""
    assert drift.check("M", -0.1, 0.0) == ""
    assert drift.check("M", -0.1, 0.1) != ""


def outside(spread: float = 0.0) -> MeasuredState:
    return MeasuredState(Pose2(3.9, 0.0, 0.0), PlanarVelocity(0.08, 0.0, 0.0), height=-1.0, spread=spread)


@pytest.mark.parametrize("info", [BOAT, AQUA])
def test_what_water_carries_over_its_fence_goes_back_though_it_was_told_to_rest(info: object) -> None:
    keeper = LimitKeeper(FENCED, info)  # type: ignore[arg-type]
    done = keeper.clamp(twist(), outside()).twist
    assert done.linear.x < 0 or abs(done.angular.z) > 0.3
    assert keeper.adrift(outside()).endswith("drifts towards its fence; it goes back by itself.")


def test_what_stands_by_its_wheels_never_goes_back_by_itself() -> None:
    assert LimitKeeper(FENCED, WHEELS).clamp(twist(), outside()) == (twist(), "")


def test_a_boat_does_not_turn_on_the_spot_at_its_fence_for_its_rudder_needs_way() -> None:
    still = MeasuredState(Pose2(3.35, 0.0, 0.0))
    done = LimitKeeper(FENCED, BOAT).clamp(twist(turn=0.4), still).twist
    assert done == twist()
    inside = MeasuredState(Pose2(0.0, 0.0, 0.0))
    assert LimitKeeper(FENCED, BOAT).clamp(twist(turn=0.4), inside).twist == twist(turn=0.4)


def test_what_nothing_drives_says_that_it_drifts_out() -> None:
    keeper = LimitKeeper(FENCED, BOAT)
    assert keeper.adrift(outside()).endswith("drifts over its fence.")
    assert keeper.adrift(outside()) == ""


@pytest.mark.parametrize("spread", [0.0, 0.04, 0.3, 0.9])
def test_it_keeps_off_the_fence_by_what_its_place_may_be_off(spread: float) -> None:
    keeper, room = LimitKeeper(FENCED, WHEELS), max(0.1, 2 * spread)
    near = MeasuredState(Pose2(4.0 - 0.2 - room, 0.0, 0.0), spread=spread)
    assert keeper.clamp(twist(0.5), near).twist.linear.x == pytest.approx(0.0, abs=0.02)
    assert keeper.clamp(twist(-0.5), near).twist.linear.x == -0.5
    keeper.adrift(near)
    need = 0.2 + max(0.4, room + 0.2)
    assert bool(keeper.fault("It", 4.0 - need + 0.02, 0.0)) is True
    assert keeper.fault("It", 4.0 - need - 0.02, 0.0) == ""


@pytest.mark.parametrize("x", [-3.0, 0.0, 2.0, 3.0, 3.6])
def test_the_less_sure_it_is_the_slower_it_goes_towards_its_fence(x: float) -> None:
    speeds = [
        LimitKeeper(FENCED, WHEELS)
        .clamp(twist(0.6), MeasuredState(Pose2(x, 0.0, 0.0), spread=spread))
        .twist.linear.x
        for spread in (0.0, 0.1, 0.5, 1.2)
    ]
    assert speeds == sorted(speeds, reverse=True)


def test_a_place_that_is_not_sure_is_said_and_makes_it_slow_where_there_is_a_fence() -> None:
    lost = MeasuredState(Pose2(0.0, 0.0, 0.0), sure=False)
    done, why = LimitKeeper(FENCED, WHEELS).clamp(twist(0.6), lost)
    assert done.linear.x == pytest.approx(0.25 * WHEELS.max_speed)
    assert why.startswith("Position unsure: the robot goes slowly")
    assert LimitKeeper(LimitSettings(), WHEELS).clamp(twist(0.6), lost) == (twist(0.6), "")
    vague = MeasuredState(Pose2(0.0, 0.0, 0.0), spread=MAX_UNCERTAINTY)
    assert "unsure to 4.0 m:" in LimitKeeper(FENCED, WHEELS).clamp(twist(0.6), vague).why


def test_the_faster_a_swimmer_is_carried_on_the_earlier_it_brakes() -> None:
    keeper = LimitKeeper(FENCED, AQUA)
    speeds = [
        keeper.clamp(twist(0.6), MeasuredState(Pose2(x, 0.0, 0.0), height=-1.0)).twist.linear.x
        for x in (0.0, 2.2, 2.8, 3.3)
    ]
    assert speeds == sorted(speeds, reverse=True)
    assert speeds[0] == 0.6
    assert speeds[2] < 0.15
