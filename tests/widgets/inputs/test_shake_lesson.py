"""The moving picture of the lesson: its words, its phone, its end."""

from __future__ import annotations

import pytest

from tests.headless import Stage
from widgets.inputs.shake_lesson import ShakeLesson


@pytest.mark.parametrize(
    ("axis", "doing", "words"),
    [
        ("lr", True, "Shake left and right …"),
        ("ud", True, "Shake up and down …"),
        ("fb", False, "Hold still. Next: forward and back"),
        ("", False, "Done"),
    ],
)
def test_it_says_what_to_do(stage: Stage, axis: str, doing: bool, words: str) -> None:
    lesson = stage.show(ShakeLesson(), (360, 260))
    lesson.update(axis, doing=doing, progress=0.4)
    stage.frames(2)
    assert words in lesson.texts


def test_the_phone_moves_only_while_the_hand_is_to_move(stage: Stage) -> None:
    lesson = stage.show(ShakeLesson(), (360, 260))
    beats = [index / 30 for index in range(15)]
    places = {True: set[float](), False: set[float]()}
    for doing, seen in places.items():
        for beat in beats:
            lesson.update("lr", doing=doing, progress=0.1, beat=beat)
            seen.add(round(lesson.offset, 3))
    assert min(places[True]) < -0.9
    assert max(places[True]) > 0.9
    assert places[False] == {0.0}


def test_words_that_do_not_fit_give_way_to_shorter_ones(stage: Stage) -> None:
    lesson = stage.show(ShakeLesson(), (190, 200))
    lesson.update("lr", doing=False, progress=0.0)
    stage.frames(2)
    assert "Next: left and right" in lesson.texts


def test_progress_stays_within_its_bar(stage: Stage) -> None:
    lesson = stage.show(ShakeLesson(), (360, 260))
    for told, shown in ((-1.0, 0.0), (7.0, 1.0)):
        lesson.update("lr", doing=True, progress=told)
        assert lesson.progress == shown
