"""The dashboard: messages to widgets, and every widget knows how old its message is."""

from __future__ import annotations

import math

import pytest

from app.link.feeds import Feeds, Post
from app.session.dashboard import Dashboard
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.sensor_msgs import BatteryState
from bridge.msgs.vision_msgs import Detection2D, Detection2DArray


class Clock:
    now = 100.0

    def __call__(self) -> float:
        return self.now


class Shown:
    """A widget without glass."""

    def __init__(self) -> None:
        self.state, self.age = "never", math.nan
        self.messages: list[object] = []

    def show(self, message: object) -> None:
        self.messages.append(message)


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def feeds(clock: Clock) -> Feeds:
    feeds = Feeds(clock)
    feeds.link(True)
    return feeds


def tell(feeds: Feeds, dashboard: Dashboard, topic: str, message: object) -> None:
    feeds.put(topic, Post(message, 100.0, 1))
    dashboard.deliver(topic, message)


def test_a_widget_is_never_live_stale_in_turn(feeds: Feeds, clock: Clock) -> None:
    dashboard, widget = Dashboard(feeds), Shown()
    dashboard.bind(widget, "/pose")
    dashboard.enter()
    assert widget.state == "never"
    tell(feeds, dashboard, "/pose", PoseWithCovarianceStamped())
    assert widget.state == "live"
    clock.now = 104.0
    dashboard.tick()
    assert (widget.state, widget.age) == ("stale", 4.0)


def test_a_screen_that_is_away_gets_the_newest_when_it_returns(feeds: Feeds) -> None:
    dashboard, widget = Dashboard(feeds), Shown()
    dashboard.bind(widget, "/battery_state")
    tell(feeds, dashboard, "/battery_state", BatteryState(percentage=0.5))
    tell(feeds, dashboard, "/battery_state", BatteryState(percentage=0.4))
    assert widget.messages == []
    dashboard.enter()
    assert [message.percentage for message in widget.messages] == [0.4]


def test_a_trail_goes_on_while_the_screen_is_away(feeds: Feeds) -> None:
    dashboard, widget = Dashboard(feeds), Shown()
    dashboard.bind(widget, "/pose", always=True)
    tell(feeds, dashboard, "/pose", PoseWithCovarianceStamped())
    assert len(widget.messages) == 1


def test_an_alarm_is_not_ended_by_a_fresh_message_but_by_silence(feeds: Feeds, clock: Clock) -> None:
    dashboard, widget = Dashboard(feeds), Shown()
    dashboard.bind(widget, "/pose")
    dashboard.enter()
    tell(feeds, dashboard, "/pose", PoseWithCovarianceStamped())
    widget.state = "alarm"
    dashboard.tick()
    assert widget.state == "alarm"
    clock.now = 104.0
    dashboard.tick()
    assert widget.state == "stale"


def test_what_would_deceive_is_gone_after_a_second_and_with_the_link(feeds: Feeds, clock: Clock) -> None:
    dashboard, widget = Dashboard(feeds), Shown()
    dashboard.bind(widget, "/detections", fresh=False, empty=Detection2DArray())
    dashboard.enter()
    seen = Detection2DArray(detections=[Detection2D()])
    tell(feeds, dashboard, "/detections", seen)
    clock.now = 101.0
    dashboard.tick()
    assert widget.messages[-1] is seen
    clock.now = 101.1
    dashboard.tick()
    assert widget.messages[-1] == Detection2DArray()
    feeds.put("/detections", Post(seen, 101.1, 1))
    dashboard.deliver("/detections", seen)
    feeds.link(False)
    dashboard.tick()
    assert widget.messages[-1] == Detection2DArray()


def test_what_would_deceive_does_not_come_back_with_the_screen(feeds: Feeds, clock: Clock) -> None:
    dashboard, widget = Dashboard(feeds), Shown()
    dashboard.bind(widget, "/detections", fresh=False, empty=Detection2DArray())
    tell(feeds, dashboard, "/detections", Detection2DArray(detections=[Detection2D()]))
    clock.now = 102.0
    dashboard.enter()
    assert widget.messages[-1] == Detection2DArray()


def test_what_only_adds_to_a_widget_leaves_its_age_alone(feeds: Feeds) -> None:
    dashboard, widget = Dashboard(feeds), Shown()
    dashboard.bind(widget, "/pose", fresh=False)
    dashboard.enter()
    tell(feeds, dashboard, "/pose", PoseWithCovarianceStamped())
    assert widget.state == "never"
    assert len(widget.messages) == 1
