"""Events: none missed, none twice, in order."""

from __future__ import annotations

from app.events import EventStream
from bridge.msgs.pilothouse_msgs import Event


def event(number: int, boot: str = "a") -> Event:
    return Event(id=number, boot=boot, text=f"{boot}{number}")


def stream() -> tuple[EventStream, list[str]]:
    told: list[str] = []
    return EventStream(lambda item: told.append(item.text)), told


def test_what_was_missed_comes_before_what_came_live_meanwhile() -> None:
    events, told = stream()
    events.ask()
    events.live(event(3))
    assert told == []
    events.missed([event(1), event(2), event(3)])
    assert told == ["a1", "a2", "a3"]


def test_after_a_reconnect_only_news_is_asked_for() -> None:
    events, told = stream()
    events.live(event(4))
    request = events.ask()
    assert (request.since, request.boot) == (4, "a")
    events.missed([event(4), event(5)])
    assert told == ["a4", "a5"]


def test_a_restarted_robot_side_counts_from_one_again() -> None:
    events, told = stream()
    events.live(event(9))
    events.ask()
    events.missed([event(1, "b"), event(2, "b")])
    events.live(event(3, "b"))
    assert told == ["a9", "b1", "b2", "b3"]


def test_a_robot_without_an_event_store_loses_no_live_event() -> None:
    events, told = stream()
    events.ask()
    events.live(event(1))
    events.give_up()
    assert told == ["a1"]
