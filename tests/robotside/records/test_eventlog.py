"""What happened."""

from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import Event
from bridge.msgs.std_msgs import Time
from robotside.records import NotRecorded, Records
from robotside.records.database.rows import empty
from robotside.records.eventlog import FIRST_EVENTS


def say(records: Records, count: int = 1) -> list[Event]:
    heard: list[Event] = []
    with records.together():
        for number in range(count):
            records.events.add(Event(text=f"{number}"), heard.append)
    return heard


def test_numbers_count_on_after_a_restart_and_the_log_keeps_its_identity() -> None:
    stored = empty()
    first = Records.in_memory(stored)
    say(first, 3)
    second = Records.in_memory(stored)
    assert [event.id for event in say(second)] == [4]
    assert second.events.identity == first.events.identity
    assert [event.id for event in second.events.since(2, first.events.identity)] == [3, 4]


def test_who_knows_another_log_or_none_is_told_the_newest() -> None:
    records = Records.in_memory()
    say(records, FIRST_EVENTS + 10)
    for known, identity in ((0, records.events.identity), (7, "another")):
        told = records.events.since(known, identity)
        assert (len(told), told[-1].id) == (FIRST_EVENTS, FIRST_EVENTS + 10)
    assert len(records.events.since(1, records.events.identity)) == FIRST_EVENTS + 9


def test_what_was_missed_comes_in_rounds_and_nothing_is_left_out() -> None:
    records = Records.in_memory()
    say(records, 123)
    log, known, rounds = records.events, 3, 0
    heard: list[int] = []
    while True:
        told = log.since(known, log.identity, 50)
        heard += [event.id for event in told]
        known, rounds = heard[-1], rounds + 1
        if not log.more(told):
            break
    assert (heard, rounds) == (list(range(4, 124)), 3)


def test_of_a_log_that_was_started_fresh_everything_was_missed() -> None:
    records = Records.in_memory()
    say(records, 70)
    assert [event.id for event in records.events.since(40, "another", 50)] == list(range(1, 51))
    newcomer = records.events.since(0, "", 50)
    assert [event.id for event in newcomer] == list(range(21, 71))


def test_what_others_saw_to_meanwhile_is_told_of_the_events_named_and_of_no_other_log() -> None:
    records = Records.in_memory()
    say(records, 4)
    log = records.events
    log.acknowledge([2, 3], "Anna", Time(9), lambda _: None)
    told = log.seen([1, 2, 99, -1], log.identity)
    assert [(event.id, event.acknowledged_by, event.boot) for event in told] == [(2, "Anna", log.identity)]
    assert log.seen([2], "another") == []


def test_the_newest_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("robotside.records.eventlog.MAX_EVENTS", 5)
    records = Records.in_memory()
    say(records, 12)
    assert [event.id for event in records.events.since(0, "")] == [8, 9, 10, 11, 12]


def test_the_first_who_sees_to_an_event_is_remembered() -> None:
    records, heard = Records.in_memory(), list[Event]()
    say(records, 3)
    records.events.acknowledge([2, 2, 3], "Anna", Time(9), heard.append)
    assert [(event.id, event.acknowledged_by) for event in heard] == [(2, "Anna"), (3, "Anna")]
    assert records.events.acknowledge([2], "Bert", Time(10), heard.append) == []
    assert [event.acknowledged_by for event in records.events.since(0, "")] == ["", "Anna", "Anna"]


def test_an_event_that_is_not_there_cannot_be_seen_to() -> None:
    records = Records.in_memory()
    say(records)
    with pytest.raises(NotRecorded, match="There is no event with the number 9."):
        records.events.acknowledge([1, 9], "Anna", Time(9), lambda _: None)
    assert records.events.since(0, "")[0].acknowledged_by == ""
