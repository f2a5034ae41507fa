"""The help of keys: every cap and its words are there, in as many columns as there is room for."""

from __future__ import annotations

from typing import Any

from tests.headless import Stage
from widgets.inputs.key_help import KeyCap, KeyHelp, flow
from widgets.parts.labels import SectionLabel

GROUPS: list[Any] = [
    ("STOP", [(["Esc", "Space"], "STOP")]),
    ("Robot", [(["P"], "Pause"), (["B"], "Go home")]),
    ("App", [(["F1"], "Help")]),
]


def shown(stage: Stage, width: int) -> KeyHelp:
    help_ = KeyHelp(groups=GROUPS, size_hint=(None, None), size=(width, 300))
    stage.show(help_, (width, 300))
    return help_


def test_caps_stand_beside_their_words_and_stop_looks_grave(stage: Stage) -> None:
    caps = {cap.text: cap.grave for cap in shown(stage, 340).walk() if isinstance(cap, KeyCap)}
    assert caps == {"Esc": True, "Space": True, "P": False, "B": False, "F1": False}


def test_it_has_as_many_columns_as_there_is_room_for_and_no_more_than_groups(stage: Stage) -> None:
    assert [len(shown(stage, width).ids.columns.children) for width in (340, 600, 2000)] == [1, 2, 3]


def test_made_wider_it_is_laid_out_anew(stage: Stage) -> None:
    help_ = shown(stage, 340)
    help_.width = 600
    stage.frames(2)
    assert len(help_.ids.columns.children) == 2


def test_with_nothing_to_tell_it_says_so(stage: Stage) -> None:
    help_ = shown(stage, 340)
    help_.groups = []
    (said,) = help_.ids.columns.children
    assert said.text == "No keys are assigned."


def test_a_long_group_goes_on_in_the_next_column_so_that_none_is_empty() -> None:
    rows = [([str(number)], "acts") for number in range(12)]
    columns = flow([("STOP", rows[:1]), ("Driving", rows[:3]), ("Robot", rows)], 3)
    lines = [sum(len(told) + 1 for _, told in column) for column in columns]
    assert len(columns) == 3
    assert max(lines) - min(lines) <= 2
    assert [row for column in columns for title, told in column if title == "Robot" for row in told] == rows


def test_it_says_how_high_it_would_be_without_scrolling(stage: Stage) -> None:
    help_ = shown(stage, 340)
    assert help_.whole == help_.ids.columns.height > 200


def test_a_group_that_goes_on_in_the_next_column_says_so(stage: Stage) -> None:
    help_ = shown(stage, 600)
    help_.groups = [("Robot", [([str(number)], "acts") for number in range(12)])]
    stage.frames(2)
    titles = [one.title for one in help_.walk() if isinstance(one, SectionLabel)]
    assert sorted(titles) == ["Robot", "Robot, continued"]
