"""Several robots in one world, and what is said when something goes wrong with one."""

from __future__ import annotations

import io
import math

import numpy as np
import pytest
from PIL import Image

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from sim.core.order_limits import cut
from sim.robot import CAMERA_TOPIC, ROBOTS, SimRobot, make_several
from sim.simulation.shared_run import SharedRun
from sim.simulation.simulation import Simulation
from sim.vehicles.aqua import AQUA
from sim.vehicles.ardrone import ARDRONE
from sim.vehicles.commander import COMMANDER
from sim.vehicles.minnow import MINNOW
from sim.vehicles.patrol import PATROL
from sim.vehicles.scout import SCOUT
from sim.world.tables import Start
from tests.sim.rooms import alone, plain, room, until

WATER = "[water]\ndepth = 6.0\n"


def pair(model=PATROL, other=SCOUT, world=None, at=None):
    """Two robots facing each other 3 m apart, unless told otherwise; their clocks have been started at 0."""
    place = at or Start(3.0, 0.0, 180.0)
    run = SharedRun(Simulation(world or room(), model, (other, place), noise=False))
    robots = [SimRobot(run, camera=False, number=number) for number in range(2)]
    for robot in robots:
        robot.read(0.0)
    return robots


def events(messages):
    return [message.text for name, message in messages if name == "/events"]


def test_they_see_each_other_but_not_themselves():
    patrol, scout = pair()
    scan = next(m for name, m in patrol.read(0.2) if name == "/scan")
    ring = next(m for name, m in scout.read(0.2) if name == "/sonar")
    for robot in (patrol, scout):
        robot.close()
    assert scan.ranges[180] == pytest.approx(3.0 - 0.205, abs=0.01)
    assert ring.ranges[0] == pytest.approx(3.0 - 0.205 - 0.176, abs=0.03)
    assert min(ring.ranges) == pytest.approx(ring.ranges[0], abs=0.03)


def test_they_bump_into_each_other_and_both_feel_it():
    patrol, scout = pair()
    patrol.drive(Twist.planar(0.6, 0.0))
    patrol.read(6.0)
    felt = [robot._vehicle.bumper.bumps for robot in (patrol, scout)]
    pressed = [m for name, m in scout.read(6.0) if name == "/bumper" and m.pressed]
    for robot in (patrol, scout):
        robot.close()
    assert felt == [1, 1]
    assert pressed[0].bearing == pytest.approx(0.0, abs=0.1)


def test_whoever_is_read_moves_all_on_and_nobody_misses_anything():
    patrol, scout = pair()
    one = [name for name, _ in patrol.read(1.0)]
    other = [name for name, _ in scout.read(1.0)]
    for robot in (patrol, scout):
        robot.close()
    assert one.count("/odom") == other.count("/odom") == 20
    assert "/scan" in one
    assert "/scan" not in other
    assert other.count("/sonar") == 10


def test_the_world_is_freed_with_the_last_of_them():
    patrol, scout = pair()
    patrol.close()
    assert scout.read(1.0)
    scout.close()
    scout.close()


def test_each_has_its_own_noise_and_the_first_has_the_same_as_alone():
    lone = make_several(["patrol"], "parking_lot", seed=4, camera=False)[0]
    two = make_several(["patrol", "patrol"], "parking_lot", seed=4, camera=False)
    scans = []
    for robot in (lone, *two):
        robot.read(0.0)
    for robot in (lone, *two):
        scans.append(next(m for name, m in robot.read(0.2) if name == "/imu/data").angular_velocity)
        robot.close()
    assert scans[0] == scans[1]
    assert abs(scans[1].x - scans[2].x) > 1e-4


def test_robots_without_a_place_stand_beside_the_start():
    robots = make_several(["patrol", "scout", ("commander", Start(8.0, 6.0))], "parking_lot", camera=False)
    places = [robots[0].simulation.pose(number)[:2] for number in range(3)]
    for robot in robots:
        robot.close()
    assert math.dist(places[0], places[1]) == pytest.approx(2.0, abs=0.05)
    assert places[2] == pytest.approx((8.0, 6.0), abs=0.02)


def test_a_camera_sees_the_other_robot():
    def picture(others):
        robots = make_several([("patrol", Start(-17.5, -9.0)), *others], "parking_lot", noise=False)
        robots[0].want(CAMERA_TOPIC, True)
        for robot in robots:
            robot.read(0.0)
        taken = next(m for name, m in robots[0].read(0.1) if name == CAMERA_TOPIC)
        for robot in robots:
            robot.close()
        return np.asarray(Image.open(io.BytesIO(taken.data)), dtype=int)

    alone_, together = picture([]), picture([("scout", Start(-16.0, -9.0))])
    changed = np.abs(alone_ - together).max(axis=2) > 60
    assert 0.01 < changed.mean() < 0.4


def test_a_truck_looks_back_as_well_and_a_drone_down():
    world = room(20.0, 8.0)
    truck = SimRobot(Simulation(world, COMMANDER, noise=False), camera=True)
    assert truck.info.cameras == ["front", "rear"]
    truck.want("/camera/rear/image/compressed", True)
    truck.read(0.0)
    names = [name for name, _ in truck.read(0.5) if name.startswith("/camera")]
    truck.close()
    assert names == ["/camera/rear/image/compressed"] * len(names)
    assert len(names) in (7, 8)


def test_a_twist_beyond_the_limits_is_cut_and_that_is_said_once():
    robot = alone(SCOUT, plain())
    for _ in range(5):
        robot.drive(Twist.planar(3.0, 0.0))
    said = events(robot.read(2.0))
    assert said == ["Scout-1 goes at most 1 m/s; 3 m/s was requested."]
    assert robot.simulation.vehicle.state().velocity[0] == pytest.approx(1.0, rel=1e-2)
    robot.drive(Twist.planar(0.5, 0.0))
    robot.drive(Twist.planar(0.5, 9.0))
    robot.drive(Twist.planar(0.5, 9.0))
    assert events(robot.read(2.2)) == ["Scout-1 turns at most 2 rad/s; 9 rad/s was requested."]
    assert robot.simulation.vehicle.order.twist == Twist.planar(0.5, 2.0)
    robot.close()


@pytest.mark.parametrize(
    ("order", "said"),
    [
        (Manoeuvre(kind="twist", twist=Twist.planar(1e300, 1e300)), "goes at most 3 m/s; 1e+300 m/s"),
        (Manoeuvre(kind="steer", speed=-1e300), "goes at most 3 m/s; 1e+300 m/s"),
        (Manoeuvre(kind="steer", speed=1.0, steering=3.0), "steers at most 0.52 rad; 3 rad"),
        (Manoeuvre(kind="steer", throttle=50.0), "takes a throttle of at most 1; 50"),
    ],
)
def test_whatever_is_too_much_is_cut_with_what_was_asked_and_what_is_allowed(order, said):
    info = RobotInfo(name="Commander-1", max_speed=3.0, max_yaw_rate=1.0, max_steering=0.52)
    _, told = cut(order, info)
    assert told == f"Commander-1 {said} was requested."


@pytest.mark.parametrize(
    ("model", "order", "said", "followed"),
    [
        (
            ARDRONE,
            Manoeuvre(kind="twist", twist=Twist(Vector3(0.0, 0.0, 3.9))),
            "Ardrone-1 climbs and sinks at most 1 m/s; 3.9 m/s was requested.",
            lambda order: order.twist.linear.z == 1.0,
        ),
        (
            ARDRONE,
            Manoeuvre(kind="tilt", pitch=-1.4),
            "Ardrone-1 leans at most 0.35 rad; 1.4 rad was requested.",
            lambda order: order.pitch == -0.35,
        ),
        (
            AQUA,
            Manoeuvre(kind="tilt", roll=1.4, twist=Twist(Vector3(0.0, 0.0, -0.2))),
            "Aqua-1 leans at most 0.8 rad; 1.4 rad was requested.",
            lambda order: (order.roll, order.twist.linear.z) == (0.8, -0.2),
        ),
        (
            MINNOW,
            Manoeuvre(kind="steer", throttle=5.0, steering=3.0),
            "Minnow-1 takes a throttle of at most 1; 5 was requested.",
            lambda order: (order.throttle, order.steering) == (1.0, 0.61),
        ),
        (
            COMMANDER,
            Manoeuvre(kind="steer", speed=1.0, steering=-2.0),
            "Commander-1 steers at most 0.52 rad; 2 rad was requested.",
            lambda order: (order.speed, order.steering) == (1.0, -0.52),
        ),
        (
            SCOUT,
            Manoeuvre(kind="twist", twist=Twist(Vector3(0.6, 0.0, 2.0))),
            None,
            lambda order: (order.twist.linear.x, order.twist.linear.z) == (0.6, 0.0),
        ),
    ],
)
def test_the_order_that_is_told_is_the_one_that_is_followed(model, order, said, followed):
    robot = alone(model, plain(WATER, -1.5) if model.element == "water" else plain())
    robot.manoeuvre(order)
    messages = until(robot, 0.3)
    robot.close()
    assert events(messages) == ([said] if said else [])
    assert followed([message for name, message in messages if name == "/manoeuvre"][-1])


@pytest.mark.parametrize(
    "order",
    [
        Manoeuvre(kind="twist", twist=Twist.planar(math.nan, 0.0)),
        Manoeuvre(kind="twist", twist=Twist(Vector3(0.0, 0.0, math.inf))),
        Manoeuvre(kind="steer", speed=math.inf),
        Manoeuvre(kind="steer", speed=1.0, steering=math.nan),
    ],
)
def test_what_is_no_number_is_refused_and_changes_nothing(order):
    robot = alone(COMMANDER, plain())
    robot.drive(Twist.planar(1.0, 0.0))
    with pytest.raises(ValueError, match="must be a number; the robot goes on as before"):
        robot.manoeuvre(order)
    until(robot, 2.0)
    assert robot.simulation.vehicle.state().velocity[0] == pytest.approx(1.0, rel=1e-2)
    robot.close()


def test_one_that_lies_on_its_back_says_so_and_stands_up_again_when_it_is_reset():
    robot = alone(SCOUT, room(x=1.0, y=2.0, yaw=30.0))
    backend, body = robot.simulation.backend, robot.simulation.vehicle.body
    robot.drive(Twist.planar(0.5, 0.0))
    until(robot, 2.0)
    backend.place(body, (0.0, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
    assert events(until(robot, 2.0)) == ["Scout-1 has turned over."]
    place = robot.reset().position
    assert (place.x, place.y) == pytest.approx((1.0, 2.0), abs=1e-6)
    messages = until(robot, 1.0)
    odom = [m for name, m in messages if name == "/odom"][-1].pose.pose
    assert events(messages) == []
    assert robot.simulation.pose() == pytest.approx((1.0, 2.0, math.radians(30)), abs=5e-3)
    assert (odom.position.x, odom.position.y, odom.orientation.yaw) == pytest.approx(
        (1.0, 2.0, math.radians(30)), abs=5e-3
    )
    robot.close()


def test_one_that_leaves_its_world_says_so():
    robot = alone(SCOUT, plain())
    robot.drive(Twist.planar(1.0, 0.0))
    assert events(until(robot, 11.0)) == ["Scout-1 has left room."]
    robot.close()


def test_a_drone_that_falls_into_the_water_has_sunk_and_can_be_reset():
    robot = alone(ARDRONE, plain(WATER))
    robot.simulation.backend.place(robot.simulation.vehicle.body, (3.0, 0.0, 0.5), (0.0, 0.0, 0.0, 1.0))
    assert "Ardrone-1 has sunk." in events(until(robot, 3.0))
    robot.reset()
    robot.manoeuvre(Manoeuvre(kind="take_off"))
    until(robot, 5.0)
    assert robot.simulation.vehicle.state().position[2] > 0.9
    robot.close()


def test_one_whose_start_is_taken_is_put_beside_it_and_says_so():
    scout, truck = pair(SCOUT, COMMANDER)
    backend, body = scout.simulation.backend, scout.simulation.vehicles[0].body
    backend.place(body, (3.2, 0.3, 0.1), (0.0, 0.0, 0.0, 1.0))  # where the truck began
    backend.place(scout.simulation.vehicles[1].body, (10.0, 5.0, 0.3), (0.0, 0.0, 0.0, 1.0))
    until(scout, 0.5)
    at = truck.reset().position
    assert events(until(truck, 1.0)) == [
        f"There is no room at the start of Commander-1: it stands {math.dist((at.x, at.y), (3, 0)):.1f} m beside it."
    ]
    state = scout.simulation.vehicles[1].state()
    assert state.position[:2] == pytest.approx((at.x, at.y), abs=0.02)
    assert not backend.is_crowded(scout.simulation.vehicles[1].body, 0.04)
    assert 1.0 < math.dist((at.x, at.y), (3.0, 0.0)) < 5.0
    odom = [m for name, m in until(truck, 0.5) if name == "/odom"][-1].pose.pose.position
    assert (odom.x, odom.y) == pytest.approx((at.x, at.y), abs=0.02)
    truck.drive(Twist.planar(1.0, 0.0))
    until(truck, 3.0)
    assert math.dist(scout.simulation.vehicles[1].state().position[:2], (at.x, at.y)) > 1.5
    scout.close()
    truck.close()


def test_one_that_cannot_be_put_back_says_why_and_stays_where_it_is():
    drone, boat = pair(ARDRONE, MINNOW, plain(WATER))
    backend = drone.simulation.backend
    backend.place(drone.simulation.vehicles[0].body, (-3.0, 0.0, 4.0), (0.0, 0.0, 0.0, 1.0))
    backend.place(drone.simulation.vehicles[1].body, (0.0, 0.0, 0.1), (0.0, 0.0, 0.0, 1.0))  # on its raft
    with pytest.raises(ValueError, match=r"^Ardrone-1 is not put back: there is no room at its start\.$"):
        drone.reset()
    assert drone.simulation.vehicles[0].state().position == pytest.approx((-3.0, 0.0, 4.0))
    drone.close()
    boat.close()


def test_boats_give_each_other_way_no_more_than_things_do():
    one, other = pair(MINNOW, MINNOW, plain(WATER), Start(2.5, 0.0, 180.0))
    one.manoeuvre(Manoeuvre(kind="steer", throttle=0.6))
    one.read(6.0)
    assert one._vehicle.bumper.bumps >= 1
    assert other._vehicle.state().position[0] > 2.6
    for robot in (one, other):
        robot.close()


@pytest.mark.parametrize("name", ROBOTS)
def test_each_robot_can_be_put_back_to_its_start_while_it_is_going(name):
    model = ROBOTS[name]
    robot = alone(model, plain(WATER, -1.5) if model.element == "water" else plain())
    start = robot.simulation.pose()
    if "take_off" in robot.info.manoeuvres:
        robot.manoeuvre(Manoeuvre(kind="take_off"))
        until(robot, 3.0)
    robot.drive(Twist(Vector3(0.5, 0.0, 0.0), Vector3(0.0, 0.0, 0.3)))
    until(robot, 4.0)
    assert math.dist(robot.simulation.pose()[:2], start[:2]) > 0.4
    robot.reset()
    odom = [m for told, m in until(robot, 1.0) if told == "/odom"][-1].pose.pose
    assert robot.simulation.pose() == pytest.approx(start, abs=5e-3)
    assert (odom.position.x, odom.position.y, odom.orientation.yaw) == pytest.approx(start, abs=5e-3)
    robot.close()
