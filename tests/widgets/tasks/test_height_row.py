"""One control for the height of the selected point or of all: it counts depth down and tells nothing to robots on wheels."""

from __future__ import annotations

import pytest

from app.missions.mission_editor import Draft, MissionEditor
from bridge.msgs.pilothouse_msgs import RobotInfo
from tests.headless import Stage
from widgets.tasks.height_row import HeightRow

DRONE, AQUA, WHEELS = RobotInfo(flies=True), RobotInfo(dives=True), RobotInfo()
THREE = ((0.0, 0.0), (1.0, 0.0), (2.0, 0.0))


@pytest.fixture
def editor() -> MissionEditor:
    return MissionEditor(draft=Draft(THREE))


@pytest.fixture
def row(stage: Stage, editor: MissionEditor) -> HeightRow:
    made = HeightRow(editor.set_height)
    stage.show(made, size=(300, 60))
    return made


def test_it_is_away_for_a_robot_that_keeps_no_height_and_without_points(row: HeightRow) -> None:
    for draft, info in ((Draft(THREE), WHEELS), (Draft(), DRONE)):
        row.show(draft.levels, -1, info)
        assert (row.opacity, row.disabled) == (0, True)
    row.show(Draft(THREE).levels, -1, DRONE)
    assert row.opacity == 1
    assert not row.disabled


def test_without_a_selection_it_sets_all_points_and_else_the_selected_one(
    row: HeightRow, editor: MissionEditor
) -> None:
    row.show(editor.draft.levels, -1, DRONE)
    assert (row.title, row.stepper.figures) == ("Height · all points", "as it is")
    for _ in range(5):
        row.stepper.count(1)
    assert editor.draft.levels == (2.5, 2.5, 2.5)
    row.show(editor.draft.levels, 1, DRONE)
    assert row.title == "Height · Point 2"
    row.stepper.count(1)
    assert editor.draft.levels == (2.5, 3.0, 2.5)
    row.show(editor.draft.levels, -1, DRONE)
    assert row.stepper.figures == "differ"
    row.show(editor.draft.levels, 1, DRONE)
    assert row.stepper.figures.replace("\u00a0", " ") == "3.0 m"
    for _ in range(6):
        row.stepper.count(-1)
    assert editor.draft.levels == (2.5, None, 2.5)


def test_whose_height_it_is_can_be_read_beside_whatever_it_is(editor: MissionEditor, stage: Stage) -> None:
    row = HeightRow(editor.set_height)
    stage.show(row, size=(230, 60))
    row.show((1.0, 2.0), -1, DRONE)
    stage.frames(4)
    label = row.children[-1]
    assert label.text == "Height · all points"
    assert not label.is_shortened
    assert label.height <= row.height


def test_one_that_dives_is_asked_for_a_depth(row: HeightRow, editor: MissionEditor) -> None:
    row.show(editor.draft.levels, 0, AQUA)
    assert row.title == "Depth · Point 1"
    row.stepper.count(1)
    assert editor.draft.levels == (-0.5, None, None)
