from __future__ import annotations

import math

import pytest

from bridge.msgs.sensor_msgs import Range
from bridge.msgs.std_msgs import Header, Time
from widgets.sensors.ultrasound import ECHO_TIMEOUT, MAX_RANGERS, UltrasoundView


@pytest.fixture
def view(stage):
    return stage.show(UltrasoundView(state="live"), size=(150, 172))


def echo(side: str, away: float, stamp: float = 10.0) -> Range:
    return Range(Header(Time.at(stamp), f"ultrasound_{side}"), 0, 0.26, 0.02, 4.0, away)


def test_each_side_has_its_own_figure(stage, view):
    for side, away in (("front", 0.42), ("left", 1.37), ("right", math.inf), ("rear", -math.inf)):
        view.show(echo(side, away))
    stage.frames(2)
    assert view.texts == ["ULTRASOUND", "0.42 m", "1.4 m", "clear", "<2 cm"]


@pytest.mark.parametrize(
    ("away", "role"),
    [
        (2.0, "accent"),
        (math.inf, "accent"),
        (0.59, "warn"),
        (0.29, "danger"),
        (-math.inf, "danger"),
        (math.nan, "faint"),
    ],
)
def test_what_is_near_has_a_warning_colour(view, away, role):
    view.show(echo("front", away))
    assert view.role("ultrasound_front") == role


def test_one_that_fell_silent_shows_no_distance_while_the_others_do(stage, view):
    view.show(echo("left", 0.3))
    view.show(echo("front", 1.0, 10.0 + ECHO_TIMEOUT + 0.1))
    stage.frames(2)
    assert view.texts == ["ULTRASOUND", "–", "1.0 m"]
    assert view.nearest == "ultrasound_front"
    view.show(echo("left", 0.3, 11.2))
    assert view.nearest == "ultrasound_left"


def test_a_clock_that_was_set_back_silences_nobody(view):
    for side in ("left", "front"):
        view.show(echo(side, 1.0, 5000.0))
    view.show(echo("front", 0.5, 10.0))
    assert view.silent == []
    assert view.figure("ultrasound_front") == "0.50 m"


def test_where_it_is_low_the_nearest_is_told_and_which_way_it_is(stage):
    view = stage.show(UltrasoundView(state="live", card=False), size=(120, 48))
    for side, away in (("front", 0.42), ("left", math.inf), ("rear", 0.21)):
        view.show(echo(side, away))
    stage.frames(2)
    assert view.texts == ["0.21 m", "echo behind"]


def test_noise_of_a_thing_that_stands_still_is_not_drawn_anew(view):
    view.show(echo("front", 1.0))
    drawn = []
    view.bind(echoes=lambda *_: drawn.append(1))
    for away in (1.006, 0.995):
        view.show(echo("front", away))
    assert not drawn
    for away in (1.02, math.inf, math.inf, -math.inf, math.nan, math.nan):
        view.show(echo("front", away))
    assert len(drawn) == 4


def test_all_clear_is_said_in_a_word(stage):
    view = stage.show(UltrasoundView(state="live", card=False), size=(120, 48))
    view.show(echo("front", math.inf))
    stage.frames(2)
    assert view.texts == ["clear", "all around"]


def test_names_without_end_do_not_fill_the_memory(view):
    for number in range(MAX_RANGERS + 20):
        view.show(echo(f"{number}", 1.0))
    assert len(view.echoes) == MAX_RANGERS
