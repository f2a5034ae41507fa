from __future__ import annotations

import numpy as np
import pytest

from widgets.map.grid_cells import MAX_SIDE, SHARED, bounds, every_piece, layout


def shown(cells):
    """Both channels of the whole grid, put together of what its pieces show."""
    whole = np.full((*cells.shape, 2), 77, np.uint8)
    for one in every_piece(cells):
        wide, high = one.side
        pixels = one.pixels.reshape(high, wide, 2)
        part = pixels[one.low : one.low + one.rows, one.left : one.left + one.columns]
        whole[one.row : one.row + one.rows, one.column : one.column + one.columns] = part
    return whole


def speckled(rows, columns, seed=4):
    rng = np.random.default_rng(seed)
    return rng.choice(np.array([-1, 0, 20, 49, 50, 80, 100], np.int8), (rows, columns))


@pytest.mark.parametrize("size", [(1, 1), (40, 3), (57, 130), (1100, 1030)])
def test_no_cell_changes_sides_however_lonely_it_is(size):
    cells = speckled(*size)
    occupied, known = shown(cells).transpose(2, 0, 1)
    assert ((occupied > 127) == (cells >= 50)).all()
    assert ((known > 127) == (cells >= 0)).all()
    assert (np.abs(occupied.astype(int) - 127) >= 30).all()


def test_cells_beyond_a_hundred_are_occupied():
    assert (shown(np.full((3, 3), 127, np.int8))[:, :, 0] == 255).all()


def test_an_edge_is_softened_over_its_neighbours_only():
    cells = np.zeros((9, 20), np.int8)
    cells[:, 10:] = 100
    row = shown(cells)[4, :, 0].tolist()
    assert row[:8] == [0] * 8
    assert row[8] < row[9] < 127 < row[10] < row[11]
    assert row[12:] == [255] * 8


def test_a_slanting_edge_has_no_steps_of_a_whole_cell():
    """Where it crosses a half between two rows goes on steadily, by less than half of what the cells themselves step."""
    rows, columns = np.mgrid[:40, :90]
    soft = shown(np.where(rows > 10 + columns * 0.2, 100, 0).astype(np.int8))[:, :, 0].astype(float)
    crossings = []
    for column in range(10, 80):
        line = soft[:, column]
        upper = int(np.argmax(line > 127.5))
        crossings.append(upper - (line[upper] - 127.5) / (line[upper] - line[upper - 1]))
    assert np.abs(np.diff(crossings)).max() < 0.62
    assert (
        np.abs(np.array(crossings) - np.poly1d(np.polyfit(range(70), crossings, 1))(range(70))).max() < 0.35
    )


@pytest.mark.parametrize("size", [(1, 1), (7, 1024), (1025, 5), (1680, 3200), (8192, 2)])
def test_pieces_cover_a_grid_once_and_fit_the_textures_of_a_phone(size):
    rows, columns = size
    seen = np.zeros(size, np.uint8)
    for one in layout(columns, rows):
        seen[one.row : one.row + one.rows, one.column : one.column + one.columns] += 1
        assert all(side <= MAX_SIDE and side & (side - 1) == 0 for side in one.side)
        assert one.left in (0, SHARED)
        assert one.left + one.columns <= one.side[0]
        assert one.low + one.rows <= one.side[1]
    assert (seen == 1).all()


def test_neighbouring_pieces_agree_on_the_cells_that_both_have():
    cells = speckled(20, 1030)
    first, second = every_piece(cells)
    left = first.pixels.reshape(first.side[1], first.side[0], 2)[:20]
    right = second.pixels.reshape(second.side[1], second.side[0], 2)[:20]
    overlap = first.columns - SHARED
    assert (left[:, overlap : overlap + 2 * SHARED] == right[:, : 2 * SHARED]).all()


def test_a_piece_tells_whether_anything_is_a_little_occupied_and_what_it_holds():
    sharp, grey = np.array([[0, 100, -1]], np.int8), np.array([[0, 30, -1]], np.int8)
    (one,), (same,), (other,) = every_piece(sharp), every_piece(sharp.copy()), every_piece(grey)
    assert (one.shaded, other.shaded) == (False, True)
    assert one.digest == same.digest != other.digest


def test_a_piece_that_is_drawn_already_is_not_made_and_one_of_another_shape_is():
    wide, high = np.zeros((4, 60), np.int8), np.zeros((60, 4), np.int8)
    (one,), (other,) = every_piece(wide), every_piece(high)
    assert one.digest != other.digest
    (again,) = every_piece(wide, {one.digest})
    assert again.pixels is None
    assert (again.digest, again.shaded, again.side) == (one.digest, one.shaded, one.side)
    assert all(each.pixels is not None for each in every_piece(high, {one.digest}))


@pytest.mark.parametrize("row", [0, 61, 62, 63, 64, 65, 66, 127, 128, 199])
def test_what_is_softened_in_bands_looks_as_if_it_were_softened_whole(row):
    """A wall lies over, next to and away from the border of two bands: it looks the same up and down everywhere."""
    cells = np.zeros((200, 40), np.int8)
    cells[row] = 100
    column = shown(cells)[:, 20, 0].astype(int)
    near = [column[at] for at in range(row - 3, row + 4) if 0 <= at < 200]
    alone = np.zeros((41, 40), np.int8)
    alone[20] = 100
    wanted = shown(alone)[17:24, 20, 0].astype(int).tolist()
    if 3 <= row < 197:
        assert near == wanted
    assert column[row] > 127
    assert (np.delete(column, row) < 127).all()


def test_bounds_are_of_what_is_known():
    cells = np.full((6, 9), -1, np.int8)
    assert bounds(cells) is None
    cells[2, 3] = cells[4, 7] = 0
    assert bounds(cells) == (3, 2, 8, 5)
