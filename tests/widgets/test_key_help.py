"""The help of keys: every cap and its words are there, in as many columns as there is room for."""

from __future__ import annotations

from typing import Any

from tests.headless import Stage
from widgets.key_help import KeyCap, KeyHelp

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
    assert said.text == "No keys mean anything."
