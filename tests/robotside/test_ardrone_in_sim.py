"""A quadrotor at work over the car park: it takes off for what it has to do, and lands at home."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Point, Pose, PoseStamped, Quaternion
from bridge.msgs.pilothouse_msgs import CommandRequest, Mission, Waypoint
from robotside.services.command_messages import listener
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.patrol import patrol_route
from sim.robot import make
from tests.robotside.sim_run import Run

pytestmark = pytest.mark.slow

HOME = Waypoint(-17.5, -11.0, math.pi / 2)
POINTS = [Waypoint(-17.5, -5.0), Waypoint(-14.0, -3.0)]


@pytest.fixture
def run(tmp_path: Path) -> Iterator[Run]:
    run = Run(make("ardrone", "parking_lot", seed=2, camera=False), tmp_path)
    yield run
    run.station.close()


def height(run: Run) -> float:
    return run.robot.simulation.vehicle.state().position[2]


def rotors(run: Run) -> float:
    return float(max(run.robot.simulation.vehicle.motors.speeds))  # type: ignore[attr-defined]  # a quadrotor's


def test_it_takes_off_for_a_patrol_hovers_after_it_and_lands_at_home(run: Run) -> None:
    run.patrol(POINTS, home=[HOME])
    run.wait(0.5)
    assert (run.task.phase, run.task.reason) == ("taking off", "Taking off.")
    trail = run.finish()
    assert run.task.reason == "Patrol done: 2 points visited."
    for point in POINTS:
        assert min(math.hypot(x - point.x, y - point.y) for x, y in trail) < 1.0
    run.wait(2.0)
    assert height(run) == pytest.approx(2.0, abs=0.3)
    run.ask("/task/go_home", CommandRequest())
    run.finish()
    assert run.task.reason == "Home."
    assert height(run) < 0.1
    run.wait(2.0)
    assert rotors(run) < 1.0
    assert math.hypot(run.place[0] - HOME.x, run.place[1] - HOME.y) < 1.5


def test_take_off_hold_and_land(run: Run) -> None:
    run.order("take_off", height=1.5)
    run.finish()
    assert run.task.reason == "In the air."
    assert height(run) == pytest.approx(1.5, abs=0.25)
    begun = run.place
    run.order("hold", height=2.5, duration=8.0)
    run.finish()
    assert height(run) == pytest.approx(2.5, abs=0.2)
    assert math.dist(begun, run.place) < 0.6
    run.order("land")
    run.wait(1.0)
    run.ask("/task/pause", CommandRequest())
    run.wait(2.0)
    waits = height(run)
    assert waits > 1.0
    run.ask("/task/resume", CommandRequest())
    run.finish()
    assert run.task.reason == "Landed."
    assert height(run) < 0.1


def test_stop_on_the_way_up_keeps_it_in_the_air_and_the_task_waits(run: Run) -> None:
    run.order("take_off", height=3.0)
    run.wait(2.5)
    run.ask("/stop", CommandRequest())
    run.wait(3.0)
    before = height(run)
    run.wait(2.0)
    assert run.task.state == "PAUSED"
    assert height(run) == pytest.approx(before, abs=0.15)
    assert rotors(run) > 100.0


def test_it_follows_a_heading_in_the_air(run: Run) -> None:
    run.order("follow_heading", heading=math.pi / 4, speed=1.0, duration=9.0)
    run.finish()
    _, _, yaw = run.robot.simulation.pose()
    assert run.task.state == "SUCCEEDED"
    assert yaw == pytest.approx(math.pi / 4, abs=0.1)
    assert height(run) > 1.5


def test_it_visits_points_at_their_heights_also_one_above_the_other(run: Run) -> None:
    x, y = -17.5, -7.0
    points = [Waypoint(x, y, height=1.5), Waypoint(x, y, height=4.0), Waypoint(x, y + 2.0)]
    run.patrol(points, home=[HOME])
    reached = list[float]()
    while run.station.autonomy.engine.running:
        run.wait(0.1)
        if run.task.visited > len(reached):
            reached.append(height(run))
    assert run.task.reason == "Patrol done: 3 points visited."
    assert reached == pytest.approx([1.5, 4.0, 4.0], abs=0.3)
    with pytest.raises(AssertionError, match=r"at point 2 must be from 0.3 to 30 m, not 31 m"):
        run.patrol([Waypoint(x, y), Waypoint(x, y, height=31.0)], home=[HOME])


def test_a_published_goal_has_its_height_and_one_of_a_flat_map_keeps_it(run: Run) -> None:
    for z, kept in ((3.0, 3.0), (0.0, 3.0)):
        goal = PoseStamped(pose=Pose(Point(-17.5, -9.0 + z, z), Quaternion.from_yaw(0.0)))
        assert not listener(run.station)(run.anna, "/goal_pose", goal, None)
        run.finish()
        assert run.task.reason == "Way to the goal done."
        assert height(run) == pytest.approx(kept, abs=0.3)


def test_a_height_that_it_does_not_reach_is_refused(run: Run) -> None:
    said = "The height of Ardrone-1 in parking_lot must be from 0.3 to 30 m, not"
    for task, height in itertools.product(("take_off", "hold", "follow_heading"), (0.0, 30.2, 1e9, math.inf)):
        with pytest.raises(AssertionError, match=f"{said} {re.escape(f'{height:g}')} m"):
            run.order(task, height=height)
    assert run.task.state == "IDLE"


def test_on_its_back_it_takes_no_task_and_no_stick_moves_it_and_that_is_said(run: Run) -> None:
    vehicle = run.robot.simulation.vehicle
    x, y, z = vehicle.state().position
    vehicle.scene.backend.place(vehicle.body, (x, y, z + 0.05), (1.0, 0.0, 0.0, 0.0))
    run.wait(1.0)
    with pytest.raises(AssertionError, match="Ardrone-1 has turned over; put it upright first"):
        run.order("take_off", height=1.5)
    assert rotors(run) == 0.0
    run.ask("/robot/reset", CommandRequest())
    run.wait(0.5)
    run.order("take_off", height=1.5)
    run.finish()
    assert run.task.reason == "In the air."


def test_a_height_beyond_reach_in_its_course_ends_the_patrol_where_it_hovers(run: Run) -> None:
    run.patrol([Waypoint(-17.5, -9.0, height=2.0), Waypoint(-17.5, -7.0)], laps=0)
    run.until(lambda: run.task.visited == 1, 60.0)
    task = run.station.autonomy.engine.task
    assert task is not None
    assert isinstance(task.course, Course)
    # as if it had got past every check before
    task.course.edit(patrol_route(Mission(waypoints=[Waypoint(-17.5, -7.0, height=1e308)])))
    heights = []
    while run.station.autonomy.engine.running:
        run.wait(0.1)
        heights.append(height(run))
    assert run.task.state == "FAILED"
    assert run.task.code == Code.HEIGHT_INVALID
    run.wait(5.0)
    assert max(*heights, height(run)) < 2.5
    assert height(run) == pytest.approx(2.0, abs=0.3)
    assert not any("fault" in event.text for event in run.station.events.since(0, ""))
