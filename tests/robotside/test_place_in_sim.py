"""A robot that is told a place one door off: it finds or asks its own, and no task is done elsewhere, against the truth of the simulation."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import ChoosePlaceRequest, Waypoint
from robotside.core.pose2 import Pose2
from sim.robot import make_several
from sim.world.tables import Start
from tests.robotside.sim_run import Run

pytestmark = pytest.mark.slow

DOOR = 4.4
"""From one door of the office to the next [m]."""
BEACONS = ("/fix", "/imu/data")
WRONG, THERE = 0.5, 0.3
"""A place so far off is a wrong one, and so far off a goal is not at it [m]."""


class Misplaced:
    """Stands at a true place of the office, and is told another one."""

    def __init__(self, state: Path, true: Pose2, told: Pose2, *, beacons: bool) -> None:
        start = Start(x=true.x, y=true.y, yaw=math.degrees(true.yaw))
        robot = make_several([("patrol", start)], "office", seed=4, camera=False)[0]
        read = robot.read
        if not beacons:
            robot.read = lambda now: [pair for pair in read(now) if pair[0] not in BEACONS]  # type: ignore[method-assign]
        self.run = Run(robot, state)
        self.wrong = 0.0
        """For how long it believed a wrong place [s]."""
        assert not self.run.station.placing.place(self.run.anna, told)

    def watch(self, seconds: float) -> None:
        """Let time pass while a task runs, if any does."""
        run, estimator = self.run, self.run.station.autonomy.pose_estimator
        end = run.now + seconds
        while run.now < end:
            run.wait(0.1)
            if estimator.sure and run.error > WRONG:
                self.wrong += 0.1
            if not run.station.autonomy.engine.running:
                break

    @property
    def knows(self) -> bool:
        """It is sure of where it truly is."""
        return self.run.station.autonomy.pose_estimator.sure and self.run.error < WRONG


@pytest.fixture
def made(tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[Misplaced]:
    true, told, beacons = request.param
    misplaced = Misplaced(tmp_path, true, told, beacons=beacons)
    yield misplaced
    misplaced.run.station.close()


IN_CORRIDOR, IN_ROOM = Pose2(-2.4, 0.0, 0.0), Pose2(2.0, 3.6, -math.pi / 2)


@pytest.mark.parametrize(
    "made",
    [
        pytest.param((IN_CORRIDOR, Pose2(-2.4 + DOOR, 0.0, 0.0), False), id="corridor"),
        pytest.param((IN_ROOM, Pose2(2.0 + DOOR, 3.6, -math.pi / 2), False), id="room"),
        pytest.param((IN_ROOM, Pose2(2.0 - DOOR, 3.6, -math.pi / 2), True), id="room-with-satellites"),
    ],
    indirect=True,
)
def test_who_was_placed_one_door_off_finds_or_asks_its_place_and_ends_at_the_goal(made: Misplaced) -> None:
    run, estimator = made.run, made.run.station.autonomy.pose_estimator
    goal = Waypoint(-6.8, 2.9)
    run.order("go_to", goals=[goal])
    made.watch(20.0)
    if run.task.code == "task_place_asked":
        before = run.place
        made.watch(10.0)
        assert math.dist(run.place, before) < 0.01  # it stands until it is answered
        right = [each for each in estimator.candidates if math.dist((each.x, each.y), run.place) < WRONG]
        assert len(right) == 1
        run.ask("/localisation/choose", ChoosePlaceRequest(id=right[0].id))
    else:
        assert made.knows
    made.watch(100.0)
    assert made.wrong == 0.0
    assert (run.task.state, run.task.reason) == ("SUCCEEDED", "Way to the goal done.")
    assert math.dist(run.place, (goal.x, goal.y)) < THERE
    assert made.knows
    assert run.robot.simulation.contacts == 0
