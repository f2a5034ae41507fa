"""Missions, their revisions, and home."""

from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import Mission, Waypoint
from robotside.records import NotRecorded, Records
from robotside.records.missions import MAX_REVISIONS


@pytest.fixture
def records() -> Records:
    return Records.in_memory()


def mission(name: str = "", laps: int = 1, home: float | None = None) -> Mission:
    return Mission(
        waypoints=[Waypoint(1.0, 2.0)],
        laps=laps,
        name=name,
        home=[] if home is None else [Waypoint(home, 0.0)],
    )


def test_a_robot_without_a_mission_has_an_empty_one_and_no_home(records: Records) -> None:
    assert records.missions.current == records.missions.stored == Mission()
    assert records.missions.home is None


def test_the_mission_that_was_stored_last_is_the_stored_one(records: Records) -> None:
    records.missions.set(mission("Night", home=3.0))
    records.missions.set(mission("Day", home=4.0))
    assert records.missions.current.name == "Day"
    assert records.missions.home == Waypoint(4.0, 0.0)
    assert records.missions.names() == ["Day", "Night"]


def test_each_change_of_a_mission_is_a_revision_of_which_the_newest_are_kept(records: Records) -> None:
    for laps in range(MAX_REVISIONS + 5):
        records.missions.set(mission("Night", laps))
    kept = [revision.laps for revision in records.missions.revisions("Night")]
    assert kept == list(range(5, MAX_REVISIONS + 5))


def test_a_mission_is_recalled_as_it_was_but_with_the_home_of_now(records: Records) -> None:
    records.missions.set(mission("Night", 3, home=1.0))
    records.missions.set(mission("Day", 1, home=2.0))
    found = records.missions.recall("Night")
    assert (found.name, found.laps, found.home) == ("Night", 3, [Waypoint(2.0, 0.0)])


@pytest.mark.parametrize("name", ["", "Noon"])
def test_an_unknown_mission_is_refused_with_the_names_there_are(records: Records, name: str) -> None:
    records.missions.set(mission("Night"))
    records.missions.set(mission(""))
    with pytest.raises(NotRecorded, match=f"There is no mission '{name}'; there are: Night."):
        records.missions.recall(name)


def test_names_are_bounded(records: Records, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("robotside.records.missions.MAX_MISSIONS", 1)
    records.missions.set(mission("Night"))
    records.missions.set(mission("Night"))
    with pytest.raises(NotRecorded, match="At most 1 missions"):
        records.missions.set(mission("Day"))
