from __future__ import annotations

import pytest

from app.link.feeds import Feeds, Post
from app.session.check_list import CheckListState
from bridge.msgs.geometry_msgs import Twist, TwistWithCovariance, Vector3
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Check, Checklist


class Robot:
    """What a robot tells, and whether it is on a task."""

    def __init__(self) -> None:
        self.feeds, self.running = Feeds(lambda: 0.0), False
        self.checks = CheckListState(self.feeds, lambda: self.running)

    def tell(self, *states: str) -> None:
        told = Checklist(checks=[Check(str(index), state) for index, state in enumerate(states)])
        self.feeds.put("/checklist", Post(told, 0.0, 1))
        self.checks.update()

    def drive(self, x: float = 0.0, turn: float = 0.0) -> None:
        twist = Twist(Vector3(x), Vector3(0.0, 0.0, turn))
        self.feeds.put("/odom", Post(Odometry(twist=TwistWithCovariance(twist)), 0.0, 1))
        self.checks.update()


@pytest.fixture
def robot() -> Robot:
    return Robot()


def test_it_is_unfolded_until_all_is_good(robot):
    robot.tell("ok", "unknown")
    assert robot.checks.open
    robot.tell("ok", "ok")
    assert not robot.checks.open


@pytest.mark.parametrize("motion", [{"x": 0.2}, {"x": -0.2}, {"turn": 0.3}])
def test_it_folds_when_the_robot_first_moves_and_stays_so(robot, motion):
    robot.tell("bad")
    robot.drive(x=0.01)
    robot.checks.choose(True)
    assert robot.checks.open
    robot.drive(**motion)
    robot.drive()
    assert not robot.checks.open


def test_a_task_is_a_motion(robot):
    robot.tell("bad")
    robot.running = True
    robot.checks.update()
    assert not robot.checks.open


def test_a_finger_folds_and_unfolds_it_at_any_time(robot):
    robot.tell("bad")
    robot.checks.choose(False)
    robot.checks.update()
    assert not robot.checks.open
    robot.drive(x=0.3)
    robot.checks.choose(True)
    robot.drive(x=0.3)
    assert robot.checks.open


def test_what_a_finger_unfolded_folds_when_all_becomes_good(robot):
    robot.tell("bad")
    robot.checks.choose(True)
    robot.tell("ok")
    assert not robot.checks.open
    robot.checks.choose(True)
    robot.tell("ok")
    assert robot.checks.open


def test_it_is_over_once_the_robot_has_moved_and_nothing_on_it_is_bad(robot):
    robot.tell("ok", "unknown")
    assert not robot.checks.over
    robot.drive(x=0.2)
    assert robot.checks.over
    robot.tell("ok", "bad")
    assert not robot.checks.over
    robot.tell("ok", "ok")
    assert robot.checks.over


def test_what_a_finger_unfolds_stays_until_it_folds_it(robot):
    robot.tell("ok", "unknown")
    robot.drive(x=0.2)
    robot.checks.choose(True)
    assert not robot.checks.over
    robot.checks.choose(False)
    assert robot.checks.over
