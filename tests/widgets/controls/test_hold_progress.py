from __future__ import annotations

import math

import pytest
from kivy.uix.widget import Widget

from widgets.controls.hold_progress import HOLD_DURATION, LOOKS, MAX_FRAME, Hold


class Held(Hold, Widget):
    """What is held, and nothing else."""


@pytest.fixture
def held(stage):
    widget = stage.show(Held(), size=(100, 100))
    widget.heard = []
    widget.bind(on_held_long=lambda _: widget.heard.append("held"))
    return widget


def test_a_hold_that_ends_early_does_nothing_and_counts_for_nothing(stage, held):
    held.hold()
    stage.run_for(0.9 * HOLD_DURATION)
    held.rest()
    assert held.held == 0
    held.hold()
    stage.run_for(0.9 * HOLD_DURATION)
    assert not held.heard
    assert held.held == pytest.approx(0.9, abs=0.03)


def test_what_of_a_long_frame_was_before_the_finger_came_counts_for_nothing(stage, held):
    held.hold()  # at the end of a frame that began 0.9 s ago, for all that is known
    stage.frames(1, period=0.9 * HOLD_DURATION)
    assert held.held == 0
    stage.frames(LOOKS, period=0.0)
    assert held.held == 0
    stage.run_for(0.9 * HOLD_DURATION)
    assert not held.heard


def test_it_is_told_once_and_begins_anew(stage, held):
    held.hold()
    stage.run_for(1.5 * HOLD_DURATION)
    assert held.heard == ["held"]
    assert held.held == 0


def test_a_frame_that_took_long_does_not_count_for_a_finger_that_may_have_left(stage, held):
    held.hold()
    stage.frames(LOOKS, period=2.0)
    assert not held.heard
    assert held.held <= LOOKS * MAX_FRAME / HOLD_DURATION
    held.rest()  # the finger left while the first of them was drawn
    held.hold()
    stage.frames(LOOKS, period=2.0)
    assert held.held <= LOOKS * MAX_FRAME / HOLD_DURATION
    assert not held.heard


@pytest.mark.parametrize("frame", [0.15, 0.3, 0.5, 1.0, 2.0])
def test_a_finger_that_stays_is_not_kept_waiting_by_a_glass_that_is_drawn_seldom(stage, held, frame):
    held.hold()
    stage.frames(1 + math.ceil(HOLD_DURATION / frame) + LOOKS, period=frame)
    assert held.heard == ["held"]


def test_it_may_take_longer(stage, held):
    held.hold(3.0)
    stage.run_for(2.8)
    assert not held.heard
    stage.run_for(0.3)
    assert held.heard == ["held"]
