from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import TASKS, TaskOrder
from widgets.tasks.task_chooser import TaskChooser, TaskTile


@pytest.fixture
def chooser(stage):
    chooser = TaskChooser(size_hint=(None, None), width=388)
    stage.show(chooser)
    stage.frames(4)
    chooser.heard = []
    chooser.bind(on_command=lambda _, task: chooser.heard.append(task))
    return chooser


def tiles(chooser):
    return [part for part in reversed(chooser.children) if isinstance(part, TaskTile)]


def test_every_task_has_a_tile_that_gives_its_name(stage, chooser):
    for tile in tiles(chooser):
        stage.tap(*tile.to_window(*tile.center))
        stage.run_for(0.3)
    assert chooser.heard == list(TASKS)


def test_showing_an_order_marks_its_task_and_says_nothing(chooser):
    chooser.show(TaskOrder(task="guide"))
    assert [tile.text for tile in tiles(chooser) if tile.chosen] == ["Guide"]
    assert chooser.heard == []


def test_on_a_wide_screen_they_stand_in_one_row(stage, chooser):
    chooser.width = 860
    stage.frames(4)
    assert len({tile.y for tile in tiles(chooser)}) == 1


def test_disabled_it_chooses_nothing(stage, chooser):
    chooser.state = "disabled"
    stage.tap(*tiles(chooser)[0].to_window(*tiles(chooser)[0].center))
    stage.run_for(0.3)
    assert chooser.heard == []


def test_a_few_tasks_are_shared_out_evenly(stage, chooser):
    chooser.tasks = ["patrol", "go_to", "go_home", "hold", "follow_heading", "surface"]
    stage.frames(4)
    assert chooser.across == 3
    assert [tile.text for tile in tiles(chooser)][-1] == "Surface"
