"""A map that takes long to make ready: the robot goes on without it, and never changes maps in the middle of a task."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge.msgs.nav_msgs import OccupancyGrid
from bridge.msgs.pilothouse_msgs import StartTaskRequest
from robotside.mapping.occupancy_grid import Grid
from robotside.station.fitness import NO_MAP
from tests.fakes import Box, FakeRobot
from tests.robotside.held_worker import HeldWorker
from tests.robotside.scene import SQUARE, Scene

WALL = Box(1.0, 2.0, 1.5, 4.0)


def other_map() -> OccupancyGrid:
    return FakeRobot(boxes=[WALL]).map()


def knows_wall(scene: Scene) -> bool:
    return bool(scene.station.autonomy.navigator.planner.fault("It", 1.25, 3.0))


@pytest.fixture
def worker() -> HeldWorker:
    return HeldWorker()


@pytest.fixture
def scene(tmp_path: Path, worker: HeldWorker) -> Iterator[Scene]:
    scene = Scene(FakeRobot(), tmp_path, worker=worker)
    scene.run(3.5)
    yield scene
    scene.station.close()


def come(scene: Scene, msg: OccupancyGrid) -> None:
    scene.station.autonomy.on_message("/map", msg, scene.now)
    scene.run(0.1)


def test_a_map_is_there_from_the_start_whatever_the_worker_does(tmp_path: Path, worker: HeldWorker) -> None:
    worker.holds = True
    scene = Scene(FakeRobot(boxes=[WALL]), tmp_path, worker=worker)
    assert scene.station.autonomy.has_map
    assert knows_wall(scene)


def test_the_first_map_counts_once_it_is_ready(tmp_path: Path, worker: HeldWorker) -> None:
    robot = FakeRobot()
    robot.silent.add("/map")
    scene = Scene(robot, tmp_path, worker=worker)
    worker.holds = True
    come(scene, robot.map())
    assert scene.refused("/task/start", StartTaskRequest()) == NO_MAP
    assert "There is a map now." not in scene.events("localisation")
    worker.holds = False
    scene.run(0.1)
    assert scene.station.autonomy.has_map
    assert scene.events("localisation").count("There is a map now.") == 1


def test_until_another_map_is_ready_the_old_one_counts(scene: Scene, worker: HeldWorker) -> None:
    worker.holds = True
    come(scene, other_map())
    assert not knows_wall(scene)
    worker.holds = False
    scene.run(0.1)
    assert knows_wall(scene)


def test_a_map_that_is_ready_in_the_middle_of_a_task_waits_for_its_end(
    scene: Scene, worker: HeldWorker
) -> None:
    worker.holds = True
    come(scene, other_map())
    scene.set(*SQUARE)
    scene.start()
    worker.holds = False
    scene.run(1.0)
    assert scene.task.state == "RUNNING"
    assert not knows_wall(scene)
    scene.ask("/task/cancel")
    scene.run(0.1)
    assert knows_wall(scene)


def test_of_maps_that_come_meanwhile_only_the_newest_is_made_ready(scene: Scene, worker: HeldWorker) -> None:
    worker.holds = True
    before = worker.submitted
    come(scene, FakeRobot().map())
    for _ in range(5):
        come(scene, FakeRobot().map())
    come(scene, other_map())
    worker.holds = False
    scene.run(0.2)
    assert worker.submitted == before + 2
    assert knows_wall(scene)


def test_a_map_too_large_for_the_memory_is_refused_and_the_old_one_stays(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    def too_large(_: OccupancyGrid) -> Grid:
        raise MemoryError

    monkeypatch.setattr(Grid, "from_msg", too_large)
    come(scene, other_map())
    assert "are too many for this computer" in scene.events("localisation")[-1]
    assert scene.station.autonomy.has_map
    monkeypatch.undo()
    come(scene, other_map())
    assert knows_wall(scene)
