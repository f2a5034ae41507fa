"""What is said over the screens of what was understood, and when that is taken away again."""

from __future__ import annotations

from typing import Any

import pytest

from app.device.vibration import REFUSED, STOPS, UNDERSTOOD, Pattern
from app.intents.intents import Heard, Verdict
from app.screens.shell import intent_prompts as module
from app.screens.shell.intent_prompts import IntentPrompts


class Around:
    """Stands for the ways in and for what is said; notes it."""

    def __init__(self) -> None:
        self.on_taken: list[Any] = []
        self.said = ""

    def say(self, text: str, level: str, about: str) -> None:
        self.said = text

    def unsay(self, about: str) -> None:
        self.said = ""


@pytest.fixture
def around() -> Around:
    around = Around()
    IntentPrompts(around, around, around.say)  # type: ignore[arg-type]
    return around


def taken(around: Around, intent: str, method: str, what: Any, sentence: str, **heard: Any) -> str:
    for listener in around.on_taken:
        listener(Heard(intent, method, **heard), Verdict(what, sentence))
    return around.said


@pytest.mark.parametrize("method", ["voice", "shake"])
def test_a_stop_that_was_guessed_says_by_which_method_it_was(around: Around, method: str) -> None:
    said = taken(around, "stop", method, "acted", "STOP.", said="stop", confidence=0.97)
    assert said == f"{method.capitalize()}, “stop”: 97 % sure. STOP."


def test_a_stop_that_was_pressed_is_told_by_its_button(around: Around) -> None:
    assert taken(around, "stop", "keyboard", "acted", "STOP.", said="space") == ""


@pytest.mark.parametrize("method", ["voice", "shake", "keyboard"])
def test_what_a_study_took_as_an_answer_is_told_by_its_own_card(around: Around, method: str) -> None:
    assert taken(around, "pause", method, "practised", "Understood: Pause. Nothing is done.") == ""


def test_a_success_takes_away_what_was_refused_to_the_same_method(around: Around) -> None:
    why = "No task runs that could be paused."
    assert taken(around, "pause", "keyboard", "not now", why) == f"Pause: {why}"
    assert taken(around, "record", "gamepad", "acted", "Record.") == f"Pause: {why}", "that was another hand"
    assert taken(around, "record", "keyboard", "acted", "Record.") == ""


def test_a_success_leaves_what_was_said_of_another_method_since(around: Around) -> None:
    taken(around, "pause", "keyboard", "not now", "No task runs.")
    said = taken(around, "lights", "voice", "acted", "Lights.", said="lights")
    assert taken(around, "record", "keyboard", "acted", "Record.") == said


@pytest.mark.parametrize(
    ("intent", "method", "what", "felt"),
    [
        ("stop", "shake", "acted", [STOPS]),
        ("pause", "voice", "acted", [UNDERSTOOD]),
        ("pause", "voice", "asks", [UNDERSTOOD]),
        ("pause", "voice", "not now", [REFUSED]),
        ("stop", "voice", "not now", [REFUSED]),
        ("pause", "switches", "not allowed", [REFUSED]),
        ("pause", "voice", "lapsed", [REFUSED]),
        ("pause", "voice", "cancelled", []),
        ("stop", "keyboard", "acted", []),
    ],
)
def test_who_may_not_look_feels_whether_it_is_stop_understood_or_refused(
    around: Around, monkeypatch: pytest.MonkeyPatch, intent: str, method: str, what: Any, felt: list[Pattern]
) -> None:
    told: list[Pattern] = []
    monkeypatch.setattr(module, "vibrate", told.append)
    taken(around, intent, method, what, "A sentence.", said="x", confidence=0.9)
    assert told == felt
