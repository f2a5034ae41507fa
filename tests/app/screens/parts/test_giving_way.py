"""What a bar leaves out until the rest has room."""

from __future__ import annotations

from collections.abc import Mapping

from app.screens.parts.giving_way import giving_way

WIDTHS = {"clock": (30, 10, 0), "name": (50, 20)}


def width(given: Mapping[str, int]) -> float:
    return sum(widths[given.get(name, 0)] for name, widths in WIDTHS.items())


def test_nothing_gives_way_where_all_has_room() -> None:
    assert giving_way(80, ("clock", "name"), width) == {}


def test_the_first_goes_first_and_no_more_than_needed() -> None:
    assert giving_way(79, ("clock", "name", "clock"), width) == {"clock": 1}
    assert giving_way(59, ("clock", "name", "clock"), width) == {"clock": 1, "name": 1}
    assert giving_way(29, ("clock", "name", "clock"), width) == {"clock": 2, "name": 1}


def test_where_nothing_helps_all_has_given_way() -> None:
    assert giving_way(5, ("clock", "name", "clock"), width) == {"clock": 2, "name": 1}
