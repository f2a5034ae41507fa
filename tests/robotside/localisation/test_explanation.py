"""What beams ended on, and what they went through."""

from __future__ import annotations

import math

import numpy as np
import pytest

from robotside.core.pose2 import Pose2
from robotside.localisation.explanation import MAX_BEAMS, MAX_REACH, Look, explained
from robotside.localisation.field import Field
from robotside.mapping.occupancy_grid import Grid

HERE = Pose2(0.0, 0.0, 0.0)


def room() -> Field:
    """Of 8 m by 6 m round the origin, with a wall of 0.3 m across it at x = 2.0."""
    cells = np.pad(np.zeros((60, 80), dtype=np.bool_), 10, constant_values=True)
    cells[10:70, 70:73] = True
    return Field(Grid(cells, 0.1, -5.0, -4.0))


def look(*ends: tuple[float, float], more: int = 0) -> Look:
    """Of some ends, and of `more` on the wall in the west."""
    west = [(-4.05, 0.3 * n - 1.5) for n in range(more)]
    return Look.of(np.array([*ends, *west]))


def test_a_look_that_lies_on_surfaces_is_explained() -> None:
    seen = explained(room(), HERE, look((2.05, 0.0), (2.05, 1.0), (0.0, 3.05), more=8))
    assert (seen.fit, seen.through) == (1.0, 0.0)
    assert seen.evidence > -0.5


def test_a_beam_that_went_through_a_wall_speaks_more_against_a_place_than_one_that_met_the_unknown() -> None:
    met_somebody = explained(room(), HERE, look((1.2, 0.0), more=8))
    went_through = explained(room(), HERE, look((4.05, 0.0), more=8))
    on_a_wall = explained(room(), HERE, look((2.05, 0.0), more=8))
    assert met_somebody.through == 0.0
    assert went_through.through == pytest.approx(1 / 9)
    assert went_through.fit == pytest.approx(8 / 9)  # though it ended on a wall
    assert went_through.evidence < met_somebody.evidence < on_a_wall.evidence


def test_beams_begin_at_the_laser_and_not_behind_the_bumper_that_it_sits_on() -> None:
    before_the_wall = Pose2(0.9, 0.0, 0.0)
    on_east = np.array(
        [(3.1, 0.3 * n - 1.5) for n in range(10)]
    )  # at x = 4.0, seen by a laser beyond the wall across the room
    assert explained(room(), before_the_wall, Look.of(on_east)).through == 1.0
    assert explained(room(), before_the_wall, Look.of(on_east, ahead=1.6)).through == 0.0


@pytest.mark.parametrize("in_the_wall", [0.0, 0.3])
def test_who_stands_up_to_a_wall_sees_through_none(in_the_wall: float) -> None:
    at_the_wall = Pose2(1.95 + in_the_wall, 0.0, math.pi)  # by a dock that the map draws a little thick
    along = look((1.95 + in_the_wall + 4.05, 0.0), (3.0, 3.05), (3.0, -3.05))
    assert explained(room(), at_the_wall, along).through == 0.0


def test_a_grazed_corner_is_no_wall() -> None:
    cells = np.pad(np.zeros((60, 80), dtype=np.bool_), 10, constant_values=True)
    cells[40, 70] = True
    field = Field(Grid(cells, 0.1, -5.0, -4.0))
    assert explained(field, HERE, look((4.05, 0.05), more=8)).through == 0.0


def test_a_near_wall_does_not_outvote_all_others() -> None:
    angles = np.linspace(-math.pi, math.pi, 720, endpoint=False)
    near = np.column_stack([0.5 * np.cos(angles[:600]), 0.5 * np.sin(angles[:600])])
    far = np.column_stack([6.0 * np.cos(angles[600:]), 6.0 * np.sin(angles[600:])])
    ends = Look.of(np.concatenate([near, far])).ends
    assert len(ends) <= MAX_BEAMS
    assert (np.hypot(ends[:, 0], ends[:, 1]) > 5.0).mean() > 0.5


def test_beams_are_followed_so_far_and_no_farther() -> None:
    seen = Look.of(np.array([[MAX_REACH + 1.5, 0.0], [1.0, 0.0]]), ahead=1.0)
    assert seen.ends.tolist() == [[1.0, 0.0]]


def test_without_a_beam_nothing_is_explained() -> None:
    seen = explained(room(), HERE, Look.of(np.empty((0, 2))))
    assert (seen.evidence, seen.fit) == (-math.inf, 0.0)


@pytest.mark.parametrize(
    ("count", "width", "tells"), [(7, math.tau, False), (40, 0.4, False), (40, math.tau, True)]
)
def test_a_look_tells_a_place_by_many_ends_in_several_directions(
    count: int, width: float, tells: bool
) -> None:
    angles = np.linspace(0.0, width, count, endpoint=False)
    reach = 8.0 if width > 1.0 else np.linspace(4.0, 14.0, count)
    assert Look.of(np.column_stack([reach * np.cos(angles), reach * np.sin(angles)])).tells is tells
