"""Holding, ticked by hand."""

from __future__ import annotations

import math

import pytest
from py_trees.common import Status

from robotside.tasks.behaviours.course import Span
from robotside.tasks.behaviours.hold import Hold
from tests.robotside.tasks.behaviours.stage import Stage


def make(duration: float) -> tuple[Stage, Span, Hold]:
    stage = Stage()
    span = Span(duration, lambda: stage.situation.worked)
    return stage, span, Hold(span, stage.navigator, stage.situation)


def test_it_holds_as_long_as_told_and_tells_how_far_it_is() -> None:
    stage, span, hold = make(10.0)
    assert stage.tick(hold, 4.0) is Status.RUNNING
    assert stage.situation.doing.phase == "holding"
    assert stage.situation.doing.text == "Holding here for 10 s."
    assert span.progress(math.nan) == pytest.approx(0.4, abs=0.01)
    assert span.time_left(math.nan, 0.5) == pytest.approx(6.0, abs=0.1)
    assert stage.tick(hold, 6.2) is Status.SUCCESS
    assert stage.robot.at_rest


def test_without_a_time_it_holds_until_it_is_stopped() -> None:
    stage, span, hold = make(math.nan)
    assert stage.tick(hold, 300.0) is Status.RUNNING
    assert stage.situation.doing.text == "Holding here until it is stopped."
    assert math.isnan(span.progress(0.0))
    assert math.isnan(span.time_left(0.0, 0.5))


def test_a_pause_does_not_count() -> None:
    stage, _, hold = make(10.0)
    stage.tick(hold, 4.0)
    stage.pause(60.0)
    assert stage.tick(hold, 5.5) is Status.RUNNING
    assert stage.tick(hold, 1.0) is Status.SUCCESS


def test_taken_up_again_only_what_was_left_is_held() -> None:
    stage, span, hold = make(10.0)
    stage.tick(hold, 8.0)
    stage, again, hold = make(10.0)
    again.take_up(span.noted())
    assert stage.tick(hold, 2.2) is Status.SUCCESS
