"""Driving a truck: no bend tighter than it can, no more room taken than its body needs."""

from __future__ import annotations

import math

import msgspec
import numpy as np
import pytest

from bridge.msgs.geometry_msgs import Twist
from robotside.core.pose2 import Points, Pose2
from robotside.core.worker import completed
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.ackermann_controller import HORIZON, AckermannController
from robotside.navigation.path_controller import Piece
from robotside.navigation.planner import Planner, Unreachable
from tests.fakes import FakeRobot

NOTHING: Points = np.empty((0, 2))
SWING = 1 / 3.5 / 0.8 * 0.05
"""So much more the truck's way may bend from one command to the next, as its front wheels swing [1/m]."""
GRID = Grid(np.zeros((400, 400), dtype=np.bool_), 0.1, -20.0, -20.0)


def truck(
    start: tuple[float, float, float] = (0.0, 0.0, 0.0), clearance: float | None = None
) -> tuple[FakeRobot, AckermannController]:
    robot = FakeRobot(start=start)
    robot.info = msgspec.structs.replace(
        robot.info, kind="ackermann", max_speed=5.0, max_yaw_rate=1.4, radius=2.6, min_radius=3.5
    )
    return robot, AckermannController(robot, clearance)


def drive(goal: tuple[float, float, float], things: Points = NOTHING) -> tuple[FakeRobot, float]:
    """To the end of its way; and its tightest bend [1/m]."""
    robot, controller = truck()
    controller.follow(
        completed(controller.search(Planner(GRID, 0.9), Pose2(*robot.pose), goal, "The goal", NOTHING))
    )
    now, tightest = 0.0, 0.0
    list(robot.read(now))
    while not controller.arrived(Pose2(*robot.pose)) and now < 120.0:
        pose = Pose2(*robot.pose)
        if not controller.under_way:
            controller.follow(
                completed(controller.search(Planner(GRID, 0.9), pose, goal, "The goal", NOTHING))
            )
        controller.steer(pose, pose.inverse().apply(things), sure=True)
        if abs(robot.twist.linear.x) > 0.2:
            tightest = max(tightest, abs(robot.twist.angular.z / robot.twist.linear.x))
        now += 0.05
        list(robot.read(now))
    return robot, tightest


@pytest.mark.parametrize(
    "goal",
    [
        (7.0, 2.0, math.nan),
        (-3.0, 4.0, math.nan),
        pytest.param((5.0, 4.0, math.pi), marks=pytest.mark.slow),
        (-4.0, 0.0, 0.0),
    ],
)
def test_it_comes_to_its_goal_by_bends_that_it_can_drive(goal: tuple[float, float, float]) -> None:
    robot, tightest = drive(goal)
    assert math.dist(robot.pose[:2], goal[:2]) < 0.6
    assert tightest < 1 / 3.5 + 1e-6
    if not math.isnan(goal[2]):
        assert abs(math.remainder(robot.pose[2] - goal[2], math.tau)) < 0.35


def test_it_stands_before_what_lies_in_its_way() -> None:
    things = np.column_stack([np.full(80, 6.0), np.linspace(-4.0, 4.0, 80)])
    robot, _ = drive((9.0, 0.0, math.nan), things)
    assert robot.at_rest
    assert 1.0 < 6.0 - robot.pose[0] - 2.5 < 2.0 or robot.pose[0] < 2.6


def test_its_body_needs_room_ahead_of_the_axle_and_beside_it_no_more_than_it_is_wide() -> None:
    _, controller = truck()
    assert controller.free(0.0, NOTHING) == HORIZON
    assert controller.free(0.0, np.array([[5.0, 0.0]])) == pytest.approx(1.75, abs=0.3)
    assert controller.free(0.0, np.array([[5.0, 1.2]])) == HORIZON
    assert controller.free(0.25, np.array([[4.0, 1.6]])) < 3.0


@pytest.mark.parametrize(("clearance", "passes"), [(None, True), (0.1, True), (0.3, False)])
def test_a_gap_is_passed_or_refused_by_the_clearance_that_is_set(
    clearance: float | None, passes: bool
) -> None:
    """2.4 m are more than its body of 1.88 m and 0.2 m to either side, and less than with 0.3 m."""
    occupied = np.zeros((200, 400), dtype=np.bool_)
    occupied[:, 260:264] = True
    occupied[88:112, 260:264] = False
    planner = Planner(Grid(occupied, 0.1, -20.0, -10.0), 0.9)
    _, controller = truck(clearance=clearance)
    search = controller.search(planner, Pose2(0.0, 0.0, 0.0), (12.0, 0.0, math.nan), "The goal", NOTHING)
    if passes:
        assert completed(search)
    else:
        with pytest.raises(Unreachable):
            completed(search)
    aside = 0.936 + 0.6 * (0.2 if clearance is None else clearance)
    assert controller.free(0.0, np.array([[4.0, aside + 0.01]])) == HORIZON
    assert controller.free(0.0, np.array([[4.0, aside - 0.02]])) < HORIZON


def test_who_stands_close_to_something_may_go_away_from_it() -> None:
    _, controller = truck()
    close = np.array([[3.2, 0.0]])
    assert controller.free(0.0, close) == 0.0
    assert controller.free(0.0, close, -1.0) == HORIZON


def test_a_goal_off_the_map_is_named() -> None:
    robot, controller = truck()
    with pytest.raises(Unreachable, match=r"Point 3 at \(50.0, 0.0\) is off the map"):
        list(
            controller.search(
                Planner(GRID, 0.9), Pose2(*robot.pose), (50.0, 0.0, math.nan), "Point 3", NOTHING
            )
        )


@pytest.mark.parametrize(("ahead", "half"), [(7.0, 0.2), (5.5, 0.6), (6.0, 1.0)])
def test_no_bend_is_taken_faster_than_its_tyres_hold_with_ease(ahead: float, half: float) -> None:
    """0.8 m/s2 aside, two fifths of what wet grass gives, also round what stands in its way all at once at 2 m/s."""
    robot, controller = truck((-15.0, 0.0, 0.0))
    straight = np.column_stack([np.arange(-15.0, 18.0, 0.1), np.zeros(330)])
    controller.follow([Piece(straight, True)])
    things, aside, fastest = NOTHING, [], 0.0
    list(robot.read(0.0))
    for tick in range(1, 180):
        pose = Pose2(*robot.pose)
        if tick == 82:
            things = np.column_stack([np.full(21, pose.x + ahead), np.linspace(-half - 0.6, half, 21)])
        controller.steer(pose, pose.inverse().apply(things), sure=True)
        aside.append(abs(robot.twist.linear.x * robot.twist.angular.z))
        fastest = max(fastest, robot.twist.linear.x)
        list(robot.read(0.05 * tick))
    assert max(aside) < 0.8 * 1.001
    assert fastest == pytest.approx(2.0)


def gone_askew(way: list[Piece], askew: float) -> float:
    """How far a truck comes off a `way` from the origin [m] that it begins so far `askew` [rad], with wheels that need their time and slip."""
    robot, controller = truck((0.0, 0.0, askew))
    controller.follow(way)
    bend = now = off = 0.0
    list(robot.read(now))
    for _ in range(1200):
        pose = Pose2(*robot.pose)
        if controller.arrived(pose) or not controller.under_way:
            break
        controller.steer(pose, NOTHING, sure=True)
        told, speed = robot.twist, robot.twist.linear.x
        if speed:
            bend += max(-SWING, min(SWING, told.angular.z / speed - bend))
            robot.twist = Twist.planar(speed, 0.95 * bend * speed)
        off = max(off, float(np.hypot(*(controller.ahead[:8] - pose[:2]).T).min()))
        now += 0.05
        list(robot.read(now))
    return off


@pytest.mark.parametrize("goal", [(-6.0, 3.5, 0.0), (1.0, 6.5, math.pi), (3.0, 9.0, -math.pi / 2)])
def test_it_comes_back_to_a_way_that_it_planned_and_begins_askew(
    goal: tuple[float, float, float],
) -> None:
    _, controller = truck()
    search = controller.search(Planner(GRID, 0.9), Pose2(0.0, 0.0, 0.0), goal, "The goal", NOTHING)
    assert gone_askew(completed(search), -0.2) < 0.45


@pytest.mark.parametrize(("aside", "on_its_way"), [(0.5, True), (0.7, False)])
def test_too_far_beside_its_way_it_stands_and_has_none(aside: float, on_its_way: bool) -> None:
    robot, controller = truck()
    controller.follow([Piece(np.column_stack([np.arange(0.0, 9.0, 0.1), np.zeros(90)]), True)])
    for tick in range(40):
        controller.steer(Pose2(0.05 * tick, 0.0, 0.0), NOTHING, sure=True)
    assert not robot.at_rest
    controller.steer(Pose2(2.0, aside, 0.0), NOTHING, sure=True)
    assert controller.under_way is on_its_way
    assert robot.at_rest is not on_its_way
