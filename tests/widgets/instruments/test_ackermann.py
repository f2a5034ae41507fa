from __future__ import annotations

import math

import numpy as np
import pytest

from bridge.msgs.arrays import Float64Array
from bridge.msgs.pilothouse_msgs import AckermannState
from widgets.instruments.ackermann import AckermannView, _bent

WHEELS = ["rear_left", "rear_right", "front_left", "front_right"]


@pytest.fixture
def view(stage):
    return stage.show(AckermannView(state="live"), size=(176, 176))


def state(
    speed=1.8, steering=-0.21, radius=-9.4, angles=(0.0, 0.0, -0.2, -0.22), speeds=(1.9, 1.7, 2.0, 1.8)
):
    return AckermannState(
        speed=speed,
        steering=steering,
        turning_radius=radius,
        wheels=WHEELS,
        wheel_angles=Float64Array(angles),
        wheel_speeds=Float64Array(speeds),
    )


def test_speed_steering_and_radius_are_told_and_each_wheels_speed(stage, view):
    view.show(state())
    stage.frames(2)
    assert view.texts[:2] == ["STEERING", "12° right"]
    assert {"1.8 m/s", "radius 9.4 m", "1.9", "1.7", "2.0"} < set(view.texts)


@pytest.mark.parametrize(
    ("steering", "radius", "steer", "turn"),
    [
        (0.52, 3.5, "30° left", "3.5 m"),
        (-0.52, -3.5, "30° right", "3.5 m"),
        (0.0, math.inf, "straight", "none"),
        (0.001, -2000.0, "straight", "none"),
        (math.nan, math.nan, "–", "–"),
    ],
)
def test_which_way_and_how_tightly_it_turns_is_said_in_words(view, steering, radius, steer, turn):
    view.show(state(steering=steering, radius=radius))
    assert (view.steer_words, view.radius_words) == (steer, turn)


def test_before_the_first_message_there_are_dashes_and_no_wheel_has_a_speed(stage, view):
    stage.frames(2)
    assert set(view.texts) == {"STEERING", "–", "radius –"}


def test_a_wheel_that_is_not_measured_has_a_dash(stage, view):
    view.show(state(speeds=(1.9, math.nan)))
    stage.frames(2)
    assert view.texts.count("–") == 3


def test_a_wheel_whose_name_says_nothing_is_not_drawn(stage, view):
    view.show(AckermannState(speed=1.0, wheels=["spare"], wheel_speeds=Float64Array([9.9])))
    stage.frames(2)
    assert "9.9" not in view.texts


def test_backing_the_speed_is_negative(view):
    view.show(state(speed=-0.8))
    assert view.speed_words == "−0.8 m/s"


def test_where_it_is_wide_the_figures_stand_beside_the_truck(stage):
    view = stage.show(AckermannView(state="live"), size=(326, 228))
    view.show(state())
    stage.frames(2)
    assert {"SPEED", "1.8", "m/s", "STEER", "12°", "right", "RADIUS", "9.4", "m"} < set(view.texts)


def test_where_there_is_little_room_the_wheels_speeds_give_way_to_the_truck(stage):
    view = stage.show(AckermannView(state="live"), size=(212, 148))
    view.show(state())
    stage.frames(2)
    assert "1.9" not in view.texts
    assert "12°" in view.texts


def test_where_it_is_low_speed_and_steering_are_told(stage):
    view = stage.show(AckermannView(state="live", card=False), size=(72, 54))
    view.show(state())
    stage.frames(2)
    assert view.texts == ["1.8 m/s", "12° right"]


def test_the_way_bends_to_the_left_when_it_steers_left_and_keeps_its_width():
    along = np.linspace(0.0, 100.0, 30)
    left, right = (_bent(along, 0.01, aside) for aside in (-20.0, 20.0))
    assert left[-1][0] < left[0][0]
    assert np.hypot(*(right - left).T) == pytest.approx(40.0)
    straight = _bent(along, 0.0, 5.0)
    assert straight[-1] == pytest.approx([5.0, 100.0])


def test_where_it_is_low_and_wide_there_are_as_many_figures_as_fit(stage):
    view = stage.show(AckermannView(state="live"), size=(174, 96))
    view.show(state())
    stage.frames(2)
    assert "SPEED" in view.texts
    assert "RADIUS" not in view.texts
