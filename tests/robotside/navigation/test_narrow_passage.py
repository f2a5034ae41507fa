"""The width of a gap and its middle, against geometry."""

from __future__ import annotations

import numpy as np
import pytest

from robotside.core.worker import completed
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.narrow_passage import Gap, squeezed

OPEN = Grid(np.zeros((60, 60), dtype=np.bool_), 0.1, -3.0, -3.0)
NEED = 0.23


def through(gap: float, at: float, turned: float = 0.0) -> tuple[np.ndarray, Gap | None]:
    """A way along x, 5 cm beside the middle of a gap between two posts, seen from a frame that is `turned` [rad]."""
    c, s = np.cos(turned), np.sin(turned)
    frame = np.array([[c, -s], [s, c]])
    path = np.column_stack([np.arange(-1.0, 1.05, 0.1), np.full(21, at + 0.05)]) @ frame.T
    posts = np.array([[0.0, at + gap / 2], [0.0, at - gap / 2]]) @ frame.T
    way, found = completed(squeezed(OPEN, path, posts, NEED, np.zeros(21, dtype=np.bool_)))
    return way @ frame, found


@pytest.mark.parametrize("turned", [0.0, 0.7, -2.0])
@pytest.mark.parametrize("at", [0.0, 0.33, -0.87])
def test_the_way_leads_through_the_middle_of_a_gap_that_is_wide_enough(at: float, turned: float) -> None:
    way, gap = through(0.5, at, turned)
    assert gap is None
    assert way[10] == pytest.approx([0.0, at], abs=1e-6)
    assert way[0] == pytest.approx([-1.0, at + 0.05])  # where nothing is near it stays


@pytest.mark.parametrize("width", [0.3, 0.4, 0.44])
def test_a_gap_that_is_too_narrow_is_told_with_its_place_and_both_widths(width: float) -> None:
    _, gap = through(width, 0.33)
    assert gap is not None
    assert (gap.width, gap.needed) == (pytest.approx(width), 2 * NEED)
    assert (gap.x, gap.y) == (pytest.approx(0.0, abs=1e-6), pytest.approx(0.33))
    assert str(gap) == f"the gap at (0.0, 0.3) is {width:.2f} m wide and the robot needs 0.46 m"


def test_of_two_narrow_gaps_the_narrower_is_told() -> None:
    path = np.column_stack([np.arange(-1.0, 1.05, 0.1), np.zeros(21)])
    posts = np.array([[-0.5, 0.2], [-0.5, -0.2], [0.5, 0.15], [0.5, -0.15]])
    _, gap = completed(squeezed(OPEN, path, posts, NEED, np.zeros(21, dtype=np.bool_)))
    assert gap is not None
    assert gap.width == pytest.approx(0.3)


def test_beside_a_single_thing_there_is_no_gap() -> None:
    path = np.column_stack([np.arange(-1.0, 1.05, 0.1), np.zeros(21)])
    way, gap = completed(squeezed(OPEN, path, np.array([[0.0, 0.1]]), NEED, np.zeros(21, dtype=np.bool_)))
    assert gap is None
    assert way == pytest.approx(path)


def test_walls_of_the_map_stand_in_the_middle_of_their_cells() -> None:
    occupied = np.zeros((60, 60), dtype=np.bool_)
    occupied[:28, 30] = occupied[32:, 30] = True  # four free cells, so 0.5 m between the middles
    path = np.column_stack([np.arange(-1.0, 1.05, 0.1), np.full(21, 0.04)])
    for need, width in ((0.25, None), (0.27, 0.5)):
        way, gap = completed(
            squeezed(
                Grid(occupied, 0.1, -3.0, -3.0), path, np.empty((0, 2)), need, np.zeros(21, dtype=np.bool_)
            )
        )
        assert (gap.width if gap else None) == (pytest.approx(width) if width else None)
        assert abs(way[10, 1]) < 0.02
