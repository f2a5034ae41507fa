"""Two switches reach whatever a finger can press: every screen, page, pane, card and dialog, in each shape of the window."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from kivy.core.window import Window

from app.inputs.switch_access.window.targets import WindowTargets
from app.intents.intents import Heard
from app.link.channels import ANSWER, Answer
from app.link.feeds import Post
from app.screens.inputs.study.form_view import FormView
from app.screens.shell.key_help import HelpCard, toggle_help
from app.screens.trust.people_dialog import PeopleDialog
from bridge.core.identity import public_id
from bridge.msgs.pilothouse_msgs import (
    ControlStatus,
    Gateway,
    GatewayArray,
    GetPeopleResponse,
    InvitePersonResponse,
    Payload,
    PayloadArray,
    Person,
    RobotInfo,
    TaskStatus,
)
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from tests.app.inputs.switch_access.window.probing import bound, box, taken
from tests.app.screens.drive.test_dive import AQUA
from tests.app.test_profiles import BOAT, DRONE, SCOUT, TRUCK
from widgets.tasks.place_list import SOME

FORMS = {"tablet": (1280, 800), "phone": (412, 892), "phone on its side": (892, 412)}
TASKS = ("patrol", "deliver", "guide", "go_to", "go_home", "hold", "follow_heading", "dock")

KINDS = {
    "Joystick",
    "RudderThrottle",
    "TiltCircle",
    "SlideToConfirm",
    "Fader",
    "GridMap",
    "TextField",
    "Toggle",
    "Segment",
    "StepperEnd",
    "ListRow",
    "TopicRow",
    "TaskTile",
    "NavButton",
    "IconButton",
    "PrimaryButton",
}
"""Kinds of things that the walk must have come by, else it did not walk."""
BESIDE = ("Ticks",)
"""What the buttons at its ends do as well."""


class Walk:
    """The app, and what its switches find on it."""

    def __init__(self, glass: Glass, robot: FakeRobot) -> None:
        self.glass, self.app, self.robot = glass, glass.app, robot
        self.targets = WindowTargets(glass.app)
        self.seen: set[str] = set()

    def check(self, where: str, room: Any = None) -> None:
        """Whatever takes a finger here is one of the targets."""
        self.glass.stage.frames(4)
        app = self.app
        stops = [app.shell.stop] if app.shell is not None else []
        stops += bound(app.root)
        targets = self.targets.targets()
        keys = [target.key for target in targets]
        assert len({target.name for target in targets}) == len(keys), where
        found = {key: one for key, one in taken(stops, room).items() if type(one).__name__ not in BESIDE}
        missed = [one for one in found.values() if not any(one is key for key in keys)]
        behind = [] if room is not None else bound(app.root)
        missed += [one for one in behind if visible(one) and not any(one is key for key in keys)]
        assert not missed, (
            f"{where}: switches do not reach {[(one, box(one), getattr(one, 'text', '')) for one in missed]}"
        )
        self.seen |= {type(key).__name__ for key in keys}


def visible(widget: Any) -> bool:
    left, low, right, top = box(widget)
    return right > 0 and top > 0 and left < Window.width and low < Window.height


def screens(walk: Walk) -> Iterator[tuple[str, Callable[[], object]]]:
    """Name to what brings it onto the glass, in an order in which each follows from the one before."""
    app, robot = walk.app, walk.robot
    yield "drive", lambda: app.show("drive")
    yield "its drawer", lambda: app.screens["drive"].pull(out=True)
    for name in ("mission", "tasks", "topics", "more"):
        yield name, lambda name=name: app.show(name)
    yield "a topic", lambda: app.screens["topics"].open("/battery_state")
    yield from of_setup(walk)
    mission = app.screens["mission"]
    yield "mission", lambda: app.show("mission")
    for mode in ("points", "home", "place", "place_robot"):
        yield f"mission {mode}", lambda mode=mode: setattr(mission, "mode", mode)
    yield "a sheet drawn up", lambda: setattr(mission, "sheet", 1)
    yield "and down", lambda: setattr(mission, "sheet", 0)
    tasks = app.screens["tasks"]
    yield "tasks", lambda: app.show("tasks")
    for tab in ("schedule", "places", "missions", "events", "history", "now"):
        yield f"tasks {tab}", lambda tab=tab: setattr(tasks, "tab", tab)
    yield "settings", tasks._turn_settings
    for task in TASKS:
        yield f"order {task}", lambda task=task: tasks.begin(task)
    yield "a place", lambda: tasks.edit_place(SOME[0])
    yield "missions again", lambda: setattr(tasks, "tab", "missions")
    yield "save a mission", lambda: tasks.acts.by_name["save_as"].dispatch("on_release")
    inputs = app.screens["inputs"]
    yield "inputs", lambda: app.show("inputs")
    for pane in inputs.panes:
        yield f"inputs {pane}", lambda pane=pane: setattr(inputs, "chosen", pane)
    for part in ("study", "load", "log"):
        yield f"study {part}", lambda part=part: setattr(inputs.pane("study"), "part", part)
    for form in ("tlx", "sus"):
        yield (
            f"form {form}",
            lambda form=form: inputs.pane("study")._unroll(FormView(form, inputs.pane("study").log, app.now)),
        )
    yield "what waits", lambda: app.intents.submit(Heard("end_task", "voice", 0.9, said="end"))
    yield "what asks", lambda: app.intents.submit(Heard("go_home", "voice", 0.9, said="home"))
    yield "no more", lambda: app.intents.answer(False)
    yield "reset", app.shell.reset.ask
    yield "the mode", lambda: app.show("drive") or app.shell.cards.ask_mode()
    yield "who has control", lambda: robot.publish("/control/status", asked(app))
    yield (
        "a question",
        lambda: robot.publish(
            "/task/status", TaskStatus(task_id=3, task="deliver", state="RUNNING", asks="Is it there?")
        ),
    )
    yield "undo", lambda: app.shell._offer_undo("Office 12", lambda: None)
    for info in (AQUA, BOAT, DRONE, TRUCK, SCOUT):
        yield info.name, lambda info=info: introduce(walk, info)


def of_setup(walk: Walk) -> Iterator[tuple[str, Callable[[], object]]]:
    """The setup screen with what a robot told of itself."""
    app, screen = walk.app, walk.app.screens["setup"]

    def told(*gateways: Gateway) -> None:
        app._deliver("/gateways", Post(GatewayArray(gateways=list(gateways)), 0.0, 1))
        lights = Payload("lights", "lights", on=True, topics=["/lights"], services=["/lights/set"])
        app._deliver("/payloads", Post(PayloadArray(payloads=[lights]), 0.0, 1))

    down = Gateway("mqtt", "a broker", state="down", usual="mqtt://h:1", schemes=["mqtt:1", "own:1"])
    up = Gateway("mqtt", "a broker", state="up", endpoint="mqtt://h:1", guide="Say hello.", qr_rows=["1"])
    yield "setup", lambda: app.show("setup")
    for pane in screen.panes:
        yield f"setup {pane}", lambda pane=pane: screen.open(pane)
    yield "setup told", lambda: told(down)
    yield "a protocol", lambda: setattr(screen, "chosen", ("/gateways", "mqtt"))
    yield "a protocol that is up", lambda: told(up)
    yield "its guide", lambda: setattr(screen.robot.panes["/gateways", "mqtt"], "reads", True)
    yield "a payload", lambda: setattr(screen, "chosen", ("/payloads", "lights"))


def introduce(walk: Walk, info: RobotInfo) -> None:
    """It is another robot now, and the app knows."""
    walk.robot.publish("/robot/info", info)
    walk.glass.until(lambda: walk.app.session.robot.info.name == info.name, info.name)


def asked(app: Any) -> ControlStatus:
    return ControlStatus(
        mode="MANUAL",
        driver=app.client_name,
        driver_id=public_id(app.client_id),
        requested_by="Anna",
        requested_by_id="a",
    )


@pytest.mark.parametrize("form", FORMS)
def test_whatever_takes_a_finger_is_reached_by_switches(
    form: str, driving: Glass, robot: FakeRobot, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = Window.size
    # the one that draws nowhere would be made anew with the size it had
    monkeypatch.setattr(Window, "create_window", lambda *_: None)
    turn(driving, form)
    try:
        robot.know(*SOME)
        walk = Walk(driving, robot)
        for name, come in screens(walk):
            come()
            driving.stage.run_for(0.3, 1 / 10)
            walk.check(f"{form}, {name}")
        toggle_help(driving.app)
        driving.stage.frames(3)
        (dialog,) = [one for one in driving.app.root.children if isinstance(one, HelpCard)]
        walk.check(f"{form}, help", dialog.ids.card)
        dialog.close()
        driving.app.corner.press()
        driving.stage.run_for(0.4, 1 / 16)
        walk.check(f"{form}, STOP ALL's list")
        driving.app.leave()
        walk.check(f"{form}, connect")
        driving.app.robot_list.ask_address()
        driving.stage.frames(3)
        (dialog,) = [one for one in driving.app.root.children if hasattr(one, "answer")]
        walk.check(f"{form}, address", dialog.ids.card)
        dialog.close()
        driving.app.simulating.ask()
        driving.stage.frames(3)
        walk.check(f"{form}, simulator", driving.app.simulating.dialog.ids.card)
        assert walk.seen >= KINDS, KINDS - walk.seen
    finally:
        Window.size = before


def test_pairing_and_the_people_of_a_robot_are_reached_by_switches(
    driving: Glass, robot: FakeRobot, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = Window.size
    monkeypatch.setattr(Window, "create_window", lambda *_: None)
    walk = Walk(driving, robot)
    try:
        for form in FORMS:
            turn(driving, form)
            people_of_the_robot(walk, form)
        driving.app.leave()
        for form in FORMS:
            turn(driving, form)
            pairing(walk, form)
    finally:
        Window.size = before


def turn(driving: Glass, form: str) -> None:
    Window.size = FORMS[form]
    driving.app.root.size = FORMS[form]


def people_of_the_robot(walk: Walk, form: str) -> None:
    known = [Person(id=f"{one}", name=f"tablet-{one}", role="manage") for one in range(2)]
    people = PeopleDialog(walk.app.session)
    walk.app.root.add_widget(people)
    for service, answer in (
        ("/people/list", GetPeopleResponse(people=known)),
        ("/people/invite", InvitePersonResponse(code="493017", open_until=1e12)),
    ):
        people._hear(ANSWER, Post(Answer(service, answer, ""), 0.0, 1))
        walk.check(f"{form}, {service}", people.ids.card)
    people.close()


def pairing(walk: Walk, form: str) -> None:
    trust = walk.app.robot_list.trust
    trust.ask("wss://127.0.0.1:9")
    walk.check(f"{form}, code", trust.dialog.ids.card)
    trust.ask()
    walk.check(f"{form}, link", trust.dialog.ids.card)
    trust.dialog.close()
