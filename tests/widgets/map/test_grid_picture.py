from __future__ import annotations

import pytest
from kivy.graphics import Rectangle

from bridge.msgs.arrays import Int8Array
from bridge.msgs.geometry_msgs import Point, Pose
from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid
from tests.widgets.map.watched_map import near
from widgets.core.geometry import View
from widgets.core.theme import theme
from widgets.map.grid_picture import AT_ONCE, FREE_OVER_GROUND, GridPicture

LARGE = (2100, 200)
assert LARGE[0] * LARGE[1] > AT_ONCE


def grid(wide, high, value=0, x=0.0):
    info = MapMetaData(resolution=0.1, width=wide, height=high, origin=Pose(Point(x, 0.0)))
    return OccupancyGrid(info=info, data=Int8Array(bytes([value]) * (wide * high)))


@pytest.fixture
def changes():
    return []


@pytest.fixture
def picture(stage, changes):
    made = GridPicture(lambda: changes.append(1))
    yield made
    made.close()


def drawn(picture):
    return [part for part in picture._ink.children if isinstance(part, Rectangle)]


def test_a_small_grid_is_drawn_at_once(picture, changes):
    picture.show(grid(30, 20, x=4.0))
    (shown,) = drawn(picture)
    assert (shown.pos, shown.size) == ((0, 0), (30, 20))
    assert changes == [1]
    assert not picture.busy


def test_a_large_grid_is_drawn_once_it_is_ready_and_the_old_one_stays_until_then(picture, stage, changes):
    picture.show(grid(30, 20))
    before = picture.info
    picture.show(grid(*LARGE))
    assert picture.busy
    assert picture.known == (0, 0, *LARGE)
    assert picture.info is before
    assert len(drawn(picture)) == 1
    picture._worker.wait()
    stage.frames(4)
    assert not picture.busy
    assert sum(shown.size[0] for shown in drawn(picture)) == LARGE[0]
    assert picture.info.width == LARGE[0]
    assert changes == [1, 1]


def test_no_frame_carries_more_than_one_piece_over(picture, stage, monkeypatch):
    laid, real = [], picture._tile
    monkeypatch.setattr(picture, "_tile", lambda one: laid.append(one) or real(one))
    picture.show(grid(*LARGE))
    picture._worker.wait()
    for count in (1, 2, 3):
        stage.frames(1)
        assert len(laid) == count
    stage.frames(3)
    assert len(laid) == 3


def test_cells_that_came_again_keep_their_texture(picture):
    picture.show(grid(30, 20))
    (before,) = drawn(picture)
    picture.show(grid(30, 20, x=2.0))
    (same,) = drawn(picture)
    picture.show(grid(30, 20, value=100))
    (other,) = drawn(picture)
    assert same.texture is before.texture
    assert other.texture is not before.texture
    assert picture.info.origin.position.x == 0.0


def test_of_a_large_grid_that_changed_in_one_place_the_other_pieces_keep_their_textures(picture):
    picture.show(grid(*LARGE))
    picture.finish()
    before = [shown.texture for shown in drawn(picture)]
    changed = grid(*LARGE)
    changed.data[2090] = 100
    picture.show(changed)
    picture.finish()
    after = [shown.texture for shown in drawn(picture)]
    assert [any(one is other for other in before) for one in after] == [True, True, False]
    picture.show(grid(30, 20))  # drawn as if nothing had been before
    picture.show(changed)
    picture.finish()
    assert len(drawn(picture)) == 3


def test_a_small_grid_takes_the_place_of_a_large_one_that_is_not_ready(picture, stage):
    picture.show(grid(*LARGE))
    picture.show(grid(3, 2))
    stage.frames(5)
    assert picture.info.width == 3
    assert [shown.size for shown in drawn(picture)] == [(3, 2)]


def test_no_grid_takes_the_picture_away(picture, stage, changes):
    picture.show(grid(*LARGE))
    picture.show(None)
    stage.frames(5)
    assert drawn(picture) == []
    assert picture.info is picture.known is None
    assert not picture.busy
    picture.place(View())


def test_closed_it_stays_as_it_is(picture, stage):
    picture.show(grid(3, 2))
    picture.show(grid(*LARGE))
    picture.close()
    stage.frames(5)
    assert picture.info.width == 3


def test_the_shader_is_told_how_large_a_cell_is_seen(picture):
    picture.show(grid(3, 2, x=5.0))
    picture.place(View.centred(5.0, 0.0, at=(40, 30), scale=50))
    assert picture.shift.xy == near(40, 30)
    assert picture._ink["density"] == pytest.approx(5.0)


def test_what_is_free_lets_pictures_through_and_walls_do_not(picture):
    for theme.name in ("dark", "sunlight", "night"):
        picture.colour(over_pictures=False)
        assert picture._ink["free"][3] == 1.0
        assert picture._ink["free"] != picture._ink["wall"]
        picture.colour(over_pictures=True)
        assert picture._ink["free"][3] == FREE_OVER_GROUND
        assert picture._ink["wall"][3] == picture._ink["rim"][3] == 1.0
    theme.name = "dark"
