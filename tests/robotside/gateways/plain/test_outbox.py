"""What waits to be sent: the newest of each topic, not too often, and every event."""

from __future__ import annotations

import math

from bridge.core.topics import topic
from bridge.msgs.pilothouse_msgs import Event, TaskStatus
from bridge.msgs.sensor_msgs import Range
from robotside.gateways.plain.outbox import MAX_EVENTS, Outbox

FRONT, STATUS, EVENTS = topic("/range/front"), topic("/task/status"), topic("/events")


def test_of_a_stream_the_newest_is_sent_as_often_as_asked_for_and_the_last_is_not_lost() -> None:
    box = Outbox(0.2)
    for distance in (1.0, 2.0):
        box.put(FRONT, Range(range=distance))
    sent = box.take(10.0)
    assert sent == ("/range/front", Range(range=2.0))
    box.put(FRONT, Range(range=3.0))
    assert box.take(10.1) is None
    assert math.isclose(box.wait(10.1), 0.1)
    assert box.take(10.2) == ("/range/front", Range(range=3.0))
    assert box.take(11.0) is None
    assert box.wait(11.0) == math.inf


def test_a_state_is_sent_at_once_however_often_it_changes() -> None:
    box = Outbox(0.2)
    for state in ("RUNNING", "PAUSED"):
        box.put(STATUS, TaskStatus(state=state))
        assert box.wait(5.0) == 0.0
        assert box.take(5.0) == ("/task/status", TaskStatus(state=state))


def test_events_are_sent_each_and_first_of_all_and_are_bounded() -> None:
    box = Outbox(0.2)
    box.put(FRONT, Range())
    for number in range(MAX_EVENTS + 5):
        box.put(EVENTS, Event(id=number))
    sent = [box.take(1.0) for _ in range(MAX_EVENTS)]
    assert [each[1].id for each in sent if each and isinstance(each[1], Event)] == list(
        range(5, MAX_EVENTS + 5)
    )
    assert box.wait(1.0) == 0.0
    box.clear()
    assert box.take(1.0) is None


def test_one_topic_does_not_hold_up_another() -> None:
    box = Outbox(1.0)
    box.put(FRONT, Range())
    assert box.take(0.0)
    box.put(FRONT, Range())
    box.put(topic("/range/left"), Range())
    assert box.take(0.5) == ("/range/left", Range())
    assert box.take(0.5) is None
