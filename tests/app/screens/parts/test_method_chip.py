"""The chip of the ways in: what does not work has another shape and not only another colour, and a brief one says how many there are."""

from __future__ import annotations

import pytest

from app.screens.parts.method_chip import InputsChip, MethodSign
from tests.headless import Stage
from widgets.parts.kit import Text

SIX = [
    ("voice", True),
    ("shake", False),
    ("tilt", False),
    ("switches", True),
    ("gamepad", True),
    ("keyboard", True),
]


def chip(stage: Stage, *, brief: bool) -> InputsChip:
    made = stage.show(InputsChip(brief=brief))
    made.show(SIX, idle=["gamepad"])
    stage.frames(2)
    return made


def signs(made: InputsChip) -> list[MethodSign]:
    return [one for one in reversed(made.children) if isinstance(one, MethodSign)]


def numbers(made: InputsChip) -> list[str]:
    return [one.text for one in made.children if isinstance(one, Text)]


def test_where_there_is_room_every_armed_method_is_seen(stage: Stage) -> None:
    made = chip(stage, brief=False)
    assert len(signs(made)) == 6
    assert numbers(made) == []
    assert all(one.right <= made.right for one in made.children)


def test_what_does_not_work_is_struck_through_and_stands_first(stage: Stage) -> None:
    assert [one.struck for one in signs(chip(stage, brief=False))] == [True, True, *[False] * 4]


def test_what_has_nothing_to_work_with_is_muted_and_never_looks_live(stage: Stage) -> None:
    made = signs(chip(stage, brief=False))
    assert [one.role for one in made].count("muted") == 1
    assert [one.role for one in made if one.idle] == ["muted"]


def test_a_brief_one_says_in_words_how_many_there_are(stage: Stage) -> None:
    made = chip(stage, brief=True)
    assert len(signs(made)) == 1
    assert signs(made)[0].struck
    assert numbers(made) == ["6 inputs"]


def test_one_without_room_for_words_shows_what_does_not_work_and_no_bare_number(stage: Stage) -> None:
    made = chip(stage, brief=True)
    made.wordless = True
    assert numbers(made) == []
    assert [one.struck for one in signs(made)] == [True]


@pytest.mark.parametrize("methods", [[], [("voice", True)]])
def test_with_none_or_one_there_is_nothing_to_count(stage: Stage, methods: list[tuple[str, bool]]) -> None:
    made = stage.show(InputsChip(brief=True))
    made.show(methods)
    assert numbers(made) == []
    assert len(signs(made)) == 1
    assert not signs(made)[0].struck
