from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import Schedule
from widgets.parts.choices import Toggle
from widgets.parts.rows import ListRow
from widgets.tasks.schedule_list import SOME, ScheduleList


@pytest.fixture
def schedule(stage):
    schedule = ScheduleList(size_hint=(None, None), size=(388, 300), now=0.0)
    schedule.show(Schedule(tasks=SOME))
    stage.show(schedule)
    stage.frames(4)
    schedule.heard = []
    schedule.bind(
        on_command=lambda _, task: schedule.heard.append((task.id, task.enabled)),
        on_open=lambda _, task: schedule.heard.append(task.id),
    )
    return schedule


def of(schedule, kind):
    parts = [part for part in schedule.walk(restrict=True) if isinstance(part, kind)]
    return sorted(parts, key=lambda part: -part.to_window(*part.pos)[1])


def test_each_says_what_when_and_how_soon(schedule):
    assert [(row.title, row.detail) for row in of(schedule, ListRow)] == [
        ("Patrol", "22:00, Mon to Fri · in 3 h"),
        ("Deliver: Reception → Lab", "every 1 h 30 min · in 25 min"),
        ("Dock", "06:30, every day"),
    ]


def test_time_passes(schedule):
    schedule.now = 600.0
    assert of(schedule, ListRow)[1].detail.endswith("in 15 min")


def test_the_switch_switches_and_the_row_opens(stage, schedule):
    toggle = of(schedule, Toggle)[0]
    stage.tap(*toggle.to_window(*toggle.center))
    stage.run_for(0.3)
    row = of(schedule, ListRow)[2]
    stage.tap(*row.to_window(row.x + 60, row.center_y))
    stage.run_for(0.3)
    assert schedule.heard == [(1, False), 3]


def test_nothing_is_said(schedule):
    schedule.show(Schedule())
    assert any(
        getattr(part, "text", "") == "No tasks are scheduled." for part in schedule.walk(restrict=True)
    )


def test_what_stands_at_the_end_of_a_row_keeps_the_distance_of_what_stands_at_its_beginning(stage):
    listed = stage.show(ScheduleList(), size=(388, 300))
    listed.show(Schedule(tasks=SOME))
    stage.frames(3)
    row = next(one for one in listed.walk(restrict=True) if isinstance(one, ListRow))
    toggle = next(one for one in row.children if isinstance(one, Toggle))
    assert row.right - toggle.right == row.ids.sign.x - row.x == 12
