"""A world in which nothing moves sleeps, and whatever acts wakes it in the very next step."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre
from bridge.msgs.sensor_msgs import BatteryState, Imu, LaserScan
from sim.core.constants import STEPS_PER_SECOND
from sim.core.shapes import Shape
from sim.physics import sleep
from sim.physics.backend_bullet import Bullet
from sim.physics.quiet_pybullet import p
from sim.robot import make, make_several
from sim.world.tables import Start

pytestmark = pytest.mark.slow

UPRIGHT = (0.0, 0.0, 0.0, 1.0)


@pytest.fixture
def steps(monkeypatch):
    """Steps that the engine really does."""
    done = []
    step = p.stepSimulation
    monkeypatch.setattr(p, "stepSimulation", lambda **which: done.append(which) or step(**which))
    return done


def run(backend, seconds):
    for _ in range(round(seconds * STEPS_PER_SECOND)):
        backend.step()


@pytest.fixture
def backend():
    backend = Bullet()
    backend.add_ground()
    yield backend
    backend.close()


@pytest.fixture
def box(backend):
    """At rest on the ground, asleep."""
    number = backend.add_body(Shape("box", (0.2, 0.2, 0.2), (0.0, 0.0, 0.1)), 1.0)
    run(backend, 2.0)
    assert backend.asleep
    return number


def test_a_world_at_rest_does_no_steps_and_stays_as_it_is(backend, box, steps):
    before = backend.state(box)
    run(backend, 10.0)
    assert steps == []
    assert backend.state(box) == before


def test_what_falls_from_rest_does_not_sleep(backend):
    ball = backend.add_body(Shape("sphere", (0.2, 0.2, 0.2), (0.0, 0.0, 9.0)), 1.0)
    run(backend, 1.0)
    assert backend.state(ball).velocity[2] == pytest.approx(-9.81, abs=1e-6)


@pytest.mark.parametrize(
    "act",
    [
        lambda backend, box: backend.set_velocity(box, (1.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
        lambda backend, box: backend.apply(box, (0.0, 0.0, 0.1), (90.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
        lambda backend, box: backend.place(box, (0.0, 0.0, 1.0), UPRIGHT),
        lambda backend, box: backend.add_body(Shape("sphere", (0.1, 0.1, 0.1), (5.0, 0.0, 1.0)), 1.0),
    ],
    ids=["velocity", "force", "place", "another body"],
)
def test_whatever_acts_on_a_body_is_felt_in_the_next_step(backend, box, act, steps):
    act(backend, box)
    backend.step()
    assert len(steps) == 1
    assert not backend.asleep


def test_a_force_moves_what_sleeps_as_far_as_what_never_did(monkeypatch):
    def pushed():
        backend = Bullet()
        backend.add_ground()
        box = backend.add_body(Shape("box", (0.2, 0.2, 0.2), (0.0, 0.0, 0.1)), 1.0)
        run(backend, 2.0)
        slept = backend.asleep
        for _ in range(60):
            backend.apply(box, backend.state(box).position, (20.0, 0.0, 0.0), (0.0, 0.0, 0.0))
            backend.step()
        x = backend.state(box).position[0]
        backend.close()
        return slept, x

    slept, way = pushed()
    monkeypatch.setattr(sleep, "STILL_STEPS", math.inf)
    awake, full = pushed()
    assert (slept, awake) == (True, False)
    assert full > 0.1
    assert way == pytest.approx(full, rel=1e-3)


def test_what_was_measured_holds_only_while_nothing_moves(backend, box):
    eye = backend.add_body(Shape("sphere", (0.02, 0.02, 0.02), (-2.0, 0.0, 0.1)), 0.001)
    run(backend, 2.0)
    start, end = [(0.0, 0.0, 0.0)], [(10.0, 0.0, 0.0)]
    first = backend.rays(eye, start, end)
    assert backend.rays(eye, start, end) is first
    assert float(first[0]) == pytest.approx(0.19, abs=1e-3)
    backend.place(box, (1.0, 0.0, 0.1), UPRIGHT)
    assert float(backend.rays(eye, start, end)[0]) == pytest.approx(0.29, abs=1e-3)
    backend.add_static((Shape("box", (0.2, 2.0, 2.0), (0.0, 0.0, 0.0)),))
    assert float(backend.rays(eye, start, end)[0]) == pytest.approx(0.19, abs=1e-3)


# robots


@pytest.fixture(params=["patrol", "scout", "commander"])
def robot(request):
    """At rest, asleep."""
    robot = make(request.param, "parking_lot", seed=3, camera=False)
    robot.want("/sim/ground_truth", True)
    robot.read(0.0)
    robot.read(2.0)
    assert robot.simulation.backend.asleep
    yield robot
    robot.close()


def test_a_command_turns_the_wheels_in_the_same_step(robot):
    robot.drive(Twist.planar(0.5, 0.0))
    robot.read(2.0 + 1 / STEPS_PER_SECOND)
    vehicle = robot.simulation.vehicle
    wheels = vehicle.joints[:2]
    assert all(wheel.speed > 1e-3 for wheel in wheels)


def test_it_drives_and_stops_as_one_that_never_slept(monkeypatch):
    def driven():
        robot = make("patrol", "parking_lot", seed=3, camera=False)
        robot.read(0.0)
        robot.read(5.0)
        slept = robot.simulation.backend.asleep
        robot.drive(Twist.planar(0.5, 0.3))
        robot.read(8.0)
        moving = robot.simulation.pose()
        robot.stop()
        robot.read(12.0)
        rest = robot.simulation.pose()
        robot.close()
        return slept, moving, rest

    slept, moving, rest = driven()
    monkeypatch.setattr(sleep, "STILL_STEPS", math.inf)
    awake, moving_awake, rest_awake = driven()
    assert (slept, awake) == (True, False)
    assert moving == pytest.approx(moving_awake, abs=1e-4)
    assert rest == pytest.approx(rest_awake, abs=1e-3)


def test_a_robot_that_brakes_is_awake_until_it_stands(robot):
    robot.drive(Twist.planar(0.5, 0.0))
    robot.read(4.0)
    robot.stop()
    at, speeds = 4.0, []
    while not robot.simulation.backend.asleep:
        at += 1 / STEPS_PER_SECOND
        robot.read(at)
        speeds.append(math.hypot(*robot.simulation.vehicle.state().velocity))
        assert at < 10.0
    assert speeds[0] > 0.3
    assert max(speeds[-sleep.STILL_STEPS :]) <= 2 * sleep.STILL_SPEED


@pytest.mark.parametrize("speed", [1e-4, -1e-3])
def test_a_robot_that_is_told_to_crawl_never_sleeps_however_slow(speed, steps):
    robot = make("patrol", "parking_lot", seed=3, camera=False)
    robot.read(0.0)
    robot.drive(Twist.planar(speed, 0.0))
    steps.clear()
    robot.read(3.0)
    robot.close()
    assert len(steps) == 3 * STEPS_PER_SECOND


def test_its_sensors_go_on_with_noise_of_their_own_and_its_battery_empties(robot):
    read = robot.read(12.0)
    assert robot.simulation.backend.asleep
    for kind, rate in ((LaserScan, 10), (Imu, 10)):
        measured = [message for _, message in read if isinstance(message, kind)]
        if kind is LaserScan and not measured:
            continue  # the scout has none
        assert len(measured) >= 10 * rate
        assert measured[0] != measured[1]
        assert len({repr(each) for each in measured}) == len(measured)
    left = [message.percentage for _, message in read if isinstance(message, BatteryState)]
    assert left[-1] < left[0]


@pytest.mark.parametrize(("name", "world"), [("minnow", "lake"), ("aqua", "lake")])
def test_what_water_and_wind_move_never_sleeps(name, world, steps):
    robot = make(name, world, seed=3, camera=False)
    robot.read(0.0)
    robot.read(1.0)
    steps.clear()
    robot.read(4.0)
    robot.close()
    assert len(steps) == 3 * STEPS_PER_SECOND


def test_a_drone_that_is_told_to_take_off_does():
    robot = make("ardrone", "parking_lot", seed=3, camera=False)
    robot.read(0.0)
    robot.read(3.0)
    robot.manoeuvre(Manoeuvre(kind="take_off"))
    robot.read(8.0)
    height = robot.simulation.vehicle.state().position[2]
    robot.close()
    assert height > 0.5


def test_one_that_stands_sees_another_that_moves_and_is_pushed_by_it():
    stands, drives = make_several(
        [("patrol", Start(-8.0, -7.5)), ("patrol", Start(-11.0, -7.5))], "parking_lot", seed=1, camera=False
    )
    for robot in (stands, drives):
        robot.read(0.0)
        robot.read(3.0)
    assert stands.simulation.backend.asleep
    before = stands.simulation.pose(0)
    drives.drive(Twist.planar(0.5, 0.0))
    scans = [message for _, message in stands.read(5.0) if isinstance(message, LaserScan)]
    behind = [min(r for r in scan.ranges if math.isfinite(r)) for scan in (scans[0], scans[-1])]
    assert behind[1] < behind[0] - 0.5
    stands.read(13.0)
    drives.read(13.0)
    after = stands.simulation.pose(0)
    assert math.dist(before[:2], after[:2]) > 0.1
    for robot in (stands, drives):
        robot.close()


def test_a_robot_that_is_put_back_is_awake():
    robot = make("patrol", "parking_lot", seed=3, camera=False)
    robot.read(0.0)
    robot.read(2.0)
    robot.reset()
    assert not robot.simulation.backend.asleep
    robot.close()
