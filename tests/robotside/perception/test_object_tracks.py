"""Tracks: one number for one thing, while it is seen, hidden for a moment and passed by another."""

from __future__ import annotations

import math

import pytest

from robotside.perception.object_tracks import MAX_TRACKS, ObjectTracks, Seen
from robotside.perception.sighting import Sighting

PERIOD = 0.2


def box(centre: float = 0.5, kind: str = "person", score: float = 0.9, wide: float = 0.1) -> Sighting:
    return Sighting(centre - wide / 2, 0.3, centre + wide / 2, 0.8, score, kind)


def at(x: float, y: float, kind: str = "person") -> Seen:
    return Seen(box(0.5 - math.atan2(y, x), kind), (x, y))


def walk(n: int) -> Seen:
    """Somebody who crosses at 1.2 m/s, 4 m ahead."""
    return at(4.0, -2.0 + 1.2 * PERIOD * n)


def test_what_stands_still_keeps_its_number_and_two_things_have_two() -> None:
    tracks = ObjectTracks()
    for n in range(20):
        noise = 0.1 * (-1) ** n
        told = tracks.update([at(4.0 + noise, 1.0), at(4.0, -1.0 + noise, "cone")], PERIOD * n)
        assert told == [(1, "person"), (2, "cone")]


@pytest.mark.parametrize("hidden", [1.0, 2.0])
def test_somebody_who_walks_behind_something_for_a_moment_comes_out_with_the_same_number(
    hidden: float,
) -> None:
    tracks = ObjectTracks()
    gone = range(10, 10 + round(hidden / PERIOD))
    told = [tracks.update([] if n in gone else [walk(n)], PERIOD * n) for n in range(28)]
    assert {number for each in told for number, _ in each} == {1}


def test_who_is_away_for_longer_gets_a_new_number() -> None:
    tracks = ObjectTracks()
    tracks.update([at(4.0, 0.0)], 0.0)
    assert tracks.update([at(4.0, 0.0)], 6.0) == [(2, "person")]


def test_two_people_who_pass_each_other_keep_their_numbers() -> None:
    tracks = ObjectTracks()
    for n in range(25):
        y = -2.4 + 0.2 * n
        told = tracks.update([at(4.0, y), at(4.6, -y)], PERIOD * n)
        assert [number for number, _ in told] == [1, 2], n


def test_in_the_map_a_thing_keeps_its_number_however_the_robot_turns() -> None:
    tracks = ObjectTracks()
    for n in range(10):
        told = tracks.update([Seen(box(0.1 + 0.08 * n), (4.0, 0.0))], PERIOD * n)
        assert told[0][0] == 1


def test_without_a_place_it_is_the_picture_that_tells() -> None:
    tracks = ObjectTracks()
    for n in range(10):
        told = tracks.update([Seen(box(0.3 + 0.02 * n)), Seen(box(0.8))], PERIOD * n)
        assert [number for number, _ in told] == [1, 2]
    assert tracks.update([Seen(box(0.1))], 2.0)[0][0] == 3


def test_one_wrong_look_changes_no_class() -> None:
    tracks = ObjectTracks()
    kinds = ["person", "person", "person", "cone", "person"]
    told = [tracks.update([at(4.0, 0.0, kind)], PERIOD * n) for n, kind in enumerate(kinds)]
    assert told == [[(1, "person")]] * 5


def test_where_the_place_was_wrong_the_number_goes_on_by_the_picture() -> None:
    tracks = ObjectTracks()
    tracks.update([Seen(box(0.5), (4.0, 0.0))], 0.0)
    tracks.forget()
    assert tracks.update([Seen(box(0.5), (14.0, 7.0))], 0.2) == [(1, "person")]


def test_a_crowd_is_not_followed_without_end() -> None:
    tracks = ObjectTracks()
    for n in range(40):
        tracks.update([at(3.0 * k, 50.0 * n) for k in range(10)], 0.01 * n)
    assert len(tracks._tracks) <= MAX_TRACKS
