"""The pane where shaking is set up, by an app that is only what it asks for."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from app.device.motion import NoMotion
from app.screens.inputs.panes.shake_pane import LESSON, TRY, ShakePane
from tests.app.inputs.motion.test_shake_input import Hand


def test_without_a_sensor_no_lesson_begins_and_its_place_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    hand: Any = Hand(monkeypatch, on=True)
    hand.app.methods = SimpleNamespace(get=lambda _: hand.shaking)
    hand.app.now = lambda: hand.t
    pane = ShakePane(hand.app)
    pane.enter()
    assert not pane.teach.disabled
    assert pane.learnt.text == LESSON
    hand.sensing.use(NoMotion())
    pane.tick()
    assert pane.teach.disabled
    assert pane.learnt.text == "This computer has no motion sensor."
    pane._teach()
    assert hand.shaking.lesson is None
    assert pane.roll.parent is pane


def test_it_says_that_a_shake_acts_here_and_is_tried_out_by_a_button_until_the_pane_is_left(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    hand: Any = Hand(monkeypatch, on=True)
    hand.shaking.start()
    hand.app.methods = SimpleNamespace(get=lambda _: hand.shaking)
    hand.app.now = lambda: hand.t
    pane = ShakePane(hand.app)
    pane.enter()
    assert "acts here as anywhere" in pane.standing.text
    pane.trial.dispatch("on_release")
    assert pane.standing.text == TRY
    assert pane.trial.text == "End the try"
    hand.shakes("ud")
    pane.tick()
    assert pane.standing.text.endswith("Understood; while it is tried out nothing is done.")
    pane.leave()
    assert not hand.shaking.trying
    hand.shakes("ud")
    assert hand.intents == ["pause"]
