"""Actions of a layout: which a robot has, what each says now, and what a press sends."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from app.core.settings_store import Settings
from app.layout.layout import ACTIONS as OFFERED
from app.layout.layout import Action as Line
from app.link.capabilities import Capabilities
from app.link.commands import COMMANDS
from app.link.feeds import Feeds, Post
from app.session.layout_actions import ACTIONS, LayoutActions
from app.session.session import Session
from bridge.client.client import LinkState, Phase
from bridge.core.identity import public_id
from bridge.msgs.pilothouse_msgs import ControlStatus, LightState, RobotInfo, TaskStatus
from bridge.msgs.vision_msgs import Detection2D, Detection2DArray
from widgets.core.icons import ICONS

SERVICES = frozenset({"/stop", "/task/start", "/task/go_home", "/task/pause", "/lights/set", "/robot/reset"})
AQUA = RobotInfo(
    name="Aqua-1", kind="hexapod", tasks=["hold", "surface", "follow_heading", "go_home"], cameras=["front"]
)


class Asked:
    """What was asked for, and an app without a glass."""

    def __init__(self, folder: Path, services: frozenset[str] = SERVICES) -> None:
        self.commands: list[tuple[str, dict[str, Any]]] = []
        link = SimpleNamespace(
            url="ws://127.0.0.1:9090",
            state=LinkState(Phase.CONNECTED, "", 0, 0.0),
            silent=False,
            silence=0.0,
            robot_time=lambda: 100.0,
            command=lambda name, **fields: self.commands.append((name, fields)),
            drive=lambda _: None,
        )
        self.session = Session(
            link,  # type: ignore[arg-type]
            Feeds(lambda: 100.0),
            Settings(folder / "settings.json"),
            now=lambda: 100.0,
            client_id="me",
            wants_control=False,
        )
        self.resets: list[bool] = []
        self.records = SimpleNamespace(recorder=None, clock="00:07", frame=None, snapshot=lambda: None)
        self.recorded: list[bool] = []
        self.visit = SimpleNamespace(toggle_recording=lambda: self.recorded.append(True))
        self.shell = SimpleNamespace(reset=SimpleNamespace(ask=lambda: self.resets.append(True)))
        self.session.robot.capabilities = Capabilities(
            {"/control/status": "pilothouse_msgs/ControlStatus"}, services, rosapi=True
        )
        self.actions = LayoutActions([Line(what) for what in ACTIONS], self.session, self)
        self.tell("/robot/info", AQUA)
        self.tell("/control/status", ControlStatus(driver="us", driver_id=public_id("me")))

    def tell(self, topic: str, message: Any) -> None:
        self.session.deliver(topic, Post(message, 100.0, 1))

    def __getitem__(self, name: str) -> Any:
        return next(action for action in self.actions.current() if action.name == name)

    @property
    def names(self) -> list[str]:
        return [action.name for action in self.actions.current()]


@pytest.fixture
def asked(tmp_path: Path) -> Asked:
    return Asked(tmp_path)


def test_layouts_may_name_exactly_these_and_each_has_its_icon() -> None:
    assert set(OFFERED) == set(ACTIONS)
    assert {icon for _, icon in ACTIONS.values()} <= set(ICONS)


def test_only_the_tasks_that_the_robot_knows_are_there(asked: Asked) -> None:
    tasks = [name for name in asked.names if name.startswith("task.")]
    assert tasks == ["task.surface", "task.hold", "task.follow_heading", "task.go_home"]


def test_what_the_robot_has_not_got_is_not_there(tmp_path: Path) -> None:
    bare = Asked(tmp_path, frozenset({"/stop"}))
    assert bare.names == ["record", "snapshot"]


def test_a_task_is_started_and_ended_by_the_same_button(asked: Asked) -> None:
    asked.actions.act("task.surface")
    ((name, fields),) = asked.commands
    assert (name, fields["order"].task) == ("start", "surface")
    before = asked["task.surface"].meaning
    asked.tell("/task/status", TaskStatus(task_id=1, task="surface", state="RUNNING"))
    now = asked["task.surface"]
    assert now.text == "End surfacing"
    assert now.meaning != before
    asked.actions.act("task.surface")
    assert asked.commands[-1] == ("cancel", {})


def test_another_task_is_asked_for_instead_and_the_one_of_now_is_not_ended_before(asked: Asked) -> None:
    asked.tell("/task/status", TaskStatus(task_id=1, task="follow_heading", state="RUNNING"))
    asked.actions.act("task.surface")
    ((name, fields),) = asked.commands
    assert (name, fields["order"].task, fields["instead"]) == ("start", "surface", True)


def test_a_slide_never_ends_what_it_began(asked: Asked) -> None:
    def slide() -> Any:
        return next(action for action in asked.actions.slides() if action.name == "task.surface")

    assert (slide().text, slide().able) == ("Surface", True)
    asked.tell("/task/status", TaskStatus(task_id=1, task="surface", state="RUNNING"))
    assert (slide().text, slide().able) == ("Surface", False)
    assert asked.actions.confirm("task.surface") == ""
    asked.tell("/task/status", TaskStatus(task_id=1, task="surface", state="PAUSED"))
    assert (slide().text, slide().able) == ("Resume surfacing", True)
    assert asked.actions.confirm("task.surface") == "resume"
    assert asked.commands == [("resume", {})]
    asked.tell("/control/status", ControlStatus(driver_id=public_id("me"), stopped=True))
    assert not slide().able


def test_home_is_gone_to_whatever_it_does(asked: Asked) -> None:
    asked.tell("/task/status", TaskStatus(task_id=1, task="hold", state="RUNNING"))
    asked.actions.act("task.go_home")
    assert asked.commands == [("home", {})]


@pytest.mark.parametrize(
    "control",
    [ControlStatus(driver="Anna", driver_id="other"), ControlStatus(driver_id=public_id("me"), stopped=True)],
)
def test_no_task_is_started_without_control_or_while_stop_is_pressed(
    asked: Asked, control: ControlStatus
) -> None:
    asked.tell("/control/status", control)
    assert not asked["task.surface"].able
    asked.actions.act("task.surface")
    assert asked.commands == []


def test_lights_are_switched_to_what_they_are_not(asked: Asked) -> None:
    assert asked["lights"].said == ""
    asked.tell("/lights", LightState(brightness=0.0))
    assert (asked["lights"].said, asked["lights"].icon) == ("off", "lightbulb")
    asked.actions.act("lights")
    asked.tell("/lights", LightState(brightness=1.0))
    assert (asked["lights"].said, asked["lights"].icon) == ("on", "lightbulb_fill")
    asked.actions.act("lights")
    assert asked.commands == [("lights", {"brightness": 1.0}), ("lights", {"brightness": 0.0})]


def test_what_a_robot_carries_needs_no_line_of_a_layout(asked: Asked) -> None:
    asked.actions = LayoutActions([Line("pause")], asked.session, asked)
    assert asked.names == ["pause"], "what is not mounted shows nothing, whatever services there are"
    asked.tell("/robot/info", RobotInfo(payloads=["lights"], cameras=["front", "rear"]))
    assert asked.names == ["pause", "lights", "camera"]
    asked.actions.act("lights")
    assert asked.commands == [("lights", {"brightness": 1.0})]


def test_lights_are_not_there_before_the_robot_has_said_what_it_offers(asked: Asked) -> None:
    asked.session.robot.capabilities = None
    assert "lights" not in asked.names


def test_cameras_go_round_and_one_alone_has_no_button(asked: Asked) -> None:
    assert "camera" not in asked.names
    asked.tell("/robot/info", RobotInfo(cameras=["front", "rear"]))
    seen = []
    for _ in range(3):
        seen.append(asked["camera"].said)
        asked.actions.act("camera")
    assert seen == ["front", "rear", "front"]
    assert asked.session.cameras.wanted(None) == "rear"


def test_what_was_found_is_drawn_only_into_the_picture_that_is_searched(asked: Asked) -> None:
    found = Detection2DArray(detections=[Detection2D()])
    asked.tell("/robot/info", RobotInfo(cameras=["front", "rear"]))
    assert asked.session.cameras.detections_shown(found) is found
    asked.actions.act("camera")
    assert asked.session.cameras.detections_shown(found).detections == []


def test_a_camera_that_is_gone_gives_way_to_the_first(asked: Asked) -> None:
    asked.tell("/robot/info", RobotInfo(cameras=["front", "rear"]))
    asked.actions.act("camera")
    asked.tell("/robot/info", RobotInfo(cameras=["front"]))
    assert asked.session.cameras.wanted(None) == "front"


def test_a_reset_is_asked_about_and_not_sent(asked: Asked) -> None:
    asked.actions.act("reset")
    assert (asked.resets, asked.commands) == ([True], [])
    assert COMMANDS["reset"].service == "/robot/reset"


def test_a_recording_says_how_long_it_runs(asked: Asked) -> None:
    assert asked["record"].text == "Start recording"
    asked.records.recorder = object()
    assert (asked["record"].text, asked["record"].said) == ("Stop recording", "00:07")
    asked.actions.act("record")
    assert asked.recorded == [True]


def test_pause_becomes_resume(asked: Asked) -> None:
    assert not asked["pause"].able
    asked.tell("/task/status", TaskStatus(task_id=1, task="hold", state="RUNNING"))
    asked.actions.act("pause")
    asked.tell("/task/status", TaskStatus(task_id=1, task="hold", state="PAUSED"))
    assert asked["pause"].text == "Resume"
    asked.actions.act("pause")
    assert [name for name, _ in asked.commands] == ["pause", "resume"]


def test_a_picture_is_kept_once_there_is_one(asked: Asked) -> None:
    assert not asked["snapshot"].able
    asked.records.frame = object()
    assert asked["snapshot"].able
