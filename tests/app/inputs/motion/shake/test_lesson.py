"""The lesson: what it measures, what it asks for again, and how it is kept."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.inputs.motion.shake import AXES, USUAL, Lesson, PersonalAxis, Recogniser, fitted, own_from, own_to
from app.inputs.motion.shake.lesson import MOVING_TIME, Measured, measure
from bench.support import motion
from bench.support.motion import Recording

OWN = PersonalAxis((1.0, 0.0, 0.0), 8.0, 0.4)


def do(lesson: Lesson, takes: list[Recording], begun: float = 0.0) -> float:
    """Have somebody do each in turn, holding still before."""
    t = begun
    for take in takes:
        still = np.tile(take.samples.mean(axis=0), (74, 1))
        for axes in np.concatenate([still, take.samples[: int(3.0 * take.rate)]]).tolist():
            t += 1 / take.rate
            lesson.feed(t, tuple(axes))
    return t


def test_three_movements_in_some_ten_seconds_and_it_is_over() -> None:
    lesson = Lesson()
    assert (lesson.axis, lesson.doing, lesson.progress) == ("lr", False, 0.0)
    t = do(lesson, [motion.made(axis, 1, 0) for axis in AXES])
    assert lesson.over
    assert lesson.axis is None
    assert lesson.progress == 1.0
    assert 10.0 < t < 14.0
    for axis, way in zip(AXES, np.eye(3), strict=True):
        own = lesson.own[axis]
        assert abs(np.dot(own.way, way)) > 0.9
        assert own.gap == pytest.approx(0.5, abs=0.15)
        assert own.peak > 3.0


@pytest.mark.parametrize(
    ("take", "sentence"),
    [
        (motion.drawn(12.0, 1), "round"),
        (Recording("", "", 60.0, np.tile([0.0, 0.0, 9.8], (700, 1))), "too gentle"),
    ],
)
def test_what_was_no_movement_to_and_fro_is_asked_for_again(take: Recording, sentence: str) -> None:
    lesson = Lesson(("ud",))
    circle = Recording("", "", take.rate, take.samples[int(4.2 * take.rate) :])
    do(lesson, [circle])
    assert sentence in lesson.sentence
    assert lesson.axis == "ud"
    assert lesson.own == {}
    do(lesson, [motion.made("ud", 0, 0)], begun=9.0)
    assert lesson.over
    assert lesson.sentence == ""


def test_two_movements_along_one_line_cannot_be_told_apart() -> None:
    lesson = Lesson()
    do(lesson, [motion.made("lr", 0, 0), motion.made("lr", 0, 1)])
    assert lesson.sentence == "Up-down looked like left-right: do it once more, along another line."
    assert list(lesson.own) == ["lr"]


def test_a_movement_that_cannot_be_used_three_times_stays_as_it_is_for_anybody() -> None:
    lesson, lines = Lesson(), [motion.made("lr", 0, seed) for seed in range(5)]
    do(lesson, [*lines[:3]])
    assert lesson.axis == "ud"
    assert "looked like" in lesson.sentence
    t = do(lesson, [lines[3]], begun=13.0)
    assert (lesson.axis, lesson.sentence) == ("fb", "")
    do(lesson, [motion.made("fb", 0, 0)], begun=t)
    assert lesson.over
    assert list(lesson.own) == ["lr", "fb"]
    assert fitted(USUAL, lesson.own).ways[1] == USUAL.ways[1]


def test_a_sensor_that_falls_silent_begins_the_movement_anew() -> None:
    lesson = Lesson()
    take = motion.made("lr", 0, 0)
    for index, axes in enumerate(take.samples[:120].tolist()):
        lesson.feed(index / 60.0, tuple(axes))
    assert lesson.doing
    lesson.feed(9.0, (0.0, 0.0, 9.8))
    assert not lesson.doing
    assert lesson.elapsed == 0.0


def test_who_swings_aslant_is_understood_after_the_lesson() -> None:
    """A hand that goes up and ahead at once, for its own up-down."""
    aslant = np.array([[1, 0, 0], [0, math.cos(0.8), -math.sin(0.8)], [0, math.sin(0.8), math.cos(0.8)]])

    def tilted(seed: int) -> Recording:
        take = motion.made("ud", 0, seed)
        held = take.samples.mean(axis=0)
        return Recording("up_down", "", take.rate, (take.samples - held) @ aslant.T + held)

    lesson = Lesson(("ud",))
    do(lesson, [tilted(0)])
    trials = motion.trials([tilted(seed) for seed in (1, 2)], 3)

    def said(recogniser: Recogniser, take: Recording) -> list[str]:
        found = [recogniser.feed(i / take.rate, tuple(axes)) for i, axes in enumerate(take.samples.tolist())]
        return [shake.axis for shake in found if shake]

    assert lesson.over
    assert [said(Recogniser(fitted(USUAL, lesson.own)), trial.take) for trial in trials] == [["ud"]] * 6
    assert sum(said(Recogniser(), trial.take) == ["ud"] for trial in trials) < 6


def swung(peak: float, frequency: float, own: PersonalAxis) -> list[str]:
    """What one with that of his own for left-right is understood to say by a swing of 1.4 to 4 s."""
    at = np.arange(int(60 * max(1.4, 2.5 / frequency))) / 60.0
    values = [0.0] * 300 + (peak * np.sin(math.tau * frequency * at)).tolist() + [0.0] * 120
    recogniser = Recogniser(fitted(USUAL, {"lr": own}))
    said = (recogniser.feed(index / 60.0, (value, 0.0, 9.8)) for index, value in enumerate(values))
    return [shake.axis for shake in said if shake]


def test_the_lesson_of_one_who_is_slow_and_gentle_makes_no_stop_of_gentle_steps() -> None:
    slow = PersonalAxis((1.0, 0.0, 0.0), 4.0, 0.9)
    assert swung(4.0, 0.6, slow) == ["lr"], "his own"
    assert swung(4.0, 1.6, slow) == [], "quick and gentle is how one sets off"
    assert swung(12.0, 1.6, slow) == ["lr"], "who is frightened shakes quickly, and hard"


@pytest.mark.parametrize("peak", [4.0, 4.5])
def test_nor_of_steps_that_are_not_much_quicker_than_he_is(peak: float) -> None:
    assert swung(peak, 1.2, PersonalAxis((1.0, 0.0, 0.0), 4.0, 0.9)) == []


def test_a_thin_ellipse_is_round_though_it_is_long(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its length alone has most of the movement."""
    at = np.arange(int(60 * MOVING_TIME)) / 60.0

    def measured(wide: float) -> Measured:
        swing = np.stack(
            [8.0 * np.cos(math.tau * 1.5 * at), 0.0 * at, 8.0 * wide * np.sin(math.tau * 1.5 * at)]
        )
        return measure(
            "lr", [(t, (x, y, z)) for t, (x, y, z) in zip(at.tolist(), swing.T.tolist(), strict=True)], {}
        )

    assert measured(0.15).sentence == ""
    assert "went round" in measured(0.45).sentence
    monkeypatch.setattr("app.inputs.motion.shake.lesson.MIN_STRAIGHTNESS", 0.84)
    assert "went round" in measured(0.4).sentence


def test_a_lesson_asks_for_a_straighter_line_closer_to_its_own() -> None:
    for usual, own in zip(USUAL.ways, fitted(USUAL, dict.fromkeys(AXES, OWN)).ways, strict=True):
        assert own.share > usual.share
        assert own.straight >= max(usual.straight, 0.7)


def test_nothing_measured_changes_nothing() -> None:
    assert fitted(USUAL, {}) is USUAL


def test_what_was_measured_comes_back_out_of_the_settings() -> None:
    assert own_from(own_to({"lr": OWN})) == {"lr": OWN}
    assert own_from({}) == {}


@pytest.mark.parametrize(
    ("kept", "sentence"),
    [
        (3, "is a table"),
        ({"lr": 3}, "a way of three numbers"),
        ({"lr": {"way": [1, 0, 0], "peak": 900, "gap": 0.4}}, "2.5 to 60 m/s², not 900"),
        ({"ud": {"way": [1, 0, 0], "peak": 9, "gap": "x"}}, "0.1 to 1.2 s, not nan"),
        ({"fb": {"way": [9, 0, 0], "peak": 9, "gap": 0.4}}, "length of 1, not 9"),
        ({"fb": {"way": [True, 0, 0], "peak": 9, "gap": 0.4}}, "length of 1"),
    ],
)
def test_what_cannot_be_is_said(kept: object, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        own_from(kept)
