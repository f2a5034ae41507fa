from __future__ import annotations

import re

import pytest
from msgspec.structs import replace

from bridge.core.codes import Code
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.pilothouse_msgs import TaskStatus
from widgets.status.paused_card import OWN_WORDS, WORDS, PausedCard


@pytest.fixture
def card(stage):
    card = PausedCard(client_id="a", size_hint=(None, None), width=420)
    stage.show(card)
    card.asked = []
    card.bind(on_command=lambda _, name: card.asked.append(name))
    return card


def paused(reason, code="", actor_id="", **parameters):
    return TaskStatus(
        task="deliver",
        places=["Lab", "Office 9"],
        state="PAUSED",
        reason=reason,
        code=code,
        actor_id=actor_id,
        parameters=[KeyValue(key, value) for key, value in parameters.items()],
    )


def tap(stage, button):
    stage.run_for(0.7)
    stage.tap(*button.to_window(*button.center))
    stage.frames(2)


@pytest.mark.parametrize(
    ("reason", "code", "actor", "said"),
    [
        ("Paused: tablet-A took the stick.", "task_taken_over", "a", "You took the stick."),
        ("Paused: Bob took the stick.", "task_taken_over", "b", "Bob took the stick."),
        ("Stopped by tablet-A.", "task_stopped", "a", "You pressed STOP."),
        ("Stopped by Bob.", "task_stopped", "b", "Stopped by Bob."),
        ("Paused by Bob.", "task_paused", "b", "Paused by Bob."),
        ("Paused: tablet-A took the stick.", "", "", "Paused: tablet-A took the stick."),
    ],
)
def test_it_says_what_is_paused_and_who_did_it(card, reason, code, actor, said):
    card.show(paused(reason, code, actor, name="Bob" if actor == "b" else "tablet-A"))
    assert card.open
    assert card.headline.endswith(" is paused")
    assert card.said == said


@pytest.mark.parametrize(
    ("actor", "said"),
    [
        ("a", "You told it to stay. Resume lets it go on."),
        ("b", "Bob told it to stay. Resume lets it go on."),
    ],
)
def test_of_one_that_stays_where_it_charges_it_says_where_and_how_it_goes_on(card, actor, said):
    told = paused("Bob had it stay at Pad, charging.", "task_stays", actor, name="Bob", place="Pad")
    card.show(replace(told, place="Pad"))
    assert (card.headline, card.said) == ("Stays at Pad, charging", said)


def test_a_code_without_the_names_that_belong_to_it_leaves_the_robots_own_words(card):
    card.show(paused("Paused: Bob took the stick.", "task_taken_over", "b"))
    assert card.said == "Paused: Bob took the stick."


@pytest.mark.parametrize(("code", "words"), [*WORDS.items(), *OWN_WORDS.items()])
def test_its_words_name_nothing_that_their_code_does_not_have(code, words):
    assert set(re.findall(r"{(\w+)}", words)) <= set(Code(code).parameters)


def test_it_is_resumed_by_a_tap_and_not_under_the_stick(stage, card):
    card.show(paused("Paused: tablet-A took the stick."))
    card.held = True
    tap(stage, card.resume)
    assert card.asked == []
    card.held = False
    tap(stage, card.resume)
    assert card.asked == ["resume"]


def test_it_can_be_put_away_where_there_is_room_for_a_cross(stage, card):
    card.show(paused("Paused: tablet-A took the stick."))
    tap(stage, card.cross)
    assert card.asked == ["close"]
    card.width = 300
    stage.frames(2)
    assert card.cross.parent is None
    assert card.resume.icon == ""
    card.width = 420
    stage.frames(2)
    assert card.cross.parent is not None
    assert card.resume.icon == "play_arrow"


def test_a_task_that_runs_needs_no_card(card):
    card.show(paused("Paused by Bob."))
    card.show(TaskStatus(task="deliver", state="RUNNING"))
    assert not card.open
