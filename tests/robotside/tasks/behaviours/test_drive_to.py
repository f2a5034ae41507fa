"""Driving to a point, ticked by hand."""

from __future__ import annotations

from py_trees.common import Status

from bridge.msgs.pilothouse_msgs import Mission, Waypoint
from robotside.tasks.behaviours.drive_to import STANDING_TIMEOUT, DriveTo
from tests.robotside.tasks.behaviours.stage import Stage


def test_a_robot_that_makes_no_way_says_so_and_ends_with_a_sentence() -> None:
    stage = Stage()
    course, _ = stage.patrol(Mission(waypoints=[Waypoint(5.0, 0.0)], home=[Waypoint(0.0, 0.0)]))
    tree = DriveTo(course, stage.navigator, stage.situation)
    stage.tick(tree, 2.0)
    assert stage.situation.doing.text == "Heading for point 1 of 1."
    drive, stage.robot.drive = stage.robot.drive, lambda _: None  # type: ignore[method-assign]
    stage.robot.stop()
    stage.tick(tree, STANDING_TIMEOUT + 0.5)
    assert stage.situation.doing.text == "Makes no way to point 1 of 1; it goes on trying."
    stage.robot.drive = drive  # type: ignore[method-assign]
    stage.tick(tree, 2.0)
    assert stage.situation.doing.text == "Heading for point 1 of 1."
    stage.robot.drive = lambda _: None  # type: ignore[method-assign]
    stage.robot.stop()
    assert stage.tick(tree, 60.0) is Status.FAILURE
    assert tree.feedback_message.startswith("Stuck at (")
