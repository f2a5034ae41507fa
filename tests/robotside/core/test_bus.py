"""Messages inside the robot's computer."""

from __future__ import annotations

from bridge.msgs import Msg
from bridge.msgs.std_msgs import Float64
from robotside.core.bus import Bus


def test_the_bus_gives_a_message_to_its_topics_listeners_and_to_those_of_all() -> None:
    bus, heard = Bus(), []
    bus.subscribe("/a", lambda topic, msg: heard.append(("a", topic, msg)))
    bus.subscribe(None, lambda topic, msg: heard.append(("all", topic, msg)))
    bus.publish("/a", Float64(1.0))
    bus.publish("/b", Float64(2.0))
    assert heard == [("a", "/a", Float64(1.0)), ("all", "/a", Float64(1.0)), ("all", "/b", Float64(2.0))]


def test_who_comes_late_to_the_bus_hears_the_last_message_first() -> None:
    bus, heard = Bus(), list[Msg]()
    bus.publish("/a", Float64(1.0))
    bus.publish("/a", Float64(2.0))
    bus.subscribe("/a", lambda _, msg: heard.append(msg))
    assert heard == [Float64(2.0)]
    assert bus.last("/a") == Float64(2.0)
    assert bus.last("/b") is None


def test_who_left_the_bus_hears_nothing_even_while_a_message_is_on_its_way() -> None:
    bus, heard = Bus(), list[Msg]()
    leave = bus.subscribe("/a", lambda _, msg: heard.append(msg))
    leave()
    leave()
    bus.publish("/a", Float64(1.0))
    assert heard == []
