from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import ControlStatus
from widgets.status.mode_card import ModeCard


@pytest.fixture
def card(stage):
    card = ModeCard(size_hint=(None, None), width=420)
    stage.show(card)
    card.asked = []
    card.bind(on_command=lambda _, name: card.asked.append(name))
    return card


def tap(stage, button):
    stage.run_for(0.7)
    stage.tap(*button.to_window(*button.center))
    stage.frames(2)


def test_without_a_task_there_is_no_auto(stage, card):
    card.show(ControlStatus(mode="MANUAL"))
    tap(stage, card.auto)
    assert (card.asked, card.said) == ([], "You are driving. Start a task to switch to AUTO.")


def test_without_a_driver_manual_is_not_lit_and_the_card_says_that_nobody_drives(stage, card):
    card.show(ControlStatus(mode="MANUAL"))
    assert card.manual.fill == "accent"
    card.who = ""
    assert (card.manual.fill, card.said) == ("raised", "Nobody drives. Start a task to switch to AUTO.")
    tap(stage, card.manual)
    assert card.asked == []


def test_another_driver_is_named(card):
    card.ready, card.task, card.who = True, "patrol", "Anna"
    card.show(ControlStatus(mode="PAUSED"))
    assert card.said == "Anna is driving. AUTO continues: patrol."


@pytest.mark.parametrize(
    ("now", "button", "mode"), [("PAUSED", "auto", "AUTO"), ("AUTO", "manual", "MANUAL")]
)
def test_the_other_mode_is_asked_for_once(stage, card, now, button, mode):
    card.ready, card.task = True, "patrol"
    card.show(ControlStatus(mode=now))
    for _ in range(2):
        tap(stage, getattr(card, button))
    assert card.asked == [mode]
    assert card.said == f"Requesting {mode} …"
    card.answer("refused")
    tap(stage, getattr(card, button))
    assert card.asked == [mode, mode]


def test_the_mode_in_force_is_marked_and_closes(stage, card):
    card.ready = True
    card.show(ControlStatus(mode="AUTO"))
    assert (card.auto.fill, card.manual.fill) == ("plan", "raised")
    tap(stage, card.auto)
    assert card.asked == ["close"]


def test_it_is_asked_of_nobody_who_may_not(stage, card):
    card.ready, card.why_not = True, "Anna has control."
    card.show(ControlStatus(mode="AUTO"))
    tap(stage, card.manual)
    assert (card.asked, card.said) == ([], "Anna has control.")


def test_an_accepted_mode_closes_the_card(card):
    card.open = True
    card.answer("sent")
    assert card.open
    card.answer("accepted")
    assert not card.open


def test_a_tiny_card_says_what_matters_in_its_headline(stage, card):
    card.ready, card.task = True, "patrol"
    card.show(ControlStatus(mode="AUTO"))
    stage.frames(3)
    wide = card.height
    card.width = 300
    stage.frames(4)
    assert (card.headline, card.said) == ("MANUAL pauses: patrol.", "")
    assert card.cross.parent is None
    assert card.height < min(wide, 115)


def test_a_card_that_was_never_wider_has_no_cross(stage):
    card = stage.show(ModeCard(size_hint=(None, None), width=300))
    stage.frames(3)
    assert card.cross.parent is None
