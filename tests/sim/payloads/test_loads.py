"""What is mounted weighs: it costs charge and pace, sinks a boat and keeps a drone on the ground."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.core.constants import GRAVITY
from sim.core.load import Load, with_loads
from sim.payloads import PAYLOADS, laden, load
from sim.robot import ROBOTS, make, make_several
from tests.sim.rooms import alone, plain, until

WATER = plain("[water]\ndepth = 10.0\n")
FIGURES = load()
ARM, LIGHTS, SONAR = (getattr(FIGURES, name).mass for name in ("arm", "lights", "sonar"))


def carrying(name, *payloads, world=None):
    """A robot with the weight of its payloads, and without what they take of power."""
    return alone(laden(ROBOTS[name], payloads), world or plain())


def told(robot, seconds, topic):
    return [message for name, message in until(robot, seconds) if name == topic][-1]


def test_the_parallel_axis_theorem():
    two = with_loads(2.0, (0.0, 0.0, 0.1), (0.02, 0.03, 0.04), [Load(1.0, (0.3, 0.0, 0.4))])
    assert two.mass == 3.0
    assert two.centre == pytest.approx((0.1, 0.0, 0.2))
    reduced = 2.0 * 1.0 / 3.0
    assert two.moments == pytest.approx(
        (0.02 + reduced * 0.3**2, 0.03 + reduced * (0.3**2 + 0.3**2), 0.04 + reduced * 0.3**2)
    )


@pytest.mark.parametrize("name", ROBOTS)
def test_a_robot_that_carries_nothing_is_the_one_that_it_was(name):
    assert laden(ROBOTS[name], []) is ROBOTS[name]


@pytest.mark.parametrize("name", [name for name in ROBOTS if name != "ardrone"])
def test_every_payload_weighs_on_every_vehicle(name):
    own = ROBOTS[name].parameters
    for payload in PAYLOADS:
        heavier = laden(ROBOTS[name], [payload]).parameters
        body, before = (getattr(one, "hull", None) or one.body for one in (heavier, own))
        assert body.mass == pytest.approx(before.mass + getattr(FIGURES, payload).mass)
        assert all(more >= less for more, less in zip(body.inertia, before.inertia, strict=True))
        assert sum(body.inertia) > sum(before.inertia)


def test_what_is_mounted_by_name_weighs():
    one = make("scout", "office", camera=False, payloads=["arm"])
    others = make_several(["scout", "scout"], "office", camera=False, payloads=[[], ["arm"]])
    masses = [robot.simulation.vehicles[number].parameters.body.mass for number, robot in enumerate(others)]
    own = ROBOTS["scout"].parameters.body.mass
    assert one.simulation.vehicle.parameters.body.mass == pytest.approx(own + ARM)
    assert masses == pytest.approx([own, own + ARM])
    for robot in (one, *others):
        robot.close()


def test_a_boat_sinks_by_the_water_that_weighs_as_much_and_heels_to_no_side():
    robot = carrying("minnow", "arm", "lights", world=WATER)
    until(robot, 8.0)
    state = robot.simulation.vehicle.state()
    robot.close()
    area = ROBOTS["minnow"].parameters.hull.waterplane
    assert state.position[2] == pytest.approx(-(ARM + LIGHTS) / (1000.0 * area), rel=0.02)
    assert state.rotation[0] == pytest.approx(0.0, abs=1e-6)


def test_a_boat_dips_its_bow_by_the_moment_of_what_stands_there():
    robot = carrying("minnow", "arm", world=WATER)
    until(robot, 10.0)
    _, y, _, w = robot.simulation.vehicle.state().rotation
    robot.close()
    hull = ROBOTS["minnow"].parameters.hull
    deck = hull.depth - hull.draft + FIGURES.arm.at[2] + FIGURES.arm.centre[2]
    stiffness = hull.mass * GRAVITY * hull.metacentric[1] - ARM * GRAVITY * deck
    expected = ARM * GRAVITY * FIGURES.arm.at[0] / stiffness
    assert 2 * math.atan2(y, w) == pytest.approx(expected, rel=0.05)


def test_a_boat_that_lies_deeper_is_slower():
    speeds = []
    for payloads in ((), ("arm", "lights")):
        robot = carrying("minnow", *payloads, world=WATER)
        robot.manoeuvre(Manoeuvre(kind="steer", throttle=1.0))
        until(robot, 10.0)
        vehicle = robot.simulation.vehicle
        vehicle.dynamics.update((0.0, 0.0, 0.0))
        speeds.append(vehicle.dynamics.through[0])
        robot.close()
    hull = ROBOTS["minnow"].parameters.hull
    deeper = (ARM + LIGHTS) / (1000.0 * hull.waterplane) / hull.draft
    assert speeds[1] == pytest.approx(speeds[0] / (1 + deeper), rel=0.01)


def test_a_drone_hovers_on_the_speed_that_carries_its_lights_and_takes_more_for_it():
    hovering = []
    for payloads in ((), ("lights",)):
        robot = carrying("ardrone", *payloads)
        robot.manoeuvre(Manoeuvre(kind="take_off", height=1.0))
        until(robot, 8.0)
        vehicle = robot.simulation.vehicle
        own = ROBOTS["ardrone"].parameters
        mass = own.body.mass + (LIGHTS if payloads else 0.0)
        expected = math.sqrt(mass * GRAVITY / 4 / own.rotors.lift)
        assert vehicle.rotors.speeds == pytest.approx([expected] * 4, rel=1e-3)
        assert vehicle.state().position[2] == pytest.approx(1.0, abs=0.02)
        hovering.append(vehicle.battery.power - own.battery.idle)
        robot.close()
    assert hovering[1] > 1.6 * hovering[0]


def test_what_a_drone_cannot_lift_is_refused_in_one_sentence():
    said = r"Ardrone-1 carries 0\.23 kg at most; the payload weighs 0\.98 kg\."
    with pytest.raises(ValueError, match=said):
        make("ardrone", "parking_lot", camera=False, payloads=["arm", "lights"])


def test_wheels_roll_under_what_they_carry():
    powers, torques = [], []
    for payloads in ((), ("arm", "sonar")):
        robot = carrying("patrol", *payloads)
        robot.drive(Twist.planar(0.6, 0.0))
        until(robot, 4.0)
        powers.append(robot.simulation.vehicle.battery.power)
        torques.append(sum(robot.simulation.vehicle.motors.torques))
        until(robot, 2.0)
        assert told(robot, 0.2, "/odom").twist.twist.linear.x == pytest.approx(0.6, abs=0.01)
        robot.close()
    own = ROBOTS["patrol"].parameters
    mass = own.body.mass + 2 * own.wheels.mass + 2 * own.casters.mass
    heavier = (mass + ARM + SONAR) / mass
    assert torques[1] / torques[0] == pytest.approx(heavier, rel=0.03)
    assert (powers[1] - own.battery.idle) / (powers[0] - own.battery.idle) > 0.97 * heavier


def test_a_swimmer_is_trimmed_and_slower_to_start():
    ways = []
    for payloads in ((), ("arm", "lights")):
        robot = carrying("aqua", *payloads, world=plain("[water]\ndepth = 12.0\n", -4.0))
        robot.manoeuvre(Manoeuvre(kind="hover"))
        until(robot, 4.0)
        assert robot.simulation.vehicle.state().position[2] == pytest.approx(-4.0, abs=0.01)
        robot.manoeuvre(Manoeuvre(kind="course", throttle=1.0))
        until(robot, 1.5)
        ways.append(robot.simulation.vehicle.state().position[0])
        robot.close()
    assert ways[1] < 0.99 * ways[0]
