"""What a press comes to: an intent with its method and times, pausing and going on by turns, or something held."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from app.inputs.base.button_presses import Press
from app.inputs.binding_actions import MEANINGS, BindingActions, meaning_icon, meaning_words
from app.inputs.gamepad.pad_map import MEANT, Profile
from app.inputs.keys.held_key import MAX_HOLD
from app.inputs.keys.key_table import KeyTable
from app.inputs.shortcuts import Shortcuts
from app.intents.intents import INTENTS, Heard
from widgets.core.icons import OUTLINED


class Intents:
    def __init__(self) -> None:
        self.heard: list[Heard] = []
        self.asking = False

    def submit(self, heard: Heard) -> None:
        self.heard.append(heard)


class Desk:
    def __init__(self) -> None:
        self.intents, self.state = Intents(), ""
        self.table, self.profile = KeyTable(), Profile()
        self.typing, self.pads_on = False, True
        status = lambda _: SimpleNamespace(state=self.state) if self.state else None  # noqa: E731
        app: Any = SimpleNamespace(
            intents=self.intents, session=SimpleNamespace(feeds=SimpleNamespace(latest=status))
        )
        self.time, self.said = 12.5, []
        self.system: set[int] = set()
        self.silent: set[int] = set()
        self.meanings = BindingActions(
            app,
            lambda: self.time,
            is_down=self.system.__contains__,
            silent=self.silent.__contains__,
            on_lost=lambda why, _: self.said.append(why),
        )
        self.shortcuts = Shortcuts(
            self.meanings,
            lambda: self.table,
            lambda _: self.profile,
            lambda: self.typing,
            lambda: self.pads_on,
        )

    def key(self, name: str, *modifiers: str, text: str = "") -> bool:
        press = Press("key", 1, name, 12.0, modifiers=frozenset(modifiers), text=text)
        taken = self.shortcuts.pressed(press)
        if taken:
            self.shortcuts.released(press)
        return taken

    def button(self, name: str) -> Press:
        press = Press("pad", 1, name, 12.0, device="Pad", number=4)
        self.shortcuts.pressed(press)
        return press

    def holds(self, name: str = "t", scancode: int = 23) -> tuple[Press, list[bool]]:
        """That key goes down and holds the clutch, and what is told of that."""
        told: list[bool] = []
        self.meanings.held["tilt"].append(told.append)
        press = Press("key", ord(name), name, self.time, scancode=scancode)
        self.meanings.repeated(name)
        assert self.shortcuts.pressed(press)
        return press, told

    def pass_time(self, seconds: float, repeats: str = "") -> None:
        end = self.time + seconds
        while self.time < end - 1e-9:
            self.time += 0.03
            if repeats:
                self.meanings.repeated(repeats)
            self.meanings.update()

    @property
    def wanted(self) -> list[str]:
        return [heard.intent for heard in self.intents.heard]


@pytest.fixture
def desk() -> Desk:
    return Desk()


def test_a_key_is_an_intent_by_the_keyboard_with_its_times(desk: Desk) -> None:
    assert desk.key("b")
    (heard,) = desk.intents.heard
    assert (heard.intent, heard.method, heard.confidence) == ("go_home", "keyboard", 1.0)
    assert (heard.began, heard.ended, heard.said) == (12.0, 12.5, "b")


def test_a_button_is_an_intent_by_the_gamepad(desk: Desk) -> None:
    desk.button("dpup")
    (heard,) = desk.intents.heard
    assert (heard.intent, heard.method, heard.said) == ("lights", "gamepad", "dpup of Pad")


def test_one_key_pauses_what_runs_and_goes_on_with_what_is_paused(desk: Desk) -> None:
    for state in ("", "RUNNING", "PAUSED"):
        desk.state = state
        desk.key("p")
    assert desk.wanted == ["pause", "pause", "resume"]


def test_yes_and_no_are_taken_only_while_something_asks(desk: Desk) -> None:
    assert not desk.key("y")
    desk.intents.asking = True
    assert desk.key("y")
    assert desk.wanted == ["yes"]


def test_while_somebody_types_only_the_keys_above_the_letters_mean_anything(desk: Desk) -> None:
    desk.typing = True
    assert not desk.key("b")
    assert not desk.key("backspace")
    assert desk.key("f1")


def test_with_ctrl_or_without_a_meaning_or_switched_off_a_key_is_left_to_others(desk: Desk) -> None:
    assert not desk.key("b", "ctrl")
    assert not desk.key("f5")
    desk.table = replace(desk.table, on=False)
    assert not desk.key("b")


def test_a_question_mark_is_help_by_its_text_or_by_shift_and_stroke(desk: Desk) -> None:
    assert desk.key("ß", text="?")
    assert desk.key("/", "shift")
    assert not desk.key("/")
    assert desk.wanted == ["help", "help"]


def test_buttons_of_gamepads_that_are_switched_off_mean_nothing(desk: Desk) -> None:
    desk.pads_on = False
    desk.button("dpup")
    assert desk.wanted == []


def test_what_is_held_is_told_when_it_begins_and_when_the_last_of_its_keys_ends(desk: Desk) -> None:
    told: list[bool] = []
    desk.meanings.held["talk"].append(told.append)
    desk.profile = desk.profile.with_button("guide", "hold.talk")
    first, second = desk.button("lefttrigger"), desk.button("guide")
    assert told == [True]
    desk.shortcuts.released(first)
    assert told == [True]
    desk.shortcuts.released(second)
    assert told == [True, False]


def test_a_key_that_the_system_has_down_no_longer_holds_nothing_though_its_end_was_not_told(
    desk: Desk,
) -> None:
    press, told = desk.holds()
    desk.system.add(press.scancode)
    desk.pass_time(5.0)
    assert told == [True]
    desk.system.clear()
    desk.pass_time(0.03)
    assert told == [True, False]
    desk.shortcuts.released(press)
    assert told == [True, False]


def test_a_key_whose_repeats_stay_away_holds_nothing(desk: Desk) -> None:
    _, told = desk.holds()
    desk.pass_time(2.0, repeats="t")
    assert told == [True]
    desk.pass_time(0.36)
    assert told == [True, False]
    desk.pass_time(1.0, repeats="t")
    assert told == [True, False], "it must be let go first"


def test_a_key_pressed_after_it_is_repeated_in_its_place(desk: Desk) -> None:
    _, told = desk.holds()
    desk.pass_time(1.0, repeats="t")
    desk.pass_time(2.0, repeats="w")
    assert told == [True]


def test_nothing_is_held_for_longer_than_a_hand_would_and_that_is_said(desk: Desk) -> None:
    _, told = desk.holds()
    desk.pass_time(MAX_HOLD - 0.1)
    assert told == [True]
    desk.pass_time(0.2)
    assert told == [True, False]
    (said,) = desk.said
    assert said.startswith("T is held for 30 s: let it go")


def test_a_gamepad_that_fell_silent_holds_nothing(desk: Desk) -> None:
    told: list[bool] = []
    desk.meanings.held["tilt"].append(told.append)
    desk.button("righttrigger")
    desk.pass_time(1.0)
    assert told == [True]
    desk.silent.add(4)
    desk.pass_time(0.03)
    assert told == [True, False]
    assert desk.said[0].startswith("Pad is silent")


def test_what_is_held_for_nobody_is_left_to_others(desk: Desk) -> None:
    assert not desk.key("v")


def test_everything_that_a_button_means_at_first_is_there_with_words_and_an_icon() -> None:
    assert set(MEANT.values()) <= set(MEANINGS)
    assert set(INTENTS) <= set(MEANINGS)
    assert all(words and icon in OUTLINED for words, icon in MEANINGS.values())
    assert (meaning_words("jump"), meaning_icon("jump")) == ("Nothing", "block")
