"""What is wanted, done by the session: what goes to the robot, and why something cannot be done now."""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from app.core.command_origin import origins
from app.intents.intent_executor import ALONE, IntentExecutor
from app.intents.intents import INTENTS
from bridge.client.client import LinkState, Phase
from bridge.core.identity import public_id
from bridge.msgs.pilothouse_msgs import ControlStatus, LightState, RobotInfo, TaskOrder, TaskStatus
from tests.app.session.test_layout_actions import SERVICES, Asked

RAY = RobotInfo(
    name="Ray-1",
    kind="hexapod",
    tasks=["patrol", "go_home", "hold", "surface", "go_to"],
    cameras=["front", "down"],
    max_speed=1.0,
)


class Fader:
    minimum, maximum, value = 0.1, 1.0, 0.5


class Robot(Asked):
    """A robot that is connected, in our control, with a mission of one point, and the app round it."""

    def __init__(self, folder: Path) -> None:
        super().__init__(folder, frozenset({*SERVICES, "/mission/set"}))
        self.methods: list[str] = []
        session, command = self.session, self.session.link.command

        def noted(name: str, **fields: Any) -> None:
            self.methods.append(origins.current().method)
            command(name, **fields)

        session.link.command = noted  # type: ignore[method-assign]
        self.stops: list[bool] = []
        self.inputs = SimpleNamespace(stop=lambda: self.stops.append(True))
        self.corner = SimpleNamespace(button=SimpleNamespace(robots=1))
        self.shown: list[str] = []
        self.show = self.shown.append
        self.themes = SimpleNamespace(choose_next=lambda: None)
        self.back = self.show_inputs = lambda: None
        speed = SimpleNamespace(maximum_speed=0.5, ids=SimpleNamespace(fader=Fader()))
        form = SimpleNamespace(complete=False, task="")
        pane = SimpleNamespace(scheduled=None, form=form, order=TaskOrder(task="go_to", places=["Lab"]))
        card = SimpleNamespace(parent=None)
        self.speed, self.pane = speed, pane
        self.made: dict[str, Any] = {"tasks": SimpleNamespace(pane=pane)}
        self.shell = SimpleNamespace(
            made=self.made.get,
            screens={"drive": SimpleNamespace(speed=speed)},
            cards=SimpleNamespace(handover=card),
            reset=SimpleNamespace(card=card),
            standing=SimpleNamespace(where=SimpleNamespace(parent=None)),
            question=card,
        )
        self.acting = IntentExecutor(self)
        self.tell("/robot/info", RAY)
        self.tell("/control/status", ControlStatus(driver="me", driver_id=public_id("me")))
        self.tell("/task/status", TaskStatus(state="IDLE"))
        session.mission.add(1.0, 2.0)

    def task(self, state: str, task: str = "patrol") -> None:
        self.tell("/task/status", TaskStatus(state=state, task=task))

    @property
    def names(self) -> list[str]:
        return [name for name, _ in self.commands]


@pytest.fixture
def robot(tmp_path: Path) -> Any:
    asked = Robot(tmp_path)
    settings = asked.session.drafts._settings
    yield asked
    settings.close()


@pytest.mark.parametrize(
    ("state", "intent", "command"),
    [
        ("RUNNING", "pause", "pause"),
        ("PAUSED", "resume", "resume"),
        ("INTERRUPTED", "resume", "resume"),
        ("RUNNING", "end_task", "cancel"),
        ("RUNNING", "go_home", "home"),
        ("IDLE", "go_home", "home"),
        ("IDLE", "hold", "start"),
    ],
)
def test_each_is_asked_of_the_robot_by_the_command_that_its_button_sends(
    robot: Robot, state: str, intent: str, command: str
) -> None:
    robot.task(state)
    assert robot.acting.why_not(intent) == ""
    robot.acting.do(intent)
    assert robot.names[-1] == command


def test_holding_takes_the_place_of_the_task_that_runs_and_never_ends_itself(robot: Robot) -> None:
    robot.task("RUNNING")
    robot.acting.do("hold")
    assert robot.commands[-1][1]["instead"] is True
    robot.task("RUNNING", "hold")
    assert robot.acting.why_not("hold") == "It is holding already."


def test_a_patrol_whose_points_the_robot_has_not_is_started_once_they_are_sent(robot: Robot) -> None:
    robot.acting.do("patrol")
    assert robot.names == ["mission"]


def test_start_starts_the_task_that_is_chosen(robot: Robot) -> None:
    assert robot.acting.words("start") == "Start patrol"
    robot.pane.form.complete, robot.pane.form.task = True, "go_to"
    assert robot.acting.words("start") == "Start go to Lab"
    robot.acting.do("start")
    assert robot.commands[-1][1]["order"].places == ["Lab"]
    robot.made.clear()
    assert robot.acting.words("start") == "Start patrol", "nobody has looked at the tasks yet"


@pytest.mark.parametrize(
    ("intent", "state", "why"),
    [
        ("pause", "IDLE", "No task runs that could be paused."),
        ("pause", "PAUSED", "It is paused already."),
        ("resume", "RUNNING", "No task is paused."),
        ("end_task", "IDLE", "No task runs."),
        ("patrol", "RUNNING", "Patrol runs; end it first."),
        ("take_control", "IDLE", "You have control already."),
        ("snapshot", "IDLE", "There is no picture to keep."),
        ("take_off", "IDLE", "This robot knows no such task: Take off."),
        ("yes", "IDLE", "Nothing is asked just now."),
    ],
)
def test_what_cannot_be_done_now_has_one_sentence(robot: Robot, intent: str, state: str, why: str) -> None:
    robot.task(state)
    assert robot.acting.why_not(intent) == why


def test_there_is_no_patrol_without_points(robot: Robot) -> None:
    robot.session.mission.clear()
    assert robot.acting.why_not("patrol") == "There are no points on the map to patrol."


@pytest.mark.parametrize("intent", ["resume", "patrol", "go_home", "hold"])
def test_nothing_sets_out_while_stop_is_pressed(robot: Robot, intent: str) -> None:
    robot.task("PAUSED" if intent == "resume" else "IDLE")
    robot.tell(
        "/control/status", ControlStatus(driver="me", driver_id=public_id("me"), stopped=True, at_rest=True)
    )
    assert robot.acting.why_not(intent) == "STOP is pressed; release it first."


def test_who_has_no_control_is_told_who_has_it(robot: Robot) -> None:
    robot.tell("/control/status", ControlStatus(driver="Anna", driver_id="a"))
    assert robot.acting.why_not("go_home") == "Anna has control; ask for it first."
    assert robot.acting.why_not("take_control") == ""


def test_without_a_link_nothing_is_asked_and_stop_is_possible(robot: Robot) -> None:
    robot.session.link_state = LinkState(Phase.WAITING, "", 1, 1.0)
    assert robot.acting.why_not("pause") == "There is no link to the robot."
    assert robot.acting.why_not("stop") == ""


def test_without_a_robot_only_what_needs_none_can_be_done(robot: Robot) -> None:
    robot.session, robot.shell = None, None  # type: ignore[assignment]
    for intent in INTENTS:
        if intent not in ALONE:
            assert robot.acting.why_not(intent) == "No robot is connected."
    assert robot.acting.why_not("stop") == ""
    robot.corner.button.robots = 0
    assert robot.acting.why_not("stop") == "No robot is known that could be stopped."


def test_faster_and_slower_go_in_steps_between_what_the_robot_may(robot: Robot) -> None:
    assert robot.acting.words("faster") == "Faster: 0.70 m/s"
    for _ in range(3):
        robot.acting.do("faster")
    assert robot.speed.maximum_speed == robot.speed.ids.fader.value == 1.0
    assert robot.acting.why_not("faster") == "It is as fast as it may be."
    for _ in range(9):
        robot.acting.do("slower")
    assert math.isclose(robot.speed.maximum_speed, 0.1)
    assert robot.acting.why_not("slower") == "It is as slow as it can be set."


def test_the_lights_are_switched_over(robot: Robot) -> None:
    robot.tell("/lights", LightState(brightness=0.0))
    assert robot.acting.words("lights") == "Switch the lights on"
    robot.acting.do("lights")
    assert robot.commands[-1] == ("lights", {"brightness": 1.0})


def test_yes_answers_the_card_that_asks(robot: Robot) -> None:
    said: list[str] = []
    robot.shell.question = SimpleNamespace(
        parent=True, open=True, blocked=False, cut=False, held=False, question="Picked up?", ask=said.append
    )
    assert robot.acting.why_not("yes") == ""
    assert robot.acting.answer(True) == "Picked up? Yes."
    assert robot.acting.answer(False) == "Picked up? Not yet."
    assert said == ["confirm"]


def test_a_yes_that_cannot_be_given_says_why_and_a_no_can_be_given(robot: Robot) -> None:
    said: list[str] = []
    robot.shell.question = SimpleNamespace(
        parent=True, open=True, blocked=False, cut=True, held=True, question="Go on?", ask=said.append
    )
    assert robot.acting.why_not("yes") == "Go on? Not yet: STOP is pressed; release it first."
    assert robot.acting.why_not("no") == ""
    assert robot.acting.answer(False) == "Go on? No."
    assert said == ["cancel"]


def test_every_intent_can_be_done_or_answered(robot: Robot) -> None:
    doable = {*robot.acting._alone(), *robot.acting._asked_for(), "yes", "no"}
    assert doable == set(INTENTS)
