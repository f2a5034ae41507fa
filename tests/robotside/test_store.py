"""What is remembered while the robot is off."""

from __future__ import annotations

import math
import os
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import Mission, Waypoint
from bridge.msgs.std_msgs import Time
from robotside.store import Left, Store

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


def test_how_it_was_left_is_read_back(tmp_path: Path) -> None:
    assert Store(tmp_path).left() == Left()
    Store(tmp_path).leave(Left("Anna", "Patrol"))
    assert Store(tmp_path).left() == Left("Anna", "Patrol")


@pytest.mark.parametrize("damage", [b"", b"{", b'{"stopped_by": 1}', b"\xff"])
def test_a_damaged_note_of_how_it_was_left_counts_as_stop_pressed(tmp_path: Path, damage: bytes) -> None:
    (tmp_path / "left.json").write_bytes(damage)
    assert Store(tmp_path).left() == Left("somebody")


def test_what_cannot_be_written_leaves_the_old_file_and_nothing_else(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = Store(tmp_path)
    store.save(MISSION)

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        store.save(Mission())
    assert [path.name for path in tmp_path.iterdir()] == ["mission.json"]
    assert store.load()[0].motion == "random"


@pytest.mark.parametrize("damage", [b"", b"{", b'{"laps": "many"}', b"\xff\xfe", b"[]"])
def test_a_damaged_file_is_set_aside_and_said(tmp_path: Path, damage: bytes) -> None:
    (tmp_path / "mission.json").write_bytes(damage)
    mission, problem = Store(tmp_path).load()
    assert mission == Mission()
    assert problem.startswith("The stored mission was damaged and is set aside as mission.damaged.json")
    assert (tmp_path / "mission.damaged.json").read_bytes() == damage
    assert Store(tmp_path).load() == (Mission(), "")
