"""What scrolls is seen within its list and nowhere else."""

from __future__ import annotations

import numpy as np
import pytest
from kivy.uix.floatlayout import FloatLayout

from widgets.parts.column import Column
from widgets.parts.rows import ListRow, Roll
from widgets.study.score_history import ScoreHistory


@pytest.mark.parametrize("at", [0, 0.5, 1])
@pytest.mark.parametrize(
    "kind",
    [
        lambda: ScoreHistory(state="live", size_hint_y=None, height=90),
        lambda: ListRow(title="Patrol", chosen=True),
        lambda: ListRow(title="Patrol", state="down"),
    ],
    ids=["chart", "chosen row", "pressed row"],
)
def test_no_edge_of_what_scrolls_is_drawn_beyond_the_list(stage, kind, at):
    roll, column = Roll(size_hint=(None, None), size=(240, 100), pos=(20, 100)), Column(spacing=10)
    for _ in range(5):
        column.add_widget(kind())
    roll.add_widget(column)
    whole = FloatLayout()
    whole.add_widget(roll)
    stage.show(whole, size=(300, 300))
    roll.pos = 20, 100
    roll.scroll_y = at
    stage.frames(3)
    seen = stage.pixels(whole)[..., :3].max(-1) > 8
    assert seen[105:195].any()
    assert not np.concatenate([seen[:99], seen[201:]]).any()


def test_the_bar_of_a_chosen_row_has_the_rows_own_corners(stage):
    row, whole = ListRow(title="Patrol", chosen=True, size_hint_x=None, width=200), FloatLayout()
    whole.add_widget(row)
    stage.show(whole, size=(300, 300))
    row.height = 60
    row.pos = 50, 120
    stage.frames(3)
    seen = stage.pixels(whole)[120:180, 50:250, :3].max(-1) > 8
    corner = round(row.corner)
    assert (seen[:corner, :corner] == seen[:corner, -corner:][:, ::-1]).all()
    assert not seen[0, :3].any()
    assert seen[corner:-corner, :9].all()
