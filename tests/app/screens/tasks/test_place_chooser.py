"""Places of an order chosen on a map: beside the form where there is room, on the mission's map of an upright phone."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from app.screens.tasks.place_chooser import PlaceChooser
from bridge.msgs.pilothouse_msgs import PlaceCandidate, PlaceCandidates
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets.tasks.place_list import SOME


@pytest.fixture
def tasks(driving: Glass, robot: FakeRobot) -> Iterator[Any]:
    """The tasks screen of a robot that knows some places."""
    robot.know(*SOME)
    before = tuple(driving.stage.window.size)
    driving.app.show("tasks")
    screen = driving.app.screens["tasks"]
    driving.until(lambda: len(screen.places.places) == len(SOME), "no places")
    yield screen
    driving.stage.window.size = driving.app.root.size = before
    driving.stage.frames(2)


def turned(glass: Glass, size: tuple[int, int]) -> None:
    glass.stage.window.size = glass.app.root.size = size
    glass.stage.frames(4)


def tap_place(glass: Glass, area: Any, name: str) -> None:
    x, y = next(place[:2] for place in area.places if place[2] == name)
    glass.stage.frames(2)
    glass.stage.tap(*area.to_window(*area.view.to_screen(x, y)))
    glass.stage.frames(2)


def chooser_of(tasks: Any) -> PlaceChooser:
    return next(one for one in tasks.walk(restrict=True) if isinstance(one, PlaceChooser))


@pytest.mark.parametrize("size", [(1280, 800), (892, 412)], ids=["tablet", "sideways"])
def test_places_are_chosen_by_taps_on_the_map_beside_the_form(
    driving: Glass, tasks: Any, size: tuple[int, int]
) -> None:
    turned(driving, size)
    tasks.begin("deliver")
    driving.stage.frames(4)
    chooser = chooser_of(tasks)
    assert min(chooser.map.size) > 100
    assert not chooser.map.collide_widget(driving.app.shell.stop)
    for name in ("Office 12", "Lab"):
        tap_place(driving, chooser.map, name)
    assert tasks.pane.order.places == ["Office 12", "Lab"]
    assert [tuple(point) for point in chooser.map.waypoints] == [
        (SOME[0].x, SOME[0].y),
        (SOME[2].x, SOME[2].y),
    ]
    tap_place(driving, chooser.map, "Office 12")
    assert tasks.pane.order.places == ["Office 12", "Office 12"], "the last one is changed"


def test_a_robot_that_may_be_at_two_places_is_unsure_on_this_map_too(
    driving: Glass, robot: FakeRobot, tasks: Any
) -> None:
    turned(driving, (1280, 800))
    tasks.begin("deliver")
    shown = chooser_of(tasks).map
    asked = PlaceCandidates(
        candidates=[PlaceCandidate(1, 0.0, 0.0, 0.0, 0.6, 0.1), PlaceCandidate(2, 4.0, 0.0, 0.0, 0.4, 0.1)]
    )
    robot.publish("/localisation/candidates", asked)
    driving.until(lambda: shown.unsure, "it was drawn as sure")


def test_a_task_without_places_has_no_map_beside_it_and_the_list_is_back(driving: Glass, tasks: Any) -> None:
    turned(driving, (892, 412))
    tasks.begin("go_to")
    driving.stage.frames(2)
    assert tasks.now.parent is None
    tasks.begin("hold")
    driving.stage.frames(2)
    assert tasks.now.parent is tasks.ids.listed
    assert not any(isinstance(one, PlaceChooser) for one in tasks.walk(restrict=True))


def test_a_tap_beside_all_places_chooses_none_and_says_where_one_is_made(driving: Glass, tasks: Any) -> None:
    turned(driving, (1280, 800))
    tasks.begin("go_to")
    driving.stage.frames(4)
    chooser = chooser_of(tasks)
    chooser.map.dispatch("on_new_place", 500.0, 500.0)
    assert tasks.pane.order.places == []
    assert "Make one on the mission's map" in chooser.hint


def test_an_upright_phone_opens_the_mission_s_map_and_comes_back_with_the_place(
    driving: Glass, robot: FakeRobot, tasks: Any
) -> None:
    turned(driving, (412, 892))
    tasks.begin("go_to")
    driving.stage.frames(4)
    button = next(one for one in tasks.walk(restrict=True) if getattr(one, "text", "") == "Choose on the map")
    button.trigger_action(0)
    driving.stage.frames(4)
    mission = driving.app.screens["mission"]
    assert (driving.app.shell.screen, mission.selection.text) == ("mission", "Tap the place to choose.")
    mission.map.dispatch("on_new_place", 500.0, 500.0)
    assert mission.card.shown is None, "a tap beside makes no place"
    index = next(at for at, one in enumerate(mission.map.places) if one[2] == "Lab")
    mission.map.dispatch("on_open_place", index)
    driving.stage.frames(2)
    assert (driving.app.shell.screen, tasks.detail, tasks.pane.order.places) == ("tasks", "order", ["Lab"])
    assert (mission.mode, mission.card.shown) == ("view", None)
    assert not [name for name, _ in robot.asked if name == "/places/set"]
