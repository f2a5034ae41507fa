from __future__ import annotations

import math

import pytest

from bridge.msgs.pilothouse_msgs import RudderState
from widgets.controls.sticks.rudder_throttle import RudderThrottle

SIDE = 242


@pytest.fixture
def helm(stage):
    helm = stage.show(RudderThrottle(max_steering=0.6, most=0.8), size=(SIDE, SIDE))
    helm.orders = []
    helm.bind(
        on_command=lambda _, order: helm.orders.append((round(order.throttle, 6), round(order.steering, 6)))
    )
    return helm


def hold(stage, helm, across=0.0, up=0.0):
    """A finger on the pad, so many knob's travels from its middle."""
    (x, y), (most_across, most_up) = helm.middle, helm.travel
    finger = stage.touch(x + across * most_across, y + up * most_up)
    finger.touch_down()
    return finger


def test_pushed_ahead_it_orders_the_throttle_that_the_slider_allows(stage, helm):
    hold(stage, helm, up=1)
    assert helm.orders == [(0.8, 0.0)]
    assert helm.order.kind == "steer"
    assert math.isnan(helm.order.speed)


def test_pushed_to_the_left_it_lays_the_rudder_to_turn_left(stage, helm):
    hold(stage, helm, across=-1)
    assert helm.orders == [(0.0, 0.6)]
    assert (helm.throttle_words, helm.rudder_words) == ("idle", "34° port")


def test_both_go_to_their_ends_in_a_corner(stage, helm):
    hold(stage, helm, across=1, up=-1)
    assert helm.orders == [(-0.8, -0.6)]
    assert (helm.throttle_words, helm.rudder_words) == ("80 % astern", "34° starboard")


def test_a_thumb_that_goes_ahead_a_little_aside_steers_straight(stage, helm):
    hold(stage, helm, across=0.06, up=0.5)
    throttle, steering = helm.orders[-1]
    assert throttle > 0.3
    assert (steering, helm.rudder_words) == (0.0, "set amidships")


def test_let_go_throttle_and_rudder_come_back_to_zero(stage, helm):
    hold(stage, helm, up=1, across=1).touch_up()
    assert helm.orders[-1] == (0.0, 0.0)
    assert helm.knob_pos == helm.middle
    assert math.copysign(1.0, helm.order.throttle) == math.copysign(1.0, helm.order.steering) == 1.0


def test_a_gamepad_pushes_it_and_a_finger_takes_it_over(stage, helm):
    assert helm.lean(0.5, 0.0)
    hold(stage, helm, up=-1)
    assert not helm.lean(1.0, 0.0)
    assert helm.orders[-1] == (-0.8, 0.0)


@pytest.mark.parametrize("lean", [(math.nan, 0.0), (0.0, math.inf)])
def test_a_push_that_is_no_number_is_refused(helm, lean):
    with pytest.raises(ValueError, match="from -1 to 1"):
        helm.lean(*lean)
    assert helm.orders == []


def test_disabled_it_lets_go_and_says_that_a_finger_came_in_vain(stage, helm):
    told = []
    helm.bind(on_in_vain=lambda _: told.append(1))
    hold(stage, helm, up=1)
    helm.state = "disabled"
    hold(stage, helm, up=1)
    assert helm.orders == [(0.8, 0.0), (0.0, 0.0)]
    assert told == [1]


def test_what_the_boat_tells_is_drawn_and_commands_nothing(stage, helm):
    helm.show(RudderState(angle=0.3, throttle=0.5))
    stage.frames(2)
    assert (helm.angle, helm.throttle, helm.orders) == (0.3, 0.5, [])


def test_before_the_boat_has_told_anything_there_is_no_mark_of_it(stage, helm):
    helm.show(RudderState(angle=math.nan, throttle=math.nan))
    stage.frames(2)
    assert math.isnan(helm.angle)


@pytest.mark.parametrize("side", [140, 176, 242])
@pytest.mark.parametrize("push", [(1.0, 1.0), (-1.0, -1.0), (0.0, 0.0)])
def test_knob_and_words_stay_inside_at_every_size(stage, side, push):
    helm = stage.show(RudderThrottle(), size=(side, side))
    helm.lean(*push)
    stage.frames(2)
    left, low, width, height = helm.pad
    x, y = helm.knob_pos
    assert left <= x - helm.knob_radius <= x + helm.knob_radius <= left + width + 1e-6
    assert low <= y - helm.knob_radius <= y + helm.knob_radius <= low + height + 1e-6
    assert len(helm.texts) == (4 if side > 200 else 2)


def test_while_a_task_steers_and_no_hand_does_the_boats_own_throttle_and_rudder_are_told(stage, helm):
    helm.show(RudderState(throttle=0.86, angle=-math.radians(26)))
    assert (helm.throttle_words, helm.rudder_words) == ("idle", "set amidships")
    helm.led = True
    assert (helm.throttle_words, helm.rudder_words) == ("task 86 %", "26° starboard")
    hold(stage, helm, up=1)
    assert (helm.throttle_words, helm.rudder_words) == ("80 % ahead", "set amidships")


def test_what_a_task_steers_fits_where_there_is_little_room(stage, helm):
    helm.size, helm.led = (140, 140), True
    helm.show(RudderState(throttle=0.86, angle=-math.radians(26)))
    stage.frames(2)
    assert "task 86 %" in helm.texts
