"""The pad of four arrows: full speed in eight directions while a finger is on it, zero whenever it is not."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from widgets.controls.sticks.d_pad import HUB, DPad

SIZE, MIDDLE, OUT = 200, 100, 70


@pytest.fixture
def pad(stage):
    pad = stage.show(DPad(max_speed=0.2, max_yaw_rate=0.5), size=(SIZE, SIZE))
    pad.twists = []
    pad.bind(on_command=lambda _, twist: pad.twists.append((twist.linear.x, twist.angular.z)))
    return pad


def hold(stage, x, y):
    finger = stage.touch(x, y)
    finger.touch_down()
    return finger


@pytest.mark.parametrize(
    ("x", "y", "twist"),
    [
        (0, OUT, (0.2, 0.0)),
        (0, -OUT, (-0.2, 0.0)),
        (-OUT, 0, (0.0, 0.5)),
        (OUT, 0, (0.0, -0.5)),
        (-OUT, OUT, (0.2, 0.5)),
        (OUT, -OUT, (-0.2, -0.5)),
    ],
)
def test_an_arrow_drives_at_its_full_speed_and_between_two_both_do(stage, pad, x, y, twist):
    hold(stage, MIDDLE + x, MIDDLE + y)
    assert pad.twists == [twist]


def test_let_go_it_commands_zero_once(stage, pad):
    hold(stage, MIDDLE, MIDDLE + OUT).touch_up()
    assert pad.twists == [(0.2, 0.0), (0.0, 0.0)]
    assert math.copysign(1.0, pad.twist.linear.x) == 1.0


def test_a_finger_that_wanders_to_another_arrow_drives_that(stage, pad):
    finger = hold(stage, MIDDLE, MIDDLE + OUT)
    finger.touch_move(MIDDLE - OUT, MIDDLE)
    assert pad.twists[-1] == (0.0, 0.5)


def test_on_the_hub_it_commands_nothing(stage, pad):
    finger = hold(stage, MIDDLE + HUB * MIDDLE * 0.9, MIDDLE)
    assert pad.twists == []
    finger.touch_move(MIDDLE, MIDDLE + OUT)
    finger.touch_move(MIDDLE, MIDDLE)
    assert pad.twists == [(0.2, 0.0), (0.0, 0.0)]


@pytest.mark.parametrize(
    "ends",
    [
        lambda pad: setattr(pad, "state", "disabled"),
        lambda pad: setattr(pad, "opacity", 0),
        lambda pad: pad.parent.remove_widget(pad),
        lambda pad: setattr(pad, "x", 30),
        lambda pad: pad.rest(),
    ],
    ids=["disabled", "hidden", "removed", "moved", "put to rest"],
)
def test_whatever_ends_the_hold_commands_zero(stage, pad, ends):
    finger = hold(stage, MIDDLE, MIDDLE + OUT)
    ends(pad)
    stage.frames(2)
    assert pad.twists == [(0.2, 0.0), (0.0, 0.0)]
    finger.touch_move(MIDDLE, MIDDLE + OUT + 5)
    assert pad.twists[-1] == (0.0, 0.0)


def test_disabled_it_takes_no_finger(stage, pad):
    pad.state = "disabled"
    hold(stage, MIDDLE, MIDDLE + OUT)
    assert pad.twists == []


def test_another_finger_neither_moves_nor_releases_it(stage, pad):
    hold(stage, MIDDLE, MIDDLE + OUT)
    second = hold(stage, MIDDLE - OUT, MIDDLE)
    second.touch_up()
    assert pad.twists == [(0.2, 0.0)]


def test_beside_its_square_it_is_not_touched(stage, pad):
    pad.size = 300, 200
    stage.frames(2)
    hold(stage, 20, MIDDLE)
    assert pad.twists == []


@given(st.floats(-2, 2), st.floats(-2, 2))
def test_a_push_is_one_of_eight_directions_or_none(forward, left):
    shaped = DPad().shaped(forward, left)
    assert all(share in (-1.0, 0.0, 1.0) for share in shaped)
    if math.hypot(forward, left) < HUB:
        assert shaped == (0.0, 0.0)
    else:
        assert shaped != (0.0, 0.0)
        assert shaped[0] * forward + shaped[1] * left > 0
