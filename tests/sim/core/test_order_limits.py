"""What may be asked of a robot that goes up and down."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Event, Manoeuvre, RobotInfo
from sim.core.order_limits import check, cut
from sim.robot import SimRobot
from sim.vehicles.aqua import AQUA
from sim.vehicles.ardrone import ARDRONE
from tests.sim.rooms import alone, plain, until


def said(robot: SimRobot) -> list[str]:
    return [
        message.text
        for topic, message in until(robot, 0.1)
        if topic == "/events" and isinstance(message, Event)
    ]


@pytest.fixture
def drone():
    robot = alone(ARDRONE, plain())
    yield robot
    robot.close()


@pytest.mark.parametrize("kind", ["take_off", "hover", "course"])
def test_what_is_too_high_is_cut_to_the_ceiling_and_that_is_said(drone, kind):
    drone.manoeuvre(Manoeuvre(kind=kind, height=900.0))
    assert said(drone) == ["Ardrone-1 goes no higher than 30.1 m; 900 m was requested."]
    followed, _ = cut(Manoeuvre(kind=kind, height=900.0), drone.info, drone.heights)
    assert followed.height == pytest.approx(30.05)


def test_what_is_too_deep_is_cut_to_what_the_swimmer_is_built_for_and_that_is_said():
    robot = alone(AQUA, plain("[water]\ndepth = 12.0\n", -4.0))
    robot.manoeuvre(Manoeuvre(kind="hover", height=-50.0))
    told = said(robot)
    robot.close()
    assert told == ["Aqua-1 goes no lower than -11.9 m; -50 m was requested."]


@pytest.mark.parametrize("kind", ["take_off", "hover", "course"])
def test_what_flies_is_not_sent_below_the_ground(drone, kind):
    drone.manoeuvre(Manoeuvre(kind="take_off", height=1.0))
    with pytest.raises(ValueError, match="-3 m is below the ground; Ardrone-1 goes on as before"):
        drone.manoeuvre(Manoeuvre(kind=kind, height=-3.0))
    until(drone, 6.0)
    assert drone.simulation.vehicle.state().position[2] == pytest.approx(1.0, abs=0.1)


def test_told_to_hover_on_the_ground_it_hovers_just_above_it(drone):
    drone.manoeuvre(Manoeuvre(kind="take_off", height=1.0))
    until(drone, 4.0)
    drone.manoeuvre(Manoeuvre(kind="hover", height=0.0))
    assert said(drone) == ["Ardrone-1 goes no lower than 0.15 m; 0 m was requested."]
    until(drone, 6.0)
    vehicle = drone.simulation.vehicle
    assert (vehicle.grounded, vehicle.pilot.phase) == (False, "flying")
    assert vehicle.state().position[2] == pytest.approx(0.15, abs=0.04)


def test_a_height_that_is_left_out_or_that_the_kind_does_not_name_is_nobodys_business(drone):
    for order in (Manoeuvre(kind="hover"), Manoeuvre(kind="land", height=900.0)):
        followed, why = cut(order, drone.info, drone.heights)
        assert why == ""
        assert math.isnan(followed.height) or order.kind == "land"


SWIMMER = RobotInfo(
    name="Fish", max_speed=1.0, max_yaw_rate=0.5, max_climb=0.4, max_tilt=0.3, max_steering=0.6
)


def test_too_fast_a_twist_keeps_its_direction_and_is_as_fast_as_it_may_be():
    order = Manoeuvre(kind="twist", twist=Twist(Vector3(3.0, -4.0, -2.0), Vector3(0.0, 0.0, -2.0)))
    followed, why = cut(order, SWIMMER)
    linear, turn = followed.twist.linear, followed.twist.angular.z
    assert (linear.x, linear.y, linear.z, turn) == pytest.approx((0.6, -0.8, -0.4, -0.5))
    assert why == "Fish goes at most 1 m/s; 5 m/s was requested."


def test_whatever_is_within_the_limits_is_followed_as_it_is():
    order = Manoeuvre(
        kind="twist",
        twist=Twist(Vector3(0.6, -0.8, 0.4), Vector3(0.0, 0.0, -0.5)),
        speed=-1.0,
        throttle=1.0,
        steering=-0.6,
        roll=0.3,
        pitch=-0.3,
        height=2.0,
        yaw=3.0,
    )
    assert cut(order, SWIMMER) == (order, "")


@pytest.mark.parametrize(
    ("asked", "limit"), [("speed", 1.0), ("throttle", 1.0), ("steering", 0.6), ("roll", 0.3), ("pitch", 0.3)]
)
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_each_number_of_an_order_is_cut_to_its_own_limit_to_both_sides(asked, limit, sign):
    followed, why = cut(Manoeuvre(kind="steer", **{asked: sign * 9.0}), SWIMMER)
    assert getattr(followed, asked) == sign * limit
    assert "9" in why


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_an_order_that_holds_no_number_where_it_must_is_refused(value):
    for order in (
        Manoeuvre(kind="twist", twist=Twist(Vector3(value, 0.0, 0.0), Vector3())),
        Manoeuvre(kind="twist", twist=Twist(Vector3(), Vector3(0.0, 0.0, value))),
        Manoeuvre(kind="steer", steering=value),
        Manoeuvre(kind="tilt", roll=value),
        Manoeuvre(kind="tilt", pitch=value),
    ):
        with pytest.raises(ValueError, match="must be a number; the robot goes on as before"):
            check(order, SWIMMER)
    if math.isinf(value):
        with pytest.raises(ValueError, match="speed"):
            check(Manoeuvre(kind="steer", speed=value), SWIMMER)
    else:
        check(Manoeuvre(kind="steer", speed=value, throttle=value, yaw=value, height=value), SWIMMER)
