"""Switches as one way in: which keys are theirs, STOP by them, what the operator forbids, and keys that type."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

import app.scanning.switches as switching
from app.intents import Heard, Verdict
from app.origin import origins
from app.press import Press, Presses
from app.scanning import Mark, Target
from app.scanning.engine import Engine, Selection
from app.scanning.plan import Planner
from app.scanning.settings import Key
from app.scanning.switches import Switches


class Settings(dict[str, Any]):
    def set(self, name: str, value: Any) -> None:
        self[name] = value


class Intents:
    """Of an operator who forbids some."""

    def __init__(self) -> None:
        self.taken: list[Heard] = []
        self.forbidden: set[str] = set()
        self.practised = ""

    def allowed(self, method: str, intent: str) -> bool:
        return intent not in self.forbidden

    def practise(self, heard: Heard) -> str:
        return self.practised

    def prompt(self) -> str:
        return ""

    def take(self, heard: Heard) -> Verdict:
        self.taken.append(heard)
        return Verdict("acted") if heard.intent == "stop" else Verdict("not allowed", "Not by switches.")


class Hand:
    """Somebody before an app with two buttons."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now, self.said, self.did, self.typing = 100.0, [], [], False
        monkeypatch.setattr(switching, "typing", lambda: self.typing)
        monkeypatch.setattr(Switches, "stepped", lambda *_: None)
        stops: list[Press] = []
        shell = SimpleNamespace(say=lambda text, level, about: self.said.append(text))
        self.presses = Presses(lambda press: False, stops.append)
        self.intents = Intents()
        self.app = SimpleNamespace(
            settings=Settings(),
            inputs=SimpleNamespace(presses=self.presses, is_switch=lambda _: False),
            intents=self.intents,
            methods={},
            shell=shell,
            now=lambda: self.now,
        )
        self.switches = Switches(self.app)
        self.place = "drive"
        engine = Engine(self, Planner({}), switching._Desk(self.switches))
        monkeypatch.setattr(Switches, "engine", engine)
        self.switches._engine = engine
        self.switches.start()

    def targets(self) -> list[Target]:
        return [
            Target("pause", "Pause", self._note, intent="pause"),
            Target("lights", "Lights", self._note, intent="lights"),
        ]

    def mark(self, mark: Mark | None) -> None:
        self.marked = mark

    def _note(self) -> None:
        self.did.append(origins.current())

    def down(self, name: str, **more: Any) -> bool:
        return self.presses.press(Press("key", 1, name, self.now, **more))

    def press(self, name: str, seconds: float = 0.1) -> bool:
        taken = self.down(name)
        self.wait(seconds)
        self.presses.release("key", 0, name)
        self.wait(0.4)
        return taken

    def wait(self, seconds: float) -> None:
        for _ in range(round(seconds / 0.03)):
            self.now += 0.03
            self.switches.look(self.now)


@pytest.fixture
def hand(monkeypatch: pytest.MonkeyPatch) -> Any:
    hand = Hand(monkeypatch)
    yield hand
    hand.switches.stop()


def test_what_is_done_says_that_switches_did_it_and_when(hand: Hand) -> None:
    hand.press("tab")
    began = hand.now
    hand.press("enter")
    (origin,) = hand.did
    assert (origin.method, origin.intent, origin.said) == ("switches", "pause", "Pause")
    assert origin.began == pytest.approx(began)


def test_both_together_are_stop_by_switches(hand: Hand) -> None:
    hand.down("tab")
    hand.down("enter")
    (heard,) = hand.intents.taken
    assert (heard.intent, heard.method) == ("stop", "switches")


def test_what_the_operator_forbids_is_not_done_and_said(hand: Hand) -> None:
    hand.intents.forbidden = {"pause"}
    hand.press("tab")
    hand.press("enter")
    assert (hand.did, hand.said) == ([], ["Not by switches."])


def test_a_study_only_sees_what_was_chosen(hand: Hand) -> None:
    hand.intents.practised = "Pause: noted."
    hand.press("tab")
    hand.press("enter")
    assert hand.did == []
    assert [heard.intent for heard in hand.intents.taken] == ["pause"]


def test_who_types_types_unless_something_is_marked(hand: Hand) -> None:
    hand.typing = True
    assert not hand.press("enter")
    hand.typing = False
    hand.press("tab")
    hand.typing = True
    assert hand.press("enter")
    assert len(hand.did) == 1


def test_other_keys_and_those_with_another_one_held_are_not_taken(hand: Hand) -> None:
    assert not hand.press("w")
    assert not hand.down("tab", modifiers=frozenset({"alt"}))


def test_off_nothing_is_taken_and_nothing_stays_marked(hand: Hand) -> None:
    hand.press("tab")
    hand.switches.on = False
    hand.switches.stop()
    assert hand.marked is None
    assert not hand.press("tab")
    assert hand.switches.standing == "off"
    assert hand.app.settings["switches"]["on"] is False


def test_a_key_that_is_asked_for_becomes_the_switch_and_does_nothing_else(hand: Hand) -> None:
    asked: list[Key] = []
    hand.switches.ask(asked.append)
    assert hand.press("spacebar")
    assert asked == [Key("key", "spacebar")]
    hand.switches.change(b=(*hand.switches.options.b, asked[0]))
    assert hand.switches.is_switch(Press("key", 32, "spacebar", 0.0))
    hand.press("tab")
    hand.press("spacebar")
    assert len(hand.did) == 1


def test_a_stuck_switch_is_said_once_and_stands_in_the_list(hand: Hand) -> None:
    hand.down("tab")
    hand.wait(6.0)
    assert hand.said == ["Switch A is stuck down: it is ignored until it comes up."]
    assert "stuck" in hand.switches.problem
    hand.presses.release("key", 0, "tab")
    hand.wait(0.3)
    assert (hand.said[-1], hand.switches.problem) == ("Switch A works again.", "")


def test_what_is_out_of_range_is_refused_and_what_was_kept_wrong_is_said(hand: Hand) -> None:
    with pytest.raises(ValueError, match="interval 99"):
        hand.switches.change(interval=99.0)
    hand.app.settings.set("switches", {"loops": 0})
    again = Switches(hand.app)
    assert again.options.loops == 3
    again.start()
    again.stop()
    assert "loops 0 (1 to 9)" in hand.said[-1]


def test_what_was_chosen_is_kept_for_the_next_start(hand: Hand) -> None:
    hand.press("tab")
    hand.press("enter")
    hand.switches.stop()
    assert hand.app.settings["switches_used"] == {"drive": {"pause": 1.0}}


def test_chosen_things_are_told_with_their_presses(hand: Hand) -> None:
    told: list[Selection] = []
    hand.switches.on_selected.append(told.append)
    hand.press("tab")
    hand.press("tab")
    hand.press("enter")
    assert [(one.target.name, one.presses) for one in told] == [("lights", 3)]
