"""Named poses."""

from __future__ import annotations

import math

import msgspec
import pytest

from bridge.msgs.pilothouse_msgs import Place
from robotside.records import NotRecorded, Records

OFFICE = Place(name="Office 12", kind="office", floor="1", x=4.0, y=2.0, tag="04:a2", note="Knock twice.")


@pytest.fixture
def records() -> Records:
    return Records.in_memory()


def test_a_new_place_is_given_a_number_and_is_found_by_it_and_by_its_name(records: Records) -> None:
    kept = records.places.set(OFFICE)
    assert kept == msgspec.structs.replace(OFFICE, id=1)
    assert records.places.get(1) == records.places.named("office 12 ") == kept
    assert math.isnan(kept.yaw)


def test_a_place_with_a_number_takes_the_place_of_the_old_one(records: Records) -> None:
    kept = records.places.set(OFFICE)
    moved = records.places.set(msgspec.structs.replace(kept, x=5.0))
    assert records.places.all() == [moved]


def test_a_number_is_never_used_again(records: Records) -> None:
    records.places.delete(records.places.set(OFFICE).id)
    assert records.places.set(OFFICE).id == 2


def test_a_name_is_one_readable_line(records: Records) -> None:
    assert records.places.set(Place(name=" Office\n\u202e12\0 ")).name == "Office 12"


@pytest.mark.parametrize(
    ("place", "said"),
    [
        (Place(), "A place needs a name."),
        (Place(name="\0 \n"), "A place needs a name."),
        (Place(name="OFFICE 12"), "There is a place 'Office 12' already; choose another name."),
        (Place(name="Deep", height=math.nan), "A place's height must be a number, 0 for any, not nan."),
        (Place(id=7, name="Lab"), "There is no place with the number 7."),
        (Place(name="Lab", x=math.nan), "A place's x and y must be numbers, not nan and 0.0."),
        (Place(name="Lab", kind="moon"), "There is no kind of place 'moon'; there are place, office, home,"),
    ],
)
def test_what_is_no_place_is_refused_with_a_sentence(records: Records, place: Place, said: str) -> None:
    records.places.set(OFFICE)
    with pytest.raises(NotRecorded) as refusal:
        records.places.set(place)
    assert str(refusal.value).startswith(said)
    assert len(records.places.all()) == 1


def test_there_is_no_deleting_what_is_not_there(records: Records) -> None:
    with pytest.raises(NotRecorded, match="There is no place with the number 3."):
        records.places.delete(3)


def test_places_are_bounded(records: Records, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("robotside.records.places.MAX_PLACES", 1)
    records.places.set(OFFICE)
    with pytest.raises(NotRecorded, match="At most 1 places can be stored; delete one first."):
        records.places.set(Place(name="Lab"))
