"""Switches on a view: they tell the robot's own topic, while they may, and are at rest whatever becomes of the finger."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import pytest
from msgspec.structs import replace as replaced

from app.layout.views import Panel, View
from app.screens.panels.panel_signals import not_now
from bridge.client.client import BridgeClient
from bridge.core.network_thread import NetworkThread
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import ControlStatus
from bridge.msgs.std_msgs import Bool
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from tests.app.screens.panels.test_panels import hidden, scrolled, stacked

VIEWS = (
    View(
        "Signals",
        (
            Panel("MomentaryButton", "/horn", title="Horn", wide=(0, 0, 4, 3), tall=(0, 0, 6, 3)),
            Panel("Compass", "/pose", stack="s"),
            Panel("ToggleSwitch", "/lamp", wide=(4, 0, 4, 3)),
            Panel("DPad", wide=(0, 6, 4, 5)),
        ),
    ),
    View("Other", (Panel("Battery", "/battery_state"),)),
)


class Program:
    """Another client of the robot, which listens to a horn and a lamp."""

    def __init__(self, url: str) -> None:
        self.network = NetworkThread("program")
        self.client = BridgeClient(url)
        self.heard: dict[str, list[bool]] = {"/horn": [], "/lamp": []}
        for topic, out in self.heard.items():
            self.client.subscribe(topic, Bool, lambda msg, _, out=out: out.append(msg.data))
        self.network.start(self.client.run())

    def close(self) -> None:
        self.network.start(self.client.close()).result(5)
        self.network.close()


@pytest.fixture
def program(robot: FakeRobot) -> Iterator[Program]:
    made = Program(robot.url)
    yield made
    made.close()


@pytest.fixture
def panels(driving: Glass, program: Program) -> Any:
    app = driving.app
    app.profiles.save(app.session.robot.info, replace(app.profiles.of(app.session.robot.info), views=VIEWS))
    app.show("panels")
    screen = app.screens["panels"]
    driving.until(
        lambda: horn(screen).state == "live" and lamp(screen).state == "live", "nothing may be sent"
    )
    driving.stage.frames(3)
    return screen


def horn(screen: Any) -> Any:
    return screen.shows.card_of(0).widget


def lamp(screen: Any) -> Any:
    return screen.shows.card_of(2).widget


def held(driving: Glass, program: Program, screen: Any) -> Any:
    touch = driving.hold(horn(screen))
    driving.until(lambda: program.heard["/horn"][-1:] == [True], "the horn was not heard")
    return touch


def test_a_tap_on_a_switch_is_heard_once_and_shown_as_sent(
    driving: Glass, program: Program, panels: Any
) -> None:
    driving.tap(lamp(panels))
    driving.until(lambda: lamp(panels).value is True, "it does not stand where it was sent")
    driving.until(lambda: program.heard["/lamp"] == [True], "the program heard nothing")
    driving.tap(lamp(panels))
    driving.until(lambda: program.heard["/lamp"] == [True, False], "the program heard nothing")
    assert program.heard["/horn"] == []


def test_a_switch_whose_signal_never_left_says_so(driving: Glass, program: Program, panels: Any) -> None:
    panels.session.link.signals._forbidden = lambda: True
    driving.tap(lamp(panels))
    driving.until(lambda: lamp(panels).word == "not sent", "it is not said")
    assert program.heard["/lamp"] == []


def test_a_button_is_true_while_it_is_held_and_false_afterwards(
    driving: Glass, program: Program, panels: Any
) -> None:
    touch = held(driving, program, panels)
    driving.until(lambda: program.heard["/horn"].count(True) > 3, "it is not said again")
    assert False not in program.heard["/horn"]
    touch.touch_up()
    driving.until(lambda: program.heard["/horn"][-1] is False, "it does not end")


def stop_pressed(driving: Glass, _: Any) -> None:
    driving.app.session.stop()


def control_lost(driving: Glass, screen: Any) -> None:
    other = ControlStatus(driver="Bob", driver_id="bob")
    screen.session.link._on_message("/control/status", other, driving.app.session.now())


def app_goes_behind(driving: Glass, _: Any) -> None:
    driving.app.on_pause()


def covered(driving: Glass, screen: Any) -> None:
    driving.app.show("mission")


def removed(_: Glass, screen: Any) -> None:
    screen.shows.clear()


LETS_GO: dict[str, Callable[[Glass, Any], object]] = {
    "STOP is pressed": stop_pressed,
    "control is another's": control_lost,
    "the app goes behind": app_goes_behind,
    "another screen comes": covered,
    "it is hidden": hidden,
    "it lies behind another": stacked,
    "it is scrolled out of sight": scrolled,
    "it is taken off": removed,
    "another view comes": lambda glass, screen: screen.choose(1),
    "it is edited": lambda glass, screen: screen.editor.begin(),
}


@pytest.mark.parametrize("why", LETS_GO)
def test_a_button_that_is_held_rests_and_stays_so_under_the_same_finger_when(
    driving: Glass, program: Program, panels: Any, why: str
) -> None:
    button = horn(panels)
    touch = held(driving, program, panels)
    LETS_GO[why](driving, panels)
    driving.until(lambda: program.heard["/horn"][-1] is False, "the robot was not told to rest")
    driving.until(lambda: not button.pressed, "it still shows as held")
    heard = len(program.heard["/horn"])
    touch.touch_move(touch.x + 3, touch.y + 3)
    driving.stage.frames(20)
    assert True not in program.heard["/horn"][heard:]
    touch.touch_up()


def test_a_button_that_is_scrolled_away_can_be_held_by_nothing(driving: Glass, panels: Any) -> None:
    button = horn(panels)
    assert button in panels.grips
    scrolled(driving, panels)
    assert button not in panels.grips


def test_without_control_nothing_is_sent_and_it_is_said_beside_it(
    driving: Glass, program: Program, panels: Any
) -> None:
    control_lost(driving, panels)
    driving.until(lambda: horn(panels).disabled, "it can be pressed still")
    assert not_now(panels.session) == "Take control first."
    assert panels.shows.card_of(0).beneath == "Take control first."
    driving.tap(lamp(panels))
    driving.hold(horn(panels)).touch_up()
    driving.stage.frames(20)
    assert program.heard == {"/horn": [], "/lamp": []}


@pytest.fixture
def handed(driving: Glass, panels: Any, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Topics that the link was given something to send to, whatever it makes of it; the controls may send."""
    signals, topics = driving.app.session.link.signals, list[str]()
    monkeypatch.setattr(signals, "say", lambda topic, _: topics.append(topic))
    monkeypatch.setattr(signals, "hold", lambda topic, *_: topics.append(topic))
    quick_fingers(horn(panels), lamp(panels))
    assert topics == ["/horn", "/lamp"]
    topics.clear()
    return topics


def quick_fingers(*controls: Any) -> None:
    """What a finger asks for between two looks at what may be pressed."""
    for one in controls:
        one.dispatch("on_command", Bool(True))


STOPS = ["pressed here and unanswered", "pressed here and confirmed", "pressed by another"]


@pytest.mark.parametrize("stop", STOPS)
def test_under_stop_neither_switch_nor_button_hands_the_link_anything(
    driving: Glass, robot: FakeRobot, panels: Any, handed: list[str], stop: str
) -> None:
    session = driving.app.session
    if stop == "pressed by another":
        robot.publish("/control/status", replaced(robot.control, stopped=True, mode="STOPPED"))
    else:
        (robot.hold_answers if "unanswered" in stop else robot.give_answers)()
        driving.app.session.stop()
    quick_fingers(*([horn(panels), lamp(panels)] if "here" in stop else []))
    assert handed == []
    driving.until(lambda: session.robot_stop.latched != ("unanswered" in stop), "not as it was meant")
    assert not_now(session) == "STOP is pressed; nothing is sent."
    quick_fingers(horn(panels), lamp(panels))
    driving.tap(lamp(panels))
    driving.hold(horn(panels)).touch_up()
    assert handed == []
    assert (horn(panels).disabled, lamp(panels).disabled) == (True, True)


def test_without_control_a_finger_that_is_quicker_than_the_look_hands_the_link_nothing(
    driving: Glass, panels: Any, handed: list[str]
) -> None:
    control_lost(driving, panels)
    driving.until(lambda: panels.session.control == "other", "control is here still")
    quick_fingers(horn(panels), lamp(panels))
    assert handed == []


OUT_OF_SIGHT = ["another screen comes", "it is hidden", "it is scrolled out of sight", "it is edited"]


@pytest.mark.parametrize("why", OUT_OF_SIGHT)
def test_what_is_not_in_sight_hands_the_link_nothing_when(
    driving: Glass, panels: Any, handed: list[str], why: str
) -> None:
    button = horn(panels)
    LETS_GO[why](driving, panels)
    assert not not_now(panels.session)
    quick_fingers(button)
    assert handed == []


def test_a_robot_of_ours_that_no_program_listens_beside_says_so_on_the_card(
    driving: Glass, robot: FakeRobot
) -> None:
    app = driving.app
    app.profiles.save(app.session.robot.info, replace(app.profiles.of(app.session.robot.info), views=VIEWS))
    app.show("panels")
    screen = app.screens["panels"]
    driving.stage.frames(10)
    told = screen.shows.card_of(2).beneath
    assert told.startswith("A Pilothouse robot takes no switches: only a program connected to it")
    assert lamp(screen).disabled


def test_arrows_on_a_view_drive_by_the_sticks_own_path_and_by_no_other(
    driving: Glass, robot: FakeRobot, panels: Any
) -> None:
    pad = panels.shows.card_of(3).widget
    x, y = pad.to_window(*pad.center)
    touch = driving.stage.touch(x, y + pad.half * 0.7)
    touch.touch_down()
    driving.until(lambda: any(twist.linear.x > 0 for twist in robot.twists()), "the robot was not driven")
    assert all(abs(twist.linear.x) <= 0.8 for twist in robot.twists()), "the robot's own limit"
    touch.touch_up()
    driving.until(lambda: robot.twists()[-1] == Twist(), "it was not told to rest")


def test_a_switch_is_offered_for_a_bool_that_is_the_robots_own_and_for_nothing_else(
    driving: Glass, panels: Any
) -> None:
    panels.editor.begin()
    driving.stage.frames(5)
    rows = panels.pane.ids.scroll.children[0]._rows
    assert "toggle switch" in rows["/lamp"].fits
    assert not any("switch" in row.fits for name, row in rows.items() if name not in ("/lamp", "/horn"))
