"""The gate between everything that drives and the robot."""

from __future__ import annotations

import pytest

from bridge.msgs.geometry_msgs import Twist
from robotside.guarded import Guarded
from tests.fakes import FakeRobot

AHEAD = Twist.planar(0.3, 0.0)


def test_a_twist_brakes_while_stop_is_pressed_and_drives_again_afterwards() -> None:
    robot, pressed = FakeRobot(), True
    guarded = Guarded(robot, lambda: pressed)
    guarded.drive(AHEAD)
    assert robot.commands == [None]
    pressed = False
    guarded.drive(AHEAD)
    assert robot.commands == [None, AHEAD]


def test_a_twist_is_clamped_and_looked_at_again_wherever_the_robot_gets() -> None:
    robot, allowed = FakeRobot(), 0.3
    guarded = Guarded(robot, lambda: False, lambda twist: Twist.planar(min(twist.linear.x, allowed), 0.0))
    guarded.again()
    guarded.drive(Twist.planar(0.5, 0.0))
    guarded.again()
    assert robot.commands == [Twist.planar(0.3, 0.0)]
    allowed = 0.1
    guarded.again()
    allowed = 0.0
    guarded.again()
    guarded.again()
    assert robot.commands[1:] == [Twist.planar(0.1, 0.0), None]
    allowed = 0.3
    guarded.again()
    assert robot.commands[3:] == [Twist.planar(0.3, 0.0)]


def test_after_a_stop_nothing_is_looked_at_again() -> None:
    robot = FakeRobot()
    guarded = Guarded(robot, lambda: False, lambda twist: Twist.planar(0.1 * len(robot.commands), 0.0))
    guarded.drive(AHEAD)
    guarded.stop()
    guarded.again()
    assert robot.commands[-1] is None


def test_stop_ends_what_was_wanted_even_when_a_twist_comes_while_it_is_pressed() -> None:
    robot, pressed = FakeRobot(), False
    guarded = Guarded(robot, lambda: pressed, lambda twist: Twist.planar(0.1 * len(robot.commands), 0.0))
    guarded.drive(AHEAD)
    pressed = True
    guarded.drive(AHEAD)
    pressed = False
    guarded.again()
    assert robot.commands[-1] is None


def test_a_fault_in_the_limits_brakes_the_robot() -> None:
    robot, broken = FakeRobot(), False

    def clamp(twist: Twist) -> Twist:
        if broken:
            raise ZeroDivisionError
        return twist

    guarded = Guarded(robot, lambda: False, clamp)
    guarded.drive(AHEAD)
    broken = True
    with pytest.raises(ZeroDivisionError):
        guarded.again()
    with pytest.raises(ZeroDivisionError):
        guarded.drive(AHEAD)
    assert robot.commands == [AHEAD, None, None]
    broken = False
    guarded.again()
    assert robot.at_rest


def test_everything_but_driving_passes_through() -> None:
    robot = FakeRobot()
    guarded = Guarded(robot, lambda: True)
    assert guarded.info == robot.info
    assert "/map" in [topic for topic, _ in guarded.read(0.0)]
    guarded.want("/camera/image/compressed", True)
    assert robot.wanted == {"/camera/image/compressed": True}
    guarded.stop()
    assert robot.commands == [None]
    guarded.close()
    assert robot.closed
