from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from widgets.controls.sticks.joystick import DEAD_ZONE, Joystick

SIZE = 240
MIDDLE = SIZE / 2


@pytest.fixture
def stick(stage):
    stick = stage.show(Joystick(max_speed=0.5, max_yaw_rate=2.0), size=(SIZE, SIZE))
    stick.twists = []
    stick.bind(on_command=lambda _, twist: stick.twists.append((twist.linear.x, twist.angular.z)))
    return stick


def hold(stage, x, y):
    finger = stage.touch(x, y)
    finger.touch_down()
    return finger


def test_pushed_to_the_rim_ahead_it_drives_at_full_speed(stage, stick):
    hold(stage, MIDDLE, MIDDLE + stick.reach)
    assert stick.twists == [(0.5, 0.0)]


def test_pushed_to_the_left_it_turns_left(stage, stick):
    hold(stage, MIDDLE - stick.reach, MIDDLE)
    assert stick.twists == [(0.0, 2.0)]


def test_pulled_back_it_backs(stage, stick):
    hold(stage, MIDDLE, MIDDLE - stick.reach / 2)
    assert stick.twists == [(pytest.approx(-0.25), 0.0)]


def test_let_go_it_springs_back_and_commands_zero_once(stage, stick):
    finger = hold(stage, MIDDLE, MIDDLE + stick.reach)
    finger.touch_up()
    assert stick.twists == [(0.5, 0.0), (0.0, 0.0)]
    assert stick.knob_pos == tuple(stick.center)
    assert math.copysign(1.0, stick.twist.linear.x) == 1.0


def test_a_move_that_changes_nothing_commands_nothing(stage, stick):
    finger = hold(stage, MIDDLE, MIDDLE + stick.reach)
    finger.touch_move(MIDDLE, MIDDLE + stick.reach)
    assert len(stick.twists) == 1


def test_over_the_edge_it_keeps_the_finger(stage, stick):
    finger = hold(stage, MIDDLE, MIDDLE)
    finger.touch_move(MIDDLE, 900)
    assert stick.twists[-1] == (0.5, 0.0)
    finger.touch_move(900, MIDDLE)
    assert stick.twists[-1] == (0.0, -2.0)


def test_another_finger_neither_moves_nor_releases_it(stage, stick):
    first = hold(stage, MIDDLE, MIDDLE + stick.reach)
    second = hold(stage, MIDDLE - stick.reach, MIDDLE)
    second.touch_move(MIDDLE, MIDDLE - stick.reach)
    second.touch_up()
    assert stick.twists == [(0.5, 0.0)]
    first.touch_up()
    assert stick.twists[-1] == (0.0, 0.0)


def test_two_sticks_follow_a_finger_each(stage, stick):
    other = stage.show(Joystick(), size=(SIZE, SIZE))
    other.x = 400
    ahead = hold(stage, MIDDLE, MIDDLE + stick.reach)
    back = hold(stage, 400 + MIDDLE, MIDDLE - other.reach)
    assert (stick.forward, other.forward) == (1.0, -1.0)
    ahead.touch_up()
    assert (stick.forward, other.forward) == (0.0, -1.0)
    back.touch_up()
    assert other.forward == 0.0


def test_a_corner_outside_the_round_is_not_the_stick(stage, stick):
    hold(stage, 4, 4)
    assert stick.twists == []


def test_rest_lets_the_finger_go(stage, stick):
    finger = hold(stage, MIDDLE, MIDDLE + stick.reach)
    stick.rest()
    finger.touch_move(MIDDLE, MIDDLE - stick.reach)
    assert stick.twists == [(0.5, 0.0), (0.0, 0.0)]
    hold(stage, MIDDLE, MIDDLE - stick.reach)
    assert stick.twists[-1] == (-0.5, 0.0)


def test_rest_at_rest_commands_nothing(stick):
    stick.rest()
    assert stick.twists == []


def test_disabled_it_lets_go_and_takes_no_finger(stage, stick):
    hold(stage, MIDDLE, MIDDLE + stick.reach)
    stick.state = "disabled"
    hold(stage, MIDDLE, MIDDLE + stick.reach)
    assert stick.twists == [(0.5, 0.0), (0.0, 0.0)]


def test_a_thumb_that_rests_on_the_middle_commands_nothing(stage, stick):
    hold(stage, MIDDLE + stick.reach * DEAD_ZONE * 0.7, MIDDLE)
    assert stick.twists == []


@pytest.mark.parametrize("forward", [math.nan, math.inf])
def test_a_lean_that_is_no_number_is_refused(stick, forward):
    with pytest.raises(ValueError, match="from -1 to 1"):
        stick.lean(forward, 0.0)
    assert stick.twists == []


@given(st.floats(-5, 5), st.floats(-5, 5))
def test_no_lean_commands_more_than_the_limits(forward, left):
    stick = Joystick(max_speed=0.5, max_yaw_rate=2.0)
    stick.lean(forward, left)
    assert abs(stick.twist.linear.x) <= 0.5 + 1e-9
    assert abs(stick.twist.angular.z) <= 2.0 + 1e-9
    assert math.hypot(stick.forward, stick.left) <= 1.0 + 1e-9
    assert stick.twist.linear.x * forward >= 0.0
    assert stick.twist.angular.z * left >= 0.0


def test_the_knob_stays_within_the_round(stage, stick):
    hold(stage, MIDDLE, MIDDLE)
    for angle in range(0, 360, 30):
        stick.lean(math.sin(math.radians(angle)), math.cos(math.radians(angle)))
        assert math.dist(stick.knob_pos, stick.center) + stick.knob_radius <= SIZE / 2


def test_a_finger_whose_end_was_lost_does_not_drive_when_it_comes_down_elsewhere(stage, stick):
    finger = hold(stage, MIDDLE, MIDDLE + stick.reach)
    finger.sx, finger.sy = (
        0.9,
        0.9,
    )  # the system gives the next finger the same number, and Kivy the same touch
    finger.touch_down()
    assert stick.twists == [(0.5, 0.0), (0.0, 0.0)]
    finger.touch_move(MIDDLE, MIDDLE + stick.reach)
    assert (stick.finger, stick.twists[-1]) == (None, (0.0, 0.0))


def test_a_finger_whose_end_was_lost_and_comes_down_on_the_stick_again_pushes_anew(stage, stick):
    finger = hold(stage, MIDDLE, MIDDLE + stick.reach)
    finger.touch_down()
    assert stick.twists == [(0.5, 0.0), (0.0, 0.0), (0.5, 0.0)]
    finger.touch_up()
    assert stick.twists[-1] == (0.0, 0.0)


@pytest.mark.parametrize("change", [{"pos": (40, 0)}, {"size": (200, 200)}])
def test_moved_away_under_the_finger_it_rests(stage, stick, change):
    hold(stage, MIDDLE, MIDDLE + stick.reach)
    for name, value in change.items():
        setattr(stick, name, value)
    assert (stick.finger, stick.twists[-1]) == (None, (0.0, 0.0))


def test_a_finger_takes_the_stick_from_a_gamepad_and_the_gamepad_does_not_take_it_back(stage, stick):
    stick.lean(1.0, 0.0)
    hold(stage, MIDDLE - stick.reach, MIDDLE)
    assert stick.twists == [(0.5, 0.0), (0.0, 2.0)]
    assert not stick.lean(1.0, 0.0)
    assert stick.twists == [(0.5, 0.0), (0.0, 2.0)]


def test_what_a_gamepad_does_is_told_by_sign_and_word_and_not_by_colour_alone(stick):
    looks = {}
    for what in ("ready", "drives", "silent", "let go"):
        stick.gamepad = what
        looks[what] = stick.sign, stick.sign_word
    assert len({id(sign) for sign, _ in looks.values()}) == len({id(word) for _, word in looks.values()}) == 4
    assert stick.sign_pos[0] + stick.sign_size[0] <= stick.right


def test_the_caption_goes_away_under_the_knob(stick):
    stick.caption = "climb · turn"
    assert stick.captioned
    stick.lean(-0.5, 0.0)
    assert not stick.captioned
    stick.lean(0.5, 0.0)
    assert stick.captioned


@pytest.mark.parametrize("before", [(376, 242), (242, 376)])
def test_at_rest_the_knob_is_in_the_middle_whatever_room_it_had_before(stage, before):
    stick = stage.show(Joystick(), size=before)
    assert stick.knob_pos == tuple(stick.center)
    stick.size = (242, 242)
    assert stick.knob_pos == tuple(stick.center)
