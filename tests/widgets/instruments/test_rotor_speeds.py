from __future__ import annotations

import math

import pytest

from bridge.msgs.arrays import Float64Array
from bridge.msgs.pilothouse_msgs import MotorArray
from widgets.instruments.rotor_speeds import MAX_ROTORS, RotorSpeeds

NAMES = ["front_left", "front_right", "rear_right", "rear_left"]


@pytest.fixture
def view(stage):
    return stage.show(RotorSpeeds(state="live"), size=(176, 176))


def turn(view, stage, *speeds, warmth=27.0, names=NAMES):
    told = MotorArray(
        names=names, speeds=Float64Array(speeds), temperatures=Float64Array([warmth] * len(speeds))
    )
    view.show(told)
    stage.frames(2)


def test_each_rotor_has_its_turns_a_minute_and_temperature(stage, view):
    turn(view, stage, 361.0, 372.0, 358.0, 349.0)
    assert view.texts == [
        "ROTORS",
        "rpm",
        *(t for n in ("3450", "3550", "3420", "3330") for t in (n, "27 °C")),
    ]


def test_before_the_first_message_each_has_a_dash(view):
    assert view.texts == ["ROTORS", "–", "–", "–", "–"] or view.texts[2:] == ["–"] * 4


def test_a_rotor_that_stands_while_others_turn_is_a_danger_in_words(stage, view):
    turn(view, stage, 361.0, 0.0, 358.0, 349.0)
    assert view.texts[1] == "one stopped"
    assert view.role(0.0, 27.0) == "danger"


def test_on_the_ground_all_may_stand(stage, view):
    turn(view, stage, 0.0, 0.0, 0.0, 0.0)
    assert view.texts[1] == "rpm"
    assert view.role(0.0, 27.0) == "accent"


@pytest.mark.parametrize(
    ("warmth", "word"), [(69.0, "rpm"), (70.0, "warm"), (90.0, "hot"), (math.nan, "rpm")]
)
def test_a_motor_that_is_too_warm_is_told_in_words(stage, view, warmth, word):
    turn(view, stage, 361.0, 372.0, 358.0, 349.0, warmth=warmth)
    assert view.texts[1] == word


def test_the_scale_grows_with_the_fastest_that_was_seen(stage, view):
    turn(view, stage, 361.0, 620.0, 358.0, 349.0)
    turn(view, stage, 361.0, 372.0, 358.0, 349.0)
    assert view.full == 620.0


def test_what_is_not_measured_is_a_dash_and_is_not_drawn_anew(stage, view):
    turn(view, stage, 361.0, math.nan, 358.0)
    assert view.texts.count("–") == 2
    drawn = []
    view.bind(rotors=lambda *_: drawn.append(1))
    turn(view, stage, 361.2, math.nan, 358.3)
    assert not drawn
    turn(view, stage, 363.0, math.nan, 358.0)
    assert drawn == [1]


def test_motors_without_end_do_not_fill_the_card(stage, view):
    turn(view, stage, *[300.0] * 40, names=[f"motor{number}" for number in range(40)])
    assert len(view.rotors) == MAX_ROTORS


@pytest.mark.parametrize(
    ("speeds", "text"),
    [((361.0, 372.0, 358.0, 349.0), "rotors 3440 rpm"), ((361.0, 0.0, 358.0, 349.0), "a rotor is stopped")],
)
def test_where_it_is_low_it_is_a_line(stage, speeds, text):
    view = stage.show(RotorSpeeds(state="live"), size=(160, 44))
    turn(view, stage, *speeds)
    assert view.texts == [text]
