"""Places of tasks: found by their names, refused where the robot cannot stand."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.pilothouse_msgs import Mission, Place, RobotInfo, TaskOrder, Waypoint
from robotside.core.refusal import Refusal
from robotside.records import Records
from robotside.tasks.order_heights import OrderHeights
from robotside.tasks.task_places import MAX_NAMED, TaskPlaces


def east_is_barred(name: str, x: float, y: float) -> str:
    return f"{name} is too far east." if x > 10.0 else ""


@pytest.fixture
def records() -> Records:
    return Records.in_memory()


@pytest.fixture
def places(records: Records) -> TaskPlaces:
    records.places.set(Place(name="Lab", x=2.0))
    records.places.set(Place(name="Pier", x=12.0))
    return TaskPlaces(records, east_is_barred, OrderHeights(RobotInfo(), (-math.inf, math.inf)))


def test_a_name_is_found_and_a_place_where_it_cannot_stand_is_refused(places: TaskPlaces) -> None:
    (lab,) = places.named(TaskOrder(places=["lab"]), 1, 1, "One place")
    assert lab.name == "Lab"
    with pytest.raises(Refusal, match=r"Pier is too far east\."):
        places.named(TaskOrder(places=["Pier"]), 1, 1, "One place")
    (pier,) = places.named(TaskOrder(places=["Pier"]), 1, 1, "One place", stands=False)
    assert pier.x == 12.0


def test_too_few_places_and_an_unknown_one_are_refused_with_what_there_is(places: TaskPlaces) -> None:
    with pytest.raises(Refusal, match=r"Two places are needed, not 1\."):
        places.named(TaskOrder(places=["Lab"]), 2, 2, "Two places are needed")
    with pytest.raises(Refusal, match=r"There is no place 'Moon'; there are Lab, Pier\."):
        places.named(TaskOrder(places=["Moon"]), 1, 1, "One place")


def test_of_many_places_a_refusal_names_a_few(places: TaskPlaces, records: Records) -> None:
    for number in range(MAX_NAMED):
        records.places.set(Place(name=f"Room {number}"))
    with pytest.raises(Refusal, match=r" and 2 more\."):
        places.named(TaskOrder(places=["Moon"]), 1, 1, "One place")


def test_home_is_the_missions_before_a_place_of_that_kind(places: TaskPlaces, records: Records) -> None:
    assert places.home() is None
    records.places.set(Place(name="Kennel", kind="home", x=1.0, yaw=0.5))
    assert places.home() == Waypoint(1.0, 0.0, 0.5)
    records.missions.set(Mission(home=[Waypoint(3.0, 4.0, 1.0)]))
    assert places.home() == Waypoint(3.0, 4.0, 1.0)
    (home,) = places.named(TaskOrder(places=["Home"]), 1, 1, "One place")
    assert (home.kind, home.x, home.y) == ("home", 3.0, 4.0)


def test_the_dock_is_the_named_one_or_the_first(places: TaskPlaces, records: Records) -> None:
    with pytest.raises(Refusal, match="There is no place of the kind dock"):
        places.dock(TaskOrder())
    records.places.set(Place(name="Charger", kind="dock", x=20.0))
    assert places.dock(TaskOrder()).name == "Charger"
    assert places.dock(TaskOrder(places=["Pier"])).name == "Pier"


def test_a_mission_with_a_point_where_it_cannot_stand_is_refused(places: TaskPlaces) -> None:
    places.check_mission(Mission(waypoints=[Waypoint(1.0, 0.0)]))
    with pytest.raises(Refusal, match=r"Point 2 is too far east\."):
        places.check_mission(Mission(waypoints=[Waypoint(1.0, 0.0), Waypoint(11.0, 0.0)]))


def test_a_swimmer_goes_to_a_place_at_its_height_and_is_refused_one_that_it_cannot_reach(
    records: Records,
) -> None:
    heights = OrderHeights(RobotInfo(name="Fin", dives=True), (-4.0, 0.0))
    places = TaskPlaces(records, east_is_barred, heights)
    records.places.set(Place(name="Deep", x=2.0, height=-9.0))
    with pytest.raises(Refusal, match=r"The height of Fin at deep must be from -4 to 0 m, .*not -9 m\."):
        places.named(TaskOrder(places=["Deep"]), 1, 1, "One place")
    records.places.set(Place(name="Nest", kind="home", x=2.0, height=-1.5))
    (nest,) = places.named(TaskOrder(places=["Nest"]), 1, 1, "One place")
    assert nest.height == -1.5
    home = places.home()
    assert home is not None
    assert home.height == -1.5


def test_on_the_ground_the_height_of_a_place_is_of_no_account(places: TaskPlaces, records: Records) -> None:
    records.places.set(Place(name="Nest", kind="home", x=2.0, height=-1.5))
    (nest,) = places.named(TaskOrder(places=["Nest"]), 1, 1, "One place")
    assert nest.height == 0.0
    home = places.home()
    assert home is not None
    assert math.isnan(home.height)
