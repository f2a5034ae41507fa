from __future__ import annotations

import math

import pytest

from bridge.msgs.pilothouse_msgs import Compass
from bridge.msgs.std_msgs import Header, Time
from widgets.instruments.roll_pitch import SPAN, RollPitch, _turned


@pytest.fixture
def lie(stage):
    return stage.show(RollPitch(state="live"), size=(176, 176))


def told(roll: float, pitch: float, second: float = 100.0) -> Compass:
    return Compass(Header(Time.at(second)), 38.0, math.radians(roll), math.radians(pitch))


def test_both_angles_are_told_with_the_side_that_is_down(stage, lie):
    lie.show(told(8.0, -4.0))
    stage.frames(2)
    assert lie.texts == ["ROLL", "8°", "right", "most 8°", "PITCH", "4°", "bow up", "most 4°"]


@pytest.mark.parametrize(
    ("roll", "pitch", "words"),
    [
        (-8.0, 4.0, [("8°", "left"), ("4°", "bow down")]),
        (0.3, -0.4, [("0°", "level"), ("0°", "level")]),
        (math.nan, math.nan, [("–", ""), ("–", "")]),
    ],
)
def test_the_words_follow_the_signs_of_rep_103(lie, roll, pitch, words):
    lie.show(told(roll, pitch))
    assert [lie.words("roll"), lie.words("pitch")] == words


def test_with_the_right_side_down_the_hull_turns_clockwise_as_seen_from_astern():
    ((x, y),) = _turned([(1.0, 0.0)], -math.radians(10))
    assert (x, y) == (pytest.approx(math.cos(math.radians(10))), pytest.approx(-math.sin(math.radians(10))))


def test_how_far_it_went_is_told_for_half_a_minute(lie):
    lie.show(told(-12.0, 7.0, 100.0))
    lie.show(told(5.0, -3.0, 110.0))
    assert lie.rolled == [
        pytest.approx(math.radians(-12), abs=1e-3),
        pytest.approx(math.radians(5), abs=1e-3),
    ]
    assert (lie.most("roll"), lie.most("pitch")) == ("most 12°", "most 7°")
    lie.show(told(1.0, 1.0, 100.0 + SPAN + 1))
    assert (lie.most("roll"), lie.most("pitch")) == ("most 5°", "most 3°")


def test_many_messages_in_a_second_are_not_kept_one_by_one(lie):
    for number in range(500):
        lie.show(told(number % 13, -(number % 5), 100.0 + number / 50))
    assert sum(len(rolls) for _, rolls, _ in lie._past) <= 2 * 11
    assert lie.most("roll") == "most 12°"


def test_a_clock_that_was_set_back_forgets_what_was(lie):
    lie.show(told(30.0, 0.0, 5000.0))
    lie.show(told(2.0, 0.0, 10.0))
    assert lie.most("roll") == "most 2°"


def test_an_angle_that_is_not_measured_leaves_the_past_alone(lie):
    lie.show(told(math.nan, math.nan))
    lie.show(told(9.0, 2.0))
    lie.show(told(math.nan, math.nan, 101.0))
    assert (lie.words("roll"), lie.most("roll")) == (("–", ""), "most 9°")


@pytest.mark.parametrize(
    ("roll", "role"), [(8.0, "text"), (-21.0, "warn"), (41.0, "danger"), (math.nan, "muted")]
)
def test_a_steep_angle_has_a_warning_colour(lie, roll, role):
    lie.show(told(roll, 0.0))
    assert lie.role("roll") == role


def test_before_the_first_message_there_are_dashes(stage, lie):
    stage.frames(2)
    assert lie.texts == ["ROLL", "–", "PITCH", "–"]


@pytest.mark.parametrize(
    ("size", "texts"),
    [
        ((326, 228), ["ROLL", "8°", "right", "most 8°", "PITCH", "4°", "bow up", "most 4°"]),
        ((128, 128), ["ROLL", "8°", "right", "PITCH", "4°", "bow up"]),
        ((140, 54), ["roll 8° right", "pitch 4° bow up"]),
        ((72, 54), ["roll 8°", "pitch 4°"]),
    ],
)
def test_what_is_said_fits_the_room(stage, size, texts):
    lie = stage.show(RollPitch(state="live"), size=size)
    lie.show(told(8.0, -4.0))
    stage.frames(2)
    assert lie.texts == texts
