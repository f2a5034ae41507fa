from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import TaskStatus
from widgets.status.paused_card import PausedCard


@pytest.fixture
def card(stage):
    card = PausedCard(name="tablet-A", size_hint=(None, None), width=420)
    stage.show(card)
    card.asked = []
    card.bind(on_command=lambda _, name: card.asked.append(name))
    return card


def paused(reason):
    return TaskStatus(task="deliver", places=["Lab", "Office 9"], state="PAUSED", reason=reason)


def tap(stage, button):
    stage.run_for(0.7)
    stage.tap(*button.to_window(*button.center))
    stage.frames(2)


@pytest.mark.parametrize(
    ("reason", "said"),
    [
        ("Paused: tablet-A took the stick.", "You took the stick."),
        ("Paused: Bob took the stick.", "Bob took the stick."),
        ("Stopped by tablet-A.", "You pressed STOP."),
        ("Stopped by Bob.", "Stopped by Bob."),
        ("Paused by Bob.", "Paused by Bob."),
    ],
)
def test_it_says_what_is_paused_and_who_did_it(card, reason, said):
    card.show(paused(reason))
    assert card.open
    assert card.headline.endswith(" is paused")
    assert card.said == said


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
