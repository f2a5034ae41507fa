"""Rate, age and bandwidth of what comes, who ties each topic, and the order of the lines."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import pytest

from app.screens.topics.ros_graph import RosGraph
from app.screens.topics.topic_figures import WINDOW, Flows, bytes_text, entries
from app.session.topic_list import Line
from bridge.client.message_receiver import Traffic


class Robot:
    def __init__(self) -> None:
        self.time = 100.0
        self.link = SimpleNamespace(health=SimpleNamespace(traffic=Traffic()))
        self.flows = Flows(self)  # type: ignore[arg-type]

    def now(self) -> float:
        return self.time

    def stream(self, topic: str, rate: int, size: int, seconds: int) -> None:
        for _ in range(seconds):
            self.flows.tick()
            for _ in range(rate):
                self.link.health.traffic.add(topic, size, self.time)
            self.time += 1.0
        self.flows.tick()


@pytest.fixture
def robot() -> Robot:
    return Robot()


def test_rate_and_bandwidth_are_those_of_the_last_seconds(robot: Robot) -> None:
    robot.stream("/odom", 20, 300, 10)
    assert robot.flows.of("/odom") == (pytest.approx(20.0), pytest.approx(6000.0))
    robot.stream("/odom", 5, 300, int(WINDOW) + 1)
    assert robot.flows.of("/odom")[0] == pytest.approx(5.0)


def test_of_what_does_not_come_nothing_is_measured(robot: Robot) -> None:
    assert all(math.isnan(one) for one in robot.flows.of("/odom"))
    robot.stream("/odom", 20, 300, 3)
    assert all(math.isnan(one) for one in robot.flows.of("/other"))
    robot.stream("/other", 1, 1, 20)
    assert all(math.isnan(one) for one in robot.flows.of("/odom")), "it was listened to and is no longer"


def test_another_link_begins_anew(robot: Robot) -> None:
    robot.stream("/odom", 20, 300, 3)
    robot.link.health.traffic = Traffic()
    robot.stream("/scan", 10, 100, 3)
    assert robot.flows.of("/scan")[0] == pytest.approx(10.0)
    assert all(math.isnan(one) for one in robot.flows.of("/odom"))


LINES = [
    Line("/b", "t", rate=10.0, age=0.1, state="live"),
    Line("/a", "t"),
    Line("/c", "t", rate=50.0, age=9.0, state="stale"),
    Line("/d", "t", rate=30.0, age=0.5, state="live"),
]
FLOWS = {"/b": (9.0, 900.0), "/d": (29.0, 100.0), "/c": (1.0, 5000.0)}
GRAPH = RosGraph(("/x", "/y"), {"/a": ("/x", "/y"), "/b": ("/x",)}, {"/d": ("/x",)})


def order(by: str, *, descending: bool) -> list[str]:
    found = entries(
        LINES, lambda topic: FLOWS.get(topic, (math.nan, math.nan)), GRAPH, by, descending=descending
    )
    return [one.line.name for one in found]


@pytest.mark.parametrize(
    ("by", "falling", "rising"),
    [
        ("name", "dcba", "abcd"),
        ("rate", "dbca", "cbda"),
        ("age", "cdba", "bdca"),
        ("bandwidth", "bdca", "cdba"),
        ("publishers", "abcd", "cdba"),
        ("subscribers", "dabc", "abcd"),
    ],
)
def test_lines_are_put_in_order_and_what_is_not_known_comes_last(by: str, falling: str, rising: str) -> None:
    assert order(by, descending=True) == [f"/{one}" for one in falling]
    assert order(by, descending=False) == [f"/{one}" for one in rising]


def test_an_entry_tells_who_ties_its_topic_and_silence_is_no_rate() -> None:
    found: dict[str, Any] = {
        one.line.name: one
        for one in entries(LINES, lambda topic: FLOWS.get(topic, (math.nan, math.nan)), GRAPH)
    }
    assert (found["/a"].publishers, found["/a"].subscribers) == (2, 0)
    assert (found["/c"].rate, found["/c"].bandwidth, found["/c"].age) == (0.0, 0.0, 9.0)
    assert found["/b"].rate == 10.0
    unknown = entries(LINES, lambda _: (math.nan, math.nan), None)[0]
    assert math.isnan(unknown.publishers)


@pytest.mark.parametrize(
    ("rate", "text"),
    [
        (0.0, "0 B/s"),
        (999.4, "999 B/s"),
        (999.6, "1.0 kB/s"),
        (1234.0, "1.2 kB/s"),
        (2.5e6, "2.5 MB/s"),
        (math.nan, ""),
    ],
)
def test_a_bandwidth_is_said_in_a_unit_that_can_be_read(rate: float, text: str) -> None:
    assert bytes_text(rate) == text
