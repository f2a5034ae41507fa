"""Back goes by one order, and a robot that this handheld has in hand is left only after a question."""

from __future__ import annotations

from typing import Any

import pytest
from kivy.uix.textinput import TextInput

from app.screens.parts.leave_dialog import LeaveDialog
from bridge.msgs.geometry_msgs import Twist, TwistWithCovariance, Vector3
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import ControlStatus, TaskStatus
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from tests.app.strange import strange_robot


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
    assert question(driving) is not None, "control is here"
    driving.tap(question(driving).ids.leave)
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
    assert question(driving).cause == "moves"
    driving.app.back()
    robot.publish("/task/status", TaskStatus(task_id=1, task="patrol", state="RUNNING"))
    driving.until(lambda: driving.app.session.running, "no task")
    driving.app.leaving.leave()
    assert question(driving).cause == "task"
    driving.app.back()
    robot.publish("/task/status", TaskStatus(task_id=1, task="patrol", state="PAUSED"))
    driving.until(lambda: driving.app.session.feeds.latest("/task/status").state == "PAUSED", "no pause")
    driving.app.leaving.leave()
    assert question(driving).cause == "moves", "it coasts, and nothing goes on by itself"


def test_a_robot_that_somebody_else_drives_is_left_without_a_question(
    driving: Glass, robot: FakeRobot
) -> None:
    moves(driving, robot)
    robot.publish("/control/status", ControlStatus(driver="Bob", driver_id="b"))
    driving.until(lambda: driving.app.session.control == "other", "still ours")
    driving.app.leaving.leave()
    assert driving.app.session is None


def watches(driving: Glass, robot: FakeRobot) -> None:
    """Control is nobody's, and this handheld does not want it."""
    driving.app.session.authority.release()
    robot.publish("/control/status", ControlStatus())
    driving.until(lambda: driving.app.session.control == "free", "still ours")


def test_one_at_rest_is_left_only_after_a_question_while_control_is_here(
    driving: Glass, robot: FakeRobot
) -> None:
    moves(driving, robot, 0.0)
    done: list[bool] = []
    driving.app.leaving.leave(lambda: done.append(driving.app.session is None))
    assert (question(driving).cause, done) == ("control", []), "control is not given away at one tap"
    driving.stage.frames(3)
    driving.tap(question(driving).ids.stay)
    assert driving.app.session.control == "mine"
    driving.app.leaving.leave(lambda: done.append(driving.app.session is None))
    driving.stage.frames(3)
    driving.tap(question(driving).ids.leave)
    assert done == [True]


def test_one_that_is_only_watched_is_left_at_once_and_what_comes_then_is_done(
    driving: Glass, robot: FakeRobot
) -> None:
    moves(driving, robot)
    watches(driving, robot)
    done: list[bool] = []
    driving.app.leaving.leave(lambda: done.append(driving.app.session is None))
    assert done == [True]


def test_one_whose_link_is_gone_is_left_at_once(driving: Glass, robot: FakeRobot) -> None:
    robot.cut()
    driving.until(lambda: not driving.app.session.connected, "it stands")
    driving.app.leaving.leave()
    assert driving.app.session is None


def test_a_finger_on_a_stick_is_asked_though_control_is_not_here_and_nothing_moves(
    driving: Glass, robot: FakeRobot
) -> None:
    watches(driving, robot)
    stick = driving.app.screens["drive"].stick
    finger = driving.hold(stick)
    assert (stick.forward, stick.left) == (0.0, 0.0), "it only rests there"
    driving.app.leaving.leave()
    assert question(driving).cause == "moves"
    finger.touch_up()


def test_another_robot_is_opened_after_the_same_question(driving: Glass) -> None:
    app, before = driving.app, driving.app.session
    app.open("ws://127.0.0.1:9")
    assert app.session is before
    question(driving).answer()
    assert app.session.robot.url == "ws://127.0.0.1:9"


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
    assert question(driving) is not None


def test_the_window_closes_only_after_the_same_question_and_at_once_when_it_is_closed_again(
    driving: Glass, monkeypatch: pytest.MonkeyPatch
) -> None:
    window, ended = driving.stage.window, list[bool]()
    monkeypatch.setattr(driving.app, "stop", lambda: ended.append(driving.app.session is None))
    assert window.dispatch("on_request_close"), "it stays"
    assert not window.dispatch("on_request_close"), "nobody is kept in"
    assert driving.app.back()
    assert window.dispatch("on_request_close")
    driving.stage.frames(3)
    driving.tap(question(driving).ids.leave)
    assert ended == [True]


def test_the_window_closes_at_once_where_no_robot_is_in_hand(driving: Glass, robot: FakeRobot) -> None:
    watches(driving, robot)
    assert not driving.stage.window.dispatch("on_request_close")
    driving.app.leave()
    assert not driving.stage.window.dispatch("on_request_close")


def test_a_robot_without_a_control_to_hold_is_left_only_after_a_question_while_it_moves(
    glass: Glass, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tests.bridge.foreign_robot.WATCHDOG", 1e9)
    app = glass.app
    with strange_robot() as strange:
        app.open(strange.url)
        glass.until(lambda: app.shell is not None and app.session.control == "none", "it has a control")
        glass.until(lambda: app.session.feeds.latest("/odom") is not None, "nothing was heard of it")
        assert not app.leaving.asks(app.session), "it stands"
        strange.robot.command({"linear": {"x": 0.4}, "angular": {"z": 0.0}})
        glass.until(lambda: app.session.checks.moves, "its speed was not heard")
        app.leaving.leave()
        assert app.session is not None
        assert question(glass).cause == "moves"
        glass.stage.frames(3)
        glass.tap(question(glass).ids.leave)
        assert app.session is None
