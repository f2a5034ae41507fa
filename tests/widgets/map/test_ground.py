"""Tiles beneath a map, wherever on earth a robot says that it is."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from bridge.core.geo import Datum
from widgets.core.geometry import View
from widgets.map.ground import MAX_LATITUDE, TileGround
from widgets.map.tiles.mbtiles import MBTiles

SHIPPED = Path(__file__).parents[3] / "widgets/data/parking_lot.mbtiles"
BOX = (0.0, 0.0, 800.0, 600.0)
VIEW = View(20 + 0j, 400 + 300j)
BESIDE_POLE = (89.99999999, -89.99999999)


@pytest.fixture
def lay() -> Iterator[Callable[[float, float], TileGround]]:
    laid: list[TileGround] = []

    def lay(latitude: float, longitude: float) -> TileGround:
        laid.append(TileGround(MBTiles(SHIPPED), Datum(latitude, longitude)))
        return laid[-1]

    yield lay
    for ground in laid:
        ground.close()


@pytest.mark.parametrize("latitude", [*BESIDE_POLE, MAX_LATITUDE + 0.1])
def test_nothing_is_drawn_where_the_projection_has_no_tiles(lay, latitude, stage):
    assert not lay(latitude, 8.0).place(VIEW, BOX)


@pytest.mark.parametrize("longitude", [-180.0, 179.9999, 180.0])
def test_at_the_date_line_tiles_are_as_large_as_elsewhere(lay, longitude, stage):
    ground = lay(10.0, longitude)
    assert ground.scale_at(17) == pytest.approx(lay(10.0, 8.0).scale_at(17))
    assert ground.place(VIEW, BOX)


def test_a_map_that_lies_elsewhere_keeps_the_tiles_that_were_read(lay, stage):
    ground = lay(45.5069, -73.579)
    assert ground.place(VIEW, BOX)
    moved = ground.moved(Datum(45.507, -73.579))
    assert moved.place(VIEW, BOX)
    assert moved.source is ground.source
    assert not moved.source.reader._closed
