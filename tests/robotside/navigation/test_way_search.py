"""Planning beside the loop: the robot rests or goes on safely meanwhile, and what comes too late counts for nothing."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
import numpy as np
import pytest

from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.core.pose2 import Points, Pose2
from robotside.core.worker import Work
from robotside.core.worker_thread import WorkerThread
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.navigator import Goal, LegState, Navigator
from tests.fakes import Box, FakeRobot
from tests.robotside.held_worker import HeldWorker
from tests.robotside.scene import Scene

NOTHING = np.empty((0, 2))
LIMIT = 30.0
CUPBOARD = Box(-9.0, 4.0, -8.0, 5.5)
"""It makes the hall look different from its two ends, so that the robot is sure of its place."""


@pytest.fixture
def worker() -> HeldWorker:
    return HeldWorker()


@pytest.fixture
def scene(tmp_path: Path, worker: HeldWorker) -> Iterator[Scene]:
    """It is sent somewhere and waits for its way."""
    scene = Scene(FakeRobot(start=(-4.0, 0.0, 0.0), boxes=[CUPBOARD]), tmp_path, worker=worker)
    scene.run(3.5)
    worker.holds = True
    scene.go_to(4.0, 0.0)
    scene.run(1.0)
    assert scene.task.phase == "planning"
    assert scene.robot.at_rest
    yield scene
    scene.station.close()


def test_it_rests_until_the_way_is_there_and_then_goes(scene: Scene, worker: HeldWorker) -> None:
    scene.run(60.0)
    assert scene.robot.at_rest
    assert scene.task.state == "RUNNING"
    assert worker.submitted == 1
    worker.holds = False
    scene.run(1.0)
    assert not scene.robot.at_rest


@pytest.mark.parametrize("service", ["/stop", "/task/pause", "/task/cancel"])
def test_after_stop_pause_or_cancel_a_way_that_comes_too_late_moves_nothing(
    service: str, scene: Scene, worker: HeldWorker
) -> None:
    assert scene.ask(service).success
    worker.holds = False
    for _ in range(30):
        scene.run(0.1)
        assert scene.robot.at_rest
    assert worker.cancelled == 1
    assert worker.taken == 0


def test_a_lost_link_or_a_released_stop_starts_nothing_either(scene: Scene, worker: HeldWorker) -> None:
    scene.ask("/stop")
    worker.holds = False
    scene.run(1.0)
    scene.ask("/stop/release")
    scene.run(5.0)
    assert scene.robot.at_rest
    assert worker.taken == 0


def test_of_two_goals_only_the_way_to_the_last_one_counts(scene: Scene, worker: HeldWorker) -> None:
    scene.go_to(-4.0, 4.0)
    scene.run(0.2)
    worker.holds = False
    assert scene.run_task().state == "SUCCEEDED"
    assert np.hypot(scene.robot.pose[0] + 4.0, scene.robot.pose[1] - 4.0) < 0.2
    assert worker.cancelled >= 1


def test_a_way_from_the_wrong_place_is_looked_for_anew(scene: Scene, worker: HeldWorker) -> None:
    scene.station.autonomy.place(Pose2(-3.9, 0.1, 0.0))
    scene.run(0.2)
    assert (worker.submitted, worker.cancelled) == (2, 1)


def test_a_fault_of_the_search_ends_the_task_at_rest(
    scene: Scene, worker: HeldWorker, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object) -> Points:
        raise ZeroDivisionError

    monkeypatch.setattr("robotside.navigation.planner._room_along", broken)
    worker.holds = False
    scene.run(1.0)
    assert scene.task.state == "FAILED"
    assert "ZeroDivisionError" in scene.task.reason
    assert scene.robot.at_rest


class Boat(FakeRobot):
    """Keeps courses; its course controller avoids nothing by itself."""

    def __init__(self) -> None:
        super().__init__(start=(-6.0, 0.0, 0.0))
        self.info = msgspec.structs.replace(self.info, kind="boat", manoeuvres=["course"])
        self.told: list[Manoeuvre | None] = []

    def manoeuvre(self, order: Manoeuvre) -> None:
        """Note it."""
        self.told.append(order)

    def stop(self) -> None:
        """Note that as well."""
        super().stop()
        self.told.append(None)


def test_a_boat_goes_on_while_the_new_way_is_looked_for_but_not_into_what_is_in_the_way(
    worker: HeldWorker,
) -> None:
    boat = Boat()
    navigator = Navigator(boat, Grid.from_msg(boat.map()), lambda _: None, worker)
    navigator.head_for(Goal("Point 1", 6.0, 0.0))
    assert navigator.update(Pose2(-6.0, 0.0, 0.0), NOTHING, 0.0) is LegState.UNDER_WAY
    worker.holds = True
    navigator.obstacles.update(np.array([[0.0, 0.0]]), 2.0)
    told = []
    for tick in range(120):
        x = -6.0 + 0.05 * tick
        navigator.update(Pose2(x, 0.0, 0.0), NOTHING, 2.0 + 0.05 * tick)
        told.append((x, boat.told[-1] is not None))
    assert navigator.planning
    assert worker.submitted == 2
    goes = [x for x, going in told if going]
    assert min(goes) == -6.0
    assert -4.0 < max(goes) < -navigator.controller.clear
    rests = [x for x, going in told if not going]
    assert rests == [x for x, _ in told if x > max(goes)]
    worker.holds = False
    navigator.update(Pose2(max(goes), 0.0, 0.0), NOTHING, 9.0)
    assert boat.told[-1] is not None


@pytest.fixture
def thread() -> Iterator[WorkerThread]:
    with WorkerThread("planning test") as thread:
        yield thread


def idle(thread: WorkerThread) -> Callable[[], None]:
    """Gives a call that waits until the thread has done all that it was given."""

    def wait() -> None:
        last = threading.Event()

        def mark() -> Work[None]:
            last.set()
            yield

        thread.submit(mark())
        assert last.wait(LIMIT)

    return wait


def test_whole_with_the_real_thread_it_plans_replans_and_arrives(
    tmp_path: Path, thread: WorkerThread
) -> None:
    robot = FakeRobot(start=(-4.0, 0.0, 0.0), boxes=[CUPBOARD, Box(-0.5, -2.0, 0.5, 2.0)])
    scene, planned = Scene(robot, tmp_path, worker=thread), idle(thread)
    scene.run(3.5)
    scene.go_to(4.0, 0.0)
    phases = set()
    for _ in range(1200):
        scene.run(0.1)
        planned()
        phases.add(scene.task.phase)
        if scene.task.state != "RUNNING":
            break
    assert scene.task.state == "SUCCEEDED"
    assert "driving" in phases
    assert np.hypot(robot.pose[0] - 4.0, robot.pose[1]) < 0.2
    scene.station.close()


def test_whole_with_the_real_thread_a_pause_in_the_middle_of_planning_is_obeyed(
    tmp_path: Path, thread: WorkerThread
) -> None:
    robot = FakeRobot(start=(-4.0, 0.0, 0.0), boxes=[CUPBOARD])
    scene, planned = Scene(robot, tmp_path, worker=thread), idle(thread)
    scene.run(3.5)
    gate, began = threading.Event(), threading.Event()

    def block() -> Work[None]:
        began.set()
        assert gate.wait(LIMIT)
        yield

    thread.submit(block())
    assert began.wait(LIMIT)
    scene.go_to(4.0, 0.0)
    scene.run(1.0)
    assert scene.task.phase == "planning"
    assert scene.ask("/task/pause").success
    gate.set()
    planned()
    scene.run(2.0)
    assert robot.at_rest
    placed = PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(-4.0, 0.0))))
    scene.station.on_message(scene.anna, "/initialpose", placed, None)
    assert scene.ask("/task/resume").success
    for _ in range(600):
        scene.run(0.1)
        planned()
        if scene.task.state != "RUNNING":
            break
    assert scene.task.state == "SUCCEEDED"
    scene.station.close()
