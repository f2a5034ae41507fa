from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from widgets.controls.sticks.tilt_circle import TiltCircle
from widgets.controls.sticks.tilt_stick import NEUTRAL_ZONE
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

LIMIT = math.radians(20)


@pytest.fixture
def circle(stage):
    return watched(stage.show(TiltCircle(max_tilt=LIMIT), size=(176, 176)))


def watched(circle):
    circle.orders = []
    circle.bind(on_command=lambda _, order: circle.orders.append((order.kind, order.roll, order.pitch)))
    return circle


def hold(stage, circle, aside, ahead):
    x, y, _ = circle.round
    finger = stage.touch(x + aside * circle.travel[0], y + ahead * circle.travel[1])
    finger.touch_down()
    return finger


def test_held_at_the_upper_rim_it_tilts_nose_down_as_far_as_it_may(stage, circle):
    hold(stage, circle, 0.0, 1.0)
    assert circle.orders == [("tilt", 0.0, pytest.approx(LIMIT))]
    assert (circle.forward, circle.left) == (pytest.approx(1.0), 0.0)


def test_held_to_the_right_it_rolls_right_side_down(stage, circle):
    hold(stage, circle, 0.5, 0.0)
    assert circle.orders == [("tilt", pytest.approx(LIMIT / 2), 0.0)]
    assert circle.left == pytest.approx(-0.5)


def test_let_go_it_commands_level_once(stage, circle):
    finger = hold(stage, circle, 0.0, 1.0)
    finger.touch_up()
    circle.rest()
    assert circle.orders[1:] == [("tilt", 0.0, 0.0)]
    assert math.copysign(1.0, circle.left) == 1.0


def test_inside_the_green_ring_it_is_level(stage, circle):
    circle.tilt(0.0, NEUTRAL_ZONE * LIMIT * 0.9)
    assert (circle.orders, circle.order.pitch) == ([], 0.0)
    assert circle.knob_pos[1] > circle.round[1]
    circle.tilt(0.0, NEUTRAL_ZONE * LIMIT * 1.1)
    assert circle.orders == [("tilt", 0.0, pytest.approx(NEUTRAL_ZONE * LIMIT * 1.1))]


@given(st.floats(-9, 9), st.floats(-9, 9))
def test_no_tablet_tilts_farther_than_the_rim_nor_the_other_way(roll, pitch):
    circle = TiltCircle(max_tilt=LIMIT)
    circle.tilt(roll, pitch)
    assert math.hypot(circle.roll, circle.pitch) <= LIMIT + 1e-9
    assert circle.roll * roll >= 0.0
    assert circle.pitch * pitch >= 0.0


@pytest.mark.parametrize("roll", [math.nan, math.inf])
def test_a_tilt_that_is_no_number_is_refused(circle, roll):
    with pytest.raises(ValueError, match="finite number"):
        circle.tilt(roll, 0.0)
    assert circle.orders == []


def test_a_gamepad_leans_it_by_shares(circle):
    assert circle.lean(1.0, 0.0)
    assert circle.orders == [("tilt", 0.0, pytest.approx(LIMIT))]
    assert circle.ahead == 1.0


def test_a_sensor_does_not_take_it_from_a_finger(stage, circle):
    hold(stage, circle, 0.0, 1.0)
    assert not circle.tilt(0.2, 0.0)
    assert len(circle.orders) == 1


def test_where_it_needs_a_hold_the_tablet_tilts_only_while_a_finger_is_on_it(stage, circle):
    circle.needs_hold = True
    assert not circle.tilt(0.2, 0.0)
    assert circle.orders == []
    finger = hold(stage, circle, -0.9, 0.0)
    assert circle.orders == [("tilt", pytest.approx(0.2), 0.0)]
    assert circle.tilt(0.0, 0.1)
    assert circle.orders[-1] == ("tilt", 0.0, pytest.approx(0.1))
    finger.touch_up()
    assert circle.orders[-1] == ("tilt", 0.0, 0.0)
    assert circle.ahead > 0


def test_steered_it_commands_what_its_giver_made_of_the_tilt_dead_zone_and_all(circle):
    circle.needs_hold = circle.clutched = True
    assert circle.steer((0.3, 0.6), (0.01, 0.5))
    assert circle.orders == [("tilt", pytest.approx(0.01 * LIMIT), pytest.approx(0.5 * LIMIT))]
    assert (circle.aside, circle.ahead) == (pytest.approx(0.3), pytest.approx(0.6))
    circle.steer((0.3, 0.0), (0.02, 0.0))
    assert circle.orders[-1] == ("tilt", pytest.approx(0.02 * LIMIT), 0.0), "it has no zone of its own"
    with pytest.raises(ValueError, match="finite shares"):
        circle.steer((0.0, math.nan), (0.0, 0.0))


def test_a_finger_that_moves_on_it_says_only_when(stage, circle):
    circle.needs_hold = True
    circle.steer((0.0, 0.4), (0.0, 0.2))
    finger = hold(stage, circle, 0.0, -0.5)
    finger.touch_move(0.5, 0.9)
    assert circle.orders == [("tilt", 0.0, pytest.approx(0.2 * LIMIT))]
    assert circle.held


def test_put_to_rest_it_is_level_and_tells_whoever_clutches_it(circle):
    told = []
    circle.bind(on_let_go=lambda one: told.append(one.roll))
    circle.needs_hold = circle.clutched = True
    circle.steer((0.5, 0.0), (0.5, 0.0))
    circle.rest()
    assert told == [0.0]


def test_of_what_does_not_lean_shares_are_said(stage, circle):
    circle.needs_hold = circle.clutched = circle.in_shares = True
    circle.steer((-0.3, 0.6), (-0.1, 0.5))
    stage.frames(2)
    assert circle.texts == ["50\u00a0% ahead · 10\u00a0% left"]


def test_a_clutch_that_opened_says_why(stage, circle):
    circle.needs_hold = circle.clutched = True
    circle.opened = "Too far"
    stage.frames(2)
    assert circle.texts == ["Too far"]


def test_disabled_it_lets_go_and_nothing_leans_it(stage, circle):
    hold(stage, circle, 0.0, 1.0)
    circle.state = "disabled"
    assert not circle.tilt(0.2, 0.0)
    assert circle.orders[1:] == [("tilt", 0.0, 0.0)]


def test_a_corner_outside_the_round_is_not_the_circle(stage, circle):
    stage.touch(4, 170).touch_down()
    assert circle.orders == []


@pytest.mark.parametrize("size", [(176, 176), (326, 228), (228, 326), (120, 300)])
def test_the_circle_stays_within_the_round_and_that_within_the_widget(stage, size):
    circle = stage.show(TiltCircle(), size=size)
    x, y, radius = circle.round
    assert radius > 50
    assert min(x - radius - circle.x, circle.right - x - radius) >= 0
    assert min(y - radius - circle.y, circle.top - y - radius) >= 0
    circle.tilt(1.0, -1.0)
    assert math.dist(circle.knob_pos, (x, y)) + circle.knob_radius <= radius


def test_what_it_commands_is_said_in_words(stage, circle):
    stage.frames(1)
    assert circle.texts == ["T\u200aI\u200aL\u200aT"]
    circle.tilt(math.radians(-5), math.radians(12))
    stage.frames(2)
    assert circle.texts == ["12° ahead · 5° left"]


def test_where_it_is_wide_the_figures_stand_beside_it(stage):
    circle = stage.show(TiltCircle(card=True), size=(326, 228))
    circle.tilt(math.radians(5), 0.0)
    stage.frames(2)
    assert circle.texts[1:] == ["PITCH", "0°", "level", "ROLL", "5°", "right"]


def test_on_a_picture_the_veil_covers_the_round_and_no_box_about_it(stage, circle):
    circle.size = (200, 240)
    x, y, radius = circle.round
    left, low, width, height = circle.veil_box
    assert (left + width / 2, low + height / 2, width) == (x, y, height)
    assert width / 2 == pytest.approx(radius, abs=2)
    circle.card = True
    assert circle.veil_box[3] >= circle.height


def test_disabled_on_a_picture_its_words_fade_with_it(stage, circle):
    circle.state = "disabled"
    (word,) = circle.marks(Shapes())
    assert tuple(word.colour) == tuple(theme.faint)
