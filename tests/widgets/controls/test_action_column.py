"""The column of actions: a finger presses any that can be asked for."""

from __future__ import annotations

from typing import Any

import pytest
from kivy.metrics import dp

from tests.headless import Stage
from widgets.controls.action_column import Action, ActionColumn, ActionKey
from widgets.core.theme import theme

SOME = [
    Action("surface", "Surface", "water"),
    Action("hold", "Hold depth", "pause_circle", able=False),
    Action("lights", "Lights", "lightbulb", said="on"),
]


@pytest.fixture
def column(stage: Stage) -> Any:
    column = stage.show(ActionColumn(actions=SOME), (292, 400))
    stage.frames(4)
    column.heard = []
    column.bind(on_action=lambda _, name: column.heard.append(name))
    return column


def keys(column: Any) -> list[ActionKey]:
    return list(reversed(column.grid.children))


def test_a_finger_asks_for_the_one_it_is_on(stage: Stage, column: Any) -> None:
    stage.tap(*keys(column)[2].to_window(*keys(column)[2].center))
    assert column.heard == ["lights"]


def test_what_cannot_be_asked_for_takes_no_finger(stage: Stage, column: Any) -> None:
    stage.tap(*keys(column)[1].to_window(*keys(column)[1].center))
    column.actions = [Action("surface", "Surface", able=False), *SOME[1:]]
    stage.tap(*keys(column)[0].to_window(*keys(column)[0].center))
    column.state = "disabled"
    stage.tap(*keys(column)[2].to_window(*keys(column)[2].center))
    assert column.heard == []


def test_what_meant_something_else_a_moment_ago_takes_no_finger(stage: Stage, column: Any) -> None:
    column.actions = [Action("surface", "End surfacing"), *SOME[1:]]
    stage.tap(*keys(column)[0].to_window(*keys(column)[0].center))
    assert column.heard == []


@pytest.mark.parametrize("size", [(292, 400), (150, 220), (300, 150)])
def test_no_button_is_smaller_than_a_finger_needs(stage: Stage, column: Any, size: tuple[int, int]) -> None:
    column.size = size
    column.across = 2 if size[0] > size[1] else 1
    stage.frames(4)
    assert all(min(key.size) >= theme.target for key in keys(column))


def test_a_narrow_one_says_how_it_stands_behind_its_words(stage: Stage, column: Any) -> None:
    column.width = dp(150)
    stage.frames(4)
    assert keys(column)[2].text == "Lights · on"


def test_its_foot_stays_free_for_stop(stage: Stage, column: Any) -> None:
    column.foot = 100
    stage.frames(4)
    assert column.roll.y >= column.y + 100
