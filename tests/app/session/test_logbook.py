"""The logbook: every event once, who saw to it, what was missed, and how far it is known tomorrow."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from app.core.settings_store import Settings
from app.link.commands import Outcome
from app.link.event_order import KnownEvents, Missed
from app.session.logbook import MAX_ACKNOWLEDGED, MAX_EVENTS, MAX_LOGS, NEWS_AGE, Logbook, marks
from bridge.msgs.pilothouse_msgs import Event
from bridge.msgs.std_msgs import Time


def event(number: int, level: str = "info", boot: str = "a", **words: Any) -> Event:
    return Event(id=number, boot=boot, level=level, **words)


@pytest.fixture
def settings(tmp_path: Path) -> Iterator[Settings]:
    settings = Settings(tmp_path)
    yield settings
    settings.close()


class Asked(list[list[int]]):
    """What the robot was asked to note."""

    def __call__(self, name: str, *, ids: Any) -> None:
        assert name == "acknowledge"
        self.append(list(ids))


@pytest.fixture
def asked() -> Asked:
    return Asked()


@pytest.fixture
def book(settings: Settings, asked: Asked) -> Logbook:
    book = Logbook(settings, asked)
    book.know(KnownEvents("a", 0))
    return book


def test_an_event_is_kept_once_and_changes_when_somebody_has_seen_to_it(book: Logbook) -> None:
    assert book.add(event(1, "alarm"))
    assert not book.add(event(1, "alarm"))
    assert book.alarms == 1
    assert book.add(event(1, "alarm", acknowledged_by="Anna"))
    assert not book.add(event(1, "alarm", acknowledged_by="Anna"))
    assert not book.add(event(1, "alarm"))
    assert (book.alarms, [one.acknowledged_by for one in book.events]) == (0, ["Anna"])


def test_only_warnings_and_alarms_wait_for_somebody(book: Logbook) -> None:
    for number, level in enumerate(("info", "ok", "warn", "alarm"), 1):
        book.add(event(number, level))
    assert [one.id for one in book.open] == [3, 4]
    assert book.alarms == 1


def test_what_was_said_where_it_was_so_asks_for_nothing_but_an_alarm_always_does(book: Logbook) -> None:
    book.add(event(1, "warn", kind="control"))
    book.add(event(2, "warn", kind="command"))
    book.add(event(3, "warn", kind="battery"))
    book.add(event(4, "alarm", kind="control"))
    assert [one.id for one in book.asking] == [3, 4]
    assert len(book.open) == 4, "all of them are still listed to be seen to"


def test_one_that_is_acknowledged_is_asked_for_once_until_there_is_an_answer(
    book: Logbook, asked: Asked
) -> None:
    alarm = event(1, "alarm")
    book.add(alarm)
    book.acknowledge([alarm])
    book.acknowledge([alarm])
    assert asked == [[1]]
    assert book.is_asked(alarm)
    book.add(event(1, "alarm", acknowledged_by="me"))
    assert not book.is_asked(alarm)


def test_one_that_somebody_else_saw_to_a_moment_before_is_not_asked_for(book: Logbook, asked: Asked) -> None:
    book.add(event(1, "alarm"))
    seen = event(1, "alarm", acknowledged_by="Anna")
    book.add(seen)
    book.acknowledge([seen])
    assert asked == []


@pytest.mark.parametrize("phase", ["refused", "no_reply"])
def test_without_success_it_can_be_asked_for_again(book: Logbook, asked: Asked, phase: str) -> None:
    alarm = event(1, "alarm")
    book.add(alarm)
    book.acknowledge([alarm])
    book.answered(Outcome("acknowledge", "c1", phase, fields={"ids": asked[0]}))
    assert not book.is_asked(alarm)
    book.acknowledge([alarm])
    assert asked == [[1], [1]]


def test_a_link_that_is_given_up_leaves_nothing_waiting(book: Logbook) -> None:
    alarm = event(1, "alarm")
    book.add(alarm)
    book.acknowledge([alarm])
    book.dropped()
    assert not book.is_asked(alarm)


def test_very_many_are_acknowledged_in_parts_that_the_robot_takes(book: Logbook, asked: Asked) -> None:
    for number in range(1, MAX_ACKNOWLEDGED + 8):
        book.add(event(number, "warn"))
    book.acknowledge(book.open)
    assert [len(part) for part in asked] == [MAX_ACKNOWLEDGED, 7]


def test_what_was_missed_is_marked_until_it_was_looked_at(book: Logbook) -> None:
    for number in (1, 2, 3):
        book.add(event(number))
    book.miss(Missed("a", 1, 3, gone=True))
    assert [one.id for one in book.missed] == [2, 3]
    assert book.gone
    book.clear_missed()
    assert (book.missed, book.gone) == ([], False)


def test_what_came_live_was_not_missed(book: Logbook) -> None:
    for number in range(1, 6):
        book.add(event(number))
    book.miss(Missed("a", 1, 5, live=frozenset({3, 5})))
    assert [one.id for one in book.missed] == [2, 4]
    assert book.words == "2 while you were away"


def test_what_was_missed_is_said_once_and_what_waits_in_it_is_counted(book: Logbook) -> None:
    assert (book.news(), book.words) == ("", "")
    for number, level in enumerate(("info", "alarm", "info"), 1):
        book.add(event(number, level))
    book.miss(Missed("a", 1, 3))
    assert book.news() == "2 events while you were away, 1 to be seen to."
    assert (book.news(), book.words) == ("", "2 while you were away")
    book.add(event(4))
    book.miss(Missed("a", 3, 4, gone=True))
    assert book.news() == "1 event while you were away; the robot keeps no more of them.", (
        "of the last absence"
    )
    assert book.words == "1 and more while you were away"
    book.clear_missed()
    assert book.news() == ""


def test_of_a_log_that_is_no_more_nothing_can_be_seen_to(book: Logbook, asked: Asked) -> None:
    book.add(event(1, "alarm"))
    book.know(KnownEvents("b", 4))
    book.add(event(4, "alarm", "b"))
    assert [(one.boot, one.id) for one in book.open] == [("b", 4)]
    book.acknowledge(book.events)
    assert asked == [[4]]


def test_it_is_remembered_over_the_end_of_the_app_how_far_each_robot_is_known(
    tmp_path: Path, settings: Settings, asked: Asked
) -> None:
    book = Logbook(settings, asked)
    for known in (KnownEvents("a", 7), KnownEvents("b", 3), KnownEvents("a", 9)):
        book.know(known)
    settings.close()
    assert marks(Settings(tmp_path)) == {"a": 9, "b": 3}


def test_the_logs_that_were_heard_last_are_remembered(book: Logbook, settings: Settings) -> None:
    for number in range(MAX_LOGS + 5):
        book.know(KnownEvents(f"log {number}", 1))
    assert len(marks(settings)) == MAX_LOGS
    assert f"log {MAX_LOGS + 4}" in marks(settings)


@pytest.mark.parametrize("strange", [[], "a", {"a": "many"}, {"a": True}, {"a": None}])
def test_strange_settings_are_none(settings: Settings, strange: object) -> None:
    settings.set("events", strange)
    assert marks(settings) == {}


def test_the_newest_are_kept(book: Logbook) -> None:
    for number in range(1, MAX_EVENTS + 3):
        book.add(event(number))
    assert (len(book.events), book.events[0].id) == (MAX_EVENTS, 3)


@pytest.mark.parametrize(
    ("stamp", "by", "clock", "news"),
    [
        (100.0, "", 101.0, True),
        (100.0, "", 101.0 + NEWS_AGE, False),
        (100.0, "", math.nan, True),
        (0.0, "", 900.0, True),
        (100.0, "Anna", 101.0, False),
    ],
)
def test_only_what_has_just_happened_is_news(stamp: float, by: str, clock: float, news: bool) -> None:
    one = event(1, "alarm", stamp=Time.at(stamp), acknowledged_by=by)
    assert Logbook.is_news(one, clock) is news
