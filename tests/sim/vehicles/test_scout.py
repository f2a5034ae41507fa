"""The SuperScout against geometry and the figures of its drive."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Twist
from sim.vehicles.scout import PARAMETERS, SCOUT
from tests.sim.rooms import alone, plain, room, until

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def scout():
    robot = alone(SCOUT, plain())
    yield robot
    robot.close()


def sonars(world, *, noise=False, seconds=0.1):
    robot = alone(SCOUT, world, noise=noise)
    ring = [m for name, m in robot.read(seconds) if name == "/sonar"][-1]
    robot.close()
    return ring


@pytest.mark.parametrize("speed", [1.0, 0.3, -0.5])
def test_it_drives_as_fast_as_it_is_told(scout, speed):
    scout.drive(Twist.planar(speed, 0.0))
    until(scout, 2.5)
    before = scout.simulation.pose()
    until(scout, 2.0)
    assert math.dist(before[:2], scout.simulation.pose()[:2]) == pytest.approx(2 * abs(speed), rel=1e-3)


def test_it_turns_as_fast_as_it_is_told(scout):
    scout.drive(Twist.planar(0.0, 1.0))
    until(scout, 2.5)
    before = scout.simulation.pose()[2]
    until(scout, 2.0)
    assert (scout.simulation.pose()[2] - before) % math.tau == pytest.approx(2.0, rel=1e-3)


def test_it_stops_within_the_distance_that_its_brakes_allow(scout):
    scout.drive(Twist.planar(1.0, 0.0))
    until(scout, 2.5)
    before = scout.simulation.pose()
    scout.stop()
    until(scout, 1.5)
    way = math.dist(before[:2], scout.simulation.pose()[:2])
    assert way == pytest.approx(1 / 2 / PARAMETERS.limits.braking, abs=0.02)


def test_its_odometry_closes_a_circle(scout):
    robot = alone(SCOUT, plain())
    robot.drive(Twist.planar(0.7, 1.0))
    told = [m for name, m in until(robot, 8.0) if name == "/odom"][-1].pose.pose.position
    x, y, _ = robot.simulation.pose()
    robot.close()
    assert math.dist((told.x, told.y), (x, y)) < 0.01


def test_its_sixteen_sonars_measure_a_room():
    """Each tells the nearest that its cone meets, from the ring, in whole inches."""
    ring = sonars(room(8.0, 6.0))
    assert len(ring.ranges) == 16
    assert list(ring.bearings) == pytest.approx(
        [math.remainder(math.tau * i / 16, math.tau) for i in range(16)]
    )
    own = PARAMETERS.sonar
    for bearing, distance in zip(ring.bearings, ring.ranges, strict=True):
        x, y = own.radius * math.cos(bearing), own.radius * math.sin(bearing)
        reaches = []
        for number in range(own.beams):
            angle = bearing + own.field_of_view * (number / (own.beams - 1) - 0.5)
            dx, dy = math.cos(angle), math.sin(angle)
            reaches += [
                (4.0 * math.copysign(1, dx) - x) / dx if abs(dx) > 1e-9 else math.inf,
                (3.0 * math.copysign(1, dy) - y) / dy if abs(dy) > 1e-9 else math.inf,
            ]
        assert distance == pytest.approx(min(reaches), abs=own.step)
        assert distance / own.step == pytest.approx(round(distance / own.step), abs=1e-4)


def test_in_a_corridor_left_and_right_tell_the_same():
    ranges = list(sonars(room(40.0, 3.0)).ranges)
    assert ranges[1:8] == pytest.approx(ranges[:8:-1])
    assert ranges[0] == ranges[8] == math.inf


def test_too_near_is_minus_inf():
    assert sonars(room(6.0, 6.0, x=2.7)).ranges[0] == -math.inf


def test_with_noise_they_err_by_a_part_of_the_range():
    exact, noisy = sonars(room(8.0, 6.0)), sonars(room(8.0, 6.0), noise=True)
    errors = [abs(a - b) / b for a, b in zip(noisy.ranges, exact.ranges, strict=True)]
    assert 0 < max(errors) < 0.06


def test_its_bumper_tells_where_it_touches():
    robot = alone(SCOUT, room(4.0, 4.0))
    robot.drive(Twist.planar(0.8, 0.0))
    pressed = [m for name, m in until(robot, 4.0) if name == "/bumper" and m.pressed]
    assert robot.simulation.contacts == 1
    assert pressed[0].bearing == pytest.approx(0.0, abs=0.05)
    robot.close()


def test_pushing_against_a_wall_warms_its_motors_and_costs_more_than_waiting():
    robot = alone(SCOUT, room(4.0, 4.0, x=1.5))
    vehicle = robot.simulation.vehicle
    until(robot, 1.0)
    waiting = vehicle.battery.power
    robot.drive(Twist.planar(0.5, 0.0))
    until(robot, 15.0)
    warm = vehicle.motors.temperatures
    robot.close()
    assert waiting == pytest.approx(PARAMETERS.battery.idle, abs=0.5)
    assert vehicle.battery.power > 1.2 * waiting
    assert min(warm) > 20.2


def test_driving_costs_its_rolling_resistance(scout):
    vehicle = scout.simulation.vehicle
    scout.drive(Twist.planar(0.8, 0.0))
    until(scout, 3.0)
    charge, before = vehicle.battery.charge, scout.simulation.pose()
    until(scout, 10.0)
    spent = (charge - vehicle.battery.charge) * 17.0 * 3600 * 24.0
    way = math.dist(before[:2], scout.simulation.pose()[:2])
    mass = 23.0 + 2 * 0.5 + 2 * 0.15
    assert spent == pytest.approx(300.0 + 0.02 * mass * 9.81 * way / 0.65, rel=0.05)
