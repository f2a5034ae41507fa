from __future__ import annotations

import io
import sqlite3
import tomllib
from contextlib import closing

import numpy as np
import pytest
from PIL import Image

from bridge.core.geo import Datum
from scripts import make_mbtiles as script

WORLD = tomllib.loads((script.ROOT / "sim/worlds/parking_lot.toml").read_text())
DATUM = Datum(WORLD["datum"]["latitude"], WORLD["datum"]["longitude"])
FILE = script.ROOT / "widgets/data/parking_lot.mbtiles"


def stored(zoom: int, column: int, row: int) -> Image.Image:
    with closing(sqlite3.connect(f"{FILE.as_uri()}?mode=ro", uri=True)) as file:
        key = (zoom, column, 2**zoom - 1 - row)
        found = file.execute(
            "SELECT tile_data FROM tiles WHERE zoom_level = ? AND tile_column = ? AND tile_row = ?", key
        ).fetchone()
    return Image.open(io.BytesIO(found[0]))


def test_the_shipped_pictures_are_those_of_the_world_as_it_is_now():
    grid = script.Mercator(DATUM, 20)
    column, row, west, north = next(t for t in grid.tiles(1.0))
    drawn = Image.open(io.BytesIO(script.tile(WORLD, west, north, grid.metres)))
    apart = np.asarray(drawn, np.int16) - np.asarray(stored(20, column, row), np.int16)
    assert np.abs(apart).mean() < 1.0, "run python scripts/make_mbtiles.py"


def test_a_tile_is_where_the_datum_says():
    grid = script.Mercator(DATUM, 22)
    column, row = grid.position(0, 0)
    assert grid.position(grid.metres, 0)[0] == pytest.approx(column + 1, abs=1e-3)
    assert grid.position(0, -grid.metres)[1] == pytest.approx(row + 1, abs=4e-3)


def test_tiles_cover_the_reach_on_every_side():
    grid = script.Mercator(DATUM, 21)
    found = list(grid.tiles(20.0))
    assert min(west for _, _, west, _ in found) <= -20
    assert max(west for _, _, west, _ in found) + grid.metres >= 20
    assert max(north for *_, north in found) >= 20


def test_a_parked_car_has_its_colour_on_the_picture():
    car = WORLD["cars"][0]
    canvas = script.Canvas(car["x"] - 4, car["y"] + 4, 8.0, 512)
    script.paint(canvas, WORLD)
    column, row = (round(part) for part in canvas.pixel(car["x"], car["y"] + 1.5))
    red, green, blue = canvas.image.getpixel((column, row))
    assert red > 100 > green
    assert abs(green - blue) < 40


def test_what_does_not_belong_in_the_lot_is_not_on_the_picture():
    with_cones, without = (script.Canvas(-10, 10, 20.0, 128) for _ in range(2))
    script.paint(with_cones, WORLD)
    script.paint(without, {key: value for key, value in WORLD.items() if key != "cones"})
    assert with_cones.image.tobytes() == without.image.tobytes()


def test_the_same_place_has_the_same_grain_in_every_tile():
    x = np.array([[3.2, 3.7]])
    assert script.patches(x, x, 1).tolist() == script.patches(x.copy(), x.copy(), 1).tolist()
    assert script.patches(x, x, 1).tolist() != script.patches(x, x, 2).tolist()


def test_a_whole_file_is_written_the_same_twice(tmp_path, monkeypatch):
    monkeypatch.setattr(script, "COVER", {17: 20.0})
    for name in ("one", "two"):
        assert script.write(script.ROOT / "sim/worlds/parking_lot.toml", tmp_path / name) >= 1
    assert (tmp_path / "one").read_bytes() == (tmp_path / "two").read_bytes()
