"""The history of tasks."""

from __future__ import annotations

import math

import msgspec
import pytest

from bridge.msgs.pilothouse_msgs import TaskOrder, TaskRun
from bridge.msgs.std_msgs import Time
from robotside.records import Records

PATROL = TaskRun(order=TaskOrder(task="patrol"), started=Time(100), state="RUNNING", by="Anna")


@pytest.fixture
def records() -> Records:
    return Records.in_memory()


def test_a_task_is_under_way_until_it_has_ended(records: Records) -> None:
    run = records.runs.begin(PATROL, "lap 2")
    assert records.runs.under_way == (run, "lap 2")
    records.runs.note(msgspec.structs.replace(run, visited=3), "lap 3")
    assert records.runs.under_way is not None
    assert (records.runs.under_way.run.visited, records.runs.under_way.course) == (3, "lap 3")
    records.runs.note(msgspec.structs.replace(run, state="SUCCEEDED", ended=Time(200)))
    assert records.runs.under_way is None
    assert records.runs.before()[0].state == "SUCCEEDED"


def test_the_end_of_an_older_task_does_not_end_the_newer_one(records: Records) -> None:
    old, new = records.runs.begin(PATROL), records.runs.begin(PATROL)
    records.runs.note(msgspec.structs.replace(old, ended=Time(200)))
    assert records.runs.under_way is not None
    assert records.runs.under_way.run == new


def test_runs_come_newest_first_and_page_by_page(records: Records) -> None:
    for _ in range(5):
        records.runs.begin(PATROL)
    first = [run.id for run in records.runs.before(limit=2)]
    assert first == [5, 4]
    assert [run.id for run in records.runs.before(4, limit=2)] == [3, 2]
    assert records.runs.last == 5


def test_the_newest_runs_are_kept(records: Records, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("robotside.records.runs.MAX_RUNS", 3)
    for _ in range(5):
        records.runs.begin(PATROL)
    assert [run.id for run in records.runs.before()] == [5, 4, 3]


def test_a_distance_that_is_not_known_counts_as_none(records: Records) -> None:
    assert records.runs.begin(PATROL).distance == 0.0
    records.runs.note(msgspec.structs.replace(PATROL, id=1, distance=math.nan))
    assert records.runs.before()[0].distance == 0.0
