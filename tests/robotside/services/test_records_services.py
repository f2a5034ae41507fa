"""Places, missions, history and events, by services."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import msgspec
import pytest

from app.missions import tasking
from app.session import logbook
from bridge.msgs.arrays import Int32Array
from bridge.msgs.pilothouse_msgs import (
    AcknowledgeEventsRequest,
    CommandRequest,
    DeletePlaceRequest,
    Event,
    GetHistoryRequest,
    GetMissionsRequest,
    Place,
    RecallMissionRequest,
    SetPlaceRequest,
    StartTaskRequest,
    TaskOrder,
    Waypoint,
)
from tests.fakes import Box, FakeRobot
from tests.robotside.scene import SQUARE, Scene


def office(**words: Any) -> SetPlaceRequest:
    return SetPlaceRequest(place=msgspec.structs.replace(Place(name="Office 12", x=4.0, y=2.0), **words))


def places(scene: Scene) -> list[Place]:
    return scene.station.bus.last("/places").places  # type: ignore[union-attr]


def test_a_place_is_kept_shown_changed_and_forgotten(scene: Scene) -> None:
    assert places(scene) == []
    answer: Any = scene.ask("/places/set", office())
    assert (answer.success, answer.message, answer.id) == (True, "Office 12 is saved.", 1)
    scene.ask("/places/set", office(id=1, x=5.0))
    assert [place.x for place in places(scene)] == [5.0]
    assert scene.ask("/places/delete", DeletePlaceRequest(id=1)).message == "Office 12 is forgotten."
    assert places(scene) == []


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ({"x": 9.95}, "Office 12"),
        ({"x": 500.0}, "Office 12"),
        ({"name": ""}, "A place needs a name."),
        ({"id": 9}, "There is no place with the number 9."),
        ({"kind": "moon"}, "There is no kind of place 'moon'"),
    ],
)
def test_a_place_where_it_cannot_stand_or_that_is_none_is_refused(
    scene: Scene, words: dict[str, Any], said: str
) -> None:
    assert scene.refused("/places/set", office(**words)).startswith(said)
    assert places(scene) == []


@pytest.mark.parametrize("walled", [False, True])
def test_a_dock_before_which_a_trucks_body_has_no_room_is_refused(tmp_path: Path, walled: bool) -> None:
    """5 m before it its rear axle has 1.6 m of room, and its front would stand in the wall."""
    robot = FakeRobot(boxes=[Box(-3.0, -2.4, 3.0, -1.0)] if walled else [])
    robot.info = msgspec.structs.replace(robot.info, kind="ackermann", radius=2.6, min_radius=3.5)
    scene = Scene(robot, tmp_path)
    scene.run(4.0)
    dock = Place(name="Dock", kind="dock", x=0.3, y=1.0, yaw=math.pi / 2)
    order = StartTaskRequest(order=TaskOrder(task="dock"))
    if walled:
        said = scene.refused("/places/set", SetPlaceRequest(place=dock))
        assert said.startswith("The place before Dock at (0.3, -3.0) is 0.")
        assert places(scene) == []
        scene.station.records.places.set(dock)  # kept from another map
        assert scene.refused("/task/start", order) == said
    else:
        assert scene.ask("/places/set", SetPlaceRequest(place=dock)).success
        assert scene.ask("/task/start", order).success


def test_who_does_not_drive_changes_no_places_while_somebody_does(scene: Scene) -> None:
    scene.ask("/control/acquire", CommandRequest(client_name="Anna"))
    bert = scene.client("bert")
    assert scene.refused("/places/set", office(), bert).startswith("Anna has control")
    assert scene.refused("/places/delete", DeletePlaceRequest(id=1), bert).startswith("Anna has control")
    assert scene.ask("/places/set", office()).success


def test_a_mission_is_recalled_by_its_name_and_is_the_stored_one_then(scene: Scene) -> None:
    scene.set(*SQUARE, name="Night", laps=2)
    scene.set(Waypoint(1.0, 1.0), name="Day", home=[Waypoint(2.0, 2.0)])
    names: Any = scene.ask("/missions/get", GetMissionsRequest())
    assert names.names == ["Day", "Night"]
    assert [(one.name, one.points, one.motion, one.revisions) for one in names.missions] == [
        ("Day", 1, "loop", 1),
        ("Night", 3, "loop", 1),
    ]
    assert all(one.stamp.seconds > 0 for one in names.missions)
    assert (
        scene.ask("/mission/recall", RecallMissionRequest(name="Night")).message
        == "Night is the mission now."
    )
    shown: Any = scene.station.bus.last("/mission")
    assert (shown.name, shown.laps, len(shown.waypoints), shown.home[0].x) == ("Night", 2, 3, 2.0)
    said = scene.refused("/mission/recall", RecallMissionRequest(name="Noon"))
    assert said == "There is no mission 'Noon'; there are: Day, Night."


def test_the_history_has_every_task_with_its_end_over_restarts(scene: Scene, tmp_path: Path) -> None:
    scene.ask("/control/acquire", CommandRequest(client_name="Anna"))
    scene.set(*SQUARE, laps=1)
    scene.start()
    scene.run_task()
    scene.start()
    scene.run(3.0)
    scene.ask("/task/cancel")
    runs: Any = scene.ask("/history/get", GetHistoryRequest())
    assert [(run.id, run.state, run.by) for run in runs.runs] == [
        (2, "CANCELED", "Anna"),
        (1, "SUCCEEDED", "Anna"),
    ]
    first = runs.runs[1]
    assert (first.visited, first.order.task) == (3, "patrol")
    assert first.distance > 5.0
    assert first.ended.seconds > first.started.seconds
    again = Scene(FakeRobot(), tmp_path)
    again.run(4.0)
    again.start()
    assert again.task.task_id == 3


def test_a_question_about_history_that_makes_no_sense_is_refused(scene: Scene) -> None:
    said = scene.refused("/history/get", GetHistoryRequest(before=-1, limit=1000))
    assert said == "before must be 0 or more and limit 1 to 200, not -1 and 1000."


def test_an_app_asks_for_no_more_at_once_than_the_robot_takes(scene: Scene) -> None:
    assert scene.ask("/history/get", GetHistoryRequest(limit=tasking.RUNS_LIMIT)).success
    numbers = Int32Array(list(range(1, logbook.MAX_ACKNOWLEDGED + 1)))
    assert not scene.refused("/events/acknowledge", AcknowledgeEventsRequest(ids=numbers)).startswith(
        "At most "
    )


def test_an_event_is_seen_to_once_by_whoever_says_so_first_and_all_are_told(scene: Scene) -> None:
    scene.station.events.say("contact", "It touched something.", "alarm")
    number = scene.of("/events")[-1].id  # type: ignore[attr-defined]
    request = AcknowledgeEventsRequest(client_name="Anna", ids=Int32Array([number]))
    assert scene.ask("/events/acknowledge", request).message == "1 event acknowledged."
    told = scene.of("/events")[-1]
    assert isinstance(told, Event)
    assert (told.id, told.acknowledged_by, told.acknowledged.secs) == (number, "Anna", told.stamp.secs)
    later = msgspec.structs.replace(request, client_name="Bert")
    assert scene.ask("/events/acknowledge", later, scene.client("bert")).message == ("Already acknowledged.")
    assert scene.refused("/events/acknowledge", AcknowledgeEventsRequest(ids=Int32Array([99]))) == (
        "There is no event with the number 99."
    )
