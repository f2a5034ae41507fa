from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import ScheduledTask, TaskOrder
from widgets.parts.choices import Segment
from widgets.parts.stepper import Stepper
from widgets.tasks.when_picker import Day, WhenPicker

NIGHTLY = ScheduledTask(id=7, order=TaskOrder(task="patrol"), at="22:55", days=[True] * 5 + [False] * 2)


@pytest.fixture
def picker(stage):
    picker = WhenPicker(size_hint=(None, None), width=388)
    picker.show(NIGHTLY)
    stage.show(picker)
    stage.frames(4)
    picker.heard = []
    picker.bind(on_command=lambda _, task: picker.heard.append(task))
    return picker


def of(picker, kind):
    return [part for part in picker.walk(restrict=True) if isinstance(part, kind)]


def test_what_is_shown_is_taken_over_and_says_nothing(picker):
    assert (picker.way, picker.hour, picker.minute) == ("at", 22, 55)
    assert [day.on for day in of(picker, Day)] == [True] * 5 + [False] * 2
    assert picker.heard == []


def test_hours_and_minutes_go_round_the_clock(picker):
    hours, minutes = of(picker, Stepper)
    minutes.count(1)
    assert picker.heard[-1].at == "22:00"
    for _ in range(3):
        hours.count(1)
    assert picker.heard[-1].at == "01:00"
    hours.count(-1)
    hours.count(-1)
    assert picker.heard[-1].at == "23:00"


def test_a_day_is_switched(stage, picker):
    saturday = of(picker, Day)[5]
    stage.tap(*saturday.to_window(*saturday.center))
    stage.run_for(0.3)
    assert list(picker.heard[-1].days) == [True] * 6 + [False]
    assert picker.heard[-1].id == 7
    assert picker.heard[-1].order == NIGHTLY.order


def test_every_so_often_needs_no_days_and_is_never_nought(stage, picker):
    every = of(picker, Segment)[1]
    stage.tap(*every.to_window(*every.center))
    stage.frames(4)
    assert (picker.heard[-1].at, picker.heard[-1].every) == ("", 3600.0)
    assert of(picker, Day) == []
    hours, minutes = of(picker, Stepper)
    hours.count(-1)
    assert picker.heard[-1].every == 300.0
    minutes.count(1)
    assert picker.heard[-1].every == 600.0


@pytest.mark.parametrize(("every", "shown"), [(5400.0, (1, 30)), (86400.0, (24, 0))])
def test_a_period_is_taken_over(picker, every, shown):
    picker.show(ScheduledTask(every=every))
    assert (picker.way, picker.hour, picker.minute) == ("every", *shown)
