"""What no program has written is told apart from what one has."""

from __future__ import annotations

import math
from typing import Any

import pytest

from robotside.records.database.rows import empty
from robotside.records.database.soundness import Unsound, check_columns, check_counters
from robotside.records.database.tables import FactRow, PlaceRow

SOUND: dict[str, Any] = {
    "id": 1, "name": "Lab", "kind": "", "floor": "", "x": 1.0, "y": 2, "yaw": None, "tag": "", "note": "",
}  # fmt: skip


def test_what_a_program_writes_is_sound() -> None:
    check_columns(PlaceRow(**SOUND))


@pytest.mark.parametrize(
    ("column", "value"),
    [
        ("name", b"Lab"),
        ("name", 7),
        ("x", "1"),
        ("x", math.inf),
        ("yaw", math.nan),
        ("y", None),
        ("id", None),
    ],
)
def test_a_column_that_holds_what_it_may_not_is_found(column: str, value: Any) -> None:
    with pytest.raises((TypeError, ValueError), match=column):
        check_columns(PlaceRow(**{**SOUND, column: value}))


def test_a_name_that_is_a_key_must_be_one() -> None:
    with pytest.raises(TypeError, match="name"):
        check_columns(FactRow(name=b"log", value=""))


@pytest.mark.parametrize("text", ["x", "", "-1", "1e3", "9" * 5000, "٣"])
def test_a_counter_that_is_no_number_is_damage(text: str) -> None:
    content = empty()
    content["facts"]["last event"] = text
    with pytest.raises(Unsound, match="The database is damaged .its fact 'last event' is"):
        check_counters(content)


def test_a_counter_below_the_numbers_that_were_given_is_brought_up_to_them() -> None:
    content = empty()
    content["facts"].update({"last event": "3", "last run": "9"})
    content["events"].update({7: "an event", 5: "another"})
    content["runs"][8] = "a run"
    check_counters(content)
    assert content["facts"] == {"last event": "7", "last run": "9"}
