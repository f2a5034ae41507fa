"""A finger that stays, told from one that left while a frame was drawn, wherever something waits for it."""

from __future__ import annotations

from typing import Any

import pytest

from widgets.controls.course_dial import HOLD_DURATION, CourseDial
from widgets.controls.goals.goal_pad import GoalPad
from widgets.core.finger_stay import FingerStay
from widgets.parts.buttons import SETTLE_DURATION, PushButton
from widgets.parts.stepper import StepperEnd

STALL = 2.0
"""Of a frame, longer than anything waits for [s]."""
BEFORE = pytest.mark.parametrize("before", [0, 1], ids=["in the long frame", "in the one after it"])


@pytest.fixture
def stay(stage: Any) -> tuple[FingerStay, list[str]]:
    heard: list[str] = []
    return FingerStay(lambda: heard.append("stayed"), 0.5), heard


def tap_in_a_stall(stage: Any, widget: Any, before: int) -> None:
    """A finger that came down before a frame that takes long, and left while it was drawn."""
    touch = stage.touch(*widget.to_window(*widget.center))
    touch.touch_down()
    stage.frames(1, period=STALL)
    stage.frames(before)
    touch.touch_up()
    stage.run_for(STALL)


def test_a_finger_that_stays_is_told_of_once(stage: Any, stay: Any) -> None:
    waits, heard = stay
    waits.begin()
    assert waits.waiting
    stage.run_for(STALL)
    assert (heard, waits.waiting) == (["stayed"], False)


@BEFORE
def test_one_that_left_while_a_frame_took_long_did_not_stay(stage: Any, stay: Any, before: int) -> None:
    waits, heard = stay
    waits.begin()
    stage.frames(1, period=STALL)
    stage.frames(before)
    assert waits.waiting
    waits.end()
    stage.run_for(STALL)
    assert (heard, waits.waiting) == ([], False)


@BEFORE
def test_a_tap_on_a_stepper_while_a_frame_takes_long_counts_once(stage: Any, before: int) -> None:
    end = stage.show(StepperEnd(name="add"), size=(60, 60))
    counts: list[int] = []
    end.bind(on_count=lambda _: counts.append(1))
    tap_in_a_stall(stage, end, before)
    assert len(counts) == 1


@BEFORE
def test_a_tap_on_the_goal_pad_while_a_frame_takes_long_is_one_step(stage: Any, before: int) -> None:
    pad = stage.show(GoalPad(), size=(400, 300))
    pad.wanted = [0.0, 0.0, 0.0]
    left, low, wide, high = pad.button("east")
    touch = stage.touch(*pad.to_window(left + wide / 2, low + high / 2))
    touch.touch_down()
    stage.frames(1, period=STALL)
    stage.frames(before)
    touch.touch_up()
    stage.run_for(STALL)
    assert pad.wanted[0] == pytest.approx(pad.step)


@BEFORE
def test_a_tap_on_the_course_dial_while_a_frame_takes_long_asks_for_no_course(
    stage: Any, before: int
) -> None:
    dial = stage.show(CourseDial(), size=(300, 300))
    dial.heading = 0.0
    asked: list[float] = []
    dial.bind(on_course=lambda _, yaw: asked.append(yaw))
    x, y, radius = dial.place
    touch = stage.touch(*dial.to_window(x + radius * 0.9, y))
    touch.touch_down()
    assert dial.resting
    stage.frames(1, period=STALL + HOLD_DURATION)
    stage.frames(before)
    touch.touch_up()
    assert asked == []


@BEFORE
def test_a_button_whose_meaning_changed_in_a_frame_that_takes_long_takes_no_finger_of_that_frame(
    stage: Any, before: int
) -> None:
    button = stage.show(PushButton(text="Pause", meaning="pause"), size=(200, 60))
    pressed: list[str] = []
    button.bind(on_release=lambda one: pressed.append(one.meaning))
    button.meaning = "resume"
    stage.frames(1, period=STALL + SETTLE_DURATION)
    stage.frames(before)
    stage.tap(*button.to_window(*button.center))
    assert pressed == []
    stage.run_for(1.0)
    stage.tap(*button.to_window(*button.center))
    assert pressed == ["resume"]
