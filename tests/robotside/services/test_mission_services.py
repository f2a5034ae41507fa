"""How many points a mission may have, and where they may be."""

from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import Mission, SetMissionRequest, Waypoint
from tests.robotside.scene import Scene


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
