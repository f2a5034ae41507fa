"""The places of a world that a robot side takes over, once."""

from __future__ import annotations

from bridge.msgs.pilothouse_msgs import Place
from robotside.records import Records
from robotside.records.landmarks import take_over
from tests.fakes import FakeRobot


class Known(FakeRobot):
    """A robot that knows some places."""

    def __init__(self, *places: Place) -> None:
        super().__init__()
        self.places = list(places)


class Told:
    """What was said to the operators."""

    def __init__(self) -> None:
        self.said: list[str] = []

    def __call__(
        self, kind: str, text: str, level: str = "info", *, at: tuple[float, float] | None = None
    ) -> None:
        self.said.append(f"{level}: {text}")


LAB, DOCK = Place(name="Lab", x=1.0, y=2.0), Place(name="Dock", kind="dock", x=-3.0)


def test_the_places_of_a_world_are_there_without_anybody_entering_them() -> None:
    records, told = Records.in_memory(), Told()
    take_over(Known(LAB, DOCK), records, told)
    assert [(place.name, place.kind, place.x) for place in records.places.all()] == [
        ("Lab", "place", 1.0),
        ("Dock", "dock", -3.0),
    ]
    assert told.said == ["info: 2 places of the world taken over."]
    records.close()


def test_what_people_deleted_does_not_come_back() -> None:
    records, told = Records.in_memory(), Told()
    take_over(Known(LAB), records, told)
    records.places.delete(records.places.all()[0].id)
    take_over(Known(LAB), records, told)
    assert records.places.all() == []
    assert told.said == ["info: 1 place of the world taken over."]
    records.close()


def test_places_that_people_entered_stay_alone() -> None:
    records, told = Records.in_memory(), Told()
    records.places.set(Place(name="Mine"))
    take_over(Known(LAB), records, told)
    assert [place.name for place in records.places.all()] == ["Mine"]
    assert told.said == []
    records.close()


def test_one_that_cannot_be_kept_is_said_and_the_others_are() -> None:
    records, told = Records.in_memory(), Told()
    take_over(Known(LAB, Place(name="LAB"), DOCK), records, told)
    assert [place.name for place in records.places.all()] == ["Lab", "Dock"]
    assert told.said[1].startswith(
        "warn: Not all places of the world could be taken over: There is a place 'Lab'"
    )
    records.close()


def test_a_robot_that_knows_no_places_changes_nothing() -> None:
    records, told = Records.in_memory(), Told()
    take_over(FakeRobot(), records, told)
    take_over(Known(), records, told)
    assert (records.places.all(), told.said) == ([], [])
    records.close()
