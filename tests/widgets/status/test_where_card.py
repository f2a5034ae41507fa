"""The robot's question at which of several places it is."""

from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import PlaceCandidate, PlaceCandidates
from widgets.status.where_card import WhereCard

PLACES = [PlaceCandidate(number, 3.0 * number, 0.0, 0.0, 0.5 / number, 0.1) for number in range(1, 6)]


@pytest.fixture
def card(stage):
    card = WhereCard(size_hint=(None, None), width=420)
    stage.show(card)
    card.chosen, card.asked = [], []
    card.bind(on_choose=lambda _, number: card.chosen.append(number))
    card.bind(on_by_hand=lambda _: card.asked.append("by hand"))
    return card


def tap(stage, button):
    stage.run_for(0.7)
    stage.tap(*button.to_window(*button.center))
    stage.frames(2)


def shown(card):
    return [button.text for button in card.places if button.parent is not None]


def test_it_asks_where_it_is_and_each_place_has_a_button(stage, card):
    card.show(PlaceCandidates(candidates=PLACES[:2]))
    assert card.open
    assert card.headline == "Am I at A or B?"
    assert shown(card) == ["A · 50\u00a0%", "B · 25\u00a0%"]
    tap(stage, card.places[1])
    assert card.chosen == [2]


def test_none_of_them_leads_to_placing_it_by_hand(stage, card):
    card.show(PlaceCandidates(candidates=PLACES[:2]))
    tap(stage, card.by_hand)
    assert (card.chosen, card.asked) == ([], ["by hand"])


def test_the_likeliest_have_buttons_and_all_are_named(card):
    card.show(PlaceCandidates(candidates=PLACES))
    assert len(shown(card)) == 3
    assert card.headline == "Am I at A, B, C, D or E?"
    card.show(PlaceCandidates(candidates=PLACES[:2]))
    assert len(shown(card)) == 2


def test_it_is_gone_when_it_is_no_longer_asked(card):
    card.show(PlaceCandidates(candidates=PLACES[:2]))
    card.show(PlaceCandidates())
    assert not card.open
    card.show(PlaceCandidates(candidates=PLACES[:1]))
    assert not card.open


def test_who_may_not_answer_reads_who_can_and_presses_nothing(stage, card):
    card.show(PlaceCandidates(candidates=PLACES[:2]))
    card.blocked, card.why_not = True, "Anna has control and can answer."
    assert card.said == "Anna has control and can answer."
    tap(stage, card.places[0])
    card.choose(0)
    assert card.chosen == []
