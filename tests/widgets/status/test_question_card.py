from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import TaskStatus
from widgets.core.theme import theme
from widgets.status.question_card import QuestionCard

ASKS = TaskStatus(
    task="deliver", state="RUNNING", asks="Has it been picked up at Lab?", reason="Waiting at Lab."
)
CUT = TaskStatus(task="deliver", state="INTERRUPTED", places=["A", "B"], reason="The computer restarted.")


@pytest.fixture
def card(stage):
    card = QuestionCard(size_hint=(None, None), width=420)
    stage.show(card)
    card.asked = []
    card.bind(on_command=lambda _, name: card.asked.append(name))
    return card


def tap(stage, card, name):
    stage.run_for(0.7)
    stage.tap(*card.ids[name].to_window(*card.ids[name].center))
    stage.run_for(0.3)


def test_without_a_question_there_is_nothing(stage, card):
    card.show(TaskStatus(task="deliver", state="RUNNING", reason="Driving to Lab."))
    stage.frames(3)
    assert not card.open
    assert card.height == 0


def test_one_large_button_answers(stage, card):
    card.show(ASKS)
    tap(stage, card, "answer")
    assert card.asked == ["confirm"]
    assert card.ids.answer.height >= 60
    assert card.ids.answer.width >= 260
    assert (card.question, card.said) == ("Has it been picked up at Lab?", "Waiting at Lab.")


def test_a_second_tap_does_not_answer_the_next_question(stage, card):
    card.show(ASKS)
    tap(stage, card, "answer")
    card.show(TaskStatus(task="deliver", state="RUNNING", asks="Has it been taken at Office 9?"))
    stage.frames(2)
    stage.tap(*card.ids.answer.to_window(*card.ids.answer.center))
    assert card.asked == ["confirm"]


@pytest.mark.parametrize(("button", "name"), [("answer", "resume"), ("discard", "cancel")])
def test_what_was_cut_short_is_resumed_or_discarded(stage, card, button, name):
    card.show(CUT)
    tap(stage, card, button)
    assert card.asked == [name]


def test_with_stop_pressed_it_can_be_discarded_and_not_resumed(stage, card):
    card.show(CUT)
    card.held = True
    tap(stage, card, "answer")
    tap(stage, card, "discard")
    assert card.asked == ["cancel"]


def test_who_may_not_answer_cannot(stage, card):
    card.show(ASKS)
    card.blocked = True
    tap(stage, card, "answer")
    assert card.asked == []


def test_a_refusal_is_said_until_the_next_question(card):
    card.show(ASKS)
    card.answer("confirm", "refused", "The robot asks nothing just now.")
    assert (card.said, card.said_role) == ("The robot asks nothing just now.", "danger")
    card.show(ASKS)
    assert card.said_role == "danger"
    card.show(CUT)
    assert card.said == "The computer restarted."


def test_a_question_that_nobody_asks_any_more_for_want_of_a_link_fades_and_says_how_old_it_is(card):
    card.show(ASKS)
    card.old = "8 s old"
    assert (card.role, card.said) == ("muted", "Asked before the link was lost; 8 s old.")
    card.old = ""
    assert (card.role, card.said) == ("accent", "Waiting at Lab.")


def test_where_there_is_little_room_it_is_lower_and_its_button_as_large_as_a_finger_needs(stage, card):
    card.show(ASKS)
    stage.frames(3)
    usual = card.height
    card.tight = True
    stage.frames(3)
    assert card.height <= usual - 20
    assert card.ids.answer.height >= theme.target
