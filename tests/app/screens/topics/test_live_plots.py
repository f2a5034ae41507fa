"""Numbers of topics over time: only what is drawn is listened to, over each link anew, and no more once it is left."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import pytest

from app.link.channels import LINK, watched
from app.link.feeds import Post
from app.link.subscriptions import Seen
from app.screens.parts.plot_stack import MAX_PLOTS
from app.screens.topics.live_plots import WHO, LivePlots
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.std_msgs import Float64

TWIST, NUMBER = "geometry_msgs/Twist", "std_msgs/Float64"


class Watches:
    def __init__(self) -> None:
        self.looks: list[tuple[str, dict[str, str]]] = []

    def look(self, who: str, topics: dict[str, str]) -> None:
        self.looks.append((who, topics))


@pytest.fixture
def session() -> Any:
    made = SimpleNamespace(link=SimpleNamespace(watches=Watches()), connected=True, time=100.0)
    made.now = lambda: made.time
    return made


@pytest.fixture
def plots(stage: Any, session: Any) -> LivePlots:
    made = LivePlots(session)
    stage.show(made.stack, (500, 400))
    return made


def hear(plots: LivePlots, topic: str, message: Any, at: float) -> None:
    plots.on_post(watched(topic), Post(Seen(topic, message), at, 1))


def test_what_is_drawn_is_listened_to_and_nothing_else(plots: LivePlots, session: Any) -> None:
    assert plots.turn("/wind", TWIST, "linear.x", "m/s")
    assert plots.turn("/level", NUMBER, "data", "m")
    hear(plots, "/wind", Twist(Vector3(3.0, 0.0, 0.0)), 100.0)
    hear(plots, "/other", Twist(Vector3(9.0, 0.0, 0.0)), 100.0)
    assert session.link.watches.looks[-1] == (WHO, {"/wind": TWIST, "/level": NUMBER})
    assert plots.stack.find("/wind", "linear.x").history.last == 3.0  # type: ignore[union-attr]
    assert len(plots.stack.find("/level", "data").history) == 0  # type: ignore[union-attr]


def test_fields_of_one_unit_share_a_plot_and_those_of_another_have_their_own(plots: LivePlots) -> None:
    for path in ("linear.x", "linear.y"):
        plots.turn("/wind", TWIST, path, "m/s")
    plots.turn("/wind", TWIST, "angular.z", "rad/s")
    assert [len(plot.traces) for plot in plots.stack.plots] == [2, 1]
    plots.stack.plots[0].span = 5.0
    assert plots.stack.plots[1].span == 5.0


def test_a_second_tap_takes_it_away_and_listens_to_it_no_more(plots: LivePlots, session: Any) -> None:
    plots.turn("/wind", TWIST, "linear.x", "m/s")
    plots.turn("/level", NUMBER, "data", "m")
    plots.turn("/wind", TWIST, "linear.x", "m/s")
    assert session.link.watches.looks[-1] == (WHO, {"/level": NUMBER})
    assert len(plots.stack.plots) == 1
    assert plots.drawn("/wind") == []


def test_where_there_is_no_room_it_says_so(plots: LivePlots) -> None:
    for number in range(MAX_PLOTS):
        assert plots.turn("/level", NUMBER, "data", f"unit {number}") or number
        plots.turn(f"/level{number}", NUMBER, "data", f"unit {number}")
    assert not plots.turn("/one/more", NUMBER, "data", "another")


def test_over_a_new_link_it_is_listened_to_anew(plots: LivePlots, session: Any) -> None:
    plots.turn("/level", NUMBER, "data", "m")
    session.link = SimpleNamespace(watches=Watches())
    plots.on_post(LINK, Post(None, 100.0, 1))
    assert session.link.watches.looks == [(WHO, {"/level": NUMBER})]


def test_a_message_of_another_type_is_a_hole(plots: LivePlots) -> None:
    plots.turn("/level", NUMBER, "data", "m")
    hear(plots, "/level", Float64(1.0), 100.0)
    hear(plots, "/level", Twist(), 100.1)
    assert math.isnan(plots.stack.traces[0].history.last)


def test_silence_is_said(plots: LivePlots, session: Any) -> None:
    plots.turn("/level", NUMBER, "data", "m")
    plots.tick()
    assert plots.stack.plots[0].state == "never"
    hear(plots, "/level", Float64(1.0), 100.0)
    plots.tick()
    assert plots.stack.plots[0].state == "live"
    session.time = 107.0
    plots.tick()
    assert (plots.stack.plots[0].state, plots.stack.plots[0].age) == ("stale", 7.0)


def test_once_it_is_left_nothing_is_listened_to(plots: LivePlots, session: Any) -> None:
    plots.turn("/level", NUMBER, "data", "m")
    plots.close()
    assert session.link.watches.looks[-1] == (WHO, {})
    assert plots.stack.plots == []
    plots.close()
    assert len(session.link.watches.looks) == 2
