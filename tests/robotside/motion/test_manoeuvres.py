"""What a manoeuvre leads to, and what is left of it where less is allowed."""

from __future__ import annotations

import math

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from robotside.core.config import LimitSettings
from robotside.core.pose2 import Pose2
from robotside.limits.limits import KeptOrder, LimitKeeper
from robotside.motion.manoeuvres import at_rest, finite, leads_to, paced, settled
from robotside.motion.measured import MeasuredState
from robotside.motion.stopping_path import PlanarVelocity

TRUCK = RobotInfo(
    "T", "ackermann", max_speed=5.0, max_yaw_rate=1.4, radius=1.0, max_steering=0.52, min_radius=3.5
)
BOAT = RobotInfo("B", "boat", max_speed=2.0, max_yaw_rate=0.6, radius=0.5, max_steering=0.6, min_radius=1.4)
AQUA = RobotInfo("A", "hexapod", max_speed=0.65, max_yaw_rate=0.6, radius=0.3, max_tilt=0.8, max_climb=0.25)
DRONE = RobotInfo("D", "quadrotor", max_speed=4.0, max_yaw_rate=1.7, radius=0.3, max_tilt=0.35, max_climb=1.0)
KINDS = ["twist", "steer", "course", "tilt", "hover", "take_off", "land", "surface", "rest"]
SQUARE = ((-4.0, -4.0), (4.0, -4.0), (4.0, 4.0), (-4.0, 4.0))
HERE = Pose2(0.0, 0.0, 0.0)


def knowing(info: RobotInfo, *kinds: str) -> RobotInfo:
    return msgspec.structs.replace(info, manoeuvres=list(kinds or KINDS))


def keep(info: RobotInfo, order: Manoeuvre, measured: MeasuredState, **limits: object) -> KeptOrder:
    return LimitKeeper(LimitSettings(**limits), knowing(info)).keep(order, measured)  # type: ignore[arg-type]


def tilt(**words: float) -> Manoeuvre:
    z, turn = words.pop("z", 0.0), words.pop("turn", 0.0)
    return Manoeuvre(kind="tilt", twist=Twist(Vector3(0.0, 0.0, z), Vector3(0.0, 0.0, turn)), **words)  # type: ignore[arg-type]


def steer(steering: float, **words: float) -> Manoeuvre:
    return Manoeuvre(kind="steer", steering=steering, **words)  # type: ignore[arg-type]


# what it leads to


def test_steered_wheels_lead_round_a_circle() -> None:
    twist = leads_to(steer(0.52, speed=2.0), TRUCK, MeasuredState())
    assert twist.linear.x / twist.angular.z == pytest.approx(3.5)
    back = leads_to(steer(-0.26, speed=-2.0), TRUCK, MeasuredState())
    assert back.angular.z == pytest.approx(2.0 * math.tan(0.26) / math.tan(0.52) / 3.5)


def test_a_throttle_leads_to_its_share_of_the_speed() -> None:
    assert leads_to(steer(0.0, throttle=-0.5), BOAT, MeasuredState()).linear.x == -1.0
    assert leads_to(steer(0.3), BOAT, MeasuredState()) == Twist()


def test_a_course_leads_round_to_it() -> None:
    course = Manoeuvre(kind="course", speed=1.0, yaw=0.1)
    assert leads_to(course, BOAT, MeasuredState(HERE)).angular.z == pytest.approx(0.09)
    assert leads_to(course, BOAT, MeasuredState()).angular.z == 0.0


def test_what_leans_gains_speed_where_it_leans_to_and_level_it_floats_on() -> None:
    still, on = MeasuredState(HERE), MeasuredState(HERE, PlanarVelocity(2.0, 0.0, 0.0))
    assert leads_to(tilt(pitch=0.2), DRONE, still).linear.x == pytest.approx(0.3 * 9.81 * math.tan(0.2))
    assert leads_to(tilt(roll=0.2), DRONE, still).linear.y < 0
    assert leads_to(tilt(), DRONE, on).linear.x == 2.0


# let go


def test_a_rudder_that_was_left_over_does_not_drive() -> None:
    assert at_rest(steer(0.5, throttle=0.0))
    assert not at_rest(steer(0.0, throttle=0.1))
    assert at_rest(tilt())
    assert not at_rest(tilt(roll=0.1))
    assert not at_rest(tilt(speed=0.3))


def test_a_flier_that_is_told_to_lean_no_more_stays_there_and_a_swimmer_lies_level() -> None:
    assert settled(tilt(), DRONE).kind == "hover"  # type: ignore[union-attr]
    assert settled(tilt(z=0.2), DRONE) == tilt(z=0.2)
    assert settled(tilt(), AQUA) == tilt()
    ahead = Twist.planar(0.2, 0.0)
    assert settled(Manoeuvre(kind="twist", twist=ahead), AQUA) is ahead


@pytest.mark.parametrize(
    "order",
    [
        steer(math.nan, speed=1.0),
        steer(0.0, speed=math.inf),
        tilt(pitch=math.inf),
        tilt(z=math.nan),
        Manoeuvre(kind="hover", height=-math.inf),
    ],
)
def test_what_is_no_number_is_found(order: Manoeuvre) -> None:
    assert not finite(order)
    assert finite(Manoeuvre(kind="hover"))


# a slow link


@given(st.floats(0.15, 1.0), st.floats(-3, 3), st.floats(-3, 3), st.floats(-3, 3))
def test_a_slow_link_leaves_its_share_of_everything(share: float, a: float, b: float, c: float) -> None:
    done = paced(Manoeuvre(kind="tilt", roll=a, pitch=b, throttle=c, speed=3 * c), DRONE, share)
    assert isinstance(done, Manoeuvre)
    assert math.hypot(done.roll, done.pitch) <= 0.35 * share + 1e-12
    assert abs(done.throttle) <= share
    assert abs(done.speed) <= 4.0 * share
    assert done.roll * b == pytest.approx(done.pitch * a)


def test_no_wheel_is_asked_to_turn_farther_than_it_can() -> None:
    for share in (1.0, 0.2):
        done = paced(Manoeuvre(kind="steer", steering=-3.0, speed=0.5), TRUCK, share)
        assert isinstance(done, Manoeuvre)
        assert done.steering == -TRUCK.max_steering  # a slow link takes speed off it and leaves it its bend


def test_on_a_good_link_an_order_stays_as_it_is() -> None:
    order = tilt(pitch=0.2, z=0.5, turn=-0.3)
    done = paced(order, DRONE, 1.0)
    assert isinstance(done, Manoeuvre)
    assert (done.pitch, done.twist) == (order.pitch, order.twist)


# limits


def test_within_its_limits_an_order_is_left_as_it_is() -> None:
    order = tilt(pitch=0.2, z=0.5)
    assert keep(DRONE, order, MeasuredState(HERE, height=2.0)).order is order


def test_a_speed_limit_makes_a_speed_of_a_throttle_and_keeps_the_rudder() -> None:
    done = keep(BOAT, steer(0.2, throttle=1.0), MeasuredState(HERE), max_speed=0.8).order
    assert isinstance(done, Manoeuvre)
    assert done.speed == 0.8
    assert done.steering == pytest.approx(0.2, abs=0.05)
    assert math.isnan(done.throttle)


def test_what_leans_is_held_at_the_speed_limit_by_a_twist() -> None:
    fast = MeasuredState(HERE, PlanarVelocity(0.9, 0.0, 0.0), height=2.0)
    done = keep(DRONE, tilt(pitch=0.3), fast, max_speed=1.0).order
    assert isinstance(done, Twist)
    assert done.linear.x == pytest.approx(1.0)


def test_a_turn_limit_eases_the_steering() -> None:
    done = keep(TRUCK, steer(0.5, speed=4.0), MeasuredState(HERE), max_yaw_rate=0.4).order
    assert isinstance(done, Manoeuvre)
    assert leads_to(done, TRUCK, MeasuredState()).angular.z == pytest.approx(0.4)
    assert done.speed == 4.0


def test_a_fence_ahead_makes_a_throttle_less_and_level_flight_a_brake() -> None:
    near = MeasuredState(Pose2(2.4, 0.0, 0.0), PlanarVelocity(1.0, 0.0, 0.0))
    slow, why = keep(BOAT, steer(0.0, throttle=1.0), near, keep_in=(SQUARE,))
    assert slow == Twist()
    assert why == "The robot's fence is 1.1 m away: it goes no nearer."
    far = MeasuredState(Pose2(0.0, 0.0, 0.0), PlanarVelocity(0.5, 0.0, 0.0))
    less = keep(BOAT, steer(0.0, throttle=1.0), far, keep_in=(SQUARE,)).order
    assert isinstance(less, Manoeuvre)
    assert 0.3 < less.speed < 1.2
    on = MeasuredState(Pose2(2.4, 0.0, 0.0), PlanarVelocity(1.9, 0.0, 0.0), height=2.0)
    level = keep(DRONE, tilt(turn=0.1), on, keep_in=(SQUARE,)).order
    assert isinstance(level, Twist)
    assert level.linear.x < 1.0
    away = tilt(pitch=-0.3)
    slower = MeasuredState(on.pose, PlanarVelocity(0.8, 0.0, 0.0), height=2.0)
    assert keep(DRONE, away, slower, keep_in=(SQUARE,)).order is away


def test_a_swimmer_at_its_fence_lies_level_and_may_still_rise() -> None:
    at = MeasuredState(Pose2(3.64, 0.0, 0.0), PlanarVelocity(0.03, 0.0, 0.0), height=-2.0)
    done = keep(AQUA, tilt(roll=0.3, pitch=0.3, throttle=1.0, z=0.1), at, keep_in=(SQUARE,)).order
    assert isinstance(done, Manoeuvre)
    assert (done.speed, done.roll, done.pitch) == (0.0, 0.0, 0.0)
    assert done.twist.linear.z == pytest.approx(0.1, abs=0.01)


def test_a_climb_is_held_at_the_greatest_height_however_it_leans() -> None:
    high = MeasuredState(HERE, PlanarVelocity(2.0, 0.0, 0.0), height=4.98, pitch=0.3)
    done, why = keep(DRONE, tilt(pitch=0.3, z=1.0), high, max_height=5.0)
    assert isinstance(done, Manoeuvre)
    assert done.pitch == 0.3
    assert done.twist.linear.z == pytest.approx(0.0, abs=0.1)
    assert why == "The robot goes no higher than 5 m."


@pytest.mark.parametrize("kind", ["hover", "course", "take_off"])
def test_no_height_is_held_beyond_the_limits(kind: str) -> None:
    order = Manoeuvre(kind=kind, height=40.0, speed=0.0)
    done = keep(DRONE, order, MeasuredState(HERE, height=2.0), max_height=5.0).order
    assert isinstance(done, Manoeuvre)
    assert done.height == 5.0


def test_the_usual_height_of_a_take_off_is_cut_too() -> None:
    done = keep(DRONE, Manoeuvre(kind="take_off"), MeasuredState(HERE, height=0.0), max_height=0.6).order
    assert isinstance(done, Manoeuvre)
    assert done.height == 0.6


def test_one_that_must_stay_under_water_does_not_surface() -> None:
    done = keep(AQUA, Manoeuvre(kind="surface"), MeasuredState(HERE, height=-3.0), min_depth=1.0).order
    assert isinstance(done, Manoeuvre)
    assert (done.kind, done.height) == ("hover", -1.0)


def test_a_swimmer_that_dives_is_slowed_before_its_greatest_depth() -> None:
    deep = MeasuredState(HERE, PlanarVelocity(0.5, 0.0, 0.0), height=-4.98, pitch=0.5)
    done = keep(AQUA, tilt(pitch=0.5, throttle=1.0), deep, max_depth=5.0).order
    assert isinstance(done, Manoeuvre)
    assert abs(done.speed) < 0.15


# what a robot does not know


def test_one_that_knows_no_manoeuvres_gets_the_twist_that_comes_nearest() -> None:
    keeper = LimitKeeper(LimitSettings(), TRUCK)
    done = keeper.keep(steer(0.52, speed=2.0), MeasuredState(HERE)).order
    assert isinstance(done, Twist)
    assert done.angular.z == pytest.approx(2.0 / 3.5)
    assert keeper.keep(Manoeuvre(kind="hover"), MeasuredState(HERE)).order == Twist()


@pytest.mark.parametrize("order", [Manoeuvre(kind="take_off"), tilt(z=1.0), Twist.planar(1.0, 0.0)])
def test_one_that_has_turned_over_does_nothing(order: Manoeuvre | Twist) -> None:
    keeper = LimitKeeper(LimitSettings(), knowing(DRONE))
    assert keeper.keep(order, MeasuredState(HERE, roll=math.pi)) == (
        Twist(),
        "D has turned over; put it upright first.",
    )
    assert keeper.keep(order, MeasuredState(HERE, roll=0.6)).order == order


def test_a_swimmer_may_lie_on_its_back() -> None:
    order = tilt(throttle=0.5)
    assert keep(AQUA, order, MeasuredState(HERE, roll=math.pi)).order is order


@pytest.mark.parametrize("kind", ["take_off", "hover", "course"])
@pytest.mark.parametrize(
    ("height", "goes", "why"),
    [
        (900.0, 10.0, "The robot goes no higher than 10 m."),
        (8.0, 8.0, ""),
        (math.nan, math.nan, ""),
    ],
)
def test_a_height_beyond_the_limit_is_cut_to_it_and_that_is_said(
    kind: str, height: float, goes: float, why: str
) -> None:
    info = RobotInfo(kind="quadrotor", max_speed=4.0, manoeuvres=["take_off", "hover", "course"])
    flying = MeasuredState(Pose2(0.0, 0.0, 0.0), height=2.0)
    done, said = keep(info, Manoeuvre(kind=kind, height=height), flying, max_height=10.0)
    assert isinstance(done, Manoeuvre)
    if math.isfinite(goes) or kind != "take_off":
        assert done.height == pytest.approx(goes, nan_ok=True)
    assert said == why
