"""The log that the operator reads."""

from __future__ import annotations

import math

from bridge.msgs.pilothouse_msgs import Event
from bridge.msgs.std_msgs import Time
from robotside.events import KEPT, Events


def test_events_are_numbered_from_one_and_carry_the_boot_and_the_place() -> None:
    heard: list[Event] = []
    events = Events("b1", lambda: 12.5, heard.append)
    events.say("task", "Started.")
    events.say("intruder", "A cone.", "alarm", at=(1.0, 2.0))
    assert [(e.id, e.boot, e.level, e.stamp) for e in heard] == [
        (1, "b1", "info", Time(12, 500_000_000)),
        (2, "b1", "alarm", Time(12, 500_000_000)),
    ]
    assert math.isnan(heard[0].position.x)
    assert (heard[1].position.x, heard[1].position.y) == (1.0, 2.0)


def test_an_event_is_one_line_of_at_most_three_hundred_characters() -> None:
    events = Events("b1", lambda: 0.0, lambda _: None)
    assert events.say("task", "two\nlines").text == "two lines"
    assert events.say("task", "a" * 900_000).text == "a" * 300


def test_the_newest_five_hundred_events_are_kept() -> None:
    events = Events("b1", lambda: 0.0, lambda _: None)
    for number in range(KEPT + 20):
        events.say("task", f"{number}")
    kept = events.since(0, "b1")
    assert (len(kept), kept[0].id, kept[-1].id) == (KEPT, 21, KEPT + 20)
    assert [event.id for event in events.since(KEPT + 18, "b1")] == [KEPT + 19, KEPT + 20]
