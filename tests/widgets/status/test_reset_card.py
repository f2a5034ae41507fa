"""The card that puts a robot back: never by one press alone."""

from __future__ import annotations

from typing import Any

import pytest

from bridge.msgs.pilothouse_msgs import Event
from tests.headless import Stage
from widgets.status.reset_card import ResetCard


@pytest.fixture
def card(stage: Stage) -> Any:
    card = stage.show(ResetCard(name="Aqua-1", size_hint=(None, None), width=420))
    stage.frames(4)
    card.heard = []
    card.bind(on_command=lambda _, name: card.heard.append(name))
    return card


def tap(stage: Stage, button: Any) -> None:
    stage.frames(3)
    stage.tap(*button.to_window(*button.center))


def test_after_a_mishap_the_first_press_asks_and_the_second_does_it(stage: Stage, card: Any) -> None:
    card.show(Event(level="alarm", kind="robot", text="Aqua-1 has sunk."))
    stage.run_for(0.6)
    assert (card.open, card.headline) == (True, "Aqua-1 has sunk.")
    tap(stage, card.go)
    assert (card.heard, card.headline) == ([], "Put Aqua-1 back to where it started?")
    stage.run_for(0.6)
    tap(stage, card.go)
    assert card.heard == ["reset"]


def test_of_one_that_flies_it_is_said_that_its_rotors_are_off_then(card: Any) -> None:
    card.ask()
    assert card.said == "Its task ends, and it stands still where it started."
    card.flies = True
    assert card.said == "Its task ends, and it stands on the ground where it started, rotors off."


def test_a_second_tap_at_once_is_not_the_confirmation(stage: Stage, card: Any) -> None:
    card.notify("Aqua-1 has sunk.")
    stage.run_for(0.6)
    tap(stage, card.go)
    tap(stage, card.go)
    assert card.heard == []


def test_one_that_was_asked_for_is_confirmed_as_well(stage: Stage, card: Any) -> None:
    card.ask()
    stage.run_for(0.6)
    tap(stage, card.go)
    assert card.heard == ["reset"]


def test_it_is_sent_once_until_it_is_answered(card: Any) -> None:
    card.ask()
    card.press()
    card.press()
    assert card.heard == ["reset"]
    card.answer("refused")
    card.press()
    assert card.heard == ["reset", "reset"]


def test_it_is_gone_when_the_robot_was_put_back(card: Any) -> None:
    card.ask()
    card.press()
    card.answer("accepted")
    assert not card.open


def test_left_as_it_is_it_sends_nothing(stage: Stage, card: Any) -> None:
    card.notify("Aqua-1 has sunk.")
    stage.run_for(0.6)
    tap(stage, card.leave)
    assert (card.heard, card.open) == (["close"], False)


def test_whoever_has_no_control_presses_nothing(stage: Stage, card: Any) -> None:
    card.ask()
    card.blocked = True
    stage.run_for(0.6)
    tap(stage, card.go)
    assert card.heard == []


def test_an_event_that_is_no_alarm_opens_nothing(card: Any) -> None:
    card.show(Event(level="info", kind="robot", text="Cut to 0.7 m/s."))
    assert not card.open


def test_a_mishap_that_is_told_again_leaves_a_question_that_is_being_answered(
    stage: Stage, card: Any
) -> None:
    card.notify("Aqua-1 has sunk.")
    stage.run_for(0.6)
    tap(stage, card.go)
    card.notify("Aqua-1 has sunk.")
    assert card.headline == "Put Aqua-1 back to where it started?"
    stage.run_for(0.6)
    tap(stage, card.go)
    assert card.heard == ["reset"]
    card.answer("sent")
    card.notify("Aqua-1 has sunk.")
    assert card.sent


def test_after_it_was_left_the_next_mishap_is_offered_anew(stage: Stage, card: Any) -> None:
    card.notify("Aqua-1 has sunk.")
    card.press()
    card.close()
    card.notify("Aqua-1 has left tank.")
    assert (card.open, card.asked, card.headline) == (True, False, "Aqua-1 has left tank.")
