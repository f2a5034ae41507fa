from __future__ import annotations

import collections
import math

import msgspec
import pytest

from bridge.core.topics import topic
from bridge.msgs.geometry_msgs import Twist
from sim.robot import ROBOTS, WORLDS, make
from sim.vehicles.model import Model
from sim.vehicles.patrol import PARAMETERS, Patrol
from sim.vehicles.patrol.looks import looks
from sim.world.world_files import load
from tests.sim.rooms import robot_in, room

STREAMS = (
    "/odom",
    "/imu/data",
    "/fix",
    "/scan",
    "/bumper",
    "/battery_state",
    "/joint_states",
    "/motors",
    "/manoeuvre",
    "/line_sensor",
    "/range/front",
    "/range/left",
    "/range/right",
    "/range/rear",
)


@pytest.fixture
def robot():
    robot = robot_in(room())
    yield robot
    robot.close()


def count(messages):
    return collections.Counter(name for name, _ in messages)


def test_every_robot_can_be_made_in_every_world_that_is_its_element_where_it_has_room():
    wet = {world: load(world).water is not None for world in WORLDS}
    assert set(wet.values()) == {True, False}
    for name, model in ROBOTS.items():
        for world in WORLDS:
            if model.element not in ("air", "water" if wet[world] else "land"):
                with pytest.raises(ValueError, match=f"{name} needs"):
                    make(name, world, camera=False)
                continue
            if (name, world) == ("commander", "office"):
                with pytest.raises(ValueError, match="Commander-1 has no room at"):
                    make(name, world, camera=False)
                continue
            robot = make(name, world, camera=False)
            assert (robot.info.model, robot.info.world) == (name, world)
            robot.close()


def test_a_second_robot_is_made_of_its_own_class_and_figures(monkeypatch):
    class Carrier(Patrol):
        pass

    info = msgspec.structs.replace(PARAMETERS.info, name="Carrier-1", model="carrier")
    limits = msgspec.structs.replace(PARAMETERS.limits, speed=0.3)
    figures = msgspec.structs.replace(PARAMETERS, info=info, limits=limits)
    monkeypatch.setitem(ROBOTS, "carrier", Model(Carrier, figures, looks))
    robot = make("carrier", "parking_lot", camera=False)
    assert type(robot.simulation.vehicle) is Carrier
    assert (robot.info.name, robot.info.model, robot.info.max_speed) == ("Carrier-1", "carrier", 0.3)
    robot.close()


def test_an_unknown_robot_is_refused_with_the_names_there_are():
    with pytest.raises(ValueError, match="There is no simulated robot 'tank'; there is patrol"):
        make("tank", "parking_lot")


def test_an_unknown_world_is_refused_with_the_names_there_are():
    with pytest.raises(ValueError, match=r"There is no world 'mars'; there is .*parking_lot"):
        make("patrol", "mars")


def test_info_tells_limits_place_and_camera():
    robot = make("patrol", "parking_lot")
    info = robot.info
    robot.close()
    assert (info.kind, info.max_speed, info.cameras) == ("wheels", 0.7, ["front"])
    assert info.camera_fov == pytest.approx(1.2)
    assert info.latitude == pytest.approx(45.5069)


@pytest.mark.parametrize(
    ("name", "climb", "tilt", "steering", "radius"),
    [
        ("patrol", 0.0, 0.0, 0.0, 0.0),
        ("commander", 0.0, 0.0, 0.52, 3.493),
        ("minnow", 0.0, 0.0, 0.61, 1.4),
        ("aqua", 0.25, 0.8, 0.0, 0.0),
        ("ardrone", 1.0, 0.35, 0.0, 0.0),
    ],
)
def test_info_tells_what_else_it_is_driven_by(name, climb, tilt, steering, radius):
    own = ROBOTS[name].parameters
    assert (own.max_climb, own.max_tilt, own.max_steering) == (climb, tilt, steering)
    assert own.min_radius == pytest.approx(radius, abs=1e-3)


def test_a_robot_without_camera_offers_none(robot):
    assert robot.info.cameras == []


def test_the_first_read_gives_the_map_and_one_message_of_each_sensor():
    robot = make("patrol", "parking_lot", camera=False)
    first = robot.read(1000.0)
    robot.close()
    assert first[0][0] == "/map"
    assert count(first) == dict.fromkeys(("/map", *STREAMS), 1)
    assert all(message.header.stamp.seconds == 1000.0 for _, message in first)


@pytest.mark.parametrize(("name", "full"), [("patrol", False), ("commander", True)])
def test_the_map_has_the_fruit_that_hangs_in_the_way_of_a_tall_robot_only(name, full):
    robot = make(name, "orchard", camera=False)
    grid = dict(robot.read(0.0))["/map"]
    robot.close()
    corner = grid.info.origin.position
    column, row = ((at - low) / grid.info.resolution for at, low in ((-8.75, corner.x), (4.26, corner.y)))
    assert (grid.data[int(row) * grid.info.width + int(column)] == 100) is full


def test_every_message_has_the_type_that_its_topic_promises(robot):
    robot.want("/sim/ground_truth", True)
    for name, message in robot.read(1.0):
        assert type(message) is topic(name).type


def test_streams_come_at_the_rates_of_the_topic_table(robot):
    counted = count(robot.read(10.0))
    for name in STREAMS:
        assert counted[name] == 10 * topic(name).rate, name


def test_stamps_lie_on_the_robots_clock_in_order(robot):
    stamps = [message.header.stamp.seconds for _, message in robot.read(2.0)]
    assert stamps == sorted(stamps)
    assert 0 < stamps[0] <= 1 / 50 + 1 / 240
    assert stamps[-1] == pytest.approx(2.0)


def test_reading_backwards_gives_nothing_and_moves_nothing(robot):
    robot.read(1.0)
    before = robot.simulation.pose()
    assert robot.read(0.5) == []
    assert robot.simulation.pose() == before


def test_many_small_reads_give_what_one_large_read_gives():
    small, large = robot_in(room(), seed=3, noise=True), robot_in(room(), seed=3, noise=True)
    for robot in (small, large):
        robot.drive(Twist.planar(0.5, 0.4))
    pieces = [message for i in range(1, 101) for message in small.read(i * 0.02)]
    assert pieces == large.read(2.0)
    small.close()
    large.close()


def test_a_clock_of_large_numbers_runs_as_many_steps_as_one_from_zero(robot):
    late = robot_in(room())
    late.close()
    other = make("patrol", "parking_lot", camera=False)
    other.read(1.8e9)
    for i in range(1, 501):
        other.read(1.8e9 + i * 0.01)
        robot.read(i * 0.01)
    assert other.simulation.steps == robot.simulation.steps == 1200
    other.close()


def test_a_twist_holds_until_the_next_one(robot):
    robot.drive(Twist.planar(0.5, 0.0))
    robot.read(10.0)
    assert robot.simulation.pose()[0] == pytest.approx(5.0 - 0.5**2 / 2, abs=0.02)


def test_the_ground_truth_comes_only_while_it_is_wanted(robot):
    assert count(robot.read(1.0))["/sim/ground_truth"] == 0
    robot.want("/sim/ground_truth", True)
    assert count(robot.read(2.0))["/sim/ground_truth"] == 20
    robot.want("/sim/ground_truth", False)
    assert count(robot.read(3.0))["/sim/ground_truth"] == 0


def test_the_ground_truth_is_where_the_robot_is(robot):
    robot.want("/sim/ground_truth", True)
    robot.drive(Twist.planar(0.4, 0.6))
    truth = [message for name, message in robot.read(3.0) if name == "/sim/ground_truth"][-1]
    x, y, yaw = robot.simulation.pose()
    assert (truth.pose.pose.position.x, truth.pose.pose.position.y) == pytest.approx((x, y), abs=1e-9)
    assert truth.pose.pose.orientation.yaw == pytest.approx(yaw, abs=1e-9)
    assert truth.twist.twist.linear.x == pytest.approx(0.4, abs=0.01)
    assert truth.twist.twist.angular.z == pytest.approx(0.6, abs=0.01)


def test_the_robot_starts_where_its_world_says():
    robot = robot_in(room(x=3.0, y=-4.0, yaw=120))
    assert robot.simulation.pose() == pytest.approx((3.0, -4.0, math.radians(120)), abs=1e-4)
    robot.close()


def test_it_knows_the_places_of_its_world_that_have_names():
    robot = make("scout", "office", camera=False)
    places = {place.name: place for place in robot.places}
    robot.close()
    assert len(places) == 12
    assert (places["lab"].kind, places["lab"].note) == ("lab", "Here robots are built and tested.")
    assert places["room_3"].tag == "card-3"
    assert places["dock"].yaw == math.pi


def test_closing_twice_does_nothing(robot):
    robot.close()
    robot.close()


@pytest.mark.parametrize("name", sorted(ROBOTS))
def test_info_tells_the_outline_which_fits_the_circle_round_the_body(name):
    parameters = ROBOTS[name].parameters
    corners = parameters.footprint
    assert bool(corners) == (name not in ("patrol", "scout"))
    reach = max((math.hypot(*corner) for corner in corners), default=parameters.radius)
    assert reach <= parameters.radius + 1e-9
    assert reach >= 0.8 * parameters.radius
    around = zip(corners, (*corners[1:], *corners[:1]), strict=True)
    area = sum(a[0] * b[1] - b[0] * a[1] for a, b in around)
    assert area > 0 or not corners
