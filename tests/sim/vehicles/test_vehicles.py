"""The patrol robot against the figures that physics and its data give."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Twist
from sim.vehicles.parameters import load
from sim.vehicles.patrol import PARAMETERS, PatrolParameters
from tests.sim.rooms import robot_in, room

pytestmark = pytest.mark.slow


@pytest.fixture
def robot():
    robot = robot_in(room())
    yield robot
    robot.close()


def last(messages, name):
    return [message for topic, message in messages if topic == name][-1]


def test_it_drives_as_fast_as_it_is_told(robot):
    robot.drive(Twist.planar(0.7, 0.0))
    robot.read(3.0)
    start = robot.simulation.pose()
    robot.read(8.0)
    assert (robot.simulation.pose()[0] - start[0]) / 5 == pytest.approx(0.7, rel=1e-3)


def test_it_turns_as_fast_as_it_is_told(robot):
    robot.drive(Twist.planar(0.0, 1.0))
    robot.read(2.0)
    start = robot.simulation.pose()[2]
    robot.read(4.0)
    assert (robot.simulation.pose()[2] - start) % math.tau == pytest.approx(2.0, rel=1e-3)


def test_it_drives_a_circle_of_speed_over_yaw_rate(robot):
    robot.drive(Twist.planar(0.7, 1.0))
    robot.read(2.0)
    points = []
    for i in range(63):
        robot.read(2.0 + i * 0.1)
        points.append(robot.simulation.pose())
    breadth = max(x for x, _, _ in points) - min(x for x, _, _ in points)
    assert breadth / 2 == pytest.approx(0.7, rel=0.01)


def test_it_stops_within_the_distance_that_its_brakes_allow(robot):
    robot.drive(Twist.planar(0.7, 0.0))
    robot.read(3.0)
    before = robot.simulation.pose()[0]
    robot.stop()
    robot.read(5.0)
    assert robot.simulation.pose()[0] - before == pytest.approx(
        0.7**2 / (2 * PARAMETERS.limits.braking), abs=0.01
    )


def test_told_to_drive_at_zero_it_slows_down_gently(robot):
    robot.drive(Twist.planar(0.7, 0.0))
    robot.read(3.0)
    before = robot.simulation.pose()[0]
    robot.drive(Twist())
    robot.read(5.0)
    assert robot.simulation.pose()[0] - before == pytest.approx(0.7**2 / 2, abs=0.01)


@pytest.mark.parametrize("twist", [Twist.planar(0.7, 0.0), Twist.planar(0.0, 1.9), Twist.planar(0.7, 1.9)])
def test_told_to_stop_it_rests_within_a_fifth_of_a_second(robot, twist):
    robot.drive(twist)
    robot.read(3.0)
    robot.stop()
    robot.read(3.2)
    speed = last(robot.read(3.3), "/odom").twist.twist
    assert abs(speed.linear.x) < 0.01
    assert abs(speed.angular.z) < 0.02


def test_it_is_at_rest_after_stopping(robot):
    robot.drive(Twist.planar(0.5, 1.0))
    robot.read(2.0)
    robot.stop()
    robot.read(3.0)
    rest = robot.simulation.pose()
    robot.read(6.0)
    assert robot.simulation.pose() == pytest.approx(rest, abs=1e-4)


def test_a_twist_beyond_its_limits_is_cut_to_them(robot):
    robot.drive(Twist.planar(5.0, 0.0))
    speed = last(robot.read(3.0), "/odom").twist.twist.linear.x
    assert speed == pytest.approx(PARAMETERS.limits.speed, rel=1e-3)


def test_it_drives_backwards_as_well(robot):
    robot.drive(Twist.planar(-0.4, 0.0))
    robot.read(5.0)
    assert robot.simulation.pose()[0] == pytest.approx(-2.0 + 0.4**2 / 2, abs=0.02)


def test_it_drives_straight(robot):
    robot.drive(Twist.planar(0.7, 0.0))
    robot.read(20.0)
    _, y, yaw = robot.simulation.pose()
    assert abs(y) < 0.02
    assert abs(yaw) < 0.005


def test_it_hardly_nods_when_it_brakes(robot):
    robot.drive(Twist.planar(0.7, 0.0))
    robot.read(2.0)
    robot.stop()
    messages = robot.read(3.0)
    tilt = max(abs(message.orientation.pitch) for name, message in messages if name == "/imu/data")
    assert tilt < math.radians(1.0)


def test_it_is_held_by_a_wall_and_does_not_topple():
    robot = robot_in(room(4.0, 4.0))
    robot.drive(Twist.planar(0.7, 0.0))
    robot.read(10.0)
    x, _, _ = robot.simulation.pose()
    assert x == pytest.approx(2.0 - PARAMETERS.body.radius, abs=0.01)
    assert robot.simulation.contacts == 1
    robot.close()


def test_pushing_against_a_wall_warms_its_motors_and_takes_more_power_than_driving(robot):
    robot.drive(Twist.planar(0.3, 0.0))
    robot.read(2.0)
    driving = robot.simulation.vehicle.battery.power
    held = robot_in(room(4.0, 4.0, x=1.7))
    held.drive(Twist.planar(0.3, 0.0))
    told = last(held.read(10.0), "/motors")
    held.close()
    assert held.simulation.vehicle.battery.power > 1.2 * driving
    assert told.names == ["left", "right"]
    assert min(told.temperatures) > 20.2


def test_driving_costs_its_rolling_resistance(robot):
    robot.drive(Twist.planar(0.6, 0.0))
    robot.read(2.0)
    battery = robot.simulation.vehicle.battery
    charge = battery.charge
    robot.read(12.0)
    own = PARAMETERS
    spent = (charge - battery.charge) * own.battery.capacity * 3600 * own.battery.voltage
    mass = own.body.mass + 2 * own.wheels.mass + 2 * own.casters.mass
    work = own.rolling.resistance * mass * 9.81 * 0.6 * 10.0
    assert spent - own.battery.idle * 10.0 == pytest.approx(work / own.motor.efficiency, rel=0.1)


def test_it_tells_the_order_that_it_follows(robot):
    robot.drive(Twist.planar(0.4, 0.2))
    assert last(robot.read(0.5), "/manoeuvre").twist == Twist.planar(0.4, 0.2)
    robot.stop()
    assert last(robot.read(1.0), "/manoeuvre").kind == "rest"


def test_the_same_wall_bumped_again_later_is_another_contact():
    robot = robot_in(room(4.0, 4.0, x=1.0))
    now = 0.0
    for speed in (0.5, -0.5, 0.5, -0.5):
        robot.drive(Twist.planar(speed, 0.0))
        now += 3.0 if speed > 0 else 1.5
        robot.read(now)
    assert robot.simulation.contacts == 2
    robot.close()


def test_a_drive_without_obstacle_counts_no_contact(robot):
    robot.drive(Twist.planar(0.7, 0.3))
    robot.read(10.0)
    assert robot.simulation.contacts == 0


def test_a_faulty_parameter_is_named_with_its_key(tmp_path):
    file = tmp_path / "bad.toml"
    file.write_text("[info]\nname = 3\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r"bad\.toml, line 2: info\.name: must be a text in quotes, not 3\."):
        load(file, PatrolParameters)
