from __future__ import annotations

import math
import statistics
from itertools import pairwise

import msgspec
import numpy as np
import pytest
from pymap3d import geodetic2enu

from bridge.msgs.geometry_msgs import Twist
from sim.core.noise import GaussMarkov, Noise
from sim.sensors.laser import Laser
from sim.vehicles.patrol import PARAMETERS
from tests.sim.rooms import robot_in, room


def of(messages, name):
    return [message for topic, message in messages if topic == name]


def read(seconds, *, twist=None, noise=False, seed=0, world=None):
    """Everything measured in `seconds` in a room, and where the robot is then."""
    robot = robot_in(world or room(), seed=seed, noise=noise)
    if twist is not None:
        robot.drive(twist)
    messages, pose = robot.read(seconds), robot.simulation.pose()
    robot.close()
    return messages, pose


def test_the_laser_measures_a_rectangular_room():
    scan = of(read(0.1, world=room(8.0, 6.0))[0], "/scan")[0]
    angles = scan.angle_min + np.arange(len(scan.ranges)) * scan.angle_increment
    with np.errstate(divide="ignore"):
        expected = np.minimum(4.0 / np.abs(np.cos(angles)), 3.0 / np.abs(np.sin(angles)))
    assert len(scan.ranges) == 360
    assert np.abs(np.array(scan.ranges) - expected).max() < 2e-3


def test_the_lasers_beams_run_anticlockwise_from_behind():
    """Three metres to the wall on the left, five to the one on the right, one ahead and seven behind."""
    scan = of(read(0.1, world=room(8.0, 8.0, x=3.0, y=1.0))[0], "/scan")[0]
    assert (scan.angle_min, scan.angle_increment) == pytest.approx((-math.pi, math.tau / 360))
    behind, right, ahead, left = (scan.ranges[index] for index in (0, 90, 180, 270))
    assert (behind, right, ahead, left) == pytest.approx((7.0, 5.0, 1.0, 3.0), abs=2e-3)


def test_the_laser_says_inf_where_nothing_is_in_range():
    scan = of(read(0.1, world=room(40.0, 10.0))[0], "/scan")[0]
    assert scan.ranges[180] == math.inf
    assert scan.ranges[270] == pytest.approx(5.0, abs=1e-3)


def test_the_laser_says_minus_inf_where_something_is_too_near():
    robot = robot_in(room(4.0, 10.0, x=1.5))
    far_sighted = msgspec.structs.replace(PARAMETERS.laser, range_min=1.0)
    laser = Laser(
        far_sighted, robot.simulation.backend, robot.simulation.vehicle.body, Noise(0, "laser", on=False)
    )
    scan = laser.measure(0.0)
    robot.close()
    assert scan.ranges[180] == -math.inf
    assert scan.ranges[270] == pytest.approx(5.0, abs=1e-3)


def test_the_lasers_noise_is_as_large_as_its_parameters_say():
    scans = of(read(3.0, noise=True, world=room(8.0, 6.0))[0], "/scan")
    ahead = [scan.ranges[180] for scan in scans]
    assert statistics.mean(ahead) == pytest.approx(4.0, abs=0.01)
    assert 0.004 < statistics.stdev(ahead) < 0.02


def test_the_inertial_unit_feels_gravity_upward_at_rest():
    for message in of(read(2.0)[0], "/imu/data"):
        acceleration = message.linear_acceleration
        assert (acceleration.x, acceleration.y) == pytest.approx((0.0, 0.0), abs=0.01)
        assert acceleration.z == pytest.approx(9.81, abs=0.01)
        assert message.angular_velocity.z == pytest.approx(0.0, abs=1e-3)


def test_the_inertial_unit_feels_the_drive_speed_up():
    messages = of(read(0.5, twist=Twist.planar(0.7, 0.0))[0], "/imu/data")
    assert statistics.mean(message.linear_acceleration.x for message in messages[2:]) == pytest.approx(
        1.0, abs=0.1
    )


def test_the_inertial_unit_measures_turn_rate_and_attitude():
    messages, pose = read(2.0, twist=Twist.planar(0.0, 1.0), world=room(yaw=30))
    message = of(messages, "/imu/data")[-1]
    assert message.angular_velocity.z == pytest.approx(1.0, abs=5e-3)
    assert message.orientation.yaw == pytest.approx(pose[2], abs=5e-3)


def test_odometry_without_noise_is_where_the_robot_is():
    messages, (x, y, yaw) = read(6.0, twist=Twist.planar(0.7, 1.0))
    belief = of(messages, "/odom")[-1].pose.pose
    assert math.dist((belief.position.x, belief.position.y), (x, y)) < 0.01
    assert belief.orientation.yaw == pytest.approx(yaw, abs=0.01)


def test_odometry_starts_from_the_robots_start():
    belief = of(read(0.1, world=room(x=2.0, y=1.0, yaw=90))[0], "/odom")[0]
    assert (belief.header.frame_id, belief.child_frame_id) == ("odom", "base_link")
    assert (belief.pose.pose.position.x, belief.pose.pose.position.y) == pytest.approx((2.0, 1.0), abs=1e-3)
    assert belief.pose.pose.orientation.yaw == pytest.approx(math.pi / 2, abs=1e-3)


def drift(seed):
    """How far odometry is off after 12 m in a spiral [m]."""
    messages, (x, y, _) = read(20.0, twist=Twist.planar(0.6, 0.15), noise=True, seed=seed)
    belief = of(messages, "/odom")[-1].pose.pose.position
    return math.dist((belief.x, belief.y), (x, y))


@pytest.mark.slow
def test_odometry_with_noise_drifts_but_not_beyond_reason():
    drifts = [drift(seed) for seed in range(4)]
    assert statistics.mean(drifts) > 0.02
    assert max(drifts) < 0.04 * 12


def test_wheels_turn_as_far_as_the_robot_drives():
    messages, (x, _, _) = read(5.0, twist=Twist.planar(0.7, 0.0))
    joints = of(messages, "/joint_states")[-1]
    assert joints.name == ["wheel_left_joint", "wheel_right_joint"]
    assert [angle * 0.035 for angle in joints.position] == pytest.approx([x, x], rel=5e-3)
    assert joints.velocity == pytest.approx([20.0, 20.0], rel=1e-3)


def test_fixes_lie_round_the_truth_as_pymap3d_sees_it():
    fix = of(read(0.3, world=room(x=12.0, y=-7.0))[0], "/fix")[0]
    east, north, up = geodetic2enu(fix.latitude, fix.longitude, fix.altitude, 45.0, -73.0, 0.0)
    assert (east, north, up) == pytest.approx((12.0, -7.0, 0.0), abs=1e-3)


def test_fixes_with_noise_wander_within_their_covariance():
    messages = of(read(60.0, noise=True, seed=4)[0], "/fix")
    errors = [geodetic2enu(m.latitude, m.longitude, m.altitude, 45.0, -73.0, 0.0)[0] for m in messages]
    deviation = math.sqrt(messages[0].position_covariance[0])
    assert max(errors) - min(errors) > 0.1
    assert max(abs(error) for error in errors) < 5 * deviation


def bumper_at(direction):
    """The first pressed message of a robot that drives ahead into the wall, and its stamp's phase."""
    world = room(6.0, 6.0, x=2.5 if direction > 0 else -2.5)
    messages, _ = read(3.0, twist=Twist.planar(0.4 * direction, 0.0), world=world)
    return next(message for message in of(messages, "/bumper") if message.pressed)


@pytest.mark.parametrize(("direction", "bearing"), [(1, 0.0), (-1, math.pi)])
def test_the_bumper_says_where_it_was_hit(direction, bearing):
    hit = bumper_at(direction).bearing
    assert math.cos(hit - bearing) > 0.98


def test_the_bumper_speaks_at_once_when_it_is_hit():
    messages = of(read(3.0, twist=Twist.planar(0.43, 0.0), world=room(6.0, 6.0, x=2.5))[0], "/bumper")
    assert len(messages) == 31
    assert not messages[0].pressed
    assert math.isnan(messages[0].bearing)


def test_the_bumper_is_released_when_the_robot_backs_off():
    robot = robot_in(room(6.0, 6.0, x=2.5))
    robot.drive(Twist.planar(0.5, 0.0))
    robot.read(2.0)
    robot.drive(Twist.planar(-0.5, 0.0))
    assert not of(robot.read(4.0), "/bumper")[-1].pressed
    robot.close()


@pytest.mark.slow
def test_the_battery_empties_faster_when_the_robot_works():
    idle = of(read(20.0)[0], "/battery_state")[-1]
    busy = of(read(20.0, twist=Twist.planar(0.7, 0.1))[0], "/battery_state")[-1]
    assert 0 < busy.percentage < idle.percentage < 0.92
    assert busy.current < idle.current < 0
    assert busy.voltage < idle.voltage


def test_an_empty_battery_brings_the_robot_to_rest():
    robot = robot_in(room())
    robot.drive(Twist.planar(0.5, 0.0))
    robot.read(2.0)
    robot.simulation.vehicle.battery.charge = 0.0
    robot.read(4.0)
    rest = robot.simulation.pose()
    robot.read(6.0)
    assert robot.simulation.pose() == pytest.approx(rest, abs=1e-4)
    robot.close()


def test_a_wandering_error_stays_within_reason_and_is_correlated():
    wander = GaussMarkov(Noise(1, "test"), 2.0, 60.0, 0.2)
    values = [wander.step() for _ in range(20000)]
    steps = [abs(b - a) for a, b in pairwise(values)]
    assert statistics.stdev(values) == pytest.approx(2.0, rel=0.4)
    assert statistics.mean(steps) < 0.2


def test_sensors_draw_from_generators_of_their_own():
    assert Noise(1, "laser").normal(1.0) != Noise(1, "gps").normal(1.0)
    assert Noise(1, "laser").normal(1.0) == Noise(1, "laser").normal(1.0)
