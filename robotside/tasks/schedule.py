"""Arithmetic of the schedule: instant and zone are passed in, no function here reads a clock.

A time of day is that of the robot's zone. One that the clocks jump over in spring starts as much later as they jump, one
that comes twice in autumn starts the first time.
"""

from __future__ import annotations

import datetime as dt
import math
import os
import re
from collections.abc import Iterable
from typing import NamedTuple
from zoneinfo import ZoneInfo

import msgspec

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import ScheduledTask
from bridge.msgs.std_msgs import Time
from robotside.core.notice import Notice, Problem

__all__ = [
    "MAX_LATENESS",
    "MIN_PERIOD",
    "ScheduledStart",
    "fault",
    "following",
    "local_zone",
    "scheduled_starts",
]

MAX_LATENESS = 60.0
"""A start that is later than this is missed [s]."""

SOON = 23 * 3600.0
"""A time of day that comes within this needs no second look, even if the clock was set [s]."""

MIN_PERIOD = 60.0
"""[s]"""

MAX_PERIOD = 31 * 86400.0
"""[s]"""

_AT = re.compile(r"([01]\d|2[0-3]):([0-5]\d)")


class ScheduledStart(NamedTuple):
    """A scheduled task whose `next` has changed."""

    task: ScheduledTask
    """With its new `next`."""
    due: bool
    """It starts now."""
    missed: float = 0.0
    """When it should have started and did not [s]; 0 for nothing missed."""


def fault(task: ScheduledTask) -> Problem:
    """The fault in the times of `task`, as one sentence; empty for none."""
    if bool(task.at) == bool(task.every):
        said = "A scheduled task needs either a time of day (at) or a period (every)."
        return Notice(Code.SCHEDULE_TIME_MISSING, said)
    if task.at:
        if not _AT.fullmatch(task.at):
            said = f"The time of day must be written as 00:00 to 23:59, not {task.at[:20]!r}."
            return Notice(Code.SCHEDULE_TIME_INVALID, said, at=task.at[:20])
        if any(task.days):
            return ""
        return Notice(Code.SCHEDULE_DAY_MISSING, "A scheduled task needs at least one day of the week.")
    if not MIN_PERIOD <= task.every <= MAX_PERIOD:
        said = f"The period must be {MIN_PERIOD:.0f} to {MAX_PERIOD:.0f} s, not {task.every:g} s."
        return Notice(Code.SCHEDULE_PERIOD_INVALID, said, period=task.every)
    return ""


def following(task: ScheduledTask, after: float, zone: dt.tzinfo) -> float:
    """The first start later than `after` [s since the epoch]; 0 for never."""
    if not task.enabled or fault(task):
        return 0.0
    if task.every:
        return after + task.every
    hour, minute = (int(part) for part in task.at.split(":"))
    day = dt.datetime.fromtimestamp(after, zone).date()
    for number in range(-1, 9):
        date = day + dt.timedelta(days=number)
        start = dt.datetime.combine(date, dt.time(hour, minute), zone).timestamp()
        if task.days[date.weekday()] and start > after:
            return start
    return 0.0


def scheduled_starts(tasks: Iterable[ScheduledTask], now: float, zone: dt.tzinfo) -> list[ScheduledStart]:
    """The changes of `tasks` up to `now` [s since the epoch]: those that start, that were missed, that have no time yet.

    However many starts were missed, only the last one is reported. A clock that goes back a little starts nothing a second
    time; one that goes back by more than a start has its times reckoned anew.
    """
    found = []
    for task in tasks:
        due = task.next.seconds
        if task.enabled and task.at and 0 < due - now < SOON:
            continue
        first = following(task, now, zone)
        if due > 0 and first <= 0:
            found.append(ScheduledStart(_at(task, 0.0), due=False))
        elif due <= 0 or due > _latest(task, first, zone) + 1.0:
            if first > 0:
                found.append(ScheduledStart(_at(task, first), due=False))
        elif due <= now:
            late = now - due > MAX_LATENESS
            found.append(
                ScheduledStart(
                    _at(task, _after(task, due, now, first)), due=not late, missed=due if late else 0.0
                )
            )
    return found


def _latest(task: ScheduledTask, first: float, zone: dt.tzinfo) -> float:
    """The latest start that may be waited for, the next but one when the first one was done already."""
    return first if task.every else following(task, first, zone)


def _after(task: ScheduledTask, due: float, now: float, first: float) -> float:
    """The start behind `due`; periods go on from there and do not drift."""
    return due + task.every * (math.floor((now - due) / task.every) + 1) if task.every else first


def _at(task: ScheduledTask, start: float) -> ScheduledTask:
    return msgspec.structs.replace(task, next=Time.at(start) if start else Time())


def local_zone() -> dt.tzinfo:
    """The zone of this computer, with its changes of the clock as far as they are known; else UTC's offset of now."""
    try:
        if os.environ.get("TZ"):
            return ZoneInfo(os.environ["TZ"])
        with open("/etc/localtime", "rb") as file:  # noqa: PTH123 - ZoneInfo wants the open file
            return ZoneInfo.from_file(file)
    except (OSError, ValueError, KeyError):
        return dt.datetime.now().astimezone().tzinfo or dt.UTC
