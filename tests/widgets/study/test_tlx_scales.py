"""The forms after a task: no answer is there before a hand gave one, and what it took is kept."""

from __future__ import annotations

import math

import pytest
from kivy.metrics import sp

from tests.headless import Stage
from widgets.core.shapes import Shapes
from widgets.study.score_history import ScoreHistory
from widgets.study.sus_form import ITEMS, SusForm
from widgets.study.tlx_scales import SCALES, TlxScales


class Clock:
    now = 100.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def tlx(clock):
    return TlxScales(clock)


def test_no_scale_has_an_answer_before_a_hand_gave_one(tlx):
    assert tlx.answers == {}
    assert {scale.figure for scale in tlx.rows.values()} == {"—"}
    assert all(math.isnan(scale.ticks.value) for scale in tlx.rows.values())


def test_a_place_on_the_line_is_the_nearest_of_21_ticks(tlx):
    ticks = tlx.rows["mental"].ticks
    ticks.size = 200 + 24, 60
    left, right = ticks.span
    assert {ticks.at(x) for x in range(int(left) - 40, int(right) + 40)} == set(range(0, 101, 5))
    assert ticks.at(left + (right - left) * 0.36) == 35


def test_a_finger_gives_an_answer_and_moves_it(stage: Stage, tlx):
    stage.show(tlx)
    ticks = tlx.rows["effort"].ticks
    left, right = ticks.span
    y = ticks.center_y
    finger = stage.touch(*ticks.to_window(left + (right - left) * 0.2, y))
    finger.touch_down()
    assert tlx.answers == {"effort": 20}
    finger.touch_move(*ticks.to_window(left + (right - left) * 0.7, y))
    finger.touch_up()
    assert tlx.answers == {"effort": 70}


def test_the_first_step_of_a_button_goes_to_the_middle_and_the_others_by_five(tlx):
    scale = tlx.rows["physical"]
    scale.step(5)
    assert scale.value == 50
    scale.step(5)
    assert scale.value == 55
    for _ in range(30):
        scale.step(-5)
    assert scale.value == 0


def test_each_answer_is_told_with_its_order_and_its_time(tlx, clock):
    told = []
    tlx.bind(on_command=lambda _, *answer: told.append(answer))
    for when, name, value in ((101.0, "effort", 20), (102.5, "mental", 35), (104.0, "effort", 25)):
        clock.now = when
        tlx.rows[name].answer(value)
    assert told == [("effort", 20), ("mental", 35), ("effort", 25)]
    assert tlx.order == ["effort", "mental"]
    assert tlx.seconds == {"effort": 4.0, "mental": 2.5}


def test_the_time_for_which_it_was_put_away_is_in_no_answers_time(tlx, clock):
    clock.now = 101.0
    tlx.pause()
    clock.now = 150.0
    tlx.pause()
    clock.now = 161.0
    tlx.resume()
    clock.now = 163.0
    tlx.resume()
    tlx.rows["effort"].answer(20)
    assert tlx.seconds == {"effort": 3.0}


def test_scales_without_an_answer_are_marked_and_named(tlx):
    tlx.rows["mental"].answer(0)
    assert tlx.mark_unanswered() == [name for key, (name, *_) in SCALES.items() if key != "mental"]
    assert tlx.rows["effort"].figure == "no answer"
    tlx.rows["effort"].answer(5)
    assert not tlx.rows["effort"].lacking


def test_every_sentence_of_the_usability_scale_takes_one_of_five_steps(clock):
    form = SusForm(clock)
    assert (form.answers, len(ITEMS)) == ({}, 10)
    for number, item in enumerate(form.rows.values()):
        item.steps.choose(str(number % 5 + 1))
    assert form.answers == {str(number + 1): number % 5 + 1 for number in range(10)}


def test_sentences_without_an_answer_are_told_by_their_number(clock):
    form = SusForm(clock)
    for item in list(form.rows.values())[1:]:
        item.answer(3)
    assert form.mark_unanswered() == ["1"]
    assert form.rows["1"].lacking


def drawn(**kwargs):
    history = ScoreHistory(size_hint=(None, None), size=(460, 210), state="live", **kwargs)
    history.draw()
    return history


def test_scores_stand_beside_what_they_are_compared_with():
    history = drawn(scores=[("Voice", 36.0), ("Shake", 44.2)], baseline=34.2, baseline_words="in the paper")
    assert {"34.2 in the paper", "newest 44.2", "36", "44", "Voice", "Shake"} <= set(history.texts)


def test_of_many_scores_the_newest_are_shown_without_words_over_each_other():
    history = drawn(scores=[(f"run {number}", float(number)) for number in range(90)])
    assert "newest 89.0" in history.texts
    assert not any(text.startswith("run") for text in history.texts)


@pytest.mark.parametrize("baseline", [34.2, 68.0, math.nan])
def test_without_scores_that_is_said_beside_what_they_would_be_compared_with(baseline):
    words = {one.text: one.y for one in drawn(scores=[], baseline=baseline).marks(Shapes())}
    said, low, high = words["No questionnaire completed yet."], words["0"], words["100"]
    assert math.isnan(baseline) or abs(said - low - (high - low) * baseline / 100) > sp(14)
