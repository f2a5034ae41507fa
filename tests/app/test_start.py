"""The app's start: what the first frame loads, and what is made only when somebody needs it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from app.inputs.methods import ON_DEMAND
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass

pytestmark = pytest.mark.usefixtures("fresh")

ROOT = Path(__file__).parents[2]

FIRST_FRAME = """
import sys
from types import ModuleType
sys.modules["numpy"] = ModuleType("numpy")  # the stage takes pictures, the app does not yet
from tests import headless
del sys.modules["numpy"]
import os
os.environ.update(headless._QUIET | headless._LOGIC)  # Kivy reads them when it is first imported
from app.lean_kivy import be_lean
be_lean()
headless.prepare("logic")
from app.__main__ import main  # noqa: F401 - as the program does it
from kivy.base import EventLoop
from kivy.core.window import Window
from app.application import PilothouseApp
import tempfile
with tempfile.TemporaryDirectory() as folder:
    app = PilothouseApp(settings_dir=folder, discover=False)
    app.root = app.build()
    Window.add_widget(app.root)
    EventLoop.start()
    app.on_start()
    EventLoop.idle()
    print(*sorted(sys.modules), sep="\\n")
    app.on_stop()
"""
HEAVY = (
    "numpy", "websockets", "spake2", "cryptography", "statistics", "mcap", "miniaudio", "vosk", "pocketsphinx", "hama",
    "hibari", "PIL", "kivy_garden", "sqlalchemy", "alembic", "starlette", "uvicorn", "py_trees", "pybullet", "rosbags",
    "bridge.client.client", "bridge.client.pairing", "bridge.protocol", "bridge.server", "bridge.generate",
    "app.study", "app.link.link", "app.link.recorder", "app.session.session", "app.stop.stop_lane", "app.missions",
    "app.inputs.voice.voice_input", "app.inputs.voice.talkback", "app.inputs.voice.recognition", "app.inputs.voice.audio",
    "app.inputs.voice.speech", "app.inputs.voice.android", "app.inputs.switch_access", "app.inputs.motion.shake",
    "app.inputs.motion.shake_input", "app.inputs.motion.tilt_input",
    "app.screens.robot_screens", "app.screens.drive", "app.screens.mission", "app.screens.tasks", "app.screens.topics",
    "app.screens.inputs", "app.screens.trust", "app.screens.shell.shell", "app.screens.shell.key_help",
    "app.screens.connect.simulator_dialog", "widgets.controls.stop.stop_list", "widgets.controls.goals", "widgets.sensors",
    "widgets.map", "widgets.tasks", "widgets.study", "widgets.inputs", "widgets.fields",
    "robotside", "sim",
)  # fmt: skip
"""Modules and packages that the connect screen does not need."""
NEEDED = ("kivy.core.window", "app.application", "app.screens.connect.connect", "app.inputs.gamepad.gamepad")
"""If these are missing, the list is not of an app that has started."""


@pytest.fixture(scope="module")
def loaded() -> frozenset[str]:
    """Names of all modules at the first frame, in a process of its own."""
    told = subprocess.run(
        [sys.executable, "-c", FIRST_FRAME], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return frozenset(told.stdout.split())


def test_the_first_frame_loads_what_the_connect_screen_needs(loaded: frozenset[str]) -> None:
    assert loaded.issuperset(NEEDED)


def test_the_first_frame_loads_nothing_heavy(loaded: frozenset[str]) -> None:
    found = [one for one in sorted(loaded) for heavy in HEAVY if one == heavy or one.startswith(f"{heavy}.")]
    assert found == []


def test_a_screen_is_made_when_it_is_first_shown(driving: Glass) -> None:
    shell = driving.app.shell
    assert set(shell.screens.made) == {"mission", "drive"}, "the first one, and the one that was asked for"
    for name in shell.screens:
        driving.app.show(name)
        driving.stage.frames(2)
        assert shell.shown is shell.screens.made[name]
    assert set(shell.screens.made) == set(shell.screens)


def test_stop_works_in_the_frame_in_which_it_is_first_shown(glass: Glass, robot: FakeRobot) -> None:
    app = glass.app
    app.open(robot.url)
    glass.until(lambda: app.shell is not None, "no screens")
    assert list(app.shell.screens.made) == ["mission"], "nothing else is made"
    app.inputs.stop()
    glass.until(lambda: "/stop" in robot.services(), "STOP did not reach the robot")
    glass.until(lambda: app.shell.stop.phase == "stopped", "not confirmed")
    assert list(app.shell.screens.made) == ["mission"]


def test_what_came_before_a_screen_was_made_is_on_it(driving: Glass, robot: FakeRobot) -> None:
    from bridge.msgs.pilothouse_msgs import Event

    robot.publish("/events", Event(id=7001, level="warn", code="", text="A wheel slips."))
    glass_events: Any = driving.app.session.logbook
    driving.until(lambda: any(one.id == 7001 for one in glass_events.events), "the event did not come")
    assert "tasks" not in driving.app.shell.screens.made
    driving.app.show("tasks")
    tasks = driving.app.screens["tasks"]
    tasks.tab = "events"
    driving.until(lambda: any(one.id == 7001 for one in tasks.events.log.events), "the event is not listed")


def test_commands_need_no_screen_that_was_never_shown(driving: Glass) -> None:
    from app.intents.intents import Heard

    app = driving.app
    app.acting.words("start")
    app.intents.submit(Heard("hold", "keyboard"))
    driving.stage.frames(3)
    assert "tasks" not in app.shell.screens.made


def test_a_robot_that_turns_out_to_be_something_else_makes_no_screen_that_nobody_saw(driving: Glass) -> None:
    shell = driving.app.shell
    before = shell.screens.made["drive"]
    shell.replace("tasks")
    assert "tasks" not in shell.screens.made
    shell.replace("drive")
    assert shell.screens.made["drive"] is not before
    assert shell.shown is shell.screens.made["drive"]


def test_leaving_a_robot_ends_the_screens_that_were_made_and_makes_no_other(driving: Glass) -> None:
    shell, ended = driving.app.shell, []
    for name, screen in shell.screens.made.items():
        screen.end = lambda name=name: ended.append(name)
    made = set(shell.screens.made)
    driving.app.leave()
    assert set(ended) == made == set(shell.screens.made)


def test_input_methods_that_nobody_uses_are_not_made_by_driving(driving: Glass) -> None:
    methods = driving.app.methods
    driving.stage.frames(30)
    assert [name for name in ON_DEMAND if methods.made(name) is not None] == []
    driving.app.show("inputs")
    driving.stage.frames(2)
    assert [name for name in ON_DEMAND if name != "talk" and methods.made(name) is None] == []


def test_the_log_misses_nothing_of_a_robot(driving: Glass) -> None:
    log = driving.app.methods.made("log")
    assert log is not None
    assert log._hear in driving.app.session.listeners


def test_stop_all_makes_its_list_when_it_is_pressed(glass: Glass, robot: FakeRobot) -> None:
    corner = glass.app.corner
    assert corner._list is None
    glass.app.robots.add(robot.url, met=True)
    glass.until(lambda: corner.button.parent is not None, "no STOP ALL")
    assert corner._list is None
    glass.tap(corner.button)
    assert corner.list.parent is not None
    glass.until(lambda: "/stop" in robot.services(), "STOP ALL did not reach the robot")


def test_the_first_picture_is_asked_for_before_a_screen_is_made(
    glass: Glass, robot: FakeRobot, monkeypatch: pytest.MonkeyPatch
) -> None:
    from app.link.link import Link
    from bridge.msgs.pilothouse_msgs import RobotInfo

    info = RobotInfo(name="Fake-1", kind="wheels", cameras=["front"])
    robot.publish("/robot/info", info)
    app, order, watch = glass.app, [], Link.watch
    make = app.visit._make_shell
    monkeypatch.setattr(Link, "watch", lambda link, camera: (order.append("picture"), watch(link, camera)))
    monkeypatch.setattr(app.visit, "_tick_connecting", lambda _: None)  # it enters without knowing the robot
    app.visit._make_shell = lambda session: (order.append("screens"), make(session))[1]
    app.open(robot.url)
    glass.until(lambda: app.session.connected, "no link")
    robot.publish("/robot/info", info)  # once more: the first may have come before the link was said to stand
    glass.until(lambda: app.shell is not None, "no screens when it said what it is")
    assert order == ["picture", "screens"]


def test_a_layout_with_a_mistake_is_said_over_the_usual_one(glass: Glass, robot: FakeRobot) -> None:
    from app.layout.layout import DEFAULT

    app = glass.app
    app.layouts._owners = {"boat": "no such layout"}
    robot_kind = app.layouts.of("", "boat")
    assert robot_kind.name == DEFAULT
    assert app.layouts.mistake
    app.layouts.of = lambda model, kind: robot_kind
    app.open(robot.url)
    glass.until(lambda: app.shell is not None, "no screens")
    glass.until(lambda: any("no such layout" in text for text in glass.banners()), "the mistake is not said")
