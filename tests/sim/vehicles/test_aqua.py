"""The swimmer against Archimedes, its own drag, and what its fins can push."""

from __future__ import annotations

import math
import statistics

import msgspec
import pytest

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.sensors.depth import AIR_PRESSURE
from sim.vehicles.aqua import AQUA, PARAMETERS, Aqua
from sim.vehicles.aqua.pilot import angles
from sim.vehicles.model import Model
from tests.sim.rooms import alone, plain, until

pytestmark = pytest.mark.slow

BODY, FINS = PARAMETERS.body, PARAMETERS.fins
WATER = "[water]\ndepth = 12.0\n"
WEIGHT = BODY.mass * GRAVITY


def swimmer(*, z=-4.0, extra="", noise=False, body=None, fins=None, speed=None):
    figures = PARAMETERS
    if body:
        figures = msgspec.structs.replace(figures, body=msgspec.structs.replace(BODY, **body))
    if fins:
        figures = msgspec.structs.replace(figures, fins=msgspec.structs.replace(FINS, **fins))
    if speed:
        figures = msgspec.structs.replace(
            figures, limits=msgspec.structs.replace(PARAMETERS.limits, speed=speed)
        )
    return alone(Model(Aqua, figures, AQUA.looks, "water"), plain(WATER + extra, z), noise=noise)


@pytest.fixture
def aqua():
    robot = swimmer()
    yield robot
    robot.close()


def body(robot):
    vehicle = robot.simulation.vehicle
    vehicle.dynamics.update(robot.simulation.weather.current)
    return vehicle.dynamics


def height(robot):
    return robot.simulation.vehicle.state().position[2]


def test_weighing_what_it_displaces_it_hangs_where_it_is():
    robot = swimmer(body={"buoyancy": 1.0})
    before = robot.simulation.vehicle.state().position
    until(robot, 10.0)
    moved = math.dist(before, robot.simulation.vehicle.state().position)
    robot.close()
    assert moved < 1e-6


def test_left_alone_it_rises_as_fast_as_its_drag_allows():
    robot = swimmer(body={"buoyancy": 1.05}, z=-8.0)
    until(robot, 15.0)
    rising = body(robot).through[2]
    robot.close()
    drag = 1000.0 / 2 * BODY.drag[2] * BODY.length * BODY.width
    assert rising == pytest.approx(math.sqrt(0.05 * WEIGHT / drag), rel=1e-3)


@pytest.mark.parametrize("buoyancy", [1.02, 1.2])
def test_at_the_surface_it_draws_what_archimedes_says(buoyancy):
    robot = swimmer(body={"buoyancy": buoyancy}, z=0.0)
    until(robot, 20.0)
    floating = height(robot)
    robot.close()
    assert floating == pytest.approx(BODY.height / 2 - BODY.height / buoyancy, abs=5e-5)


def test_it_swings_like_the_pendulum_that_its_buoyancy_makes_of_it():
    robot = swimmer(body={"buoyancy": 1.0})
    simulation, vehicle = robot.simulation, robot.simulation.vehicle
    simulation.backend.set_velocity(vehicle.body, (0.0, 0.0, 0.0), (0.02, 0.0, 0.0))
    before, crossings = 0.0, []
    while len(crossings) < 3:
        simulation.advance()
        now = vehicle.state().turning[0]
        if before < 0 <= now:
            crossings.append(simulation.time - now / (now - before) / STEPS_PER_SECOND)
        before = now
    robot.close()
    period = (crossings[-1] - crossings[0]) / 2
    inertia = BODY.inertia[0] + BODY.added_inertia[0]
    assert period == pytest.approx(math.tau * math.sqrt(inertia / (WEIGHT * BODY.lift_arm)), rel=5e-3)


@pytest.mark.parametrize("frequency", [2.5, 4.0, 6.0])
def test_with_all_fins_at_full_swing_their_thrust_and_its_drag_balance(frequency):
    robot = swimmer(body={"buoyancy": 1.0}, fins={"frequency": frequency}, speed=5.0)
    robot.manoeuvre(Manoeuvre(kind="course", throttle=1.0))
    until(robot, 12.0)
    ahead = body(robot).through[0]
    fins = robot.simulation.vehicle.fins
    robot.close()
    drag = 1000.0 / 2 * BODY.drag[0] * BODY.width * BODY.height
    area = (FINS.root + 2 * FINS.tip) * FINS.length**2 / 3
    thrust = 6 * FINS.thrust * area * 1000.0 * FINS.amplitude * frequency
    assert fins.strongest * 6 == pytest.approx(thrust)
    assert ahead == pytest.approx(math.sqrt(thrust / drag), rel=2e-3)
    assert 0.6 < ahead < 1.1


def test_it_comes_to_a_depth_and_a_heading_and_holds_both():
    """A metre deeper and a quarter round: less than 15 cm too far, within 2 cm after 18 s, then still to 5 mm."""
    robot = swimmer(noise=True)
    robot.manoeuvre(Manoeuvre(kind="hover", yaw=math.pi / 2, height=-5.0))
    way = []
    for _ in range(150):
        until(robot, 0.2)
        way.append((height(robot), robot.simulation.pose()[2]))
    robot.close()
    heights = [z for z, _ in way]
    assert min(heights) > -5.15
    assert all(abs(z + 5.0) < 0.02 for z in heights[90:])
    assert statistics.pstdev(heights[100:]) < 0.005
    turned = next(number for number, (_, yaw) in enumerate(way) if abs(yaw - math.pi / 2) < 0.05)
    assert turned * 0.2 < 6.0
    assert way[-1][1] == pytest.approx(math.pi / 2, abs=0.01)


def test_its_fins_hold_down_what_it_is_too_light_by_from_the_first_moment(aqua):
    aqua.manoeuvre(Manoeuvre(kind="hover"))
    until(aqua, 0.5)
    before = height(aqua)
    until(aqua, 3.0)
    assert abs(height(aqua) - before) < 0.008


def test_a_fin_turns_round_no_faster_than_it_can():
    robot = swimmer()
    robot.manoeuvre(Manoeuvre(kind="course", throttle=1.0))
    until(robot, 3.0)
    robot.manoeuvre(Manoeuvre(kind="course", throttle=-1.0))
    fins, way = robot.simulation.vehicle.fins, []
    for _ in range(60):
        before = fins.offsets[0]
        robot.simulation.advance()
        way.append(abs(math.remainder(fins.offsets[0] - before, math.tau)))
    robot.close()
    assert max(way) == pytest.approx(FINS.turn_rate / STEPS_PER_SECOND)


def test_a_twist_moves_what_it_holds(aqua):
    aqua.drive(Twist(Vector3(0.4, 0.0, -0.1), Vector3(0.0, 0.0, 0.2)))
    until(aqua, 10.0)
    before = height(aqua)
    until(aqua, 5.0)
    assert body(aqua).through[0] == pytest.approx(0.4, abs=0.06)
    assert body(aqua).turning[2] == pytest.approx(0.2, abs=0.01)
    assert (height(aqua) - before) / 5.0 == pytest.approx(-0.1, abs=0.02)


def test_after_the_twist_it_stays_at_the_depth_and_heading_that_it_has(aqua):
    aqua.drive(Twist(Vector3(0.0, 0.0, -0.2), Vector3(0.0, 0.0, 0.3)))
    until(aqua, 4.0)
    aqua.drive(Twist())
    until(aqua, 6.0)
    depth, yaw = height(aqua), aqua.simulation.pose()[2]
    until(aqua, 6.0)
    assert height(aqua) == pytest.approx(depth, abs=0.03)
    assert aqua.simulation.pose()[2] == pytest.approx(yaw, abs=0.02)


def test_told_to_sink_no_more_it_goes_no_farther_than_its_way_takes_it(aqua):
    aqua.drive(Twist(Vector3(0.0, 0.0, -PARAMETERS.limits.climb)))
    until(aqua, 5.0)
    before = height(aqua)
    lowest = before
    aqua.drive(Twist())
    for _ in range(60):
        until(aqua, 0.1)
        lowest = min(lowest, height(aqua))
    assert before - lowest < 0.25


def test_held_nose_down_it_swims_down(aqua):
    aqua.manoeuvre(Manoeuvre(kind="tilt", speed=0.4, pitch=0.4, roll=0.3))
    until(aqua, 6.0)
    before = height(aqua)
    roll, pitch, _ = angles(body(aqua))
    assert (roll, pitch) == pytest.approx((0.3, 0.4), abs=0.06)
    until(aqua, 4.0)
    assert height(aqua) - before < -0.3


@pytest.mark.parametrize(("roll", "pitch"), [(0.0, 0.8), (0.0, -0.8), (0.8, 0.0), (-0.8, 0.0), (0.8, -0.8)])
def test_it_holds_the_greatest_roll_and_pitch_that_it_takes_under_way(roll, pitch):
    """0.8 rad each: within 0.03 rad of it, and its speed through the water is what it is told."""
    robot = swimmer(z=-6.0)
    robot.manoeuvre(Manoeuvre(kind="tilt", speed=0.5, roll=roll, pitch=pitch))
    until(robot, 9.0)
    dynamics = body(robot)
    robot.close()
    assert angles(dynamics)[:2] == pytest.approx((roll, pitch), abs=0.03)
    assert dynamics.through[0] == pytest.approx(0.5, abs=0.01)


def test_it_surfaces_when_it_is_told_and_stays_there(aqua):
    aqua.manoeuvre(Manoeuvre(kind="surface"))
    until(aqua, 30.0)
    afloat = BODY.height / 2 - BODY.height / BODY.buoyancy
    assert height(aqua) == pytest.approx(afloat, abs=0.02)


def test_told_to_stop_its_fins_take_its_way_off_and_hold_still(aqua):
    aqua.drive(Twist.planar(0.6, 0.3))
    until(aqua, 6.0)
    aqua.stop()
    until(aqua, 4.0)
    assert abs(body(aqua).through[0]) < 0.05
    until(aqua, 1.0)
    assert aqua.simulation.vehicle.fins.amplitudes == [0.0] * 6


def test_the_current_takes_it_along():
    robot = swimmer(extra="current = [0.2, 0.1]\n")
    robot.manoeuvre(Manoeuvre(kind="hover"))
    until(robot, 20.0)
    velocity = robot.simulation.vehicle.state().velocity
    robot.close()
    assert velocity[:2] == pytest.approx((0.2, 0.1), abs=0.03)


def test_its_gauge_tells_the_weight_of_the_water_over_it(aqua):
    told = [m for name, m in until(aqua, 0.5) if name == "/depth"][-1]
    assert (told.fluid_pressure - AIR_PRESSURE) / 1000.0 / GRAVITY == pytest.approx(-height(aqua), abs=1e-3)


def test_its_legs_swing_against_each_other_and_warm_with_their_load(aqua):
    aqua.manoeuvre(Manoeuvre(kind="course", throttle=1.0))
    messages = until(aqua, 60.0)
    legs = [m for name, m in messages if name == "/joint_states"]
    motors = [m for name, m in messages if name == "/motors"][-1]
    assert len(legs[-1].name) == len(motors.names) == 6
    swings = [message.position[0] * message.position[1] for message in legs[-100:]]
    assert statistics.mean(swings) < 0
    assert all(23.0 < degrees < 45.0 for degrees in motors.temperatures)
    torque = FINS.thrust * (FINS.root + 2 * FINS.tip) * FINS.length**3 / 3 * 1000 * FINS.frequency
    assert max(motors.torques) <= torque * FINS.amplitude + 1e-9
    spent = (PARAMETERS.battery.charge - aqua.simulation.vehicle.battery.charge) * 14.0 * 3600 * 28.8
    assert spent > 60.0 * PARAMETERS.battery.idle * 1.2


@pytest.mark.parametrize("kind", ["hover", "course"])
def test_it_tells_the_depth_and_the_heading_that_it_took_when_it_was_told_to_keep_them(aqua, kind):
    aqua.drive(Twist(Vector3(0.0, 0.0, -0.2), Vector3(0.0, 0.0, 0.3)))
    until(aqua, 3.0)
    taken, yaw = height(aqua), angles(body(aqua))[2]
    aqua.manoeuvre(Manoeuvre(kind=kind))
    for _ in range(2):
        told = [message for topic, message in until(aqua, 3.0) if topic == "/manoeuvre"][-1]
        assert told.kind == kind
        assert (told.height, told.yaw) == pytest.approx((taken, yaw))
    aqua.manoeuvre(Manoeuvre(kind=kind, height=-2.0, yaw=1.0))
    told = [message for topic, message in until(aqua, 0.2) if topic == "/manoeuvre"][-1]
    assert (told.height, told.yaw) == (-2.0, 1.0)
