"""The arithmetic of the schedule, on calendars that are written down here."""

from __future__ import annotations

import datetime as dt
import math
from zoneinfo import ZoneInfo

import msgspec
import pytest

from bridge.msgs.pilothouse_msgs import ScheduledTask, TaskOrder
from bridge.msgs.std_msgs import Time
from robotside.tasks.schedule import MAX_LATENESS, fault, following, local_zone, scheduled_starts

BERLIN = ZoneInfo("Europe/Berlin")
DAY = 86400.0


def at(text: str, zone: dt.tzinfo = BERLIN, fold: int = 0) -> float:
    return dt.datetime.fromisoformat(text).replace(tzinfo=zone, fold=fold).timestamp()


def spoken(instant: float) -> str:
    return dt.datetime.fromtimestamp(instant, BERLIN).strftime("%a %d %H:%M")


def daily(time: str, *days: int) -> ScheduledTask:
    wanted = [number in days for number in range(7)] if days else [True] * 7
    return ScheduledTask(1, order=TaskOrder(task="patrol"), at=time, days=wanted)


def run(task: ScheduledTask, *instants: float) -> list[float]:
    """When it starts, looked at again and again at these instants."""
    starts = []
    for now in instants:
        for turn in scheduled_starts([task], now, BERLIN):
            task = turn.task
            if turn.due:
                starts.append(now)
    return starts


def every_minute(start: float, hours: float) -> list[float]:
    return [start + 30.0 * n for n in range(int(hours * 120))]


def test_a_time_of_day_is_that_of_the_robots_zone() -> None:
    now = at("2026-06-03T12:00")
    assert spoken(following(daily("10:30"), now, BERLIN)) == "Thu 04 10:30"
    assert spoken(following(daily("12:01"), now, BERLIN)) == "Wed 03 12:01"
    assert following(daily("12:00"), now, BERLIN) == now + DAY


def test_only_its_days_count_monday_first() -> None:
    now = at("2026-06-03T12:00")  # a Wednesday
    assert spoken(following(daily("10:00", 0, 5), now, BERLIN)) == "Sat 06 10:00"
    assert spoken(following(daily("10:00", 2), now, BERLIN)) == "Wed 10 10:00"


def test_the_clocks_change_and_a_time_of_day_stays() -> None:
    before = at("2026-03-28T10:00")
    assert following(daily("10:00"), before, BERLIN) - before == 23 * 3600.0
    before = at("2026-10-24T10:00")
    assert following(daily("10:00"), before, BERLIN) - before == 25 * 3600.0


def test_an_hour_that_is_left_out_starts_once_and_one_that_comes_twice_starts_the_first_time() -> None:
    spring = at("2026-03-28T22:00")
    starts = run(daily("02:30"), *every_minute(spring, 30))
    assert [spoken(start) for start in starts] == ["Sun 29 03:30", "Mon 30 02:30"]
    autumn = at("2026-10-24T22:00")
    starts = run(daily("02:30"), *every_minute(autumn, 30))
    assert [spoken(start) for start in starts] == ["Sun 25 02:30", "Mon 26 02:30"]
    assert starts[0] == at("2026-10-25T02:30", fold=0)


def test_every_so_often_does_not_drift() -> None:
    task = ScheduledTask(1, order=TaskOrder(task="hold"), every=600.0)
    begin = at("2026-06-03T12:00")
    starts = run(task, *(begin + 7.0 * n for n in range(900)))
    assert len(starts) == 10
    assert all(0 <= start - begin - 600.0 * n < 7.0 for n, start in enumerate(starts, 1))


def test_what_is_late_is_missed_once_and_the_next_one_counts() -> None:
    task = ScheduledTask(1, order=TaskOrder(task="hold"), every=600.0, next=Time.at(1000.0))
    (turn,) = scheduled_starts([task], 1000.0 + MAX_LATENESS + 1.0, BERLIN)
    assert (turn.due, turn.missed, turn.task.next.seconds) == (False, 1000.0, 1600.0)
    (turn,) = scheduled_starts([task], 1000.0 + 5 * 600.0 + MAX_LATENESS + 1.0, BERLIN)
    assert (turn.due, turn.missed, turn.task.next.seconds) == (False, 1000.0, 4600.0)


def test_a_clock_that_jumps_ahead_over_a_start_tells_that_it_was_missed() -> None:
    task = daily("10:00")
    task = scheduled_starts([task], at("2026-06-03T09:00"), BERLIN)[0].task
    (turn,) = scheduled_starts([task], at("2026-06-03T13:00"), BERLIN)
    assert (turn.due, turn.missed) == (False, at("2026-06-03T10:00"))
    assert spoken(turn.task.next.seconds) == "Thu 04 10:00"


@pytest.mark.parametrize("days", [(), (2,)])
def test_a_clock_that_goes_back_a_little_starts_nothing_twice(days: tuple[int, ...]) -> None:
    before = at("2026-06-03T10:00")
    hour = [before - 1800.0 + 30.0 * n for n in range(120)]
    assert len(run(daily("10:00", *days), *hour, *hour)) == 1


def test_a_clock_that_was_days_ahead_leaves_no_start_out_once_it_is_right() -> None:
    task = scheduled_starts([daily("10:00")], at("2027-06-03T12:00"), BERLIN)[0].task
    (turn,) = scheduled_starts([task], at("2026-06-03T12:00"), BERLIN)
    assert spoken(turn.task.next.seconds) == "Thu 04 10:00"
    task = ScheduledTask(1, order=TaskOrder(task="hold"), every=600.0, next=Time.at(9e8))
    (turn,) = scheduled_starts([task], 5e8, BERLIN)
    assert turn.task.next.seconds == 5e8 + 600.0


def test_one_that_is_switched_off_never_starts_and_has_no_next() -> None:
    task = msgspec.structs.replace(daily("10:00"), enabled=False, next=Time.at(500.0))
    (turn,) = scheduled_starts([task], 500.0, BERLIN)
    assert (turn.due, turn.task.next) == (False, Time())
    assert scheduled_starts([turn.task], 600.0, BERLIN) == []


def test_nothing_changes_between_two_starts() -> None:
    task = scheduled_starts([daily("10:00")], at("2026-06-03T09:00"), BERLIN)[0].task
    assert scheduled_starts([task], at("2026-06-03T09:59"), BERLIN) == []


@pytest.mark.parametrize(
    ("task", "said"),
    [
        (
            ScheduledTask(at="10:00", every=60.0),
            "A scheduled task needs either a time of day (at) or a period",
        ),
        (ScheduledTask(), "A scheduled task needs either a time of day (at) or a period"),
        (ScheduledTask(at="24:00"), "The time of day must be written as 00:00 to 23:59, not '24:00'."),
        (ScheduledTask(at="9:00"), "The time of day must be written as 00:00 to 23:59, not '9:00'."),
        (ScheduledTask(at="10:00", days=[False] * 7), "A scheduled task needs at least one day of the week."),
        (ScheduledTask(every=59.0), "The period must be 60 to 2678400 s, not 59 s."),
        (ScheduledTask(every=math.nan), "The period must be 60 to 2678400 s, not nan s."),
        (ScheduledTask(every=-5.0), "The period must be 60 to 2678400 s, not -5 s."),
    ],
)
def test_times_that_make_no_sense_are_told_with_what_is_allowed(task: ScheduledTask, said: str) -> None:
    assert fault(task).startswith(said)
    assert following(task, 1000.0, BERLIN) == 0.0


def test_the_zone_of_this_computer_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TZ", "Europe/Berlin")
    assert dt.datetime.fromtimestamp(at("2026-06-03T12:00"), local_zone()).hour == 12
    monkeypatch.delenv("TZ")
    assert dt.datetime.fromtimestamp(0.0, local_zone()).utcoffset() is not None
