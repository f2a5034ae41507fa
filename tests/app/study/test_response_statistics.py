"""Statistics of the response log, each against figures that were reckoned by hand or are published."""

from __future__ import annotations

import math

import pytest

from app.study.response_log import Response
from app.study.response_statistics import (
    counts,
    false_activations,
    presses,
    rates,
    seconds,
    spread,
    times,
    used_well,
    wilson,
    wrong,
)


@pytest.mark.parametrize(
    ("hits", "trials", "low", "high"),
    [  # Newcombe 1998, Statistics in Medicine 17, table I, method 3
        (81, 263, 0.2553, 0.3662),
        (15, 148, 0.0624, 0.1605),
        (0, 20, 0.0, 0.1611),
        (1, 29, 0.0061, 0.1718),
        (29, 29, 0.8830, 1.0),
    ],
)
def test_the_interval_is_wilsons(hits, trials, low, high):
    assert wilson(hits, trials) == pytest.approx((low, high), abs=5e-5)


def test_nothing_is_known_of_a_share_without_trials():
    assert wilson(0, 0) == (0.0, 1.0)


def test_more_hits_than_trials_are_refused_with_both_figures():
    with pytest.raises(ValueError, match="5 of 3 is no share"):
        wilson(5, 3)


def prompted(number, method, intended, recognised, **more):
    return Response(
        session="s", method=method, prompt_id=str(number), intended=intended, recognised=recognised, user="7",
        posture="standing", **more,
    )  # fmt: skip


STUDY = [
    prompted(1, "voice", "stop", "stop"),
    prompted(2, "voice", "pause", "pause"),
    prompted(3, "voice", "pause", ""),
    prompted(4, "voice", "resume", "stop"),
    prompted(5, "shake", "stop", "stop"),
]


def test_success_is_the_share_of_prompts_that_were_understood():
    found = rates(STUDY)
    assert (found["voice", ""].hits, found["voice", ""].trials) == (2, 4)
    assert found["shake", ""].share == 1.0


def test_success_is_told_by_command_too():
    found = rates(STUDY, by_command=True)
    assert found["voice", "pause"].share == 0.5
    assert found["voice", "resume"].share == 0.0


def test_the_first_answer_to_a_prompt_counts_since_it_would_have_been_acted_upon():
    again = [prompted(1, "voice", "stop", "pause"), prompted(1, "voice", "stop", "stop")]
    assert (rates(again)["voice", ""].hits, rates(again)["voice", ""].trials) == (0, 1)


def test_another_command_than_the_prompted_one_is_wrong_and_silence_is_not():
    assert wrong(STUDY)["voice"].share == 0.25


def test_outside_of_the_study_what_is_taken_back_refused_or_not_allowed_was_no_success():
    used = [
        Response(method="voice", recognised="pause", outcome="accepted"),
        Response(method="voice", recognised="pause", outcome="refused"),
        Response(method="voice", recognised="pause", undo=True),
        Response(method="voice", recognised="start", rejected="Voice may not start a task."),
    ]
    assert (used_well(used)["voice", ""].hits, used_well(used)["voice", ""].trials) == (1, 4)
    assert used_well([*STUDY]) == {}


def test_a_response_is_timed_from_the_begin_of_the_input_to_what_became_of_it():
    one = Response(t_input_start=10.0, t_decided=10.4, t_sent=10.5, t_ack=10.6, t_effect=11.0)
    assert [seconds(one, until) for until in ("sent", "ack", "effect")] == pytest.approx([0.5, 0.6, 1.0])


def test_where_nothing_is_sent_a_response_ends_with_the_decision():
    assert seconds(Response(t_input_start=10.0, t_decided=10.4)) == pytest.approx(0.4)


def test_without_a_begin_or_an_end_or_from_another_clock_there_is_no_time():
    assert math.isnan(seconds(Response(t_decided=10.4)))
    assert math.isnan(seconds(Response(t_input_start=10.0), "ack"))
    assert math.isnan(seconds(Response(t_input_start=10.0, t_decided=9.0)))
    assert math.isnan(seconds(Response(t_input_start=10.0, t_decided=500.0)))


def test_times_are_told_by_command_and_method_and_leave_mistakes_out():
    one = {"t_input_start": 0.0}
    found = times(
        [
            *(Response(method="voice", recognised="stop", t_sent=took, **one) for took in (0.4, 0.5, 0.6)),
            prompted(1, "voice", "pause", "stop", t_sent=9.0, **one),
            Response(method="shake", recognised="stop", t_sent=1.3, **one),
            Response(method="voice", recognised="start", t_decided=1.0, rejected="not allowed", **one),
        ]
    )
    assert set(found) == {("stop", "voice"), ("stop", "shake")}
    assert (found["stop", "voice"].median, found["stop", "voice"].count) == (0.5, 3)


def test_a_spread_has_its_quartiles_between_the_values():
    assert spread([]) is None
    one = spread([2.0])
    assert one is not None
    assert (one.low, one.median, one.high, one.deviation) == (2.0, 2.0, 2.0, 0.0)
    four = spread([4.0, 1.0, 2.0, 3.0])
    assert four is not None
    assert (four.low, four.median, four.high, four.mean) == (1.75, 2.5, 3.25, 2.5)


def test_false_activations_are_counted_by_the_hour_that_the_method_was_listening():
    found = false_activations(
        [
            Response(kind="armed", method="shake", seconds=5400.0),
            Response(kind="armed", method="shake", seconds=1800.0),
            Response(method="shake", recognised="stop", user="7", posture="walking"),
            prompted(1, "shake", "stop", "stop"),
            Response(method="shake", recognised="pause", undo=True),
            Response(method="shake", recognised="pause"),
        ]
    )
    assert (found["shake"].count, found["shake"].hours, found["shake"].hourly) == (2, 2.0, 1.0)


def test_no_rate_is_told_of_a_method_that_hardly_listened():
    found = false_activations([Response(kind="armed", method="voice", seconds=20.0)])
    assert math.isnan(found["voice"].hourly)


def test_presses_are_those_of_each_selection():
    assert math.isnan(presses([Response(method="button")]))
    assert presses([Response(presses=2), Response(kind="selection", presses=5)]) == 3.5


def test_commands_are_counted_whatever_gave_them_but_not_what_was_taken_back():
    found = counts(
        [*STUDY, Response(recognised="stop", undo=True), Response(kind="drive", recognised="drive")]
    )
    assert found == {"stop": 3, "pause": 1}
