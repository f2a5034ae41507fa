"""Words that keep to their room: smaller, then in two lines, then cut short."""

from __future__ import annotations

from typing import Any

import pytest
from kivy.metrics import dp, sp

from widgets.core.base import MIN_FONT_SIZE, text_texture
from widgets.parts.labels import FittedLabel, SectionLabel


def wide(text: str, size: float) -> float:
    return float(text_texture(text, size).width)


@pytest.fixture
def label(stage: Any) -> Any:
    """In the least type its first word is 3 px narrower than its room of 60 px, and its second one too wide."""
    return stage.show(FittedLabel(largest=sp(16), size_hint=(None, None)))


def written(label: FittedLabel) -> list[str]:
    label.texture_update()
    return ["".join(word.text for word in line.words) for line in label._label._cached_lines]


def test_words_with_room_are_as_large_as_they_may_be(label: FittedLabel) -> None:
    label.text, label.room = "Start", 200
    assert (label.font_size, written(label)) == (sp(16), ["Start"])


def test_words_without_room_are_smaller(label: FittedLabel) -> None:
    label.text, label.room = "Start", wide("Start", sp(13))
    assert sp(MIN_FONT_SIZE) < label.font_size <= sp(13)
    assert label.texture_size[0] <= label.room


def test_words_that_would_be_too_small_are_in_two_lines(label: FittedLabel) -> None:
    label.text, label.room = "Go home", wide("home", sp(MIN_FONT_SIZE)) + 3
    assert (label.font_size, written(label)) == (sp(MIN_FONT_SIZE), ["Go", "home"])


@pytest.mark.parametrize(("lines", "text"), [(1, "Go home"), (2, "Homewards"), (2, "Go home now or later")])
def test_words_that_fit_in_no_way_end_in_dots_within_their_room(
    label: FittedLabel, lines: int, text: str
) -> None:
    label.lines, label.text, label.room = lines, text, wide("home", sp(MIN_FONT_SIZE)) + 3
    (line,) = written(label)
    assert line.endswith("...")
    assert label.texture_size[0] <= label.room + 1


def test_enlarged_words_go_down_to_their_usual_least_size_before_they_are_cut(
    label: FittedLabel, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = wide("Homewards", sp(MIN_FONT_SIZE))
    for module in ("widgets.core.base", "widgets.parts.labels"):
        monkeypatch.setattr(f"{module}.sp", lambda size: 2 * dp(size))
    label.lines, label.largest, label.text, label.room = 1, dp(32), "Homewards", whole + 1
    assert (label.font_size, written(label)) == (dp(MIN_FONT_SIZE), ["Homewards"])
    label.room = whole - 1
    assert written(label)[0].endswith("...")


def test_words_that_get_room_again_are_whole_again(label: FittedLabel) -> None:
    label.text, label.room = "Homewards", 20
    label.room = 300
    assert (label.font_size, written(label)) == (sp(16), ["Homewards"])


def test_a_heading_becomes_smaller_then_its_letters_come_closer_and_only_then_it_is_cut(stage: Any) -> None:
    heading = stage.show(SectionLabel(title="Höchsttempo", size_hint_x=None))
    looks = []
    for width in (300, 108, 84, 40):
        heading.width = width
        stage.frames(1)
        looks.append((heading.font_size == sp(13), heading.close, "".join(written(heading)).endswith("...")))
    assert looks == [(True, False, False), (False, False, False), (False, True, False), (False, True, True)]
