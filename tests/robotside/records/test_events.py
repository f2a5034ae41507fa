"""The log that the operator reads."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.pilothouse_msgs import Event
from bridge.msgs.std_msgs import Time
from robotside.records import Records
from robotside.records.events import Events


@pytest.fixture
def heard() -> list[Event]:
    return []


@pytest.fixture
def events(heard: list[Event]) -> Events:
    return Events(Records.in_memory().events, lambda: 12.5, heard.append)


def test_events_are_numbered_from_one_and_carry_the_log_and_the_place(
    events: Events, heard: list[Event]
) -> None:
    events.say("task", "Started.")
    events.say("intruder", "A cone.", "alarm", at=(1.0, 2.0))
    assert [(e.id, e.boot, e.level, e.stamp) for e in heard] == [
        (1, events.boot, "info", Time(12, 500_000_000)),
        (2, events.boot, "alarm", Time(12, 500_000_000)),
    ]
    assert math.isnan(heard[0].position.x)
    assert (heard[1].position.x, heard[1].position.y) == (1.0, 2.0)
    assert events.since(1, events.boot) == heard[1:]


def test_an_event_is_one_line_of_at_most_three_hundred_characters(events: Events) -> None:
    assert events.say("task", "two\nlines").text == "two lines"
    assert events.say("task", "a" * 900_000).text == "a" * 300
