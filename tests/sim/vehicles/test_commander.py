"""The truck against the figures that geometry and mechanics give."""

from __future__ import annotations

import math

import msgspec
import pytest

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.simulation.simulation import Simulation
from sim.vehicles.commander import COMMANDER, PARAMETERS, Commander
from sim.vehicles.model import Model
from tests.sim.rooms import alone, plain, room, until

pytestmark = pytest.mark.slow

AXLES = PARAMETERS.axles
MASS = (
    PARAMETERS.mass + 4 * 0.4 * AXLES.mass
)  # with what it takes to spin the wheels up, solid balls to the physics


@pytest.fixture(scope="module")
def truck():
    robot = alone(COMMANDER, plain())
    yield robot
    robot.close()


def steer(truck, speed, angle, seconds=5.0):
    truck.manoeuvre(Manoeuvre(kind="steer", speed=speed, steering=angle))
    return until(truck, seconds)


@pytest.mark.parametrize(
    ("speed", "angle"), [(1.0, 0.5), (2.0, 0.1), (2.0, -0.5), (4.0, 0.1), (4.0, 0.5), (-1.5, 0.3)]
)
def test_it_drives_the_circle_of_its_geometry(truck, speed, angle):
    """At 4 m/s and 0.5 rad the tyres hold 4.4 m/s2 sideways."""
    steer(truck, speed, angle)
    before = truck.simulation.pose()
    state = truck.simulation.vehicle.state()
    until(truck, 2.0)
    after = truck.simulation.pose()
    turned = (after[2] - before[2] + math.pi) % math.tau - math.pi
    expected = 2.0 * speed * math.tan(angle) / AXLES.base
    assert turned == pytest.approx((expected + math.pi) % math.tau - math.pi, rel=1e-3)
    chord = math.dist(before[:2], after[:2])
    radius = chord / 2 / abs(math.sin(expected / 2))
    assert radius == pytest.approx(AXLES.base / math.tan(abs(angle)), rel=5e-4)
    assert state.turning[2] == pytest.approx(expected / 2.0, rel=5e-3)


def test_its_statistics_tell_steering_radius_and_wheel_speeds(truck):
    told = [m for name, m in steer(truck, 2.0, 0.3) if name == "/ackermann"][-1]
    radius = AXLES.base / math.tan(0.3)
    assert told.steering == pytest.approx(0.3, abs=1e-3)
    assert told.turning_radius == pytest.approx(radius, rel=2e-3)
    assert told.speed == pytest.approx(2.0, rel=2e-3)
    assert told.wheels == ["rear_left", "rear_right", "front_left", "front_right"]
    middles = [(0.0, 1), (0.0, -1), (AXLES.base, 1), (AXLES.base, -1)]
    expected = [2.0 / radius * math.hypot(radius - side * AXLES.track / 2, x) for x, side in middles]
    assert list(told.wheel_speeds) == pytest.approx(expected, rel=5e-3)
    inner, outer = told.wheel_angles[2], told.wheel_angles[3]
    assert math.tan(inner) * (radius - AXLES.track / 2) == pytest.approx(AXLES.base, rel=2e-3)
    assert math.tan(outer) * (radius + AXLES.track / 2) == pytest.approx(AXLES.base, rel=2e-3)


def test_a_twist_steers_by_speed_over_yaw_rate(truck):
    truck.drive(Twist.planar(2.0, 0.4))
    until(truck, 4.0)
    assert truck.simulation.vehicle.state().turning[2] == pytest.approx(0.4, rel=5e-3)


def test_standing_it_turns_its_wheels_and_not_itself(truck):
    truck.stop()
    until(truck, 3.0)
    before = truck.simulation.pose()
    truck.drive(Twist.planar(0.0, 1.0))
    told = [m for name, m in until(truck, 2.0) if name == "/ackermann"][-1]
    assert told.steering == pytest.approx(PARAMETERS.limits.steering, abs=5e-3)
    assert truck.simulation.pose() == pytest.approx(before, abs=5e-3)


def test_driving_straight_and_braking_take_the_way_that_mechanics_give(truck):
    """Less than a thousandth of the way aside; from 5 m/s with 3 m/s2 it stands after v2/2a."""
    truck.stop()
    until(truck, 2.0)
    steer(truck, 5.0, 0.0, 4.0)
    x, y, yaw = truck.simulation.pose()
    until(truck, 4.0)
    ahead = truck.simulation.pose()
    aside = -math.sin(yaw) * (ahead[0] - x) + math.cos(yaw) * (ahead[1] - y)
    assert math.dist(ahead[:2], (x, y)) == pytest.approx(20.0, rel=1e-3)
    assert abs(aside) < 0.02
    truck.stop()
    until(truck, 3.0)
    assert math.dist(truck.simulation.pose()[:2], ahead[:2]) == pytest.approx(25 / 6, rel=0.01)


def test_a_weak_motor_starts_it_as_slowly_as_its_torque_allows():
    weak = msgspec.structs.replace(AXLES, torque=120.0)
    model = Model(Commander, msgspec.structs.replace(PARAMETERS, axles=weak), COMMANDER.looks)
    robot = alone(model, plain())
    robot.manoeuvre(Manoeuvre(kind="steer", speed=5.0))
    until(robot, 1.0)
    before = robot.simulation.vehicle.state().velocity[0]
    until(robot, 1.0)
    gained = robot.simulation.vehicle.state().velocity[0] - before
    robot.close()
    assert gained == pytest.approx(2 * 120.0 / AXLES.radius / MASS, rel=0.02)


def test_its_motors_warm_and_its_battery_empties_with_the_work_that_it_does():
    """Against a wall it works hardest on the spot; on the way it needs its rolling resistance."""
    robot = alone(COMMANDER, room(160.0, 20.0, x=-70.0))
    vehicle = robot.simulation.vehicle
    robot.manoeuvre(Manoeuvre(kind="steer", speed=4.0))
    until(robot, 4.0)
    charge, way = vehicle.battery.charge, robot.simulation.pose()[0]
    until(robot, 12.0)
    way = robot.simulation.pose()[0] - way
    spent = (charge - vehicle.battery.charge) * 160.0 * 3600 * 48.0
    rolling = AXLES.rolling * PARAMETERS.mass * 9.81 * way
    assert spent == pytest.approx(rolling / 0.85 + 80.0 * 12.0, rel=0.1)
    cool = vehicle.motors.temperatures[0]
    until(robot, 35.0)
    robot.close()
    assert robot.simulation.contacts == 1
    assert vehicle.motors.temperatures[0] > cool + 2.0


def test_a_flat_battery_brings_it_to_rest(truck):
    steer(truck, 3.0, 0.2)
    battery = truck.simulation.vehicle.battery
    full, battery.charge = battery.charge, 0.0
    until(truck, 4.0)
    battery.charge = full
    assert math.hypot(*truck.simulation.vehicle.state().velocity) < 0.01


def test_its_front_laser_sees_three_quarters_of_the_circle_from_its_bumper():
    robot = alone(COMMANDER, room(20.0, 30.0, height=1.0))  # its laser is half a metre above the ground
    scan = next(m for name, m in robot.read(0.2) if name == "/scan")
    robot.close()
    assert len(scan.ranges) == 271
    assert scan.angle_min == pytest.approx(-scan.angle_max, abs=1e-6)
    assert scan.ranges[135] == pytest.approx(10.0 - PARAMETERS.laser.ahead, abs=2e-3)
    assert scan.ranges[225] == pytest.approx(15.0, abs=2e-3)
    # backwards past its own body, which it looks through
    assert scan.ranges[270] == pytest.approx((10.0 + PARAMETERS.laser.ahead) * math.sqrt(2), abs=2e-3)


def test_an_order_that_it_does_not_know_is_refused_and_changes_nothing(truck):
    steer(truck, 1.0, 0.0, 2.0)
    with pytest.raises(
        ValueError, match="Commander-1 knows no manoeuvre 'land'; it knows twist, steer, rest"
    ):
        truck.manoeuvre(Manoeuvre(kind="land"))
    assert truck.simulation.vehicle.order.kind == "steer"


def test_it_does_not_belong_into_water():
    with pytest.raises(ValueError, match="commander needs dry land, and room is under water"):
        Simulation(plain("[water]\ndepth = 2.0\n"), COMMANDER)
