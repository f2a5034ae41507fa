"""Everything on the glass made anew, as for another size of text: the robot notices nothing but a stick that lets go."""

from __future__ import annotations

from typing import Any

import pytest
from kivy.metrics import Metrics, sp

from app.core.hand import Hand
from app.screens.setup.screen import HANDHELD
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Place
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets.core.language import language
from widgets.core.quantities import quantities


@pytest.fixture(autouse=True)
def as_before() -> Any:
    yield
    quantities.system, language.name, Metrics.fontscale = "metric", "en", 1.0


def anew(glass: Glass, name: str, value: Any) -> None:
    glass.app.preferences.choose(name, value)
    glass.stage.frames(3)


def test_link_control_and_drafts_live_on_in_larger_text(driving: Glass, robot: FakeRobot) -> None:
    app = driving.app
    session, link, before = app.session, app.session.link, app.shell
    app.show("mission")
    mission = app.screens["mission"]
    mission.mode = "points"
    mission.map.dispatch("on_add", 3.0, 4.0)
    size = before.bar.ids.name.font_size
    anew(driving, "text", 1.5)
    assert app.shell is not before
    assert (app.session, app.session.link, app.session.control) == (session, link, "mine")
    assert app.shell.screen == "mission"
    assert app.shell.bar.ids.name.font_size == pytest.approx(1.5 * size)
    assert sp(10) == 15.0
    assert [point[:2] for point in app.session.mission.draft.points] == [(3.0, 4.0)]
    assert len(app.screens["mission"].map.waypoints) == 1
    app.show("drive")
    driving.until(lambda: app.screens["drive"].stick.state == "live", "no stick")


def test_a_pushed_stick_lets_go_before_it_is_made_anew(driving: Glass, robot: FakeRobot) -> None:
    stick = driving.app.screens["drive"].stick
    touch = driving.hold(stick)
    touch.touch_move(stick.center_x, stick.top - 10)
    driving.until(lambda: any(twist.linear.x > 0.05 for twist in robot.twists()), "does not drive")
    anew(driving, "units", "imperial")
    assert (stick.finger, stick.twist) == (None, Twist())
    driving.until(lambda: robot.twists()[-1].linear.x == 0.0, "goes on driving")
    touch.touch_move(stick.center_x, stick.top - 5)
    driving.stage.frames(5)
    assert robot.twists()[-1].linear.x == 0.0, "a finger that was there before drives nothing"
    touch.touch_up()


def test_every_control_lets_go_before_another_hand_holds_them(
    driving: Glass, robot: FakeRobot, monkeypatch: pytest.MonkeyPatch
) -> None:
    app, stick, seen = driving.app, driving.app.screens["drive"].stick, list[object]()
    take_up = Hand.take_up
    monkeypatch.setattr(
        Hand, "take_up", lambda one: (seen.append((stick.finger, stick.twist, app.inputs.held)), take_up(one))
    )
    touch = driving.hold(stick)
    touch.touch_move(stick.center_x, stick.top - 10)
    driving.until(lambda: any(twist.linear.x > 0.05 for twist in robot.twists()), "does not drive")
    anew(driving, "units", "imperial")
    assert seen == [(None, Twist(), False)]
    touch.touch_up()


def test_stop_is_there_and_stops_after_it(driving: Glass, robot: FakeRobot) -> None:
    anew(driving, "text", 2.0)
    driving.tap(driving.app.shell.stop)
    driving.until(lambda: "/stop" in robot.services(), "not stopped")


def test_an_order_that_is_being_written_is_not_lost(driving: Glass, robot: FakeRobot) -> None:
    app = driving.app
    robot.know(Place(id=1, name="Lab", x=1.0, y=2.0))
    app.show("tasks")
    app.screens["tasks"].begin("follow_heading")
    app.screens["tasks"].pane.form.set(speed=0.3, duration=120.0)
    anew(driving, "language", "de")
    order = app.screens["tasks"].pane.order
    assert (order.task, order.speed, order.duration) == ("follow_heading", 0.3, 120.0)


def test_the_pane_in_which_it_was_chosen_stays_open(driving: Glass) -> None:
    app = driving.app
    app.show_setup("units")
    driving.stage.frames(3)
    screen = app.screens["setup"]
    driving.tap(screen.pane((HANDHELD, "units")).choices.rows["imperial"])
    driving.stage.frames(3)
    fresh = app.screens["setup"]
    assert fresh is not screen
    assert fresh.chosen == (HANDHELD, "units")
    assert fresh.pane((HANDHELD, "units")).choices.rows["imperial"].chosen


def test_without_a_robot_the_page_stays_and_the_connect_page_is_new(glass: Glass) -> None:
    app, before = glass.app, glass.app.connect
    app.show_setup("text")
    glass.stage.frames(3)
    anew(glass, "text", 1.25)
    page = app.pages.lone("setup")
    assert page.parent is app.root
    assert page.screen.chosen == (HANDHELD, "text")
    assert app.connect is not before
    while page.parent is not None:
        assert app.back()
    assert app.connect.parent is app.root
    app.say("Hello.", "info")
    assert app.connect._banner.text == "Hello."
