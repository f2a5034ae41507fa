"""The sign of the reaction test: hollow, full when it is time, and in words what came of a press."""

from __future__ import annotations

import pytest

from tests.headless import Stage
from widgets.core.language import PSEUDO, language
from widgets.inputs.reaction_test import PHASES, ReactionTest


@pytest.fixture
def test(stage: Stage) -> ReactionTest:
    made = stage.show(ReactionTest(total=8, result="0.6 s"), (380, 176))
    assert isinstance(made, ReactionTest)
    return made


@pytest.mark.parametrize("phase", list(PHASES))
def test_only_when_it_is_time_the_sign_is_full(stage: Stage, test: ReactionTest, phase: str) -> None:
    test.phase = phase
    stage.frames(2)
    assert test.ids.sign.filled == (phase == "go")
    assert test.word == PHASES[phase][1]


def test_it_says_how_far_it_is_while_it_runs_and_the_result_at_its_end(test: ReactionTest) -> None:
    assert test.progress == ""
    test.phase, test.count = "wait", 3
    assert test.progress == "3 of 8"
    test.phase = "done"
    assert (test.progress, test.sentence) == ("", "0.6 s")


@pytest.mark.parametrize("phase", list(PHASES))
def test_its_sign_is_the_same_in_every_language(test: ReactionTest, phase: str) -> None:
    language.name = PSEUDO
    try:
        test.phase = phase
        assert test.icon == PHASES[phase][0]
    finally:
        language.name = "en"
