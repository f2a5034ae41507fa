"""Kept missions: listed, recalled over whatever was on the map, taken back, saved under a name."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from app.link.commands import Outcome
from app.missions.mission_editor import MissionEditor
from app.missions.stored_missions import MAX_NAME_LENGTH, StoredMissions
from bridge.msgs.pilothouse_msgs import (
    GetMissionsResponse,
    KeptMission,
    Mission,
    RecallMissionResponse,
    Waypoint,
)

DAY = Mission(name="Day", waypoints=[Waypoint(1.0, 1.0), Waypoint(2.0, 1.0)])
NIGHT = Mission(name="Night", waypoints=[Waypoint(5.0, 5.0)], laps=2)


class Robot:
    """What the session is to this: it notes what is asked."""

    def __init__(self) -> None:
        self.mission = MissionEditor()
        self.asked: list[tuple[str, dict[str, Any]]] = []
        self.kept = StoredMissions(self)

    def command(self, name: str, /, **fields: Any) -> None:
        self.asked.append((name, fields))

    def send_mission(self) -> None:
        self.command("mission", mission=self.mission.sending())

    def answer(self, name: str, phase: str = "accepted", /, *, answer: Any = None, **fields: Any) -> None:
        self.kept.answered(
            Outcome(name, "c", phase, "Night is the mission now.", fields=fields, answer=answer)
        )


@pytest.fixture
def robot() -> Robot:
    robot = Robot()
    robot.mission.robot_has(DAY)
    return robot


def told(robot: Robot) -> list[tuple[str, Callable[[], None]]]:
    heard: list[tuple[str, Callable[[], None]]] = []
    robot.kept.on_recalled = lambda words, undo: heard.append((words, undo))
    return heard


def recall(robot: Robot, *, first: str) -> None:
    robot.kept.recall("Night")
    if first == "mission":
        robot.mission.robot_has(NIGHT)
    robot.answer("recall", answer=RecallMissionResponse(True, ""), name="Night")
    if first == "answer":
        robot.mission.robot_has(NIGHT)


def test_what_is_kept_is_known_once_the_robot_has_answered(robot: Robot) -> None:
    changes: list[int] = []
    robot.kept.on_change = lambda: changes.append(1)
    robot.kept.ask()
    assert not robot.kept.known
    robot.answer(
        "missions", answer=GetMissionsResponse(True, names=["Day"], missions=[KeptMission("Day", points=2)])
    )
    assert [one.name for one in robot.kept.kept] == ["Day"]
    assert (robot.kept.known, changes) == (True, [1])


@pytest.mark.parametrize("first", ["mission", "answer"])
@pytest.mark.parametrize("edited", [True, False])
def test_a_recalled_mission_is_on_the_map_though_points_were_edited_there(
    robot: Robot, first: str, edited: bool
) -> None:
    heard = told(robot)
    if edited:
        robot.mission.add(9.0, 9.0)
    before = robot.mission.draft
    recall(robot, first=first)
    assert (robot.mission.draft.name, robot.mission.draft.points) == ("Night", ((5.0, 5.0),))
    assert robot.mission.state == "stored"
    assert [words for words, _ in heard] == ["Night is the mission now."]
    robot.mission.undo()
    assert robot.mission.draft == before


@pytest.mark.parametrize("edited", [True, False])
def test_undo_gives_the_robot_its_mission_back_and_the_map_what_was_on_it(robot: Robot, edited: bool) -> None:
    heard = told(robot)
    if edited:
        robot.mission.add(9.0, 9.0)
    before = robot.mission.draft
    recall(robot, first="mission")
    heard[0][1]()
    assert robot.asked[-1] == (
        "mission",
        {"mission": Mission(name="Day", waypoints=DAY.waypoints, on_intruder="report")},
    )
    assert robot.mission.draft == before


def test_a_recall_that_is_refused_changes_nothing(robot: Robot) -> None:
    heard = told(robot)
    robot.mission.add(9.0, 9.0)
    before = robot.mission.draft
    robot.kept.recall("Night")
    robot.answer("recall", "refused", name="Night")
    robot.mission.robot_has(NIGHT)  # somebody else's: it does not go before what was edited here
    assert (robot.mission.draft, heard) == (before, [])


def test_a_link_that_is_given_up_ends_a_recall(robot: Robot) -> None:
    heard = told(robot)
    robot.mission.add(9.0, 9.0)
    before = robot.mission.draft
    robot.kept.recall("Night")
    robot.kept.dropped()
    robot.mission.robot_has(NIGHT)
    assert (robot.mission.draft, heard) == (before, [])


def test_points_are_saved_under_a_name_that_the_robot_can_keep(robot: Robot) -> None:
    robot.kept.save(f"  {'N' * 80} ")
    (name, fields) = robot.asked[-1]
    assert (name, fields["mission"].name) == ("mission", "N" * MAX_NAME_LENGTH)
    assert len(fields["mission"].waypoints) == 2


def test_what_was_saved_is_listed_anew(robot: Robot) -> None:
    robot.answer("mission", mission=NIGHT)
    assert robot.asked == []
    robot.answer("missions", answer=GetMissionsResponse(True))
    robot.answer("mission", mission=NIGHT)
    assert robot.asked == [("missions", {})]


def test_it_says_what_is_missing_before_it_can_be_saved(robot: Robot) -> None:
    assert robot.kept.lacking("Night") == ""
    assert robot.kept.lacking("  ") == "Enter a name."
    robot.mission.clear()
    said = "There are no points on the map to save; set some on the mission screen."
    assert robot.kept.lacking("Night") == said


def test_who_has_left_is_told_nothing(robot: Robot) -> None:
    heard = told(robot)
    robot.kept.deaf()
    recall(robot, first="mission")
    assert heard == []
