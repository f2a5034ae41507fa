"""Switches as one way in: which keys are theirs, STOP by them, what the operator forbids, and keys that type."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

import app.inputs.switch_access.switches as switching
from app.core.command_origin import origins
from app.inputs.base.button_presses import Press, Presses
from app.inputs.switch_access.scan.engine import Engine, Selection
from app.inputs.switch_access.scan.plan import Planner
from app.inputs.switch_access.scan.settings import Key
from app.inputs.switch_access.scan.target import Mark, Target
from app.inputs.switch_access.switches import SwitchAccess
from app.inputs.switch_access.typing_guard import TYPING_TIME
from app.intents.intents import Intents
from app.intents.method_permits import MethodPermits


class Settings(dict[str, Any]):
    def set(self, name: str, value: Any) -> None:
        self[name] = value


class IntentActions:
    """What the app does, beside what is marked."""

    def __init__(self) -> None:
        self.done: list[str] = []

    def why_not(self, intent: str) -> str:
        return ""

    def words(self, intent: str) -> str:
        return intent

    def do(self, intent: str) -> None:
        self.done.append(intent)

    def answer(self, yes: bool) -> str:
        return ""


class Hand:
    """Somebody before an app with two buttons."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now, self.said, self.did, self.typing = 100.0, [], [], False
        monkeypatch.setattr(switching, "is_typing", lambda: self.typing)
        monkeypatch.setattr(SwitchAccess, "stepped", lambda *_: None)
        stops: list[Press] = []
        shell = SimpleNamespace(say=lambda text, level, about: self.said.append(text))
        self.presses = Presses(lambda press: False, stops.append)
        self.acts, self.told = IntentActions(), []
        self.permits = MethodPermits(Settings())
        self.intents = Intents(self.acts, self.permits, lambda: self.now)
        self.intents.on_taken.append(lambda heard, verdict: self.told.append((heard, verdict.what)))
        self.app = SimpleNamespace(
            settings=Settings(),
            inputs=SimpleNamespace(presses=self.presses, is_switch=lambda _: False),
            intents=self.intents,
            methods={},
            shell=shell,
            now=lambda: self.now,
        )
        self.switches = SwitchAccess(self.app)
        self.place = "drive"
        engine = Engine(self, Planner({}), switching._Desk(self.switches))
        monkeypatch.setattr(SwitchAccess, "engine", engine)
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
            self.switches.update(self.now)


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
    ((heard, what),) = hand.told
    assert (heard.intent, heard.method, what) == ("stop", "switches", "acted")
    assert hand.acts.done == ["stop"]


def test_what_the_operator_forbids_is_not_done_and_said(hand: Hand) -> None:
    hand.permits.allow("switches", "pause", False)
    hand.press("tab")
    hand.press("enter")
    assert hand.did == []
    assert hand.said == ["Switches may not do that: Pause. It can be allowed in Inputs."]
    assert [(heard.intent, what) for heard, what in hand.told] == [("pause", "not allowed")]


def test_what_was_chosen_is_told_to_whoever_hears_of_other_ways_in(hand: Hand) -> None:
    hand.press("tab")
    hand.press("enter")
    assert [(heard.intent, heard.method, what) for heard, what in hand.told] == [
        ("pause", "switches", "acted")
    ]


def test_a_study_only_sees_what_was_chosen(hand: Hand) -> None:
    hand.intents.practise = lambda heard: "Pause: noted."
    hand.press("tab")
    hand.press("enter")
    assert hand.did == []
    assert [(heard.intent, what) for heard, what in hand.told] == [("pause", "practised")]
    assert hand.said == []


def test_after_a_choice_a_finger_takes_the_mark_away_again(hand: Hand) -> None:
    hand.press("tab")
    hand.press("enter")
    hand.press("tab")
    assert hand.marked is not None
    hand.switches._touched()
    assert hand.marked is None


def test_who_types_types_with_the_keys_that_are_switches_too(hand: Hand) -> None:
    hand.typing = True
    hand.press("w")
    assert not hand.press("tab")
    assert not hand.press("enter")
    assert not hand.switches.awake


def test_beside_a_field_in_which_nobody_types_the_scan_can_be_woken(hand: Hand) -> None:
    hand.typing = True
    assert hand.press("enter")
    assert hand.switches.awake
    hand.press("enter")
    assert len(hand.did) == 1


def test_who_typed_or_touched_the_glass_some_time_ago_keeps_nobody_from_waking_the_scan(hand: Hand) -> None:
    hand.typing = True
    hand.press("w")
    hand.switches._touched()
    hand.wait(TYPING_TIME + 0.1)
    assert hand.press("tab")
    assert hand.switches.awake


@pytest.mark.parametrize("keys", [["enter"], ["tab", "enter"]])
def test_held_or_both_together_they_are_stop_though_somebody_types(hand: Hand, keys: list[str]) -> None:
    hand.typing = True
    hand.press("w")
    taken = [hand.down(key) for key in keys]
    assert not any(taken)
    hand.wait(0.9 if keys == ["enter"] else 0.1)
    assert [heard.intent for heard, _ in hand.told] == ["stop"]
    assert not hand.switches.awake


def test_what_is_typed_with_a_switch_ends_when_its_key_is_up(hand: Hand) -> None:
    hand.typing = True
    hand.press("w")
    for _ in range(5):
        hand.press("enter", 0.3)
    hand.wait(6.0)
    assert (hand.told, hand.said) == ([], [])


def test_typing_puts_the_mark_away_as_a_finger_does(hand: Hand) -> None:
    for away in (
        lambda: hand.press("w"),
        hand.switches._touched,
        lambda: hand.switches._wrote(None, "w"),
    ):
        hand.typing = False
        hand.press("tab")
        assert hand.switches.awake
        hand.typing = True
        away()
        assert not hand.switches.awake
        assert not hand.press("enter")


def test_letters_of_a_switch_are_no_typing(hand: Hand) -> None:
    hand.switches.change(a=(Key("key", "1"),))
    hand.typing = True
    hand.down("1")
    hand.switches._wrote(None, "1")
    hand.presses.release("key", 0, "1")
    hand.wait(0.4)
    assert hand.press("enter")


def test_by_itself_the_mark_goes_round_a_dialog_with_a_field_until_it_is_answered(hand: Hand) -> None:
    hand.switches.change(one=True, loops=1)
    hand.press("enter")
    hand.typing = True
    hand.wait(30.0)
    assert hand.switches.awake
    hand.typing = False
    hand.wait(30.0)
    assert not hand.switches.awake


def test_a_dialog_that_switches_have_opened_is_theirs_though_a_finger_was_on_the_glass(hand: Hand) -> None:
    hand.switches._touched()
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
    again = SwitchAccess(hand.app)
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


def test_b_held_is_stop_though_a_key_is_asked_for(hand: Hand) -> None:
    taken: list[Key] = []
    hand.switches.ask(taken.append)
    hand.press("enter", 0.9)
    assert taken == [Key("key", "enter")]
    assert [heard.intent for heard, _ in hand.told] == ["stop"]


def test_a_key_that_becomes_the_other_switch_while_it_is_down_comes_up_as_the_one_that_it_was(
    hand: Hand,
) -> None:
    hand.switches.ask(lambda key: hand.switches.change(a=(), b=(key,)))
    hand.press("tab")
    hand.wait(6.0)
    assert hand.said == []
