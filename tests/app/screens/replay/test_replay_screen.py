"""The replay screen under fingers: with a robot of now, and without one."""

from __future__ import annotations

import io
import math
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from app.replay.player import Player
from app.screens.replay.moment_view import MomentView
from app.screens.replay.screen import ReplayScreen
from bridge.msgs.geometry_msgs import Twist
from tests.app.fakes import FakeRobot
from tests.app.glass import PATIENCE, Glass
from tests.app.replay.made import START, recorded
from widgets.core.quantities import quantities

NAME = "2025-11-21_10-01-11.mcap"


def jpeg() -> bytes:
    file = io.BytesIO()
    Image.new("RGB", (64, 48), (200, 30, 30)).save(file, "JPEG")
    return file.getvalue()


def kept(glass: Glass) -> Path:
    """A recording where the app has its own."""
    folder = glass.app.records._folder / "recordings"
    return recorded(folder / NAME, pieces=4000, picture=jpeg())


def opened(glass: Glass, screen: Any) -> None:
    glass.until(lambda: NAME in screen.list.rows, "the recording is not in the list")
    glass.until(lambda: "Patrol-1" in screen.list.rows[NAME].title, "nobody looked into it")
    glass.tap(screen.list.rows[NAME])
    glass.until(lambda: screen.view.parent is screen, "it does not open")


def test_without_a_robot_a_recording_is_found_opened_and_played(glass: Glass) -> None:
    kept(glass)
    app = glass.app
    glass.tap(app.connect.ids.recordings)
    page = app.pages.lone("replay")
    glass.until(lambda: page.parent is not None, "the recordings are not on the glass")
    screen = page.screen
    assert isinstance(screen, ReplayScreen)
    opened(glass, screen)
    row = "Patrol-1 · 0:10"
    assert screen.title == row
    assert screen.badge.startswith("REPLAY · 2025-11-21")
    view = screen.view
    glass.until(lambda: math.isfinite(view.map.robot[0]), "no pose")
    glass.until(lambda: len(view.plots.traces[0].history) == 101, "no plot")
    glass.until(lambda: view.video.state == "live", "no picture")
    glass.tap(screen.transport.play)
    glass.until(lambda: screen.player.position > START + 1.2, "it does not play")
    glass.tap(screen.transport.play)
    assert not screen.player.playing
    glass.until(lambda: view.events.count == 1, "no event")
    glass.tap(screen.transport.after)
    assert round(screen.player.position - START) == 3
    glass.until(lambda: len(view.map.trail) > 20, "no trail")
    line = screen.line
    glass.stage.drag([(line.x_of(START + 3.0), line.center_y), (line.x_of(START + 8.0), line.center_y)])
    assert abs(screen.player.position - START - 8.0) < 0.1
    glass.until(lambda: view.events.count == 4, "the events of then")
    glass.tap(screen.transport.before)
    glass.until(lambda: view.events.count == 4, "the event of that moment is there")
    assert app.back()
    assert screen.player is None
    while page.parent is not None:
        assert app.back()
    assert app.connect.parent is not None
    page.tick()


def test_a_number_is_chosen_and_drawn_and_taken_away(glass: Glass) -> None:
    kept(glass)
    glass.app._show_anywhere("replay")
    screen = glass.app.pages.lone("replay").screen
    opened(glass, screen)
    glass.tap(screen.ids.choose)
    screen.chooser.search.text = "pose position.x"
    glass.stage.frames(3)
    key = ("/pose", "pose.pose.position.x")
    glass.tap(screen.chooser.rows[key])
    assert key in screen.view.drawn
    glass.until(lambda: len(screen.view.plots.find(*key).history) == 101, "no line")
    assert screen.view.plots.plots[0].cursor == screen.view.plots.plots[-1].cursor
    glass.tap(screen.chooser.rows[key])
    assert screen.view.plots.find(*key) is None
    assert glass.app.back()
    assert screen.chooser is None
    assert screen.player is not None
    screen.leave()
    screen.leave()
    screen.enter()
    glass.until(lambda: screen.view.parent is screen, "it is not open again")
    screen.end()


def test_nothing_of_the_past_reaches_the_robot_of_now_and_stop_does(glass: Glass, robot: FakeRobot) -> None:
    kept(glass)
    app = glass.app
    app.open(robot.url)
    glass.drives()
    app.show("replay")
    screen = app.screens["replay"]
    opened(glass, screen)
    glass.stage.frames(10)
    asked, heard = len(robot.asked), len(robot.heard)
    screen.set_speed(20.0)
    for widget in (
        screen.transport.play,
        screen.transport.after,
        screen.transport.before,
        screen.line,
        screen.view.map,
        screen.view.video,
        screen.view.events,
        screen.view.plots.plots[0],
    ):
        glass.tap(widget)
        glass.stage.frames(10)
    glass.until(lambda: screen.player.position > START + 2.0, "it does not play")
    assert robot.services()[asked:] == []
    assert all(one == Twist() for topic, one in robot.heard[heard:] if topic == "/cmd_vel")
    assert {topic for topic, _ in robot.heard[heard:]} <= {"/cmd_vel"}
    glass.tap(app.shell.stop)
    glass.until(lambda: "/stop" in robot.services(), "STOP did not reach the robot")


def test_a_notice_covers_nothing_of_the_list_nor_of_the_sentence_that_stands_in_its_place(
    driving: Glass,
) -> None:
    app, before = driving.app, tuple(driving.stage.window.size)
    try:
        for size in ((412, 892), (892, 412), (1280, 800)):
            driving.stage.window.size = app.root.size = size
            app.show("replay")
            driving.stage.frames(4)
            app.shell.say("Control lapsed 4 times, last after 2 s without contact.", "warn")
            driving.stage.frames(4)
            listed = app.screens["replay"].ids.listed
            assert app.shell.notices.height > 20
            assert listed.y >= app.shell.notices.top or listed.x < 0, size
            app.shell.notices.hush()
            driving.until(lambda one=listed: one.x >= 0 and one.y < app.shell.notices.top + 40, "it stays")
    finally:
        driving.stage.window.size = app.root.size = before


def test_without_recordings_there_is_a_way_to_open_a_file_and_none_to_record_nobody(
    glass: Glass, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    elsewhere = recorded(tmp_path / "elsewhere" / NAME, pieces=4000, picture=jpeg())
    glass.tap(glass.app.connect.ids.recordings)
    page = glass.app.pages.lone("replay")
    glass.until(lambda: page.parent is not None, "the recordings are not on the glass")
    nothing = page.screen.list.nothing
    glass.until(lambda: nothing.parent is not None, "nothing is said")
    assert nothing.ids.words.text == "No recordings yet. Connect to a robot to make one."
    assert nothing.ids.record.disabled
    assert nothing.ids.record.height == 0
    monkeypatch.setattr(nothing, "_picking", Picks([elsewhere]))
    glass.tap(nothing.ids.open)
    glass.until(lambda: page.screen.view.parent is page.screen, "it does not open")
    assert page.screen.opened == NAME


def test_the_first_recording_of_a_robot_begins_and_ends_where_the_list_is_empty(driving: Glass) -> None:
    app = driving.app
    app.show("replay")
    nothing = app.screens["replay"].list.nothing
    driving.until(lambda: nothing.parent is not None, "nothing is said")
    driving.tap(nothing.ids.record)
    assert app.records.recorder is not None
    assert nothing.ids.record.text == "Stop recording"
    driving.tap(nothing.ids.record)
    assert app.records.recorder is None


class Picks:
    """A way to choose a file, by which these are chosen at once."""

    def __init__(self, paths: list[Path]) -> None:
        self.paths = paths

    def pick(self, into: Path, done: Any) -> None:
        done(self.paths, "")


def test_plots_are_in_the_units_of_the_glass(
    tmp_path: Path, stage: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(quantities, "system", "imperial")
    player, view = Player(recorded(tmp_path / "run.mcap"), lambda: 0.0), MomentView()
    try:
        waited = time.monotonic() + PATIENCE
        while not (view.plots.traces and len(view.plots.traces[0].history)):
            assert time.monotonic() < waited
            stage.frames(1)
            player.drain()
            if player.index is not None and view.player is None:
                view.open(player)
        speed, turning = view.plots.plots
        assert (speed.traces[0].unit, turning.traces[0].unit) == ("mph", "rad/s")
        most = np.nanmax(speed.traces[0].history.values)
        assert most == pytest.approx(9.0 / 0.44704), "9 m/s, the spike of the recording"
    finally:
        view.close()
        view.map.close()
        player.close()
