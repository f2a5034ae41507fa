"""A scout at work in an office: without a laser, by its sonars."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Bumper, CommandRequest, Waypoint
from sim.robot import make
from tests.robotside.sim_run import Run

pytestmark = pytest.mark.slow

ROOMS = [Waypoint(-6.8, 2.9), Waypoint(-2.4, -2.9), Waypoint(10.8, -2.9), Waypoint(-10.2, 1.6, math.pi)]


def test_a_scout_patrols_rooms_touches_nothing_and_knows_where_it_is_by_its_sonars(tmp_path: Path) -> None:
    run = Run(make("scout", "office", seed=2, camera=False), tmp_path)
    run.patrol(ROOMS, home=[ROOMS[-1]])
    trail, worst = [], 0.0
    while run.station.autonomy.engine.running and run.now < 1200.0:
        run.wait(0.2)
        trail.append(run.place)
        worst = max(worst, run.error)
    told = run.task.visited
    run.order("go_to", goals=[Waypoint(-11.0, -1.0, math.pi / 2)])
    run.finish()
    _, _, yaw = run.robot.simulation.pose()
    place, bumps = run.place, run.robot.simulation.contacts
    run.station.close()
    assert told == len(ROOMS)
    for point in ROOMS:
        assert min(math.hypot(x - point.x, y - point.y) for x, y in trail) < 0.3
    assert worst < 0.15
    assert bumps == 0
    assert math.hypot(place[0] + 11.0, place[1] + 1.0) < 0.25
    assert abs(yaw - math.pi / 2) < 0.15


def test_a_scout_without_its_sonars_does_not_go_on_by_itself(tmp_path: Path) -> None:
    run = Run(make("scout", "office", seed=2, camera=False), tmp_path)
    run.order("go_to", goals=[ROOMS[0]])
    read = run.robot.read
    run.wait(1.0)
    run.robot.read = lambda now: [pair for pair in read(now) if pair[0] != "/sonar"]  # type: ignore[method-assign]
    run.wait(1.0)
    state, reason = run.task.state, run.task.reason
    run.ask("/task/cancel", CommandRequest())
    run.station.close()
    assert state == "PAUSED"
    assert reason == "Paused: the sonars have been silent for 0.6 s."


def test_a_scout_that_pushes_against_a_wall_stays_where_it_is_and_says_that_it_is_unsure(
    tmp_path: Path,
) -> None:
    run = Run(make("scout", "office", seed=2, camera=False), tmp_path)
    said: list[str] = []
    run.station.bus.subscribe("/events", lambda _, event: said.append(event.text))
    push(run, 0.6, 8.0)
    pushes = [text for text in said if text.startswith("Position unsure: the wheels turn")]
    where = run.station.autonomy.pose_estimator
    spread, sure, error = where.spread, where.sure, run.error
    push(run, -0.3, 2.0)
    run.wait(4.0)
    back = run.error
    run.station.close()
    assert len(pushes) == 1
    assert not sure
    assert spread > 1.0
    assert error < 0.15
    assert back < 0.15
    assert where.sure
    assert said[-1] == "Position sure again."


def test_a_task_whose_wheels_turn_in_vain_is_paused(tmp_path: Path) -> None:
    run = Run(make("scout", "office", seed=2, camera=False), tmp_path)
    read, pressed = run.robot.read, Bumper(pressed=True, bearing=0.0)
    run.robot.read = lambda now: [  # type: ignore[method-assign]
        (topic, pressed if topic == "/bumper" else msg) for topic, msg in read(now)
    ]
    run.wait(0.5)
    run.order("go_to", goals=[Waypoint(-9.9, -1.0)])
    run.wait(5.0)
    state, reason = run.task.state, run.task.reason
    run.station.close()
    assert state == "PAUSED"
    assert reason == "Paused: the wheels turn, but something holds the robot."


def push(run: Run, speed: float, seconds: float) -> None:
    """Drive on whatever is there."""
    for _ in range(round(seconds / 0.1)):
        run.station.robot.drive(Twist.planar(speed, 0.0))  # as a program would: a stick pushes into nothing
        run.wait(0.1)
