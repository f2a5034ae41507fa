"""What is told one by one of what comes in one message for all."""

from __future__ import annotations

import math

import pytest

from bridge.msgs import Msg
from bridge.msgs.arrays import Float32Array, Float64Array
from bridge.msgs.pilothouse_msgs import Event, MotorArray, SonarRing
from bridge.msgs.rosgraph_msgs import Log
from bridge.msgs.sensor_msgs import Range, Temperature
from bridge.msgs.std_msgs import Header, Time
from robotside.core.bus import Bus
from robotside.door.derived_topics import MAX_MOTORS, DerivedTopics


class Table:
    """A bus with an `DerivedTopics` on it, and what that has said."""

    def __init__(self, *motors: str) -> None:
        self.bus = Bus()
        self.motors = motors
        self.warm(0.0)
        self.apart = DerivedTopics(self.bus)
        self.said: list[tuple[str, Msg]] = []
        self.bus.subscribe(None, lambda topic, msg: self.said.append((topic, msg)))
        self.said.clear()

    def ring(self, *ranges: float) -> None:
        ring = SonarRing(
            Header(Time.at(7.0), "base_link"),
            bearings=Float64Array([0.0] * len(ranges)),
            ranges=Float32Array(ranges),
            field_of_view=0.4,
            range_min=0.15,
            range_max=6.0,
        )
        self.bus.publish("/sonar", ring)

    def warm(self, now: float, warmth: float = 20.0) -> None:
        if self.motors:
            header = Header(Time.at(now), "base_link")
            warmths = Float64Array([warmth + number for number in range(len(self.motors))])
            self.bus.publish("/motors", MotorArray(header, list(self.motors), temperatures=warmths))

    def heard(self, topic: str) -> list[Msg]:
        return [msg for name, msg in self.said if name == topic]


def test_one_sonar_of_a_ring_is_a_range_of_its_own() -> None:
    table = Table()
    table.apart.want("/sonar/2", True)
    table.ring(1.0, 2.0, 3.0, math.inf)
    header = Header(Time.at(7.0), "sonar_2")
    assert table.heard("/sonar/2") == [Range(header, Range.ULTRASOUND, 0.4, 0.15, 6.0, 3.0)]
    assert {topic for topic, _ in table.said} == {"/sonar", "/sonar/2"}


def test_nothing_is_told_that_nobody_wants_any_more() -> None:
    table = Table("left")
    for topic in ("/sonar/0", "/temperature/left"):
        table.apart.want(topic, True)
        table.apart.want(topic, False)
    table.ring(1.0)
    table.warm(1.0)
    assert [topic for topic, _ in table.said] == ["/sonar", "/motors"]


def test_what_is_beyond_reach_stays_infinite_and_a_ring_with_fewer_sonars_says_less() -> None:
    table = Table()
    for number in (0, 9):
        table.apart.want(f"/sonar/{number}", True)
    table.ring(math.inf, 1.0)
    (told,) = table.heard("/sonar/0")
    assert isinstance(told, Range)
    assert told.range == math.inf
    assert table.heard("/sonar/9") == []


def test_each_motor_has_its_temperature_twice_a_second() -> None:
    table = Table("left", "right")
    assert [topic.name for topic in table.apart.topics] == ["/temperature/left", "/temperature/right"]
    table.apart.want("/temperature/right", True)
    for step in range(1, 51):  # motors are told 5 times a second
        table.warm(step * 0.2, 30.0)
    heard = table.heard("/temperature/right")
    assert len(heard) == pytest.approx(20, abs=1)
    assert heard[0] == Temperature(Header(Time.at(0.2), "base_link"), 31.0)
    assert table.heard("/temperature/left") == []


def test_a_clock_that_was_set_back_silences_no_motor() -> None:
    table = Table("left")
    table.apart.want("/temperature/left", True)
    table.warm(1000.0)
    table.warm(5.0)
    assert len(table.heard("/temperature/left")) == 2


def test_names_that_are_no_topics_have_none_and_their_number_is_bounded() -> None:
    assert Table("front left", "", "a/b", "ok", "ok").apart.topics[0].name == "/temperature/ok"
    assert len(Table("front left", "", "a/b", "ok", "ok").apart.topics) == 1
    assert len(Table(*(f"m{number}" for number in range(200))).apart.topics) == MAX_MOTORS


def test_it_listens_no_longer_once_it_is_closed() -> None:
    table = Table()
    table.apart.want("/sonar/0", True)
    table.apart.close()
    table.ring(1.0)
    assert table.heard("/sonar/0") == []


def test_an_event_is_a_line_of_ros_s_log_for_who_reads_that() -> None:
    table = Table()
    alarm = Event(1, "boot", Time(5, 6), "alarm", text="The battery is low.", code="battery_low")
    table.bus.publish("/events", alarm)
    table.apart.want("/rosout", True)
    table.bus.publish("/events", alarm)
    table.bus.publish("/events", Event(2, "boot", Time(7, 0), "ok", text="It is charged."))
    low, charged = table.heard("/rosout")
    assert low == Log(
        Header(Time(5, 6)),
        Log.ERROR,
        "/pilothouse",
        "The battery is low.",
        function="battery_low",
        topics=["/events"],
    )
    assert (charged.level, charged.msg) == (Log.INFO, "It is charged.")


def test_an_event_that_comes_again_with_who_acknowledged_it_is_logged_once() -> None:
    table = Table()
    table.apart.want("/rosout", True)
    table.bus.publish("/events", Event(1, text="Once."))
    table.bus.publish("/events", Event(1, text="Once.", acknowledged_by="Ann"))
    assert [line.msg for line in table.heard("/rosout")] == ["Once."]
