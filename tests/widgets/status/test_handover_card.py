from __future__ import annotations

import math

import pytest

from bridge.msgs.pilothouse_msgs import ControlStatus
from widgets.status.handover_card import HandoverCard

ASKS = ControlStatus(driver="Bob", driver_id="b", requested_by="Anna", requested_by_id="a")


@pytest.fixture
def card(stage):
    card = HandoverCard(size_hint=(None, None), width=420)
    stage.show(card)
    card.asked = []
    card.bind(on_command=lambda _, name: card.asked.append(name))
    return card


def tap(stage, button):
    stage.run_for(0.7)
    stage.tap(*button.to_window(*button.center))
    stage.frames(2)


@pytest.mark.parametrize(("button", "name"), [("keep", "object"), ("hand_over", "grant")])
def test_the_driver_answers_with_a_large_button(stage, card, button, name):
    card.me, card.left = "b", 7.2
    card.show(ASKS)
    assert card.headline == "Anna asks for control · 8\u00a0s"
    assert card.said == "Without an answer, control is handed over."
    button = getattr(card, button)
    tap(stage, button)
    assert card.asked == [name]
    assert button.height >= 53
    assert card.take_back.parent.parent is None


def test_who_asks_takes_it_back(stage, card):
    card.me, card.left = "a", 0.0
    card.show(ASKS)
    assert card.headline == "You asked Bob · 0\u00a0s"
    tap(stage, card.take_back)
    assert card.asked == ["take_back"]
    assert card.keep.parent.parent is None


def test_one_answer_is_given_once_and_again_when_it_failed(stage, card):
    card.me = "b"
    card.show(ASKS)
    tap(stage, card.keep)
    tap(stage, card.hand_over)
    assert (card.asked, card.said) == (["object"], "Sent …")
    card.answer("no_reply")
    tap(stage, card.hand_over)
    assert card.asked == ["object", "grant"]


def test_a_finger_that_was_there_before_the_question_answers_nothing(stage, card):
    card.me = "b"
    card.show(ASKS)
    tap(stage, card.keep)
    card.asked.clear()
    card.show(ControlStatus(driver="Bob", driver_id="b", requested_by="Carl", requested_by_id="c"))
    stage.frames(2)
    stage.tap(*card.hand_over.to_window(*card.hand_over.center))
    assert card.asked == []
    tap(stage, card.hand_over)
    assert card.asked == ["grant"]


def test_who_neither_drives_nor_asks_has_nothing_to_answer(card):
    card.me = "c"
    card.show(ASKS)
    assert not card.open
    card.show(ControlStatus(driver="Bob", driver_id="b"))
    assert not card.open


def test_without_a_clock_no_time_is_claimed(card):
    card.me, card.left = "b", math.nan
    card.show(ASKS)
    assert card.headline == "Anna asks for control"


def test_the_driver_of_a_phone_is_told_too_that_silence_gives_control_away(stage, card):
    card.me, card.width = "b", 300
    card.show(ASKS)
    stage.frames(2)
    assert card.tiny
    assert card.said == "Without an answer, control is handed over."
    card.me = "a"
    card.show(ASKS)
    assert card.said == "", "who asks has the countdown"
