"""Looking for a way that is hard to find: a bit at a time, and given up at once when somebody asks for that."""

from __future__ import annotations

import itertools
import math
from pathlib import Path

import msgspec
import numpy as np
import pytest

from bridge.msgs.geometry_msgs import Twist
from robotside.core.pose2 import Pose2
from robotside.core.worker import STEPS_PER_POLL, InLoopWorker
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation import lattice_planner as lattice
from robotside.navigation.lattice_planner import LatticePlanner
from robotside.navigation.navigator import Goal, LegState, Navigator
from tests.fakes import Box, FakeRobot
from tests.robotside.held_worker import HeldWorker
from tests.robotside.scene import Scene

CLOSED = [
    Box(3.0, -2.0, 7.0, -1.6),
    Box(3.0, 1.6, 7.0, 2.0),
    Box(3.0, -2.0, 3.4, 2.0),
    Box(6.6, -2.0, 7.0, 2.0),
]
"""Round the goal: wherever it looks, there is no way."""
GOAL = Goal("Point 1", 5.0, 0.0)


class Looks:
    """How many poses were looked at."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.count = 0
        children = LatticePlanner._children

        def counted(*words: object) -> object:
            self.count += 1
            return children(*words)  # type: ignore[arg-type]

        monkeypatch.setattr(LatticePlanner, "_children", counted)


@pytest.fixture
def looks(monkeypatch: pytest.MonkeyPatch) -> Looks:
    return Looks(monkeypatch)


def truck(*boxes: Box) -> FakeRobot:
    robot = FakeRobot(start=(-4.0, 0.0, 0.0), boxes=boxes)
    robot.info = msgspec.structs.replace(robot.info, kind="ackermann")
    return robot


def test_the_hardest_search_takes_no_more_than_its_share_of_each_update(
    looks: Looks, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lattice, "MAX_POSES", 10 * STEPS_PER_POLL)
    robot = truck(*CLOSED)
    navigator = Navigator(robot, Grid.from_msg(robot.map()), lambda _: None)
    navigator.head_for(GOAL)
    shares = []
    for tick in range(100):
        before = looks.count
        leg = navigator.update(Pose2(*robot.pose), np.empty((0, 2)), tick * 0.05)
        shares.append(looks.count - before)
        if leg is LegState.BLOCKED:
            break
        assert navigator.planning
        assert robot.at_rest
    assert leg is LegState.BLOCKED
    assert navigator.reason == "There is no way to Point 1 at (5.0, 0.0) that it can drive."
    assert max(shares) <= STEPS_PER_POLL
    assert 9 * STEPS_PER_POLL < sum(shares) <= 10 * STEPS_PER_POLL


def test_it_finds_bit_by_bit_what_it_finds_in_one_go() -> None:
    robot = truck(Box(0.0, -2.0, 0.4, 2.0))
    grid = Grid.from_msg(robot.map())

    def drawn(worker: InLoopWorker) -> list[list[list[float]]]:
        ways: list[list[list[float]]] = []
        navigator = Navigator(robot, grid, lambda way: ways.append(way.tolist()), worker)
        navigator.head_for(GOAL)
        for tick in range(1000):
            navigator.update(Pose2(-4.0, 0.0, 0.0), np.empty((0, 2)), tick * 0.05)
            if ways:
                break
        return ways

    found = [drawn(InLoopWorker(share)) for share in (2, 10**6)]
    assert found[0] == found[1]
    assert math.dist(found[0][0][-1], (5.0, 0.0)) < 0.05


def searching(state: Path, looks: Looks) -> Scene:
    """It is asked to go where no way leads, and looks for one."""
    run = Scene(truck(*CLOSED), state)
    run.run(3.5)
    run.go_to(5.0, 0.0)
    for _ in itertools.takewhile(lambda _: looks.count < 3 * STEPS_PER_POLL, range(20)):
        run.run(0.1)
    status = run.task
    assert (status.phase, status.reason) == ("planning", "Looking for a way to the goal.")
    assert run.station.autonomy.navigator.planning
    return run


@pytest.mark.parametrize("service", ["/stop", "/task/pause", "/task/cancel"])
def test_whoever_stops_or_pauses_it_meanwhile_is_obeyed_at_once(
    service: str, tmp_path: Path, looks: Looks
) -> None:
    run = searching(tmp_path, looks)
    answer = run.ask(service)
    assert answer.success, answer.message
    so_far = looks.count
    assert not run.station.autonomy.navigator.planning
    run.run(1.0)
    assert looks.count == so_far
    assert run.robot.at_rest


def test_resumed_it_looks_anew(tmp_path: Path, looks: Looks) -> None:
    run = searching(tmp_path, looks)
    run.ask("/task/pause")
    run.run(0.5)
    so_far = looks.count
    run.ask("/task/resume")
    run.run(0.5)
    assert run.station.autonomy.navigator.planning
    assert looks.count > so_far


def test_another_place_takes_the_place_of_the_one_that_it_looks_for(tmp_path: Path, looks: Looks) -> None:
    run = searching(tmp_path, looks)
    run.go_to(-1.0, 0.0)
    run.run(1.0)
    status = run.task
    assert (status.phase, run.station.autonomy.navigator.planning) == ("driving", False)


@pytest.mark.parametrize("kind", ["wheels", "boat", "hexapod", "quadrotor"])
def test_every_kind_looks_for_a_way_a_bit_at_a_time_and_stands_meanwhile(
    kind: str,
) -> None:
    robot = truck(Box(0.0, -2.0, 0.4, 2.0))
    robot.info = msgspec.structs.replace(robot.info, kind=kind)
    navigator = Navigator(robot, Grid.from_msg(robot.map()), lambda _: None, InLoopWorker(1))
    robot.drive(Twist.planar(0.5, 0.0))
    navigator.head_for(GOAL)
    ticks = 0
    while navigator.controller.under_way is False and ticks < 500:
        assert navigator.update(Pose2(*robot.pose), np.empty((0, 2)), ticks * 0.05) is LegState.UNDER_WAY
        ticks += 1
        assert navigator.controller.under_way or (navigator.planning and robot.at_rest)
    assert 5 < ticks < 500


def test_while_it_looks_for_another_way_it_goes_on_along_the_one_that_it_has() -> None:
    robot, worker = truck(), HeldWorker()
    robot.info = msgspec.structs.replace(robot.info, kind="wheels")
    navigator = Navigator(robot, Grid.from_msg(robot.map()), lambda _: None, worker)
    navigator.head_for(GOAL)
    nothing = np.empty((0, 2))
    navigator.update(Pose2(-4.0, 0.0, 0.0), nothing, 0.0)
    assert navigator.controller.under_way
    worker.holds = True
    navigator.obstacles.update(np.array([[1.0, 0.0]]), 2.0)
    told = len(robot.commands)
    navigator.update(Pose2(-4.0, 0.0, 0.0), nothing, 2.0)
    assert navigator.planning
    for tick in range(3):
        navigator.update(Pose2(-4.0, 0.0, 0.0), nothing, 2.05 + 0.05 * tick)
        assert navigator.planning
    speeds = [twist.linear.x for twist in robot.commands[told:] if twist is not None]
    assert len(speeds) == 4
    assert min(speeds) > 0.05
    # right before it something turns up: it brakes for that as ever
    for tick in range(4):
        navigator.update(Pose2(-4.0, 0.0, 0.0), np.array([[0.22, 0.0]]), 2.2 + 0.05 * tick)
        assert navigator.planning
    last = robot.commands[-1]
    assert last is None or last.linear.x == 0.0
