"""What may be asked of a robot that goes up and down."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.pilothouse_msgs import Event, Manoeuvre
from sim.core.order_limits import cut
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
