"""The gate between everything that drives and the robot."""

from __future__ import annotations

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
