"""Back goes by one order, and a robot that moves for this handheld is left only after a question."""

from __future__ import annotations

from typing import Any

from kivy.uix.textinput import TextInput

from app.screens.parts.leave_dialog import LeaveDialog
from bridge.msgs.geometry_msgs import Twist, TwistWithCovariance, Vector3
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import ControlStatus, TaskStatus
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass


def moves(driving: Glass, robot: FakeRobot, speed: float = 0.4) -> None:
    robot.publish("/odom", Odometry(twist=TwistWithCovariance(Twist(Vector3(speed), Vector3()))))
    driving.until(lambda: driving.app.session.checks.moves == (speed > 0.1), "its speed was not heard")


def question(driving: Glass) -> Any:
    return next((one for one in driving.app.root.children if isinstance(one, LeaveDialog)), None)


def test_from_a_screen_back_leads_to_the_mission_and_then_to_the_robots(driving: Glass) -> None:
    app = driving.app
    assert app.back()
    assert app.shell.screen == "mission"
    assert app.back()
    assert app.session is None
    assert app.connect.parent is app.root


def test_the_keyboard_leaves_the_glass_before_the_screen(driving: Glass) -> None:
    field = TextInput(size_hint=(None, None), size=(10, 10))
    driving.app.shell.shown.add_widget(field)
    field.focus = True
    assert driving.app.back()
    assert not field.focus
    assert driving.app.shell.screen == "drive"


def test_a_stick_that_is_held_rests_when_back_leads_to_another_screen(
    driving: Glass, robot: FakeRobot
) -> None:
    stick = driving.app.screens["drive"].stick
    stick.lean(1.0, 0.0)
    driving.until(lambda: robot.twists() and robot.twists()[-1] != Twist(), "it does not drive")
    driving.app.leaving.leave()
    assert question(driving) is not None, "what is told to drive moves"
    assert driving.app.back()
    assert driving.app.back()
    driving.until(lambda: robot.twists() and robot.twists()[-1] == Twist(), "it drives on")


def test_a_robot_that_moves_is_left_only_after_a_question(driving: Glass, robot: FakeRobot) -> None:
    app = driving.app
    app.show("mission")
    moves(driving, robot)
    assert app.back()
    assert app.session is not None
    assert question(driving) is not None
    assert app.back(), "back closes the question, and nothing else"
    assert question(driving) is None
    assert app.session is not None
    app.shell.bar.dispatch("on_back")
    driving.stage.frames(3)
    driving.tap(question(driving).ids.stay)
    driving.until(lambda: question(driving) is None, "it stays open")
    assert app.session is not None
    app.shell.bar.dispatch("on_back")
    driving.stage.frames(3)
    driving.tap(question(driving).ids.leave)
    driving.until(lambda: app.session is None, "not left")


def test_the_question_says_whether_a_task_goes_on(driving: Glass, robot: FakeRobot) -> None:
    moves(driving, robot)
    driving.app.leaving.leave()
    assert not question(driving).tasked
    driving.app.back()
    robot.publish("/task/status", TaskStatus(task_id=1, task="patrol", state="RUNNING"))
    driving.until(lambda: driving.app.session.running, "no task")
    driving.app.leaving.leave()
    assert question(driving).tasked


def test_a_robot_that_somebody_else_drives_is_left_without_a_question(
    driving: Glass, robot: FakeRobot
) -> None:
    moves(driving, robot)
    robot.publish("/control/status", ControlStatus(driver="Bob", driver_id="b"))
    driving.until(lambda: driving.app.session.control == "other", "still ours")
    driving.app.leaving.leave()
    assert driving.app.session is None


def test_one_at_rest_is_left_at_once_and_what_comes_then_is_done(driving: Glass, robot: FakeRobot) -> None:
    moves(driving, robot, 0.0)
    done: list[bool] = []
    driving.app.leaving.leave(lambda: done.append(driving.app.session is None))
    assert done == [True]


def test_an_answer_that_comes_after_the_robot_was_left_otherwise_does_nothing(
    driving: Glass, robot: FakeRobot
) -> None:
    moves(driving, robot)
    done: list[bool] = []
    driving.app.leaving.leave(lambda: done.append(True))
    asked = question(driving)
    driving.app.leave()
    asked.answer()
    assert not done


def test_the_arrow_of_the_bar_goes_back_as_the_gesture_does(driving: Glass) -> None:
    driving.app.show("setup")
    driving.app.shell.bar.dispatch("on_back")
    assert (driving.app.shell.screen, driving.app.session is None) == ("mission", False)
    driving.app.shell.bar.dispatch("on_back")
    assert driving.app.session is None
