"""What is told of a robot that sinks, turns over or leaves its world: once, and again only after it had ended."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Event
from sim.core.shapes import from_yaw
from sim.robot import make
from sim.simulation.mishaps import CHECK_RATE, CLEAR_CHECKS, CONFIRM_CHECKS, SINKING_CHECKS, Mishaps
from sim.vehicles.minnow import MINNOW
from tests.sim.rooms import alone, plain, robot_in, until

SEA = "[water]\ndepth = 20.0\n[[water.waves]]\nheight = 1.5\nperiod = 2.7\ndirection = 40\nphase = 0\n"
ON_ITS_BACK = (1.0, 0.0, 0.0, 0.0)


def told(messages):
    return [message.text for topic, message in messages if topic == "/events" and isinstance(message, Event)]


@pytest.fixture
def afloat():
    robot = alone(MINNOW, plain(SEA))
    yield robot
    robot.close()


@pytest.fixture
def looks():
    """Looks at a patrol robot that is held at a place and turned somehow, and says what it tells."""
    robot = robot_in(plain())
    vehicle = robot.simulation.vehicle
    mishaps = Mishaps(vehicle.parameters.info, vehicle.scene)

    def look(times, position=(0.0, 0.0, 0.0), rotation=(0.0, 0.0, 0.0, 1.0)):
        vehicle.scene.backend.place(vehicle.body, position, rotation)
        return [event.text for _ in range(times) for event in mishaps.update(vehicle.state())]

    yield look
    robot.close()


def test_a_boat_that_high_waves_toss_has_not_sunk(afloat):
    lows, said = [], []
    for _ in range(40):
        said += told(until(afloat, 0.5))
        lows.append(afloat.simulation.vehicle.state().position[2])
    assert min(lows) < -0.4
    assert said == []


def test_a_boat_under_water_has_sunk_and_that_is_said_once_wherever_the_surface_is(afloat):
    vehicle = afloat.simulation.vehicle
    mishaps = Mishaps(vehicle.parameters.info, vehicle.scene)
    said = []
    for _ in range(3 * SINKING_CHECKS):
        afloat.simulation.weather.step()
        level = afloat.simulation.weather.surface(0.0, 0.0)
        vehicle.scene.backend.place(vehicle.body, (0.0, 0.0, level - 0.6), from_yaw(0.0))
        said += [event.text for event in mishaps.update(vehicle.state())]
    assert said == ["Minnow-1 has sunk."]


def test_a_sea_that_breaks_over_a_boat_passes_and_what_stays_under_water_for_four_seconds_has_sunk(afloat):
    vehicle = afloat.simulation.vehicle
    mishaps = Mishaps(vehicle.parameters.info, vehicle.scene)

    def under(seconds):
        level = afloat.simulation.weather.surface(0.0, 0.0)
        vehicle.scene.backend.place(vehicle.body, (0.0, 0.0, level - 0.6), from_yaw(0.0))
        times = round(seconds * CHECK_RATE)
        return [event.text for _ in range(times) for event in mishaps.update(vehicle.state())]

    assert under(3.9) == []
    assert under(0.1) == ["Minnow-1 has sunk."]


def test_what_passes_is_not_told(looks):
    assert looks(CONFIRM_CHECKS - 1, rotation=ON_ITS_BACK) == []
    assert looks(1) == []


def test_what_lasts_is_told_once_and_a_moment_without_it_is_no_end(looks):
    assert looks(10 * CHECK_RATE, rotation=ON_ITS_BACK) == ["Patrol-1 has turned over."]
    for _ in range(5):
        assert looks(CLEAR_CHECKS - 1) == []
        assert looks(CHECK_RATE, rotation=ON_ITS_BACK) == []


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize(("degrees", "said"), [(70, []), (90, ["Patrol-1 has turned over."])])
def test_one_that_lies_on_its_side_has_turned_over_and_one_on_a_slope_has_not(looks, axis, degrees, said):
    half = math.radians(degrees) / 2
    lean = [0.0, 0.0, 0.0, math.cos(half)]
    lean[axis] = math.sin(half)
    assert looks(CONFIRM_CHECKS, rotation=tuple(lean)) == said


def test_what_ended_is_told_when_it_comes_again(looks):
    for _ in range(2):
        assert looks(CHECK_RATE, (30.0, 0.0, 0.0)) == ["Patrol-1 has left room."]
        looks(CLEAR_CHECKS)


def test_one_that_was_put_back_is_told_of_at_once_when_it_falls_again():
    robot = robot_in(plain())
    vehicle = robot.simulation.vehicle

    def topple():
        vehicle.scene.backend.place(vehicle.body, (0.0, 0.0, 1.0), (math.sin(1.5), 0.0, 0.0, math.cos(1.5)))
        return told(until(robot, 1.0))

    assert topple() == ["Patrol-1 has turned over."]
    robot.drive(Twist())
    robot.reset()
    until(robot, 0.1)
    assert topple() == ["Patrol-1 has turned over."]
    robot.close()


def test_a_dock_without_current_is_told_once_when_the_contacts_have_met_for_a_moment():
    robot = make("patrol", "office", camera=False, noise=False)
    robot.read(0.0)
    (dock,) = (place for place in robot.places if place.kind == "dock")
    vehicle = robot.simulation.vehicle
    robot.simulation.backend.place(vehicle.body, (dock.x, dock.y, 0.0), from_yaw(dock.yaw))
    assert told(robot.read(2.0)) == []
    robot.simulation.dead_docks.add("dock")
    assert told(robot.read(2.3)) == []
    assert told(robot.read(4.0)) == ["Patrol-1 touches dock, which has no current to give."]
    assert told(robot.read(6.0)) == []
    robot.close()
