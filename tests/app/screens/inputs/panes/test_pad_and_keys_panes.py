"""The panes of gamepad and keyboard: what is pressed is found, what is chosen is kept, and STOP cannot be lost."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from app.inputs.base.button_presses import Press, Presses
from app.inputs.binding_actions import HOLDS
from app.inputs.bindings import Bindings
from app.inputs.gamepad.gamepad import Gamepads
from app.inputs.gamepad.sdl import PadState
from app.inputs.hand_methods import GamepadMethod, KeyboardMethod
from tests.headless import Stage

PAD = PadState(1, "Red", 0.0, 0.0, stop=False, stop_button=1, raw=(0,))


class Settings(dict[str, Any]):
    def set(self, name: str, value: Any) -> None:
        self[name] = value


class Desk:
    """The inputs as far as the panes ask for them, without a window."""

    def __init__(self) -> None:
        self.time, self.settings, self.rests = 10.0, Settings(), 0
        self.mapped = Bindings(self.settings)
        self.gamepads = Gamepads(lambda: self.time, on_news=lambda _: None, profile=self.mapped.profile)
        self.presses = Presses(lambda press: press.name in ("escape", "b"), lambda _: None)
        self.meanings = SimpleNamespace(held={name: [] for name in HOLDS})
        self.inputs = self
        self.root: Any = None
        self.acting = SimpleNamespace(on_help=None)
        self.tilt = SimpleNamespace(on=True, clutched=False)
        self.tilt.clutch = lambda *, down: setattr(self.tilt, "clutched", down)
        self.methods = SimpleNamespace(get={"tilt": self.tilt}.get, made={"tilt": self.tilt}.get)

    def rest(self) -> None:
        self.rests += 1

    def plug(self, *states: PadState) -> None:
        self.gamepads.update(states)

    def key(self, name: str) -> None:
        self.presses.press(Press("key", ord(name[0]), name, self.time))
        self.presses.release("key", 0, name)


@pytest.fixture
def desk() -> Desk:
    return Desk()


@pytest.fixture
def pad(desk: Desk, stage: Stage) -> Iterator[Any]:
    from app.screens.inputs.panes.pad_pane import PadPane

    pane = PadPane(app=desk)
    stage.show(pane, stage.window.size)
    pane.enter()
    yield pane
    pane.leave()


@pytest.fixture
def keys(desk: Desk, stage: Stage) -> Iterator[Any]:
    from app.screens.inputs.panes.keys_pane import KeysPane

    pane = KeysPane(app=desk)
    stage.show(pane, stage.window.size)
    pane.enter()
    yield pane
    pane.leave()


def test_the_picture_is_the_gamepad_as_it_is_now(desk: Desk, pad: Any) -> None:
    assert pad.picture.state == "never"
    assert "Plug one in" in pad.standing.text
    desk.plug(replace(PAD, forward=0.5, buttons=frozenset({"a"})))
    pad.tick()
    assert (pad.picture.state, pad.picture.left_stick, pad.picture.down) == ("live", [0.5, 0.0], ["a"])
    assert pad.buttons["a"].chosen
    desk.plug()
    pad.tick()
    assert pad.picture.state == "never"
    assert pad.standing.text == "Red is not plugged in; its settings are kept."


def test_a_pushed_gamepad_that_tells_nothing_new_is_said_to_be_silent(desk: Desk, pad: Any) -> None:
    desk.plug(replace(PAD, forward=1.0))
    desk.time += 3.0
    pad.tick()
    assert pad.standing.text == "Red. Nothing new for 3 s."


def test_here_a_button_is_found_in_the_list_and_does_nothing_else_but_stop(desk: Desk, pad: Any) -> None:
    desk.plug(PAD)
    assert pad.pressed(Press("pad", 7, "button 7", desk.time, device="Red", number=1))
    assert pad.buttons["button 7"].detail == "Nothing"
    assert not pad.pressed(Press("key", 9, "tab", desk.time))
    pad.leave()
    assert pad not in desk.presses.takers


def test_another_meaning_is_kept_for_gamepads_of_that_name(desk: Desk, pad: Any) -> None:
    desk.plug(PAD)
    pad.tick()
    pad.buttons["a"].dispatch("on_release")
    assert pad.meanings.parent is pad
    pad.meanings.rows["help"].dispatch("on_release")
    assert pad.roll.parent is pad
    assert (pad.buttons["a"].detail, desk.mapped.profile("Red").meaning("a")) == ("Help", "help")
    assert desk.settings["gamepads"]["profiles"]["Red"]["buttons"]["a"] == "help"
    assert desk.rests, "what is held does not mean something else all at once"
    pad.reset.dispatch("on_release")
    assert desk.mapped.profile("Red").meaning("a") == "yes"


def test_the_only_stop_is_not_given_another_meaning_and_that_is_said(desk: Desk, pad: Any) -> None:
    pad.buttons["b"].dispatch("on_release")
    pad.meanings.rows["lights"].dispatch("on_release")
    assert pad.meanings.head.refused
    assert "only STOP" in pad.meanings.head.sentence
    assert pad.back()
    assert pad.buttons["b"].detail == "STOP"


def test_sticks_are_given_to_other_ways_turned_round_and_made_finer(desk: Desk, pad: Any) -> None:
    desk.plug(PAD)
    pad.tick()
    pad.ways["left_ahead"].dispatch("on_release")
    pad.sources.rows["triggers"].dispatch("on_release")
    pad.turns["left_aside"].dispatch("on_release")
    pad.dead.count(2)
    pad.expo.count(-1)
    profile = desk.mapped.profile("Red")
    assert (profile.axes["left_ahead"], profile.inverted) == ("triggers", frozenset({"left_aside"}))
    assert profile.dead_zone == pytest.approx(0.16)
    assert profile.expo == pytest.approx(0.2)
    assert pad.ways["left_aside"].detail == "Left stick, across, turned round"
    assert pad.buttons["lefttrigger"].detail == "Pushes a control"


def test_of_two_gamepads_the_one_that_is_pressed_is_set_up(desk: Desk, pad: Any) -> None:
    desk.plug(PAD, replace(PAD, number=2, name="Blue"))
    pad.tick()
    assert pad.names.value == "Red"
    pad.pressed(Press("pad", 0, "a", desk.time, device="Blue", number=2))
    assert pad.names.value == "Blue"


def test_a_key_is_chosen_by_pressing_it(desk: Desk, keys: Any) -> None:
    keys.rows["lights"].dispatch("on_release")
    desk.key("f5")
    assert desk.mapped.keys.meaning("f5") == "lights"
    assert keys.roll.parent is keys
    assert keys not in desk.presses.takers, "the next key is no choice"
    assert desk.settings["keys"]["keys"]["f5"] == "lights"


def test_a_key_that_drives_is_refused_and_another_one_may_be_pressed(desk: Desk, keys: Any) -> None:
    keys.rows["lights"].dispatch("on_release")
    desk.key("w")
    assert keys.head.refused
    desk.key("f5")
    assert desk.mapped.keys.meaning("f5") == "lights"


def test_a_key_that_is_taken_from_another_meaning_says_so_there(desk: Desk, keys: Any) -> None:
    keys.rows["lights"].dispatch("on_release")
    desk.key("p")
    assert keys.rows["pause_resume"].detail == "P was taken from it."


def test_a_shortcut_can_have_no_key_and_all_can_be_as_at_first(desk: Desk, keys: Any) -> None:
    keys.rows["lights"].dispatch("on_release")
    keys.none.dispatch("on_release")
    assert desk.mapped.keys.meaning("l") == ""
    assert not keys.reset.disabled
    keys.reset.dispatch("on_release")
    assert desk.mapped.keys.meaning("l") == "lights"
    assert keys.reset.disabled


def test_left_while_it_waits_for_a_key_it_takes_none(desk: Desk, keys: Any) -> None:
    keys.rows["lights"].dispatch("on_release")
    keys.leave()
    desk.key("f5")
    assert desk.mapped.keys.meaning("f5") == ""


def test_whether_keys_drive_and_what_space_is_are_switches(desk: Desk, keys: Any) -> None:
    keys.drives.dispatch("on_release")
    keys.space.dispatch("on_release")
    assert (desk.mapped.keys.drives, desk.mapped.keys.space_stops) == (False, False)


def test_both_are_ways_in_that_say_how_they_stand(desk: Desk) -> None:
    pads, board = GamepadMethod(desk), KeyboardMethod(desk)
    assert (pads.standing, board.standing) == ("none plugged in", "shortcuts and driving")
    desk.plug(PAD)
    assert pads.standing == "Red: ready"
    pads.on = board.on = False
    assert (pads.standing, board.standing) == ("Red: off, but for STOP", "off, but for STOP")
    assert not Bindings(desk.settings).pads_on
    assert not Bindings(desk.settings).keys.on


def test_the_clutch_of_the_tilt_is_left_to_the_tilt(desk: Desk) -> None:
    KeyboardMethod(desk)
    assert desk.meanings.held["tilt"] == []


def test_the_help_lists_what_the_keys_and_the_gamepads_that_are_there_do(desk: Desk, stage: Stage) -> None:
    from app.screens.shell.key_help import help_groups, toggle_help

    desk.mapped.set_profile("Red", desk.mapped.profile("Red").with_button("guide", "stop"))
    groups = dict(help_groups(desk.mapped, ["Red"]))
    assert groups["STOP"] == [(["Esc", "Space"], "STOP")]
    assert (["P"], "Pause or resume") in groups["Robot"]
    assert (["F1", "?"], "Help") in groups["App"]
    assert groups["Red"][:2] == [(["B"], "STOP"), (["Guide"], "STOP")]
    desk.mapped.use_pads(False)
    desk.mapped.set_keys(replace(desk.mapped.keys, on=False))
    assert list(dict(help_groups(desk.mapped, ["Red"]))) == ["STOP", "Red"]
    from kivy.uix.floatlayout import FloatLayout

    desk.root = FloatLayout()
    stage.show(desk.root, stage.window.size)
    toggle_help(desk)
    assert len(desk.root.children) == 1
    toggle_help(desk)
    assert not desk.root.children
