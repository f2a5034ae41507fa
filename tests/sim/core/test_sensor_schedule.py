from __future__ import annotations

import pytest

from sim.core.sensor_schedule import Schedule


@pytest.mark.parametrize("rate", [1, 5, 10, 15, 20, 50, 240])
def test_a_sensor_falls_due_exactly_as_often_as_its_rate_says(rate):
    schedule = Schedule({"it": rate})
    due = [step for step in range(2400) if schedule.due(step)]
    assert due[0] == 0
    assert len(due) == 10 * rate


def test_one_that_falls_due_after_the_others_keeps_its_rate_and_its_distance():
    schedule = Schedule({"odometry": 20, "laser": 10}, {"laser": 4})
    due = {step: names for step in range(100) if (names := schedule.due(step))}
    assert due[0] == ("odometry", "laser")
    assert [step for step, names in due.items() if "laser" in names] == [0, 4, 28, 52, 76]
    assert [step for step, names in due.items() if "odometry" in names] == list(range(0, 100, 12))
    assert all(len(names) == 1 for step, names in due.items() if step)


def test_names_that_fall_due_together_keep_their_order():
    schedule = Schedule({"second": 10, "first": 20})
    assert schedule.due(0) == ("second", "first")
    assert [schedule.due(step) for step in range(1, 13)][-1] == ("first",)


def test_a_period_that_is_no_whole_number_of_steps_does_not_drift():
    schedule = Schedule({"imu": 50})
    due = [step for step in range(241) if schedule.due(step)]
    assert due[:6] == [0, 5, 10, 15, 20, 24]
    assert due[-1] == 240


def test_steps_after_which_nothing_falls_due_can_be_left_out():
    asked, seldom = (Schedule({"imu": 50, "laser": 10, "battery": 1}) for _ in range(2))
    every = [asked.due(step) for step in range(1000)]
    some = [seldom.due(step) if seldom.anything_due(step) else () for step in range(1000)]
    assert some == every
    assert sum(map(bool, every)) < 300
