"""What is remembered while the robot is off."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import Mission, Waypoint
from bridge.msgs.std_msgs import Time
from robotside.store import Store

MISSION = Mission(
    Time(5), [Waypoint(1.0, 2.0), Waypoint(3.0, 4.0, 0.5, "gate")], [Waypoint(0.0, 0.0)], "random"
)


def test_a_stored_mission_is_read_back_with_everything_that_is_not_known(tmp_path: Path) -> None:
    Store(tmp_path / "state").save(MISSION)
    mission, problem = Store(tmp_path / "state").load()
    assert problem == ""
    assert math.isnan(mission.waypoints[0].yaw)
    assert (mission.waypoints[1], mission.home, mission.motion) == (
        MISSION.waypoints[1],
        MISSION.home,
        "random",
    )


def test_a_robot_without_a_stored_mission_has_an_empty_one(tmp_path: Path) -> None:
    assert Store(tmp_path).load() == (Mission(), "")


def test_saving_leaves_nothing_but_the_file(tmp_path: Path) -> None:
    store = Store(tmp_path)
    store.save(MISSION)
    store.save(Mission())
    assert [path.name for path in tmp_path.iterdir()] == ["mission.json"]


@pytest.mark.parametrize("damage", [b"", b"{", b'{"laps": "many"}', b"\xff\xfe", b"[]"])
def test_a_damaged_file_is_set_aside_and_said(tmp_path: Path, damage: bytes) -> None:
    (tmp_path / "mission.json").write_bytes(damage)
    mission, problem = Store(tmp_path).load()
    assert mission == Mission()
    assert problem.startswith("The stored mission was damaged and is set aside as mission.damaged.json")
    assert (tmp_path / "mission.damaged.json").read_bytes() == damage
    assert Store(tmp_path).load() == (Mission(), "")
