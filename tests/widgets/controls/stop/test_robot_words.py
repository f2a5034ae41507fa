"""Words of how many robots there are: those that cannot be heard are told, be there room or not."""

from __future__ import annotations

import pytest

from widgets.controls.stop.robot_words import brief_robot_words, robot_words


@pytest.mark.parametrize(
    ("counted", "words", "brief"),
    [
        ((1, 0, 0), "1 robot", "1 robot"),
        ((2, 1, 0), "2 robots, 1 lost", "2 · 1 lost"),
        ((2, 0, 2), "2 robots, 2 silent", "2 · 2 silent"),
        ((4, 1, 2), "4 robots, 1 lost, 2 silent", "4 · 3 silent"),
    ],
)
def test_the_words_tell_those_that_cannot_be_heard(
    counted: tuple[int, int, int], words: str, brief: str
) -> None:
    assert (robot_words(*counted), brief_robot_words(*counted)) == (words, brief)
