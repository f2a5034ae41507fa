"""A whole patrol by two keys: from the list of robots to STOP and its release, against a real robot side."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from examples.demo.robot import RobotProcess
from tests.e2e.handheld import handheld
from tests.e2e.two_switches import TwoSwitches

POINTS = ((-4.0, -7.4), (6.0, -6.6))
"""On the southern aisle of the car park [m]."""
NAME = "ea"
"""Two letters that are few steps away."""
NEAR = 0.6
"""A fine step of the cross comes so near on a map that shows the whole car park [m]."""


def test_a_patrol_is_planned_started_paused_stopped_and_released_by_two_keys(
    robot: RobotProcess, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # nothing here looks at the camera's picture, and it takes most of the time where no graphics card draws it
    monkeypatch.setattr("app.session.picture_feed.PictureFeed.watch", lambda *_: None)
    (tmp_path / "settings.json").write_text(json.dumps({"robots": [{"url": robot.url}]}))
    with handheld(tmp_path, discover=False) as glass:
        app, keys = glass.app, TwoSwitches(glass)

        glass.settle(glass.one("RobotCard"))
        keys.find(lambda target: target.words.startswith("Connect"), "the robot's card")
        glass.until(lambda: app.shell is not None, "the robot's screens")
        glass.control()

        keys.choose("Mission", within="Screens")
        glass.until(lambda: app.session.feeds.latest("/map") is not None, "a map")
        keys.choose("Points", within="Choice")
        keys.find(lambda target: target.key is app.screens["mission"].map, "the map")
        for count, place in enumerate(POINTS, 1):
            keys.point(*place)
            glass.until(lambda count=count: len(app.session.mission.draft.points) == count, f"point {count}")
        keys.choose("Left")
        keys.choose("Set or choose here")
        keys.choose("Undo")
        glass.until(
            lambda: len(app.session.mission.draft.points) == len(POINTS), "the third point taken back"
        )
        for set_, meant in zip(app.session.mission.draft.points, POINTS, strict=True):
            assert math.dist(set_, meant) < NEAR
        keys.choose("Done")

        keys.choose("Tasks", within="Screens")
        keys.choose("Places", within="Pages")
        keys.choose("Missions", within="Choice")
        keys.choose("Save under a name")
        keys.choose("Name")
        for letter in NAME:
            keys.choose(letter)
        keys.choose("Done")
        keys.update()
        keys.choose("Save")
        glass.until(lambda: app.session.missions.kept, "the mission at the robot")
        assert [kept.name for kept in app.session.missions.kept] == [NAME]
        keys.choose("Mission", within="Screens")

        keys.update()
        keys.find(lambda target: target.intent == "start", "start")
        glass.until(lambda: app.session.running, "a patrol")
        keys.update()
        keys.choose("Pause")
        glass.until(lambda: app.session.control_status.mode == "PAUSED", "a pause")
        keys.update()
        keys.find(lambda target: target.intent == "resume", "resume")
        glass.until(lambda: app.session.control_status.mode == "AUTO", "that it goes on")

        keys.both()
        glass.until(lambda: app.shell.stop.phase == "stopped", "STOPPED on the button")
        keys.choose("Release STOP")
        keys.update()
        keys.choose("Release STOP")  # asked once more, since no finger stays on it
        glass.until(lambda: not app.session.robot_stop.latched, "STOP to be released")
        assert app.screens["mission"].mode == "view", (
            "a press on the map of a robot that was set going draws nothing"
        )
        keys.choose("Back", within="Top bar")
        keys.update()
        keys.choose("Leave")  # its patrol waits, so that it is asked first
        glass.until(lambda: app.shell is None, "the list of robots")
        assert keys.presses < 500
