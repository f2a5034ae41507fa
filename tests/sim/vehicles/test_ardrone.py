"""The quadrotor against its own weight, thrust and drag."""

from __future__ import annotations

import math
import statistics

import msgspec
import pytest

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.core.constants import GRAVITY
from sim.robot import make
from sim.vehicles.ardrone import ARDRONE, PARAMETERS, Ardrone
from sim.vehicles.model import Model
from tests.sim.rooms import alone, plain, room, until

pytestmark = pytest.mark.slow

BODY, ROTORS = PARAMETERS.body, PARAMETERS.rotors


@pytest.fixture
def drone():
    robot = alone(ARDRONE, plain())
    yield robot
    robot.close()


def motion(robot):
    vehicle = robot.simulation.vehicle
    vehicle.dynamics.update((0.0, 0.0, 0.0))
    return vehicle.motion()


def fly(robot, height=2.0):
    robot.manoeuvre(Manoeuvre(kind="take_off", height=height))
    until(robot, 4.0)
    robot.manoeuvre(Manoeuvre(kind="hover", yaw=0.0, height=height))
    until(robot, 8.0)


def track(robot, seconds, value, every=0.02):
    """Times and values of what is looked at, from now on."""
    rows, start = [], robot.simulation.time
    while robot.simulation.time < start + seconds - 1e-9:
        until(robot, every)
        rows.append((robot.simulation.time - start, value(motion(robot))))
    return rows


def test_it_hovers_on_the_speed_that_carries_its_weight(drone):
    fly(drone)
    before = motion(drone).position
    until(drone, 10.0)
    vehicle = drone.simulation.vehicle
    expected = math.sqrt(BODY.mass * GRAVITY / 4 / ROTORS.lift)
    assert expected == pytest.approx(361.57, abs=0.01)
    assert vehicle.rotors.speeds == pytest.approx([expected] * 4, rel=2e-4)
    assert math.dist(before, motion(drone).position) < 0.01


def test_a_crazyflie_of_published_figures_hovers_and_climbs_as_its_simulator_has_it():
    """gym-pybullet-drones (MIT licence): CF2X hovers at 14 468 turns a minute, and lifts 2.25 times its weight; g is 9.8."""
    per_turn = (60 / math.tau) ** 2
    replace = msgspec.structs.replace
    figures = replace(
        PARAMETERS,
        body=replace(BODY, mass=0.027, inertia=(1.4e-5, 1.4e-5, 2.17e-5), width=0.1, height=0.03),
        rotors=replace(
            ROTORS,
            arm=0.0397,
            lift=3.16e-10 * per_turn,
            torque=7.94e-12 * per_turn,
            lag=0.02,
            speed=21_702 / 60 * math.tau,
        ),
    )
    robot = alone(Model(Ardrone, figures, ARDRONE.looks, "air"), plain())
    fly(robot)
    speeds = robot.simulation.vehicle.rotors.speeds
    robot.close()
    turns = [speed / math.tau * 60 * math.sqrt(9.8 / GRAVITY) for speed in speeds]
    assert turns == pytest.approx([14_468.4] * 4, rel=5e-4)
    assert (figures.rotors.speed / figures.hover) ** 2 == pytest.approx(2.25, rel=2e-3)


def test_it_stands_until_it_is_told_to_take_off(drone):
    drone.drive(Twist(Vector3(1.0, 0.0, 0.0), Vector3(0.0, 0.0, 1.0)))
    told = [m for name, m in until(drone, 2.0) if name == "/flight"][-1]
    assert told.phase == "landed"
    assert motion(drone).position[2] == pytest.approx(BODY.height / 2, abs=1e-3)
    assert drone.simulation.vehicle.rotors.speeds == [0.0] * 4


def test_taking_off_and_landing_it_tells_its_phases(drone):
    drone.manoeuvre(Manoeuvre(kind="take_off"))
    phases = [m.phase for name, m in until(drone, 6.0) if name == "/flight"]
    assert motion(drone).position[2] == pytest.approx(1.05, abs=0.06)
    drone.manoeuvre(Manoeuvre(kind="land"))
    phases += [m.phase for name, m in until(drone, 6.0) if name == "/flight"]
    assert list(dict.fromkeys(phases)) == ["taking_off", "flying", "landing", "landed"]
    assert drone.simulation.vehicle.rotors.speeds == pytest.approx([0.0] * 4, abs=1.0)
    assert drone.simulation.contacts == 0


@pytest.mark.parametrize("kind", ["twist", "tilt"])
def test_no_twist_or_tilt_starts_its_rotors(drone, kind):
    drone.manoeuvre(Manoeuvre(kind=kind, twist=Twist(Vector3(0.0, 0.0, 1.0))))
    until(drone, 2.0)
    assert drone.simulation.vehicle.pilot.phase == "landed"
    assert drone.simulation.vehicle.rotors.speeds == [0.0] * 4


def test_a_twist_downward_lands(drone):
    fly(drone)
    drone.drive(Twist(Vector3(0.0, 0.0, -0.3)))
    until(drone, 10.0)
    assert drone.simulation.vehicle.pilot.phase == "landed"


@pytest.mark.parametrize(("axis", "rise"), [(0, 1.6), (2, 1.9)])
def test_a_step_of_a_metre_is_made_soon_and_hardly_too_far(drone, axis, rise):
    """From a tenth to nine tenths; less than 10 % too far; within 5 cm after 6 s."""
    fly(drone)
    start = motion(drone).position[axis]
    vehicle = drone.simulation.vehicle
    if axis == 2:
        drone.manoeuvre(Manoeuvre(kind="hover", yaw=0.0, height=3.0))
    else:
        vehicle.pilot._place[axis] += 1.0
    rows = track(drone, 8.0, lambda now: now.position[axis] - start)
    low = next(time for time, value in rows if value > 0.1)
    high = next(time for time, value in rows if value > 0.9)
    assert high - low < rise
    assert max(value for _, value in rows) < 1.1
    assert all(abs(value - 1.0) < 0.05 for time, value in rows if time > 6.0)


def test_it_turns_on_the_spot_and_keeps_its_height(drone):
    fly(drone)
    height = motion(drone).position[2]
    drone.manoeuvre(Manoeuvre(kind="hover", yaw=math.pi / 2))
    rows = track(drone, 3.0, lambda now: (now.angles[2], now.position[2]))
    turned = next(time for time, (yaw, _) in rows if abs(yaw - math.pi / 2) < math.radians(2))
    assert turned < 1.5
    assert max(abs(z - height) for _, (_, z) in rows) < 0.04


@pytest.mark.parametrize("degrees", [5.0, 10.0, 20.0])
def test_tilted_it_flies_as_fast_as_its_drag_allows(drone, degrees):
    fly(drone, 5.0)
    pitch = math.radians(degrees)
    drone.manoeuvre(Manoeuvre(kind="tilt", pitch=pitch))
    until(drone, 14.0)
    now = motion(drone)
    speed = now.velocity[0]
    sine, cosine = math.sin(pitch), math.cos(pitch)
    dx, _, dz = BODY.drag
    thrust = sum(ROTORS.lift * rotor**2 for rotor in drone.simulation.vehicle.rotors.speeds)
    assert thrust * sine == pytest.approx(speed * (dx * cosine**2 + dz * sine**2), rel=5e-3)
    assert speed == pytest.approx(BODY.mass * GRAVITY * math.tan(pitch) / dx, rel=0.05)
    assert now.angles[1] == pytest.approx(pitch, abs=2e-3)


def test_a_twist_is_flown_as_fast_as_it_says_and_let_go_it_stays(drone):
    fly(drone)
    drone.drive(Twist(Vector3(1.0, 0.5, 0.2), Vector3(0.0, 0.0, 0.3)))
    until(drone, 6.0)
    now = motion(drone)
    cosine, sine = math.cos(now.angles[2]), math.sin(now.angles[2])
    vx, vy, vz = now.velocity
    assert (cosine * vx + sine * vy, cosine * vy - sine * vx) == pytest.approx((1.0, 0.5), abs=0.15)
    assert vz == pytest.approx(0.2, abs=0.02)
    assert now.turning[2] == pytest.approx(0.3, abs=0.01)
    drone.drive(Twist())
    until(drone, 3.0)
    before = motion(drone).position
    until(drone, 5.0)
    assert math.dist(before, motion(drone).position) < 0.15


def test_told_to_stop_in_the_air_it_hovers_there(drone):
    fly(drone)
    drone.drive(Twist.planar(2.0, 0.0))
    until(drone, 3.0)
    before = motion(drone).position
    drone.stop()
    until(drone, 4.0)
    now = motion(drone)
    assert math.hypot(*now.velocity) < 0.1
    assert math.dist(before, now.position) < 2.0
    assert drone.simulation.vehicle.pilot.phase == "flying"


def test_told_to_stop_just_over_the_ground_it_sets_down(drone):
    fly(drone, 0.15)
    drone.stop()
    until(drone, 3.0)
    assert drone.simulation.vehicle.pilot.phase == "landed"
    assert max(drone.simulation.vehicle.rotors.speeds) < 1.0


@pytest.mark.parametrize("kind", ["take_off", "land"])
def test_told_to_stop_half_way_up_or_down_it_hovers_there(drone, kind):
    if kind == "land":
        fly(drone, 3.0)
    drone.manoeuvre(Manoeuvre(kind=kind, height=3.0))
    until(drone, 2.0)
    before = motion(drone).position[2]
    drone.stop()
    until(drone, 4.0)
    assert 0.5 < before < 2.6
    assert motion(drone).position[2] == pytest.approx(before, abs=0.7)
    assert abs(motion(drone).velocity[2]) < 0.05
    assert drone.simulation.vehicle.pilot.phase == "flying"


def test_gusts_move_it_about_and_do_not_take_it_away():
    """With 1 m/s of gusts it stays within a metre and tilts by less than 20 degrees."""
    robot = alone(ARDRONE, plain("[wind]\nspeed = 0.0\ngusts = 1.0\ngust_time = 1.0\n"), seed=2, noise=True)
    fly(robot)
    before = motion(robot).position
    rows = track(robot, 20.0, lambda now: (math.dist(before[:2], now.position[:2]), now.upright), 0.1)
    robot.close()
    assert max(away for _, (away, _) in rows) < 1.0
    assert statistics.mean(away for _, (away, _) in rows) > 0.02
    assert math.degrees(math.acos(min(upright for _, (_, upright) in rows))) < 20.0


@pytest.mark.parametrize("wind", [2.0, 5.5, 7.0])
def test_in_a_steady_wind_it_leans_as_its_drag_has_it_and_beyond_its_greatest_tilt_it_is_carried_off(wind):
    """m g tan θ / d: 6.3 m/s at 20 degrees is the most that it stands against; the rest is its way over the ground."""
    robot = alone(ARDRONE, plain(f"[wind]\nspeed = {wind}\ndirection = 0\ngusts = 0.0\n"))
    fly(robot, 3.0)
    until(robot, 16.0)
    now = motion(robot)
    robot.close()
    most = PARAMETERS.limits.tilt
    lean = -now.angles[1]
    assert lean == pytest.approx(min(most, math.atan(BODY.drag[0] * wind / (BODY.mass * GRAVITY))), abs=3e-3)
    dx, _, dz = BODY.drag
    sine, cosine = math.sin(lean), math.cos(lean)
    against = wind - now.velocity[0]
    thrust = sum(ROTORS.lift * rotor**2 for rotor in robot.simulation.vehicle.rotors.speeds)
    assert thrust * sine == pytest.approx(against * (dx * cosine**2 + dz * sine**2), rel=5e-3)
    assert (now.velocity[0] > 0.5) == (wind > 6.5)
    assert now.position[2] == pytest.approx(3.0, abs=0.02)


def test_its_ultrasound_tells_the_height_over_what_is_under_it(drone):
    fly(drone)
    told = [m for name, m in until(drone, 0.5) if name == "/range/down"][-1]
    assert told.range == pytest.approx(motion(drone).position[2], abs=2e-3)
    drone.manoeuvre(Manoeuvre(kind="hover", height=8.0))
    messages = until(drone, 10.0)
    assert [m for name, m in messages if name == "/range/down"][-1].range == math.inf
    assert math.isnan([m for name, m in messages if name == "/flight"][-1].height)


def test_it_flies_no_higher_than_it_may(drone):
    fly(drone, 29.0)
    drone.drive(Twist(Vector3(0.0, 0.0, 1.0)))
    until(drone, 30.0)
    assert motion(drone).position[2] < PARAMETERS.limits.height + 1.0


def test_its_battery_carries_it_for_about_a_quarter_of_an_hour_and_then_it_lands(drone):
    fly(drone)
    vehicle = drone.simulation.vehicle
    charge = vehicle.battery.charge
    until(drone, 10.0)
    shaft = 4 * ROTORS.torque * PARAMETERS.hover**3
    copper = 4 * PARAMETERS.motor.copper * (ROTORS.torque * PARAMETERS.hover**2) ** 2
    spent = (charge - vehicle.battery.charge) * 1.5 * 3600 * 11.1
    assert spent == pytest.approx(10 * (6.0 + shaft / 0.75 + copper), rel=0.01)
    assert 10 * 60 < (1 - 0.05) * 1.5 * 3600 * 11.1 / (spent / 10) < 18 * 60
    vehicle.battery.charge = 0.04
    for _ in range(600):
        until(drone, 1 / 60)
        drone.manoeuvre(Manoeuvre(kind="hover"))  # whoever flies it cannot keep it up until it falls
    assert vehicle.pilot.phase == "landed"


def test_it_bumps_into_a_wall_and_flies_on():
    robot = alone(ARDRONE, room(6.0, 6.0))
    fly(robot, 0.3)
    robot.drive(Twist.planar(0.8, 0.0))
    until(robot, 4.0)
    assert robot.simulation.contacts == 1
    robot.drive(Twist.planar(-0.5, 0.0))
    until(robot, 3.0)
    x = robot.simulation.pose()[0]
    robot.close()
    assert x < 2.5


def test_tumbled_it_cuts_its_rotors_and_does_not_start_again():
    robot = alone(ARDRONE, room(6.0, 6.0))
    fly(robot, 0.3)
    simulation = robot.simulation
    vehicle = simulation.vehicle
    over = 0.5 * math.radians(170.0)
    simulation.backend.place(vehicle.body, (0.0, 0.0, 0.2), (math.sin(over), 0.0, 0.0, math.cos(over)))
    until(robot, 6.0)
    assert motion(robot).upright < 0.3
    assert vehicle.pilot.phase == "landed"
    assert max(vehicle.rotors.speeds) < 1.0
    with pytest.raises(ValueError, match="has turned over"):
        robot.manoeuvre(Manoeuvre(kind="take_off"))
    until(robot, 2.0)
    robot.close()
    assert vehicle.pilot.phase == "landed"


def test_the_raft_that_it_stands_on_in_the_water_is_no_obstacle():
    robot = make("ardrone", "lake", camera=False)
    robot.read(0.0)
    told = [message for topic, message in robot.read(0.5) if topic == "/bumper"]
    stands = robot.simulation.vehicle.grounded
    bumps = robot.simulation.contacts
    robot.close()
    assert told
    assert not any(message.pressed for message in told)
    assert (stands, bumps) == (True, 0)


def test_it_tells_the_height_and_the_heading_that_it_keeps(drone):
    drone.manoeuvre(Manoeuvre(kind="take_off"))
    told = [message for topic, message in until(drone, 0.2) if topic == "/manoeuvre"][-1]
    assert told.height == pytest.approx(1.05, abs=0.01)
    until(drone, 4.0)
    drone.drive(Twist(Vector3(0.0, 0.0, 0.5), Vector3(0.0, 0.0, 0.5)))
    until(drone, 2.0)
    yaw = motion(drone).angles[2]
    drone.manoeuvre(Manoeuvre(kind="hover"))
    braking, *_, held = [message for topic, message in until(drone, 4.0) if topic == "/manoeuvre"]
    assert math.isnan(braking.height)
    assert held.height == pytest.approx(motion(drone).position[2], abs=0.05)
    assert held.yaw == pytest.approx(yaw, abs=1e-6)


def test_on_its_back_it_says_so_and_refuses_to_take_off():
    robot = alone(ARDRONE, plain())
    vehicle = robot.simulation.vehicle
    vehicle.scene.backend.place(vehicle.body, (0.0, 0.0, 0.1), (1.0, 0.0, 0.0, 0.0))
    told = [message for topic, message in until(robot, 1.0) if topic == "/flight"]
    assert told[-1].phase == "turned_over"
    with pytest.raises(
        ValueError, match="Ardrone-1 has turned over: its rotors do not start; put it upright"
    ):
        robot.manoeuvre(Manoeuvre(kind="take_off"))
    assert vehicle.order.kind == "rest", "what was refused is not followed"
    robot.reset()
    told = [message for topic, message in until(robot, 0.5) if topic == "/flight"]
    assert told[-1].phase == "landed"
    robot.manoeuvre(Manoeuvre(kind="take_off"))
    robot.close()


def test_landed_it_has_no_speed_whatever_its_log_says_and_carried_it_has():
    robot = alone(ARDRONE, plain(), noise=True)
    vehicle = robot.simulation.vehicle
    told = [message for topic, message in until(robot, 5.0) if topic == "/odom"]
    assert {(way.x, way.y, way.z) for way in (message.twist.twist.linear for message in told)} == {(0, 0, 0)}
    assert {message.pose.pose.position.x for message in told} == {0.0}
    fly(robot)
    told = [message for topic, message in until(robot, 1.0) if topic == "/odom"]
    assert all(message.twist.twist.linear.x for message in told)
    robot.manoeuvre(Manoeuvre(kind="land"))
    until(robot, 10.0)
    vehicle.scene.backend.set_velocity(vehicle.body, (0.3, 0.0, 0.0), (0.0, 0.0, 0.0))
    told = [message for topic, message in until(robot, 0.1) if topic == "/odom"]
    robot.close()
    assert told[0].twist.twist.linear.x > 0.05
