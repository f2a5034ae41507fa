from __future__ import annotations

import pytest
from msgspec.structs import replace

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import GetHistoryResponse, TaskOrder, TaskRun
from bridge.msgs.std_msgs import Time
from widgets.parts.buttons import QuietButton
from widgets.parts.rows import ListRow
from widgets.tasks.run_list import MAX_RUNS, NOON, SOME, RunList, run_words


@pytest.fixture
def history(stage):
    history = RunList(size_hint=(None, None), size=(388, 500), now=NOON)
    history.show(GetHistoryResponse(runs=SOME))
    stage.show(history)
    stage.frames(4)
    return history


def rows(history):
    found = [part for part in history.walk(restrict=True) if isinstance(part, ListRow)]
    return sorted(found, key=lambda row: -row.to_window(*row.pos)[1])


def test_outcome_distance_time_and_who_are_said(history):
    assert [row.detail for row in rows(history)] == [
        "runs · 84 m · 5 min · vm",
        "done · 342 m · 12 min · tablet-B",
        "failed · 1.2 km · 17 min · by itself",
    ]
    assert [row.role for row in rows(history)] == ["accent", "ok", "danger"]


def test_a_run_that_ended_unsure_of_its_place_has_a_word_of_its_own(history):
    history.show(
        GetHistoryResponse(runs=[replace(SOME[1], code=Code.TASK_PLACE_UNSURE.value, state="FAILED")])
    )
    row = rows(history)[1]
    assert (row.detail, row.role) == ("there, unsure · 342 m · 12 min · tablet-B", "warn")


def test_a_tap_tells_the_reason_whole(stage, history):
    row = rows(history)[2]
    stage.tap(*row.to_window(*row.center))
    stage.run_for(0.3)
    assert row.detail.endswith("\nNo way to Office 9: the door is closed.")
    stage.tap(*row.to_window(*row.center))
    stage.run_for(0.3)
    assert "\n" not in row.detail


def test_what_is_known_is_brought_up_to_date_and_older_ones_follow(history):
    ended = TaskRun(9, TaskOrder(task="patrol"), Time.at(1.0), Time.at(61.0), "SUCCEEDED", "Done.", 90.0)
    older = TaskRun(3, TaskOrder(task="hold"), Time.at(1.0), Time.at(61.0), "CANCELED")
    history.show(GetHistoryResponse(runs=[older]))
    history.show(GetHistoryResponse(runs=[ended]))
    assert [(run.id, run.state) for run in history.runs] == [
        (9, "SUCCEEDED"), (8, "SUCCEEDED"), (7, "FAILED"), (3, "CANCELED"),
    ]  # fmt: skip


def test_older_ones_are_asked_for_by_number(stage, history):
    asked = []
    history.bind(on_command=lambda _, before: asked.append(before))
    history.more = True
    stage.frames(4)
    (older,) = (part for part in history.walk(restrict=True) if isinstance(part, QuietButton))
    stage.tap(*older.to_window(*older.center))
    stage.run_for(0.3)
    assert asked == [7]


def test_it_does_not_grow_for_ever(history):
    history.show(
        GetHistoryResponse(runs=[TaskRun(n, TaskOrder(task="hold")) for n in range(1, MAX_RUNS + 50)])
    )
    assert len(history.runs) == MAX_RUNS
    assert history.runs[0].id == MAX_RUNS + 49


def test_a_run_that_never_began_has_no_length():
    assert run_words(TaskRun(1, TaskOrder(task="hold"), state="FAILED"), 5.0) == "failed · 0 m · by itself"
