"""The grid of free panels: none ever overlaps another, whatever is moved where."""

from __future__ import annotations

from itertools import combinations

from app.layout.layout_tables import SLIDER
from app.layout.panel_grid import (
    _FIGURES,
    _LOW,
    _ROUND,
    _SWITCHES,
    COLUMNS,
    FORMS,
    ROWS,
    Place,
    arrange,
    clamped,
    free_place,
    height_of,
    settled,
)
from widgets import CATALOGUE


def apart(places: list[Place]) -> bool:
    return not any(one.overlaps(other) for one, other in combinations(places, 2))


def test_neighbours_that_touch_do_not_overlap() -> None:
    assert not Place(0, 0, 3, 3).overlaps(Place(3, 0, 3, 3))
    assert not Place(0, 0, 3, 3).overlaps(Place(0, 3, 3, 3))
    assert Place(0, 0, 3, 3).overlaps(Place(2, 2, 1, 1))


def test_a_place_beyond_the_grid_comes_back_onto_it() -> None:
    assert clamped(Place(11, -2, 4, 0), "wide") == Place(8, 0, 4, 1)
    assert clamped(Place(-1, 500, 30, 4), "tall") == Place(0, 116, 6, 4)


def test_a_new_panel_takes_the_first_gap_that_is_large_enough() -> None:
    taken = [Place(0, 0, 3, 4), Place(5, 0, 7, 4)]
    assert free_place((2, 4), taken, "wide") == Place(3, 0, 2, 4)
    assert free_place((3, 4), taken, "wide") == Place(0, 4, 3, 4)


def test_a_handful_of_panels_fills_the_window() -> None:
    for form in FORMS:
        places = arrange([("Compass", None)] * 2, form)
        assert apart(places)
        assert ROWS[form] // 2 < height_of(places) <= ROWS[form]


def test_what_was_set_by_hand_stays_and_is_not_made_larger() -> None:
    places = arrange([("Compass", Place(0, 0, 2, 2)), ("Compass", None)], "wide")
    assert places == [Place(0, 0, 2, 2), Place(2, 0, 3, 4)]


def test_thirty_panels_lie_apart_in_every_form() -> None:
    for form in FORMS:
        places = arrange([(name, None) for name in ("Compass", "Readout", "Video")] * 10, form)
        assert apart(places)
        assert all(place.right <= COLUMNS[form] for place in places)


def test_a_moved_panel_stays_and_pushes_the_others_down() -> None:
    places = [Place(0, 0, 6, 4), Place(6, 0, 6, 4), Place(0, 4, 6, 4)]
    assert settled([Place(0, 0, 6, 4), Place(0, 2, 6, 4), places[2]], 1) == [
        Place(0, 6, 6, 4),
        Place(0, 2, 6, 4),
        Place(0, 10, 6, 4),
    ]
    assert settled(places, 0) == places


def test_every_name_with_a_usual_size_is_a_widget():
    named = {*_FIGURES, *_SWITCHES, *_ROUND, *_LOW}
    assert named <= {*CATALOGUE, SLIDER}
