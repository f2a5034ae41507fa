"""The boat against Archimedes, Froude, and the figures of its own hull."""

from __future__ import annotations

import math
import statistics

import msgspec
import pytest

from bridge.core.units import heading_from_yaw
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.core.noise import Noise
from sim.core.shapes import compose, from_yaw
from sim.physics.backend_bullet import State
from sim.sensors.compass import Compass, levelled
from sim.vehicles.minnow import MINNOW, PARAMETERS, Minnow
from sim.vehicles.model import Model
from tests.sim.rooms import alone, plain, until

pytestmark = pytest.mark.slow

HULL = PARAMETERS.hull
WATER = "[water]\ndepth = 10.0\n"
WAVES = """[[water.waves]]
height = 0.06
period = 2.5
direction = 70
[[water.waves]]
height = 0.03
period = 1.4
direction = 20
"""


@pytest.fixture
def boat():
    robot = alone(MINNOW, plain(WATER))
    yield robot
    robot.close()


def free(**changes):
    """The boat without damping and windage, and with other figures."""
    nothing = {
        "damping": (1e-9, 1e-9, 1e-9),
        "rotary_damping": (1e-9, 1e-9, 1e-9),
        "yaw_quadratic": 0.0,
        "cross_drag": 1e-9,
        "wind_drag": 1e-9,
    }
    hull = msgspec.structs.replace(HULL, **(nothing | changes))
    return alone(
        Model(Minnow, msgspec.structs.replace(PARAMETERS, hull=hull), MINNOW.looks, "water"), plain(WATER)
    )


def motion(robot):
    vehicle = robot.simulation.vehicle
    vehicle.dynamics.update(robot.simulation.weather.current)
    return vehicle.dynamics


def test_it_floats_at_its_waterline_and_stays_there(boat):
    until(boat, 5.0)
    state = boat.simulation.vehicle.state()
    assert math.dist(state.position, (0.0, 0.0, 0.0)) < 1e-6


def test_a_load_sinks_it_by_the_water_that_weighs_as_much(boat):
    hull = boat.simulation.vehicle.hull
    forces = hull.forces

    def loaded(body):
        (x, y, z), torque = forces(body)
        return (x, y, z - 10.0), torque

    hull.forces = loaded
    until(boat, 8.0)
    expected = -10.0 / (1000.0 * GRAVITY * HULL.waterplane)
    assert boat.simulation.vehicle.state().position[2] == pytest.approx(expected, rel=1e-3)


def inertia(axis):
    """About roll or pitch while the hull is free to slide, and of heave."""
    height = HULL.centre_of_mass[2]
    if axis == "heave":
        return HULL.mass + HULL.added_mass[2]
    number = ("roll", "pitch").index(axis)
    sliding = HULL.mass + HULL.added_mass[1 - number]
    about = HULL.inertia[number] + HULL.added_inertia[number] + HULL.mass * height**2
    return about - (HULL.mass * height) ** 2 / sliding


STIFFNESS = {
    "heave": 1000.0 * GRAVITY * HULL.waterplane,
    "roll": HULL.mass * GRAVITY * HULL.metacentric[0],
    "pitch": HULL.mass * GRAVITY * HULL.metacentric[1],
}


@pytest.mark.parametrize("axis", STIFFNESS)
def test_it_swings_with_the_period_of_its_stiffness_and_its_mass_with_the_waters(axis):
    robot = free()
    simulation, vehicle = robot.simulation, robot.simulation.vehicle
    kick = {"heave": ((0.0, 0.0, 0.02), (0.0, 0.0, 0.0))}
    turn = {"roll": (0.05, 0.0, 0.0), "pitch": (0.0, 0.05, 0.0)}
    velocity, turning = kick.get(axis, ((0.0, 0.0, 0.0), turn.get(axis, (0.0, 0.0, 0.0))))
    simulation.backend.set_velocity(vehicle.body, velocity, turning)
    before, crossings = 0.0, []
    while len(crossings) < 9:
        simulation.advance()
        state = vehicle.state()
        now = {
            "heave": state.velocity[2],
            "roll": state.turning[0],
            "pitch": state.turning[1],
        }[axis]
        if before < 0 <= now:
            crossings.append(simulation.time - now / (now - before) / STEPS_PER_SECOND)
        before = now
    robot.close()
    period = (crossings[-1] - crossings[0]) / (len(crossings) - 1)
    assert period == pytest.approx(math.tau * math.sqrt(inertia(axis) / STIFFNESS[axis]), rel=2e-3)


def test_at_full_throttle_thrust_and_drag_balance(boat):
    """And 63 % of that it has after the time that mass over damping gives, and the propeller's lag."""
    boat.manoeuvre(Manoeuvre(kind="steer", throttle=1.0))
    reached = None
    while boat.simulation.time < 12.0:
        until(boat, 0.02)
        speed = motion(boat).through[0]
        if reached is None and speed > 0.632 * 2.0:
            reached = boat.simulation.time
    drag = HULL.damping[0] * speed + 1.225 / 2 * HULL.wind_drag * HULL.windage[0] * speed**2
    assert drag == pytest.approx(PARAMETERS.propeller.thrust, rel=1e-3)
    assert speed == pytest.approx(2.0, abs=0.02)
    lag = (HULL.mass + HULL.added_mass[0]) / HULL.damping[0]
    assert reached == pytest.approx(lag + PARAMETERS.propeller.lag, abs=0.08)


def test_astern_its_propeller_pushes_less(boat):
    boat.manoeuvre(Manoeuvre(kind="steer", throttle=-1.0))
    until(boat, 12.0)
    speed = motion(boat).through[0]
    drag = HULL.damping[0] * speed - 1.225 / 2 * HULL.wind_drag * HULL.windage[0] * speed**2
    full = PARAMETERS.propeller.thrust * PARAMETERS.propeller.astern
    assert drag == pytest.approx(-full, rel=1e-3)


def test_a_rudder_to_the_left_turns_it_left_while_it_slides_outward(boat):
    boat.manoeuvre(Manoeuvre(kind="steer", throttle=1.0, steering=math.radians(20)))
    until(boat, 15.0)
    body = motion(boat)
    radius = math.hypot(*body.through[:2]) / body.turning[2]
    assert 2.0 < radius / HULL.length < 4.5
    assert math.radians(25) < body.turning[2] < math.radians(40)
    assert body.through[1] < -0.1


def test_with_the_rudder_hard_over_it_turns_on_the_radius_that_it_tells(boat):
    boat.manoeuvre(Manoeuvre(kind="steer", throttle=1.0, steering=boat.info.max_steering))
    until(boat, 15.0)
    state = boat.simulation.vehicle.state()
    assert math.hypot(*state.velocity[:2]) / state.turning[2] == pytest.approx(boat.info.min_radius, rel=0.05)


def test_without_throttle_the_rudder_does_nothing(boat):
    boat.manoeuvre(Manoeuvre(kind="steer", throttle=0.0, steering=0.5))
    told = [m for name, m in until(boat, 4.0) if name == "/rudder"][-1]
    assert (told.angle, told.wanted) == pytest.approx((0.5, 0.5))
    assert abs(boat.simulation.pose()[2]) < 1e-6


def test_it_comes_round_to_a_course_and_stays_on_it_in_waves():
    robot = alone(MINNOW, plain(WATER + WAVES), seed=1, noise=True)
    robot.manoeuvre(Manoeuvre(kind="course", throttle=0.6, yaw=0.0))
    until(robot, 5.0)
    robot.manoeuvre(Manoeuvre(kind="course", throttle=0.6, yaw=math.radians(60)))
    way = []
    for _ in range(250):
        until(robot, 0.1)
        way.append(math.degrees(robot.simulation.pose()[2]))
    robot.close()
    assert max(way) < 60.0 + 8.0
    assert abs(statistics.mean(way[100:]) - 60.0) < 2.0
    assert statistics.stdev(way[100:]) < 3.0


def test_waves_roll_pitch_and_lift_it_as_steep_and_high_as_they_are():
    robot = alone(MINNOW, plain(WATER + WAVES))
    rows = []
    for _ in range(600):
        until(robot, 0.05)
        state = robot.simulation.vehicle.state()
        x, y, z, w = state.rotation
        rows.append((state.position[2], 2 * (w * x + y * z), 2 * (w * y - z * x)))
    robot.close()
    heave, roll, pitch = (statistics.pstdev(column) for column in zip(*rows, strict=True))
    assert heave == pytest.approx(math.hypot(0.03, 0.015) / math.sqrt(2), rel=0.15)
    assert 0.5 < math.degrees(roll) < 3.0
    assert 0.3 < math.degrees(pitch) < 3.0


def test_it_drifts_with_the_current_and_before_the_wind():
    robot = alone(MINNOW, plain("[water]\ndepth = 10.0\ncurrent = [0.3, -0.2]\n"))
    robot.manoeuvre(Manoeuvre(kind="steer", throttle=0.0))
    until(robot, 15.0)
    assert robot.simulation.vehicle.state().velocity[:2] == pytest.approx((0.3, -0.2), abs=0.01)
    robot.close()
    windy = alone(MINNOW, plain(WATER + "[wind]\nspeed = 6.0\ndirection = 0\n"))
    windy.manoeuvre(Manoeuvre(kind="steer", throttle=0.0))
    until(windy, 15.0)
    speed = windy.simulation.vehicle.state().velocity[0]
    windy.close()
    push = 1.225 / 2 * HULL.wind_drag * HULL.windage[0] * (6.0 - speed) ** 2
    assert push == pytest.approx(HULL.damping[0] * speed, rel=0.02)


def test_a_twist_is_held_by_throttle_and_rudder(boat):
    boat.drive(Twist.planar(1.0, 0.2))
    until(boat, 20.0)
    body = motion(boat)
    assert body.through[0] == pytest.approx(1.0, abs=0.1)
    assert body.turning[2] == pytest.approx(0.2, abs=0.02)


def test_told_to_stop_it_goes_astern_until_it_lies_still(boat):
    boat.drive(Twist.planar(2.0, 0.0))
    until(boat, 8.0)
    before = boat.simulation.pose()[0]
    boat.stop()
    until(boat, 6.0)
    assert math.hypot(*motion(boat).through) < 0.03
    assert boat.simulation.pose()[0] - before < 2.0


def test_hovering_it_waits_and_keeps_its_bow_where_it_is_told(boat):
    boat.manoeuvre(Manoeuvre(kind="hover", yaw=0.7))
    until(boat, 20.0)
    x, y, yaw = boat.simulation.pose()
    assert yaw == pytest.approx(0.7, abs=0.1)
    assert math.hypot(x, y) < 4.0


@pytest.mark.parametrize(("yaw", "roll", "pitch"), [(0.3, 0.6, 0.0), (-2.0, -0.5, 0.4), (1.9, 0.0, -0.6)])
def test_its_compass_is_right_however_it_lies(yaw, roll, pitch):
    rolled = (math.sin(roll / 2), 0.0, 0.0, math.cos(roll / 2))
    pitched = (0.0, math.sin(pitch / 2), 0.0, math.cos(pitch / 2))
    rest = State((0.0, 0.0, 0.0), compose(from_yaw(yaw), compose(pitched, rolled)), (0.0,) * 3, (0.0,) * 3)
    told = Compass(PARAMETERS.compass, Noise(0, "compass", on=False)).measure(rest, 0.0)
    assert told.heading == pytest.approx(heading_from_yaw(yaw), abs=1e-9)
    assert (told.roll, told.pitch) == pytest.approx((roll, pitch), abs=1e-12)


def test_its_compass_knows_no_heading_while_it_falls():
    assert all(math.isnan(angle) for angle in levelled((0.0, 0.3, -0.9), (0.0, 0.0, 0.0)))


def test_its_battery_empties_with_the_work_of_its_propeller(boat):
    vehicle = boat.simulation.vehicle
    boat.manoeuvre(Manoeuvre(kind="steer", throttle=1.0))
    until(boat, 2.0)
    charge = vehicle.battery.charge
    until(boat, 20.0)
    spent = (charge - vehicle.battery.charge) * 10.0 * 3600 * 14.8
    shaft = PARAMETERS.propeller.speed * PARAMETERS.propeller.torque
    copper = PARAMETERS.motor.copper * PARAMETERS.propeller.torque**2
    expected = 20.0 * (PARAMETERS.battery.idle + shaft / PARAMETERS.motor.efficiency + copper)
    assert spent == pytest.approx(expected, rel=0.01)
    assert 25.0 < vehicle.motors.temperatures[0] < 60.0
    vehicle.battery.charge = 0.0
    until(boat, 6.0)
    assert vehicle.works.thrust == pytest.approx(0.0, abs=1e-6)


def test_dead_reckoning_follows_the_true_way_and_drifts_with_noise():
    errors = {}
    for noise in (False, True):
        robot = alone(MINNOW, plain(WATER), seed=3, noise=noise)
        robot.drive(Twist.planar(1.0, 0.1))
        told = [m for name, m in until(robot, 20.0) if name == "/odom"][-1].pose.pose.position
        errors[noise] = math.dist((told.x, told.y), robot.simulation.pose()[:2])
        robot.close()
    assert errors[False] < 0.1
    assert 0.1 < errors[True] < 4.0


def test_it_needs_water():
    with pytest.raises(ValueError, match="minnow needs water, and there is none in room"):
        alone(MINNOW, plain())


def test_it_tells_the_course_that_it_took_when_it_was_told_to_keep_it(boat):
    boat.manoeuvre(Manoeuvre(kind="steer", throttle=0.8, steering=0.4))
    until(boat, 4.0)
    yaw = boat.simulation.pose()[2]
    boat.manoeuvre(Manoeuvre(kind="course", throttle=0.5))
    told = [message for topic, message in until(boat, 3.0) if topic == "/manoeuvre"][-1]
    assert told.yaw == pytest.approx(yaw)
    assert math.isnan(told.height)
