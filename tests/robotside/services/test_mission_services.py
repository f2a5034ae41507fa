"""How many points a mission may have, and where and how high they may be."""

from __future__ import annotations

import math
from pathlib import Path

import msgspec
import pytest

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import (
    Mission,
    RecallMissionRequest,
    SetMissionRequest,
    Waypoint,
)
from tests.fakes import FakeRobot
from tests.robotside.scene import SQUARE, Scene


class Levelled(FakeRobot):
    """One that keeps a height, between the two of `heights` [m]."""

    def __init__(self, kind: str, heights: tuple[float, float]) -> None:
        super().__init__()
        self.info = msgspec.structs.replace(self.info, kind=kind)
        self.heights = heights


def at(height: float, name: str = "", **words: object) -> SetMissionRequest:
    points = [Waypoint(1.0, 1.0, height=height)]
    return SetMissionRequest(mission=Mission(name=name, waypoints=points, **words))  # type: ignore[arg-type]


def asked(count: int) -> SetMissionRequest:
    return SetMissionRequest(mission=Mission(waypoints=[Waypoint(1.0, 1.0)] * count))


@pytest.mark.parametrize("count", [499, 500])
def test_a_mission_of_five_hundred_points_is_kept(scene: Scene, count: int) -> None:
    assert scene.ask("/mission/set", asked(count)).success
    assert len(scene.station.records.missions.stored.waypoints) == count


def test_one_point_more_is_refused_and_the_mission_before_stays(scene: Scene) -> None:
    assert scene.ask("/mission/set", asked(2)).success
    assert scene.refused("/mission/set", asked(501)) == "A mission has at most 500 points, not 501."
    assert len(scene.station.records.missions.stored.waypoints) == 2


def test_a_mission_with_a_point_off_the_map_is_refused_whole(scene: Scene) -> None:
    mission = Mission(waypoints=[Waypoint(1.0, 1.0), Waypoint(99.0, 0.0)])
    said = scene.refused("/mission/set", SetMissionRequest(mission=mission))
    assert said.startswith("Point 2 at (99.0, 0.0) is off the map")
    assert scene.station.records.missions.stored.waypoints == []


@pytest.mark.parametrize(
    ("kind", "heights", "height", "said"),
    [
        ("quadrotor", (0.05, 22.04), 1e308, "at point 1 must be from 0.3 to 22 m, not 1e+308 m."),
        ("quadrotor", (0.05, 22.04), math.inf, "at point 1 must be from 0.3 to 22 m, not inf m."),
        ("quadrotor", (0.05, 22.04), -5.0, "at point 1 must be from 0.3 to 22 m, not -5 m."),
        ("hexapod", (-4.0, 0.0), 2.0, "at point 1 must be from -4 to 0 m, 0 being the surface, not 2 m."),
        ("wheels", (-math.inf, math.inf), 2.0, "Fake-1 keeps no height; leave it out at point 1."),
    ],
)
def test_a_height_that_the_robot_cannot_be_at_is_refused_when_the_mission_is_set(
    kind: str, heights: tuple[float, float], height: float, said: str, tmp_path: Path
) -> None:
    scene = Scene(Levelled(kind, heights), tmp_path)
    scene.run(0.5)
    answer = scene.ask("/mission/set", at(height))
    assert not answer.success
    assert answer.message.endswith(said)
    home = at(math.nan, home=[Waypoint(1.0, 0.0, height=height)])
    assert "home" in scene.refused("/mission/set", home)
    assert scene.station.records.missions.stored.waypoints == []
    assert scene.ask("/mission/set", at(math.nan)).success


def test_a_running_patrol_stays_as_it_was_when_a_height_is_refused_set_or_recalled(scene: Scene) -> None:
    scene.run(0.5)
    scene.station.records.missions.set(at(40.0, "tower").mission, lambda: None)  # kept before
    scene.set(*SQUARE)
    scene.start()
    scene.run(0.5)
    answer = scene.ask("/mission/set", at(2.0))
    assert (answer.success, answer.code) == (False, Code.HEIGHT_UNUSED)
    assert "keeps no height" in scene.refused("/mission/recall", RecallMissionRequest(name="tower"))
    scene.run(5.0)
    assert len(scene.station.records.missions.stored.waypoints) == len(SQUARE)
    assert (scene.task.state, scene.task.waypoints) == ("RUNNING", len(SQUARE))
    assert not any("new mission" in said for said in scene.events("task"))


def test_a_class_of_intruders_that_is_named_again_and_again_is_kept_once(scene: Scene) -> None:
    mission = Mission(waypoints=[Waypoint(1.0, 1.0)], intruder_classes=["person", "car"] * 5000)
    assert scene.ask("/mission/set", SetMissionRequest(mission=mission)).success
    assert scene.station.records.missions.stored.intruder_classes == ["person", "car"]
