"""What a phone does to the app, told by the events that SDL sends it, through Kivy's own handling of them, in a phone's order.

docs/android.md has the table with its sources.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from kivy.app import App
from kivy.cache import Cache
from kivy.core.window import Window

from app.core import low_memory, returning
from bridge.msgs.geometry_msgs import Twist
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass, running
from tests.headless import Stage

AWAY = "app_willenterbackground"
GONE = "app_didenterbackground"
COMING = "app_willenterforeground"
BACK = "app_didenterforeground"
ENDING = "app_terminating"


@pytest.fixture
def sdl(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Sends the app what SDL tells Kivy's window."""
    from kivy.core.window.window_sdl2 import WindowSDL

    monkeypatch.setattr(Window, "_pause_loop", False, raising=False)

    def send(app: Any, *events: str) -> None:
        monkeypatch.setattr(App, "_running_app", app)
        for event in events:
            WindowSDL._event_filter(Window, event)

    return send


def push(glass: Glass, robot: FakeRobot) -> Any:
    stick = glass.app.screens["drive"].stick
    touch = glass.hold(stick)
    touch.touch_move(stick.center_x, stick.top - 10)
    glass.until(lambda: any(twist.linear.x > 0.1 for twist in robot.twists()), "the robot heard no push")
    return touch


@pytest.mark.parametrize(
    "events",
    [(AWAY,), (AWAY, GONE), (GONE, AWAY)],
    ids=["a call over it", "Home and screen off", "an order no phone has"],
)
def test_the_robot_is_told_to_rest_before_the_link_is_closed(
    driving: Glass, robot: FakeRobot, sdl, events, monkeypatch
):
    push(driving, robot)
    link, stick, order = driving.app.session.link, driving.app.screens["drive"].stick, []
    close = link.close
    monkeypatch.setattr(link, "close", lambda *given: (order.append(stick.twist), close(*given)))
    sdl(driving.app, *events)
    assert order[:1] == [Twist()], "the stick had let go when the link was closed"
    driving.until(lambda: robot.twists()[-1] == Twist(), "the robot was not told to rest")
    driving.until(lambda: not driving.app.session.connected, "still connected")


def test_every_control_has_let_go_before_anything_else_is_done(
    driving: Glass, robot: FakeRobot, sdl, monkeypatch
):
    push(driving, robot)
    app, stick, held = driving.app, driving.app.screens["drive"].stick, {}

    def noting(owner, step):
        do = getattr(owner, step)

        def note(*given, **named):
            held.setdefault(f"{type(owner).__name__}.{step}", stick.twist)
            return do(*given, **named)

        monkeypatch.setattr(owner, step, note)

    noting(app.methods, "pause")
    noting(app.corner, "leave")
    noting(app.visit, "suspend")
    noting(app.records, "stop")
    noting(app.returning, "put_away")
    noting(app.collector, "pause")
    sdl(app, AWAY)
    assert len(held) == 6, held
    assert {step: twist for step, twist in held.items() if twist != Twist()} == {}


def test_back_on_the_glass_it_connects_again_and_a_finger_from_before_drives_nothing(
    driving: Glass, robot: FakeRobot, sdl
):
    touch = push(driving, robot)
    sdl(driving.app, AWAY, GONE)
    driving.until(lambda: not driving.app.session.connected, "still connected")
    sdl(driving.app, COMING, BACK)
    driving.until(lambda: driving.app.session.connected, "did not come back")
    told = len(robot.twists())
    touch.touch_move(driving.app.screens["drive"].stick.center_x, 5)
    driving.stage.run_for(0.5)
    assert all(twist == Twist() for twist in robot.twists()[told:])
    assert driving.app.shell.screen == "drive"
    touch.touch_up()


def test_the_phones_wifi_is_kept_awake_only_while_a_robot_is_on_the_glass(driving: Glass, sdl, monkeypatch):
    done: list[str] = []
    wifi = driving.app.visit._wifi
    monkeypatch.setattr(wifi, "hold", lambda: done.append("hold"))
    monkeypatch.setattr(wifi, "let_go", lambda: done.append("let go"))
    sdl(driving.app, AWAY, GONE, COMING, BACK)
    driving.until(lambda: driving.app.session.connected, "did not come back")
    driving.app.leave()
    assert done == ["let go", "hold", "let go"]


def test_coming_back_without_having_been_away_does_nothing(driving: Glass, sdl):
    link = driving.app.session.link
    sdl(driving.app, COMING, BACK)
    assert driving.app.session.link is link


@pytest.mark.parametrize("size", [(892, 412), (412, 892), (600, 412), (1280, 400)])
def test_a_turn_or_another_app_beside_it_leaves_link_and_stick_alone(driving: Glass, robot: FakeRobot, size):
    window, root = driving.stage.window, driving.app.root
    before = window.size
    try:
        window.size = root.size = size
        driving.stage.frames(3)
        assert driving.app.session.connected
        assert driving.app.shell.size == list(size)
        assert 0 < driving.app.shell.stop.x < driving.app.shell.stop.right <= size[0]
    finally:
        window.size = root.size = before


def test_short_of_memory_it_gives_back_what_can_be_made_again_and_nothing_changes_on_the_glass(
    driving: Glass, sdl
):
    Cache.append("kv.texture", "of a test", object())
    before = [type(widget) for widget in driving.app.root.walk()]
    sdl(driving.app, "app_lowmemory")
    assert Cache.get("kv.texture", "of a test") is None
    assert [type(widget) for widget in driving.app.root.walk()] == before
    assert driving.app.session.connected


def test_kivy_has_the_stores_that_are_given_back():
    assert set(low_memory.KEPT_BY_KIVY) <= {*Cache._categories, "kv.loader"}


# ended while it was away


def draws_and_goes_away(glass: Glass, robot: FakeRobot, sdl) -> None:
    app = glass.app
    app.open(robot.url)
    glass.until(lambda: app.shell is not None and app.session.robot.introduced, "no screens")
    app.show("mission")
    app.screens["mission"].mode = "points"
    app.screens["mission"].map.dispatch("on_add", 3.0, 4.0)
    sdl(app, AWAY, GONE)


@pytest.fixture
def died(stage: Stage, robot: FakeRobot, sdl, tmp_path: Path) -> Path:
    """The folder of an app that was put away amid a mission and then ended without a word; what was in it by then."""
    with running(stage, tmp_path) as glass:
        draws_and_goes_away(glass, robot, sdl)
        at_death = (tmp_path / "settings.json").read_bytes()
    (tmp_path / "settings.json").write_bytes(at_death)
    return tmp_path


def test_ended_while_away_it_begins_where_it_was_with_the_half_made_mission(
    died: Path, stage: Stage, robot: FakeRobot
):
    with running(stage, died) as glass:
        glass.until(
            lambda: glass.app.shell is not None and glass.app.session.mission.draft.points, "no mission"
        )
        assert [point[:2] for point in glass.app.session.mission.draft.points] == [(3.0, 4.0)]
        assert glass.app.shell.screen == "mission"
        glass.until(lambda: returning.ENDED in glass.banners(), glass.banners())
        assert not any(twist != Twist() for twist in robot.twists())


@pytest.mark.parametrize("watched", [False, True])
def test_who_only_watched_goes_back_to_watch(
    stage: Stage, robot: FakeRobot, sdl, tmp_path: Path, watched: bool
):
    with running(stage, tmp_path) as glass:
        glass.app.open(robot.url, watch=watched)
        glass.until(lambda: glass.app.shell is not None, "no screens")
        sdl(glass.app, AWAY, GONE)
        at_death = (tmp_path / "settings.json").read_bytes()
    (tmp_path / "settings.json").write_bytes(at_death)
    with running(stage, tmp_path) as glass:
        assert glass.app.session.authority.wanted is not watched


def test_a_robot_that_is_named_at_the_start_is_the_one_that_is_opened(
    died: Path, stage: Stage, robot: FakeRobot
):
    settings = json.loads((died / "settings.json").read_text())
    assert settings["put_away"]["url"] == robot.url
    from app.application import PilothouseApp

    app = PilothouseApp("ws://127.0.0.1:9", settings_dir=died, discover=False, tour=True)
    app.root = app.build()
    app.on_start()
    try:
        assert app.session.link.url == "ws://127.0.0.1:9"
        assert app.settings.get("put_away") is None
        assert app._tour is None, "nobody asked to be shown round"
    finally:
        app.on_stop()


def test_it_goes_back_once(died: Path, stage: Stage, robot: FakeRobot):
    with running(stage, died) as glass:
        glass.until(lambda: glass.app.shell is not None, "no screens")
    with running(stage, died) as glass:
        assert glass.app.session is None


def test_a_robot_that_is_gone_by_then_is_a_sentence_and_the_list(died: Path, stage: Stage, robot: FakeRobot):
    robot.stop()
    with running(stage, died) as glass:
        glass.until(
            lambda: glass.app.connect._banner and "No robot answers" in glass.app.connect._banner.text,
            "silent",
        )


def test_who_leaves_the_robot_or_comes_back_to_it_begins_anew(
    stage: Stage, robot: FakeRobot, sdl, tmp_path: Path
):
    with running(stage, tmp_path) as glass:
        draws_and_goes_away(glass, robot, sdl)
        sdl(glass.app, COMING, BACK)
        glass.until(lambda: glass.app.session.connected, "did not come back")
    with running(stage, tmp_path) as glass:
        assert glass.app.session is None


@pytest.mark.parametrize(
    "kept",
    [
        {"url": "ws://127.0.0.1:1", "screen": "drive", "at": 1e12},
        {"url": "ws://127.0.0.1:1", "screen": "drive", "at": 0},
        {"url": "ws://127.0.0.1:1", "screen": "cellar", "at": "now"},
        {"url": "ws://127.0.0.1:1", "screen": "cellar"},
        {"url": "file:///etc/passwd", "screen": "drive"},
        {"url": "ws://" + "a" * 400, "screen": "drive"},
        {"url": 7},
        ["ws://127.0.0.1:1"],
    ],
    ids=["a clock set back", "too long ago", "no time", "no such screen", "no robot", "too long", "no text", "no table"],
)  # fmt: skip
def test_what_this_app_would_not_have_kept_is_nowhere_to_go_back_to(stage: Stage, tmp_path: Path, kept: Any):
    import time

    if isinstance(kept, dict):
        kept.setdefault("at", time.time())
    (tmp_path / "settings.json").write_text(json.dumps({"put_away": kept}))
    with running(stage, tmp_path) as glass:
        glass.stage.frames(3)
        assert glass.app.session is None
        assert glass.app.settings.get("put_away") is None


def test_ended_by_the_system_in_the_foreground_every_thread_ends_and_the_robot_rests(
    driving: Glass, robot: FakeRobot, sdl, monkeypatch
):
    from kivy.base import EventLoop

    monkeypatch.setattr(EventLoop, "quit", False)
    push(driving, robot)
    sdl(driving.app, ENDING)
    assert EventLoop.quit, "Kivy's loop ends, and stops the app"
    driving.app.leave()
    driving.until(lambda: robot.twists()[-1] == Twist(), "the robot was not told to rest")
