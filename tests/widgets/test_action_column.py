"""The column of actions: a finger presses any, two switches go through those that can be asked for."""

from __future__ import annotations

from typing import Any

import pytest
from kivy.metrics import dp

from tests.headless import Stage
from widgets.action_column import Action, ActionColumn, ActionKey
from widgets.theme import theme

SOME = [
    Action("surface", "Surface", "water"),
    Action("hold", "Hold depth", "pause_circle", able=False),
    Action("lights", "Lights", "lightbulb", said="on"),
]


@pytest.fixture
def column(stage: Stage) -> Any:
    column = stage.show(ActionColumn(actions=SOME, switches=["A", "B"]), (292, 400))
    stage.frames(4)
    column.heard = []
    column.bind(on_action=lambda _, name: column.heard.append(name))
    return column


def keys(column: Any) -> list[ActionKey]:
    return list(reversed(column.grid.children))


def test_a_finger_asks_for_the_one_it_is_on(stage: Stage, column: Any) -> None:
    stage.tap(*keys(column)[2].to_window(*keys(column)[2].center))
    assert column.heard == ["lights"]


def test_the_first_switch_goes_round_those_that_can_be_asked_for(column: Any) -> None:
    gone = [column.current]
    for _ in range(3):
        column.next()
        gone.append(column.current)
    assert gone == ["surface", "lights", "surface", "lights"]


def test_the_second_switch_does_the_current_one_and_it_says_so(column: Any) -> None:
    column.next()
    assert [key.end for key in keys(column)] == ["", "", "press B"]
    column.act()
    assert column.heard == ["lights"]


def test_what_can_no_longer_be_asked_for_is_not_done(column: Any) -> None:
    column.actions = [Action("surface", "Surface", able=False), *SOME[1:]]
    assert column.current == "surface"
    column.act()
    assert column.heard == []


def test_a_switch_that_meant_something_else_a_moment_ago_does_nothing(stage: Stage, column: Any) -> None:
    column.actions = [Action("surface", "End surfacing"), *SOME[1:]]
    column.act()
    assert column.heard == []
    stage.run_for(0.6)
    column.act()
    assert column.heard == ["surface"]


def test_without_switches_none_stands_out(column: Any) -> None:
    column.switches = []
    assert column.current == ""
    assert not any(key.current for key in keys(column))
    column.act()
    assert column.heard == []


def test_when_nothing_can_be_asked_for_the_switches_do_nothing(column: Any) -> None:
    column.state = "disabled"
    column.next()
    column.act()
    assert (column.current, column.heard) == ("", [])


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


def test_the_current_one_is_scrolled_to(stage: Stage, column: Any) -> None:
    column.actions = [Action(f"a{number}", f"Action {number}") for number in range(12)]
    stage.frames(4)
    for _ in range(11):
        column.next()
    stage.frames(4)
    key = keys(column)[11]
    low, top = key.to_window(0, key.y)[1], key.to_window(0, key.top)[1]
    assert column.roll.y - 1 <= low
    assert top <= column.roll.top + 1
