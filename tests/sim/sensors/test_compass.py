"""The stabilised compass against the true heading of vehicles that accelerate, turn, roll and are put elsewhere."""

from __future__ import annotations

import math
from dataclasses import replace as replace_fields

import pytest
from msgspec.structs import replace

from bridge.core.units import heading_from_yaw
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.core.noise import Noise
from sim.core.shapes import from_yaw
from sim.physics.backend_bullet import State
from sim.sensors.compass import FILTER_RATE, Compass
from sim.vehicles.aqua import AQUA
from sim.vehicles.minnow import MINNOW, PARAMETERS
from tests.sim.rooms import alone, plain, until

pytestmark = pytest.mark.slow

SEA = """[water]
depth = 10.0
[[water.waves]]
height = 0.06
period = 2.5
direction = 70
[[water.waves]]
height = 0.03
period = 1.4
direction = 20
"""
AHEAD = Manoeuvre(kind="steer", throttle=1.0)
BOAT = (
    AHEAD,
    replace(AHEAD, steering=0.61),
    replace(AHEAD, steering=-0.61),
    replace(AHEAD, throttle=-1.0),
    Manoeuvre(kind="rest"),
)
SWIMMER = (
    Manoeuvre(kind="course", speed=0.65, yaw=0.0),
    Manoeuvre(kind="course", speed=0.65, yaw=2.0),
    Manoeuvre(kind="tilt", speed=0.65, pitch=-0.7, roll=0.5),
    Manoeuvre(kind="hover"),
)


def astray(robot, orders, seconds=5.0):
    """The greatest errors of heading, and of roll and pitch [deg] over `orders`, one after the other."""
    simulation = robot.simulation
    heading, level = 0.0, 0.0
    for order in orders:
        robot.manoeuvre(order)
        for _ in range(round(10 * seconds)):
            for topic, told in until(robot, 0.1):
                if topic != "/compass":
                    continue
                true = heading_from_yaw(simulation.pose()[2])
                x, y, z, w = simulation.vehicle.state().rotation
                roll, pitch = math.atan2(y * z + w * x, 0.5 - x * x - y * y), math.asin(2 * (w * y - z * x))
                heading = max(heading, abs(math.remainder(told.heading - true, 360.0)))
                level = max(level, math.degrees(max(abs(told.roll - roll), abs(told.pitch - pitch))))
    return heading, level


def without_iron(model):
    """`model` whose compass has been swung: its own iron is compensated."""
    own = model.parameters
    return replace_fields(model, parameters=replace(own, compass=replace(own.compass, hard_iron=0.0)))


@pytest.mark.parametrize("yaw", [0.0, 90.0, 200.0])
def test_under_full_throttle_hard_turns_and_in_waves_a_boats_compass_stays_within_half_a_degree(yaw):
    """An accelerometer alone would have it up to 38 degrees off: 2.8 m/s2 tilt what it takes for level by 16."""
    world = plain(SEA)
    robot = alone(MINNOW, replace(world, start=replace(world.start, yaw=yaw)))
    heading, level = astray(robot, BOAT)
    robot.close()
    assert heading < 0.5
    assert level < 0.5


def test_a_swimmers_compass_stays_so_too_on_its_side_and_on_the_dive():
    robot = alone(AQUA, plain("[water]\ndepth = 10.0\n", z=-4.0))
    heading, level = astray(robot, SWIMMER)
    robot.close()
    assert heading < 0.5
    assert level < 0.5


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize(
    ("model", "orders", "extra", "z"),
    [(MINNOW, BOAT, SEA, 0.0), (AQUA, SWIMMER, "[water]\ndepth = 10.0\n", -4.0)],
    ids=["minnow", "aqua"],
)
def test_with_all_its_errors_but_the_iron_a_compass_stays_within_three_degrees(model, orders, extra, z, seed):
    robot = alone(without_iron(model), plain(extra, z), seed=seed, noise=True)
    heading, level = astray(robot, orders)
    robot.close()
    assert 0.05 < heading < 3.0, "an error of nothing at all would be no sensor's"
    assert level < 2.0


def test_lying_still_it_errs_by_the_iron_about_it_alone():
    """Over the horizontal field, which at 70 degrees of dip is a third of all: what remains until it is swung."""
    figures = replace(PARAMETERS.compass, noise=0.0)
    errors = []
    for seed in range(200):
        compass = Compass(figures, Noise(seed, "compass"))
        told = compass.measure(State((0.0,) * 3, from_yaw(0.0), (0.0,) * 3, (0.0,) * 3), 0.0)
        errors.append(math.remainder(told.heading - 90.0, 360.0))
    deviation = math.sqrt(sum(error**2 for error in errors) / len(errors))
    iron = math.degrees(figures.hard_iron / math.cos(figures.dip))
    tilt = math.degrees(figures.accelerometer_noise / 9.81 * math.tan(figures.dip))
    assert deviation == pytest.approx(math.hypot(iron, tilt), rel=0.15)


def test_it_finds_the_bias_of_its_gyro_within_minutes():
    compass = Compass(replace(PARAMETERS.compass, gyro_bias=0.01, hard_iron=0.0), Noise(5, "compass"))
    rest = State((0.0,) * 3, from_yaw(1.0), (0.0,) * 3, (0.0,) * 3)
    late = []
    for tick in range(round(240 * FILTER_RATE)):
        told = compass.measure(rest, tick / FILTER_RATE)
        if tick > 200 * FILTER_RATE:
            late.append(math.remainder(told.heading - heading_from_yaw(1.0), 360.0))
    assert abs(sum(late) / len(late)) < 0.3, (
        "unfound it would be three degrees: the bias by how fast the field pulls"
    )


def test_a_knock_that_its_log_does_not_tell_turns_it_by_less_than_a_tenth_of_a_degree():
    """As when something falls on it: the accelerometer disagrees by a right angle, and counts as for a twentieth of that."""
    compass = Compass(PARAMETERS.compass, Noise(0, "compass", on=False))
    compass._scale = 0.0  # its log sees nothing
    rest = State((0.0,) * 3, from_yaw(0.0), (0.0,) * 3, (0.0,) * 3)
    compass.measure(rest, 0.0)
    told = compass.measure(replace_fields(rest, velocity=(0.0, 0.8, 0.0)), 1 / FILTER_RATE)
    assert abs(math.remainder(told.heading - 90.0, 360.0)) < 0.1
    assert math.degrees(abs(told.roll)) < 0.1


def test_put_elsewhere_and_after_a_pause_it_begins_anew():
    robot = alone(MINNOW, plain(SEA))
    robot.manoeuvre(replace(AHEAD, steering=0.61))
    until(robot, 4.0)
    robot.reset()
    told = [m for topic, m in until(robot, 0.3) if topic == "/compass"][-1]
    assert abs(math.remainder(told.heading - heading_from_yaw(robot.simulation.pose()[2]), 360.0)) < 2.0
    robot.close()
    compass = Compass(PARAMETERS.compass, Noise(0, "compass", on=False))
    for stamp, yaw in ((0.0, 0.0), (0.02, 0.0), (9.0, 2.0)):
        told = compass.measure(State((0.0,) * 3, from_yaw(yaw), (0.0,) * 3, (0.0,) * 3), stamp)
    assert told.heading == pytest.approx(heading_from_yaw(2.0), abs=1e-6)


def test_it_tells_at_its_own_rate_and_works_at_another():
    robot = alone(MINNOW, plain(SEA))
    told = [m for topic, m in until(robot, 2.0) if topic == "/compass"]
    robot.close()
    assert len(told) == pytest.approx(2.0 * PARAMETERS.compass.rate, abs=1)
