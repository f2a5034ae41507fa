"""Going by courses: what a boat, a swimmer and a drone are told on their way."""

from __future__ import annotations

import math

import msgspec
import numpy as np
import pytest

from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.core.pose2 import Points, Pose2
from robotside.core.worker import completed
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.course_controller import MAX_SPEED, TURNING_SPEED, CourseController
from robotside.navigation.path_controller import UNSURE_SPEED
from robotside.navigation.planner import Planner
from tests.fakes import FakeRobot

NOTHING: Points = np.empty((0, 2))
PLANNER = Planner(Grid(np.zeros((400, 400), dtype=np.bool_), 0.1, -20.0, -20.0), 0.3)
COURSES = ("boat", "hexapod", "quadrotor")


class Course(FakeRobot):
    """Notes the courses that it is told."""

    def __init__(self, kind: str, fastest: float) -> None:
        super().__init__()
        self.info = msgspec.structs.replace(
            self.info, kind=kind, manoeuvres=["course"], max_speed=fastest, radius=0.3
        )
        self.told: list[Manoeuvre] = []

    def manoeuvre(self, order: Manoeuvre) -> None:
        """Note it."""
        self.told.append(order)


def steered(kind: str, yaw: float, *, fastest: float = 1.5, sure: bool = True) -> Manoeuvre:
    """What one that looks to `yaw` [rad] is told, with its goal 15 m to the east."""
    robot = Course(kind, fastest)
    controller, pose = CourseController(robot), Pose2(0.0, 0.0, yaw)
    controller.follow(completed(controller.search(PLANNER, pose, (15.0, 0.0, math.nan), "The goal", NOTHING)))
    controller.steer(pose, NOTHING, sure=sure)
    return robot.told[-1]


@pytest.mark.parametrize("kind", COURSES)
def test_it_keeps_the_course_to_its_goal_at_nine_tenths_of_its_speed(kind: str) -> None:
    order = steered(kind, 0.0)
    assert order.kind == "course"
    assert order.yaw == pytest.approx(0.0)
    assert order.speed == pytest.approx(0.9 * 1.5)


@pytest.mark.parametrize("kind", COURSES)
def test_by_itself_it_goes_no_faster_than_people_can_follow(kind: str) -> None:
    assert steered(kind, 0.0, fastest=6.0).speed == MAX_SPEED == 2.0


def test_a_boat_comes_about_slowly_since_it_turns_only_by_going() -> None:
    order = steered("boat", math.pi / 2)
    assert order.yaw == pytest.approx(0.0)
    assert order.speed == TURNING_SPEED > 0


@pytest.mark.parametrize("kind", ["hexapod", "quadrotor"])
def test_what_turns_where_it_is_does_so_before_it_goes(kind: str) -> None:
    order = steered(kind, math.pi / 2)
    assert order.yaw == pytest.approx(0.0)
    assert order.speed == 0.0


@pytest.mark.parametrize("kind", COURSES)
def test_with_an_unsure_place_it_creeps(kind: str) -> None:
    assert steered(kind, 0.0, sure=False).speed == UNSURE_SPEED


def test_a_boat_looks_wherever_it_came_from_and_others_turn_to_where_they_should() -> None:
    pose = Pose2(0.0, 0.0, 0.0)
    assert CourseController(Course("boat", 1.0)).face(pose, 2.0)
    robot = Course("hexapod", 1.0)
    assert not CourseController(robot).face(pose, 2.0)
    assert (robot.told[-1].yaw, robot.told[-1].speed) == (2.0, 0.0)
    assert CourseController(robot).face(pose, 0.05)
