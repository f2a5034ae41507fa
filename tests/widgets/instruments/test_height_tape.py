from __future__ import annotations

import math

import pytest

from bridge.msgs.pilothouse_msgs import ControlStatus, FlightState
from widgets.instruments.height_tape import PHASES, HeightTape


@pytest.fixture
def tape(stage):
    return stage.show(HeightTape(state="live"), size=(176, 176))


def fly(tape, stage, **figures):
    tape.show(FlightState(**{"phase": "flying", "height": 1.24, "climb": 0.0, **figures}))
    stage.frames(2)


def test_height_climb_and_phase_are_told(stage, tape):
    fly(tape, stage, climb=0.32)
    assert {"Flying", "1.2", "m", "0.3", "m/s"} <= set(tape.texts)


def test_before_the_first_message_there_are_dashes_and_no_zeros(stage, tape):
    assert set(tape.texts) == {"HEIGHT", "–"}


@pytest.mark.parametrize("height", [math.nan, math.inf])
def test_higher_than_is_measured_is_said_so(stage, tape, height):
    fly(tape, stage, height=height)
    assert {"–", "out of reach"} <= set(tape.texts)
    assert not [text for text in tape.texts if text.startswith("1")]


def test_a_climb_that_is_not_known_is_a_dash(stage, tape):
    fly(tape, stage, climb=math.nan)
    assert "–" in tape.texts
    assert "m/s" not in tape.texts


@pytest.mark.parametrize(("phase", "words"), [("taking_off", "Taking off"), ("landed", "Landed")])
def test_the_phase_is_told_in_words(stage, tape, phase, words):
    fly(tape, stage, phase=phase)
    assert words in tape.texts


def test_a_phase_nobody_knows_is_told_as_it_is(stage, tape):
    assert "autorotating" not in PHASES
    fly(tape, stage, phase="autorotating")
    assert "Autorotating" in tape.texts


def test_the_tape_runs_past_the_pointer(stage, tape):
    fly(tape, stage, height=23.6)
    assert {"20", "22", "23.6"} <= set(tape.texts)
    fly(tape, stage, height=23.6)
    assert "3" not in tape.texts


def test_noise_below_what_is_read_is_not_drawn_anew(stage, tape):
    fly(tape, stage, height=1.241)
    drawn = []
    tape.bind(own_height=lambda *_: drawn.append(1))
    fly(tape, stage, height=1.243)
    assert not drawn


def test_the_ground_is_not_written_below(stage, tape):
    fly(tape, stage, height=0.4)
    assert not [text for text in tape.texts if text.startswith(("-", "−"))]


@pytest.mark.parametrize(("phase", "words"), [("flying", ["1.2", " m high"]), ("landed", ["Landed"])])
def test_where_it_is_low_it_is_a_line(stage, phase, words):
    tape = stage.show(HeightTape(state="live"), size=(128, 44))
    fly(tape, stage, phase=phase)
    assert tape.texts == words


@pytest.mark.parametrize(("phase", "word"), [("flying", "Flying"), ("taking_off", "Rising")])
def test_on_an_upright_phone_phase_and_units_have_room_too(stage, phase, word):
    tape = stage.show(HeightTape(state="live"), size=(124, 150))
    fly(tape, stage, phase=phase, climb=0.3)
    assert {word, "m", "m/s"} <= set(tape.texts)


@pytest.mark.parametrize("size", [(176, 176), (124, 150), (112, 150), (188, 97), (72, 90)])
@pytest.mark.parametrize(
    ("phase", "words"),
    [
        ("taking_off", {"Taking off", "Rising"}),
        ("flying", {"Flying"}),
        ("landing", {"Landing"}),
        ("landed", {"Landed"}),
    ],
)
def test_a_phase_is_told_in_whole_words_however_little_room_there_is(stage, size, phase, words):
    tape = stage.show(HeightTape(state="live"), size=size)
    fly(tape, stage, phase=phase, climb=0.3)
    assert words & set(tape.texts)


@pytest.mark.parametrize(
    ("size", "word"), [((176, 176), "Hovers"), ((124, 150), "Hovers"), ((128, 44), " m, hovers")]
)
@pytest.mark.parametrize("phase", ["taking_off", "flying", "landing"])
def test_what_is_stopped_in_the_air_hovers(stage, size, word, phase):
    tape = stage.show(HeightTape(state="live"), size=size)
    fly(tape, stage, phase=phase)
    tape.show(ControlStatus(stopped=True))
    stage.frames(2)
    assert word in tape.texts
    tape.show(ControlStatus(stopped=False))
    stage.frames(2)
    assert word not in tape.texts


def test_what_is_stopped_on_the_ground_has_landed(stage, tape):
    fly(tape, stage, phase="landed")
    tape.show(ControlStatus(stopped=True))
    stage.frames(2)
    assert "Landed" in tape.texts
