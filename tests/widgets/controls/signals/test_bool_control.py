"""Switch and box to tick: they ask for the other value, and show as done only what the robot says."""

from __future__ import annotations

import pytest

from bridge.msgs.std_msgs import Bool
from widgets.controls.signals.bool_control import REPLY_TIMEOUT
from widgets.controls.signals.tick_box import TickBox
from widgets.controls.signals.toggle_switch import ToggleSwitch


@pytest.fixture(params=[ToggleSwitch, TickBox])
def control(request, stage):
    control = stage.show(request.param(title="Lights"), size=(240, 72))
    control.sent = []
    control.bind(on_command=lambda _, msg: control.sent.append(msg.data))
    return control


def tap(stage, x=100, y=36, to=None):
    finger = stage.touch(x, y)
    finger.touch_down()
    if to is not None:
        finger.touch_move(*to)
    finger.touch_up()
    stage.frames(2)


def test_a_tap_asks_for_the_other_value(stage, control):
    control.show(Bool(True))
    tap(stage)
    control.show(Bool(False))
    tap(stage)
    assert control.sent == [False, True]


def test_what_was_never_heard_is_asked_on(stage, control):
    tap(stage)
    assert control.sent == [True]


def test_what_was_asked_is_not_shown_as_done_before_the_robot_says_so(stage, control):
    control.show(Bool(False))
    tap(stage)
    assert (control.value, control.asked, control.word) == (False, True, "asked for on")
    control.show(Bool(False))
    assert control.word == "asked for on"
    control.show(Bool(True))
    assert (control.value, control.asked, control.word) == (True, None, "on")


def test_a_robot_that_does_not_do_it_is_said_and_nothing_is_claimed(stage, control):
    control.show(Bool(False))
    tap(stage)
    stage.run_for(REPLY_TIMEOUT + 0.2)
    assert (control.value, control.asked, control.word) == (False, None, "no reply")
    tap(stage)
    assert control.sent == [True, True]


def test_what_never_left_is_said_and_not_laid_to_the_robot(stage, control):
    control.show(Bool(False))
    tap(stage)
    control.show_unsent()
    assert (control.value, control.asked, control.word, control.role) == (False, None, "not sent", "warn")
    stage.run_for(REPLY_TIMEOUT + 0.2)
    assert control.word == "not sent"


def test_nothing_is_sent_again_by_itself(stage, control):
    tap(stage)
    stage.run_for(5.0)
    assert control.sent == [True]


def test_without_a_topic_that_tells_it_shows_what_was_sent(stage, control):
    control.confirmed = False
    tap(stage)
    tap(stage)
    assert control.sent == [True, False]
    assert (control.value, control.word) == (False, "off")


def test_a_finger_that_slides_off_asks_for_nothing(stage, control):
    tap(stage, to=(100, 300))
    assert control.sent == []


@pytest.mark.parametrize(
    "ends",
    [
        lambda control: setattr(control, "state", "disabled"),
        lambda control: setattr(control, "opacity", 0),
        lambda control: control.parent.remove_widget(control),
        lambda control: control.rest(),
    ],
    ids=["disabled", "hidden", "removed", "put to rest"],
)
def test_whatever_ends_the_touch_asks_for_nothing(stage, control, ends):
    finger = stage.touch(100, 36)
    finger.touch_down()
    assert control.pressed
    ends(control)
    finger.touch_up()
    assert (control.sent, control.pressed) == ([], False)


def test_a_touch_on_what_a_parent_hides_asks_for_nothing(stage, control):
    finger = stage.touch(100, 36)
    finger.touch_down()
    control.parent.opacity = 1
    from kivy.uix.modalview import ModalView

    ModalView().open(animation=False)
    finger.touch_up()
    assert control.sent == []


def test_disabled_it_takes_no_finger(stage, control):
    control.state = "disabled"
    tap(stage)
    assert control.sent == []


@pytest.mark.parametrize(("value", "word"), [(None, "—"), (True, "on"), (False, "off")])
def test_how_it_is_stands_in_a_word_too(stage, control, value, word):
    if value is not None:
        control.show(Bool(value))
    assert control.word == word
