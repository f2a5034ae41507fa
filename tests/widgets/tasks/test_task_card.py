from __future__ import annotations

import math

import pytest

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import TaskProgress, TaskStatus
from widgets.tasks.task_card import TaskCard, figures_words

RUNS = TaskStatus(
    task_id=4, task="patrol", state="RUNNING", reason="Driving.", waypoint=3, waypoints=6, lap=1, laps=2
)
TOLD = TaskProgress(task_id=4, progress=0.38, distance_to_next=7.4, time_left=190.0)


@pytest.fixture
def card(stage):
    return stage.show(TaskCard(size_hint=(None, None), width=388))


def test_phase_reason_and_figures_are_said(card):
    card.show(TaskStatus(task_id=4, task="deliver", state="RUNNING", phase="waiting", reason="Waiting at Lab.",
                         places=["Lab", "Office 9"], waypoint=1, waypoints=2))  # fmt: skip
    card.show(TOLD)
    assert (card.title, card.phase_words, card.reason) == (
        "Deliver: Lab → Office 9",
        "waiting",
        "Waiting at Lab.",
    )
    assert card.figures == "Place 1 of 2 · 38 % · 7 m to go · 3 min left"
    assert card.progress == pytest.approx(0.38)


def test_a_patrol_counts_points_and_laps():
    assert figures_words(RUNS, TOLD) == "Point 3 of 6 · lap 1 of 2 · 38 % · 7 m to go · 3 min left"


def test_of_a_patrol_without_an_end_progress_and_time_are_said_to_be_those_of_this_lap():
    endless = TaskStatus(task_id=4, task="patrol", state="RUNNING", waypoint=3, waypoints=6, lap=2)
    assert figures_words(endless, TOLD) == (
        "Point 3 of 6 · lap 2 · 38 % of this lap · 7 m to go · 3 min to its end"
    )
    to_one = TaskStatus(task_id=4, task="patrol", state="RUNNING", waypoint=1, waypoints=1, lap=1)
    assert "lap ·" not in figures_words(to_one, TOLD), "a single point is visited once"


def test_what_is_not_known_is_left_out():
    unknown = TaskProgress(task_id=4, progress=math.nan, distance_to_next=math.nan, time_left=math.nan)
    assert figures_words(TaskStatus(task="hold", state="RUNNING"), unknown) == ""


def test_the_progress_of_another_task_does_not_count(card):
    card.show(RUNS)
    card.show(TaskProgress(task_id=3, progress=0.9))
    assert math.isnan(card.progress)
    card.show(TOLD)
    card.show(TaskStatus(task_id=5, task="hold", state="RUNNING"))
    assert math.isnan(card.progress)


@pytest.mark.parametrize(
    ("state", "words", "role"),
    [("SUCCEEDED", "done", "ok"), ("FAILED", "failed", "danger"), ("INTERRUPTED", "cut short", "warn")],
)
def test_the_state_is_a_word_with_an_icon_of_its_own(card, state, words, role):
    card.show(TaskStatus(task="patrol", state=state))
    assert (card.phase_words, card.state_role) == (words, role)


def test_a_task_that_ended_unsure_of_its_place_is_neither_done_nor_failed(card):
    card.show(TaskStatus(task="go_to", state="FAILED", code=Code.TASK_PLACE_UNSURE.value))
    assert (card.phase_words, card.state_icon, card.state_role) == ("there, unsure", "help", "warn")


def test_no_task_is_said(card):
    card.show(TaskStatus())
    assert (card.title, card.reason) == ("No task", "")


def test_what_was_cut_short_has_no_figures_of_before(card):
    card.show(RUNS)
    card.show(TaskProgress(task_id=RUNS.task_id, progress=1.0, time_left=0.0))
    card.show(TaskStatus(task_id=RUNS.task_id, task="patrol", state="INTERRUPTED"))
    card.show(TaskProgress(task_id=RUNS.task_id, progress=1.0, time_left=0.0))
    assert math.isnan(card.progress)
    assert "left" not in card.figures
    assert "%" not in card.figures


def test_where_there_is_little_room_the_title_is_from_where_to_where():
    card = TaskCard(brief=True, state="live")
    card.show(TaskStatus(task="deliver", state="RUNNING", places=["Office 12", "Charging bay"]))
    assert card.title == "Office 12 → Charging bay"
    card.brief = False
    assert card.title == "Deliver: Office 12 → Charging bay"
