"""The button that is true while it is held: sent again and again, false once after, however the hold ends."""

from __future__ import annotations

import pytest
from kivy.uix.floatlayout import FloatLayout

from bridge.msgs.std_msgs import Bool
from widgets.controls.dead_man import WATCH_PERIOD
from widgets.controls.signals.momentary_button import MomentaryButton


@pytest.fixture
def button(stage):
    button = stage.show(MomentaryButton(title="Horn"), size=(200, 80))
    button.sent = []
    button.bind(on_command=lambda _, msg: button.sent.append(msg.data))
    return button


def hold(stage, x=100, y=40):
    finger = stage.touch(x, y)
    finger.touch_down()
    return finger


def test_held_it_is_true_at_once_and_again_and_again(stage, button):
    hold(stage)
    assert button.sent == [True]
    stage.run_for(1.0)
    assert set(button.sent) == {True}
    assert 9 <= len(button.sent) <= 11


def test_let_go_it_is_false_once_and_then_silent(stage, button):
    finger = hold(stage)
    finger.touch_up()
    assert button.sent == [True, False]
    stage.run_for(1.0)
    assert button.sent == [True, False]


@pytest.mark.parametrize(
    "ends",
    [
        lambda button: setattr(button, "state", "disabled"),
        lambda button: setattr(button, "opacity", 0),
        lambda button: button.parent.remove_widget(button),
        lambda button: setattr(button, "y", 30),
        lambda button: button.rest(),
    ],
    ids=["disabled", "hidden", "removed", "moved", "put to rest"],
)
def test_whatever_ends_the_hold_sends_false_once(stage, button, ends):
    hold(stage)
    ends(button)
    stage.run_for(1.0)
    assert button.sent == [True, False]


def test_it_looks_whether_it_is_seen_before_each_time_it_says_true(stage):
    button, box = MomentaryButton(title="Horn", period=0.02), FloatLayout()
    box.add_widget(button)
    stage.show(box, size=(200, 80))
    sent = []
    button.bind(on_command=lambda _, msg: sent.append(msg.data))
    hold(stage)
    stage.run_for(WATCH_PERIOD * 1.2)  # just looked by itself
    box.opacity = 0
    sent.clear()
    stage.run_for(WATCH_PERIOD * 0.5)
    assert sent == [False]


def test_a_finger_that_slides_off_lets_go_and_does_not_take_hold_by_coming_back(stage, button):
    finger = hold(stage)
    finger.touch_move(100, 200)
    finger.touch_move(100, 40)
    stage.run_for(0.5)
    assert button.sent == [True, False]


def test_disabled_it_sends_nothing(stage, button):
    button.state = "disabled"
    hold(stage).touch_up()
    stage.run_for(0.5)
    assert button.sent == []


def test_what_the_robot_says_sends_nothing(stage, button):
    button.show(Bool(True))
    stage.run_for(0.5)
    assert (button.value, button.sent) == (True, [])


def test_the_period_can_be_chosen(stage, button):
    button.period = 0.5
    hold(stage)
    stage.run_for(1.1)
    assert len(button.sent) == 3


def test_its_words_say_what_it_does(stage, button):
    stage.frames(2)
    assert "hold" in button.texts
    hold(stage)
    stage.frames(2)
    assert "sending" in button.texts
