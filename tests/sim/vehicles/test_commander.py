"""The truck against the figures that geometry and mechanics give."""

from __future__ import annotations

import math

import msgspec
import pytest
from msgspec.structs import replace

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.simulation.simulation import Simulation
from sim.vehicles.commander import COMMANDER, PARAMETERS, Commander
from sim.vehicles.model import Model
from tests.sim.dynamics.single_track import closed_form, steady
from tests.sim.rooms import alone, plain, room, until

pytestmark = pytest.mark.slow

AXLES = PARAMETERS.axles
MASS = PARAMETERS.mass + 4 * 0.5 * AXLES.mass  # with what it takes to spin the wheels up, even discs


@pytest.fixture(scope="module")
def truck():
    robot = alone(COMMANDER, plain())
    yield robot
    robot.close()


def steer(truck, speed, angle, seconds=5.0):
    truck.manoeuvre(Manoeuvre(kind="steer", speed=speed, steering=angle))
    return until(truck, seconds)


def motion(truck):
    """Speed of the middle of the rear axle along the body, its angle to its way, and the turn rate."""
    state, yaw = truck.simulation.vehicle.state(), truck.simulation.pose()[2]
    (vx, vy, _), turning = state.velocity, state.turning[2]
    along = math.cos(yaw) * vx + math.sin(yaw) * vy
    aside = math.cos(yaw) * vy - math.sin(yaw) * vx - PARAMETERS.body.centre_of_mass[0] * turning
    return along, math.atan2(aside, abs(along)), turning


def on(surface):
    """The plain with another ground."""
    world = plain()
    return replace(world, ground=replace(world.ground, surface=surface))


SETTLING = 13
"""From one way to the other it takes its time on wet grass [s]."""
ENVELOPE = [(speed, angle) for speed in (1.0, 2.0, 3.0, 4.0, 5.0) for angle in (0.1, 0.2, 0.3, 0.4, 0.52)]


@pytest.mark.parametrize("surface", ["asphalt", "wet_grass"])
def test_over_all_speeds_and_angles_it_turns_as_its_tyres_and_the_grip_allow(surface):
    """Within a hundredth of the balance of forces, steadily, no farther athwart than tyres slip; never above the friction limit."""
    world = on(surface)
    grip = world.ground.grip
    robot = alone(COMMANDER, world)
    simulation = robot.simulation
    misses, limits = {}, {}
    for speed, angle in [*ENVELOPE, (-2.0, 0.3), (-1.5, 0.52), (3.0, -0.4)]:
        robot.manoeuvre(Manoeuvre(kind="steer", speed=speed, steering=angle))
        drifts, rates = [], []
        for step in range(SETTLING * STEPS_PER_SECOND):
            simulation.advance()
            if step % 24:
                continue
            along, drift, rate = motion(robot)
            if abs(along) > 0.5:
                drifts.append(abs(drift))
            if step > (SETTLING - 2) * STEPS_PER_SECOND:
                rates.append(rate)
        turn = steady(PARAMETERS, along, abs(angle), grip)
        expected = math.copysign(turn.rate, angle * speed)
        misses[speed, angle] = max(abs(rate / expected - 1) for rate in rates)
        limits[speed, angle] = abs(along * rate) / (grip * GRAVITY)
        assert max(drifts) < math.radians(6.0)
    robot.close()
    assert max(misses.values()) < 0.012
    assert max(limits.values()) < 1.0
    assert limits[5.0, 0.52] > 0.75, "beyond its grip it uses what there is"


@pytest.mark.parametrize(("speed", "angle"), [(1.0, 0.5), (2.0, 0.1), (2.0, -0.3), (3.0, 0.1)])
def test_well_within_the_grip_it_turns_by_speed_and_angle_with_its_understeer_gradient(truck, speed, angle):
    """r = v tan δ / (L + K v²): the geometry alone would be a hundredth off at 3 m/s."""
    steer(truck, speed, angle, 6.0)
    along, _, rate = motion(truck)
    assert rate == pytest.approx(closed_form(PARAMETERS, along, angle), rel=4e-3)
    if speed == 3.0:
        assert rate < along * math.tan(angle) / AXLES.base * 0.985


def test_slow_it_drives_the_circle_of_its_geometry(truck):
    """What a planner may count on: L / tan δ within half a hundredth at 1 m/s."""
    steer(truck, 1.0, 0.5)
    along, _, rate = motion(truck)
    assert along / rate == pytest.approx(AXLES.base / math.tan(0.5), rel=5e-3)


def test_on_wet_grass_its_wheels_lock_and_it_slides_as_far_as_friction_has_it():
    """3 m/s2 of its brakes are more than the 1.96 that the ground gives: v²/2μg, and a little before they lock."""
    world = on("wet_grass")
    robot = alone(COMMANDER, world)
    robot.manoeuvre(Manoeuvre(kind="steer", speed=5.0))
    until(robot, 8.0)
    before, speed = robot.simulation.pose(), motion(robot)[0]
    robot.stop()
    until(robot, 1.7)
    wheels = [m for name, m in until(robot, 0.1) if name == "/ackermann"][-1].wheel_speeds
    assert max(map(abs, wheels)) < 0.05, "locked"
    assert motion(robot)[0] > 1.0
    until(robot, 4.0)
    way = math.dist(before[:2], robot.simulation.pose()[:2])
    robot.close()
    sliding = speed**2 / (2 * world.ground.grip * GRAVITY)
    assert sliding < way < 1.06 * sliding


def test_on_wet_grass_its_tyres_start_it_no_faster_than_the_rear_ones_hold():
    world = on("wet_grass")
    robot = alone(COMMANDER, world)
    robot.manoeuvre(Manoeuvre(kind="steer", speed=5.0))
    until(robot, 0.5)
    before = motion(robot)[0]
    until(robot, 1.0)
    gained = motion(robot)[0] - before
    robot.close()
    assert gained < 0.6 * world.ground.grip * GRAVITY
    assert gained > 0.7 * 0.5 * world.ground.grip * GRAVITY


def test_standing_it_is_held_by_its_tyres_against_a_push_and_comes_back_from_it(truck):
    """2000 N, less than the grip: it leans into its tyres by millimetres, does not creep, and stands again where it stood."""
    truck.stop()
    until(truck, 4.0)
    simulation, vehicle = truck.simulation, truck.simulation.vehicle
    before = simulation.pose()

    def push(seconds):
        for _ in range(round(seconds * STEPS_PER_SECOND)):
            position = simulation.backend.motion(vehicle.body)[0]
            simulation.backend.apply(
                vehicle.body, (position[0], position[1], 0.0), (0.0, 2000.0, 0.0), (0.0,) * 3
            )
            simulation.advance()

    push(3.0)
    first = simulation.pose()
    push(3.0)
    assert 1e-3 < math.dist(first[:2], before[:2]) < 0.03
    assert math.dist(simulation.pose()[:2], first[:2]) < 1e-3
    until(truck, 6.0)
    assert math.dist(simulation.pose()[:2], before[:2]) < 1e-3
    assert simulation.backend.asleep


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
    expected = closed_form(PARAMETERS, 2.0, math.atan(0.4 * AXLES.base / 2.0))
    assert expected == pytest.approx(0.4, rel=0.01)
    assert truck.simulation.vehicle.state().turning[2] == pytest.approx(expected, rel=0.01)


def test_standing_it_turns_its_wheels_and_not_itself(truck):
    truck.stop()
    until(truck, 3.0)
    before = truck.simulation.pose()
    truck.drive(Twist.planar(0.0, 1.0))
    told = [m for name, m in until(truck, 2.0) if name == "/ackermann"][-1]
    assert told.steering == pytest.approx(PARAMETERS.limits.steering, abs=5e-3)
    assert truck.simulation.pose() == pytest.approx(before, abs=5e-3)


def test_driving_straight_and_braking_take_the_way_that_mechanics_give(truck):
    """Less than a thousandth of the way aside; from 5 m/s with 3 m/s2 of the wheels it stands after v²/2a and what the tyres slip."""
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
    slip = 3.0 / GRAVITY / ((PARAMETERS.tyres.front + PARAMETERS.tyres.rear) / 2)
    way = math.dist(truck.simulation.pose()[:2], ahead[:2])
    assert way == pytest.approx(25 / 6 * (1 + slip), rel=0.01)


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
