from __future__ import annotations

import pytest

from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import Place, PlaceArray
from widgets.parts.rows import ListRow
from widgets.tasks.place_list import MAX_ROWS, SOME, PlaceList, found, grouped


def at(x, y):
    return PoseWithCovarianceStamped(pose=PoseWithCovariance(pose=Pose(Point(x, y, 0.0))))


@pytest.fixture
def places(stage):
    widget = PlaceList(size_hint=(None, None), size=(360, 600))
    widget.show(PlaceArray(places=SOME))
    stage.show(widget)
    stage.frames(3)
    widget.asked = []
    widget.bind(on_command=lambda _, place: widget.asked.append(place.name))
    return widget


def names(widget):
    rows = [row for row in widget.walk() if isinstance(row, ListRow)]
    return [row.title for row in sorted(rows, key=lambda row: -row.to_window(*row.pos)[1])]


def test_without_a_position_they_stand_by_floor_kind_and_name(stage, places):
    assert names(places) == ["Charger", "Lab", "Reception", "Office 9", "Office 12"]


def test_the_nearest_group_comes_first_and_in_it_the_nearest_place(stage, places):
    places.show(at(2.0, 1.0))
    stage.frames(3)
    assert names(places)[:2] == ["Office 12", "Office 9"]
    assert grouped(SOME, (0.0, 0.5))[0][0] == "Floor 0 · Reception"


def test_the_rows_stay_under_the_finger_while_the_robot_drives_and_tell_the_new_distance(stage, places):
    places.show(at(3.0, 1.0))
    stage.frames(3)
    before = names(places)
    places.show(at(0.0, 8.0))
    stage.frames(3)
    assert names(places) == before
    (lab,) = (row for row in places.walk() if isinstance(row, ListRow) and row.title == "Lab")
    assert lab.aside == "1 m"


@pytest.mark.parametrize(
    ("search", "hits"),
    [
        ("OFFICE", ["Office 12", "Office 9"]),
        ("12", ["Office 12"]),
        ("floor 0 lab", ["Lab"]),
        ("weber", ["Office 12"]),
        ("nobody", []),
    ],
)
def test_a_search_takes_any_words_of_name_kind_floor_and_note(search, hits):
    assert [place.name for place in found(SOME, search)] == hits


def test_a_tap_gives_the_place(stage, places):
    row = next(row for row in places.walk() if isinstance(row, ListRow) and row.title == "Lab")
    stage.tap(*row.to_window(*row.center))
    stage.run_for(0.5)
    assert places.asked == ["Lab"]


def test_what_is_not_found_is_said(stage, places):
    places.search = "zzz"
    stage.frames(3)
    assert names(places) == []
    assert any(getattr(part, "text", "") == "No place is called “zzz”." for part in places.walk())


def test_a_great_many_are_cut_and_the_rest_is_counted(stage, places):
    places.show(
        PlaceArray(places=[Place(id=n, name=f"Office {n}", kind="office") for n in range(1, MAX_ROWS + 24)])
    )
    stage.frames(3)
    assert len(names(places)) == MAX_ROWS
    assert any(getattr(part, "text", "") == "23 more: search for them." for part in places.walk())


def test_the_same_places_told_again_do_not_make_the_rows_anew(stage, places):
    rows = list(places.ids.column.children)
    places.show(PlaceArray(places=list(SOME)))
    assert places.ids.column.children == rows
