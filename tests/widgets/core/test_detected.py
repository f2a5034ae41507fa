from __future__ import annotations

import math

import pytest

from widgets.core.detected import SURE_SCORE, kind_word, things_words


@pytest.mark.parametrize(
    ("kind", "score", "word"),
    [
        ("cone", 0.97, "cone"),
        ("person", SURE_SCORE, "person"),
        ("cone", SURE_SCORE - 0.01, "unknown"),
        ("cone", math.nan, "cone"),
        ("", 0.97, "unknown"),
        ("?", math.nan, "unknown"),
        (" ", math.nan, "unknown"),
        ("unknown", 0.9, "unknown"),
    ],
)
def test_a_thing_is_called_what_the_detector_is_sure_of(kind: str, score: float, word: str) -> None:
    assert kind_word(kind, score) == word


@pytest.mark.parametrize(
    ("kinds", "words"),
    [
        ([], ""),
        (["cone"], "cone"),
        (["person", "unknown", "person"], "2 × person, unknown"),
    ],
)
def test_several_are_counted_by_what_they_are(kinds: list[str], words: str) -> None:
    assert things_words(kinds) == words
