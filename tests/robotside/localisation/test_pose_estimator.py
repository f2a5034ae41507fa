"""A place is believed only when no other place on the map explains as well what the laser sees."""

from __future__ import annotations

import math

import pytest
from msgspec.structs import replace

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.sensor_msgs import NavSatFix, NavSatStatus
from bridge.msgs.std_msgs import Header, Time
from robotside.core.pose2 import Pose2
from robotside.localisation.field import Field
from robotside.localisation.pose_estimator import MAX_SPREAD, PoseEstimator
from robotside.mapping.occupancy_grid import Grid
from tests.fakes import Box, FakeRobot, Pillar
from tests.robotside.localisation.ride import DOOR, FLOOR, Ride, equal_rooms

DESK = Box(7.0, 3.0, 8.0, 4.0)
"""In the last room: from elsewhere it is not seen."""

CUPBOARD = Box(-8.0, -1.2, -7.0, 1.2)
"""Across the west end of the corridor."""


def in_corridor(x: float, *more: Box, yaw: float = 0.0, beams: int = 120) -> FakeRobot:
    return FakeRobot(start=(x, 0.0, yaw), hall=FLOOR, boxes=[*equal_rooms(), *more], beams=beams)


def test_who_is_placed_one_door_off_is_never_believed_and_finds_itself() -> None:
    ride = Ride(in_corridor(-2.0, CUPBOARD), Pose2(-2.0 + DOOR, 0.0, 0.0))
    ride.robot.drive(Twist.planar(0.3, 0.0))
    ride.run(6.0)
    assert ride.estimator.sure
    assert ride.error < 0.1
    assert ride.wrong == 0.0
    assert "position_found" in ride.codes


def test_in_one_of_several_equal_rooms_it_asks_in_which_and_the_answer_is_believed() -> None:
    ride = Ride(in_corridor(-2.0), Pose2(2.0, 0.0, 0.0))  # the floor looks the same after half a turn
    ride.robot.pose = (-2.0, 3.2, 1.0)
    ride.estimator.place(Pose2(2.0, 3.2, 1.0))
    ride.run(3.0)
    assert not ride.estimator.sure
    asked = ride.asked[-1]
    assert len(asked.candidates) >= 2
    assert asked.reason.startswith("The robot may be at ")
    assert sum(each.share for each in asked.candidates) <= 1.0 + 1e-9
    right = [each for each in asked.candidates if math.hypot(each.x + 2.0, each.y - 3.2) < 0.3]
    assert len(right) == 1
    assert right[0].share > 0.02
    assert ride.estimator.pose is not None
    off = max(each.share * (each.x - ride.estimator.pose.x) ** 2 for each in asked.candidates)
    assert ride.estimator.covariance[0, 0] > off > 0.3, "it may be in another room"
    ride.estimator.place(Pose2(right[0].x, right[0].y, right[0].yaw), certain=True)
    ride.run(2.0)
    assert ride.estimator.sure
    assert ride.error < 0.1
    assert ride.estimator.candidates == ()
    assert not ride.asked[-1].candidates
    assert max(ride.estimator.covariance.diagonal()[:2]) < 0.05**2


def test_a_robot_that_is_carried_while_it_drives_is_unsure_within_two_seconds_and_finds_itself() -> None:
    ride = Ride(in_corridor(-4.0, CUPBOARD, DESK), Pose2(-4.0, 0.0, 0.0))
    ride.robot.drive(Twist.planar(0.3, 0.0))
    ride.run(3.0)
    assert ride.estimator.sure
    ride.robot.pose = (6.0, 3.0, 2.0)
    ride.robot.drive(Twist.planar(0.0, 0.4))
    ride.run(8.0)
    assert 0.0 < ride.wrong <= 2.0  # it cannot know before it has looked a few times
    assert ride.estimator.sure
    assert ride.error < 0.1
    assert "position_unsure" in ride.codes


def test_people_round_it_who_are_not_on_the_map_do_not_make_it_believe_another_place() -> None:
    robot = in_corridor(-4.5, CUPBOARD)
    robot.pillars = [
        Pillar(-4.5 + math.cos(a) * 0.9, math.sin(a) * 0.7, 0.2) for a in (0.3, 1.2, 2.6, 4.0, 5.2)
    ]
    ride = Ride(robot, Pose2(-4.5, 0.0, 0.0))
    ride.run(4.0)
    assert ride.error < 0.1


def test_a_sure_place_is_checked_against_all_others_on_the_way() -> None:
    ride = Ride(in_corridor(-6.0, CUPBOARD), Pose2(-6.0, 0.0, 0.0))
    ride.run(2.0)
    assert ride.estimator.sure
    searched: list[object] = []
    submit = ride.estimator._whereabouts._worker.submit
    ride.estimator._whereabouts._worker.submit = lambda work: searched.append(work) or submit(work)  # type: ignore[method-assign,func-returns-value]
    ride.run(4.0)
    assert not searched
    ride.robot.drive(Twist.planar(0.5, 0.0))
    ride.run(20.0)
    assert len(searched) == 2


def test_who_was_told_its_place_need_not_be_told_again_after_it_has_driven_and_turned_round() -> None:
    ride = Ride(
        FakeRobot(beams=120), Pose2(0.0, 0.0, 0.0)
    )  # in a bare hall: it looks the same after half a turn
    for speed, turn, seconds in ((0.5, 0.0, 5.0), (0.0, 0.8, 4.0), (0.5, 0.0, 7.0)):
        ride.robot.drive(Twist.planar(speed, turn))
        ride.run(seconds)
        assert ride.estimator.sure
    assert ride.codes == []
    assert ride.error < 0.1


def test_satellites_that_say_another_place_for_a_while_make_it_doubt_until_it_has_searched_the_map() -> None:
    robot = in_corridor(-6.0, CUPBOARD)
    robot.info = replace(robot.info, latitude=45.0, longitude=-73.0)
    ride = Ride(robot, Pose2(-6.0, 0.0, 0.0))
    ride.run(2.0)
    assert ride.estimator.sure
    for second in range(5):
        fix = NavSatFix(Header(Time.at(ride.now + second)), NavSatStatus(), 45.001, -73.0)
        ride.estimator.on_fix(fix)
    doubted = False
    for _ in range(40):
        ride.run(0.05)
        doubted = doubted or not ride.estimator.sure
    assert doubted
    assert any("satellites" in notice for notice in ride.said)
    ride.run(2.0)
    assert ride.codes.count("position_unsure") == 1  # it does not flap
    assert ride.error < 0.1


def test_where_things_of_the_map_are_gone_it_does_not_take_a_place_for_its_own_that_is_alike_without_them() -> (
    None
):
    cars = [Box(x, 1.5, x + 1.0, 3.0) for x in (-6.0, -4.0, -2.0)]
    with_cars = FakeRobot(start=(-4.0, 0.0, 0.5), hall=FLOOR, boxes=cars)
    robot = FakeRobot(start=(-4.0, 0.0, 0.5), hall=FLOOR, beams=120)
    ride = Ride(robot, Pose2(-4.0, 0.0, 0.5))
    ride.estimator.set_map(Field(Grid.from_msg(with_cars.map())))
    ride.estimator.place(Pose2(-4.0, 0.0, 0.5))
    ride.robot.drive(Twist.planar(0.2, 0.2))
    ride.run(8.0)
    assert ride.wrong == 0.0
    assert ride.error < 0.1
    assert "position_found" not in ride.codes


def test_a_place_that_is_not_sure_is_never_told_as_known_to_centimetres() -> None:
    ride = Ride(in_corridor(-2.0, CUPBOARD), Pose2(-2.0, 0.0, 0.0))
    ride.run(3.0)
    assert ride.estimator.sure
    assert max(ride.estimator.covariance.diagonal()[:2]) < 0.05**2
    assert ride.estimator._localiser is not None
    ride.estimator._localiser.distrust()
    assert not ride.estimator.sure
    assert min(ride.estimator.covariance.diagonal()[:2]) >= MAX_SPREAD**2 - 0.05**2


@pytest.mark.parametrize(("said", "moved"), [(0.1, 1.9), (1.0, 1.0), (5.0, 0.1)])
def test_a_fix_moves_the_place_by_as_much_as_it_says_that_it_is_worth(said: float, moved: float) -> None:
    robot = in_corridor(0.0)
    robot.info = replace(robot.info, latitude=45.0, longitude=-73.0)
    estimator = PoseEstimator(robot.info, lambda *_, **__: None, lambda *_: None)
    estimator.set_map(Field(Grid.from_msg(robot.map())))
    estimator.place(Pose2(0.0, 0.0, 0.0))
    estimator._localiser.place(Pose2(0.0, 0.0, 0.0), spread=1.0, turn=0.1)  # type: ignore[union-attr]
    along = [said**2, 0.0, 0.0, 0.0, said**2, 0.0, 0.0, 0.0, 1.0]
    fix = NavSatFix(Header(Time.at(1.0)), NavSatStatus(), 45.0 + 2.0 / 111_132.0, -73.0, 0.0, along, 2)
    estimator.on_fix(fix)
    assert estimator.pose is not None
    assert estimator.pose.y == pytest.approx(moved, abs=0.15)
