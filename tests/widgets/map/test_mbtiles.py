from __future__ import annotations

import io
import sqlite3
from contextlib import closing
from pathlib import Path
from types import SimpleNamespace

import pytest
from PIL import Image

from widgets.map.mbtiles import MAX_TILE_SIDE, MAX_TILES_PER_FRAME, MBTiles

SHIPPED = Path(__file__).parents[3] / "widgets/data/parking_lot.mbtiles"
PLAIN = {"format": "png", "minzoom": "3", "maxzoom": "5"}


def picture(colour: str, side: int = 256) -> bytes:
    raw = io.BytesIO()
    Image.new("RGB", (side, side), colour).save(raw, "PNG")
    return raw.getvalue()


def write(path: Path, about: dict[str, str], tiles: dict[tuple[int, int, int], bytes]) -> Path:
    with closing(sqlite3.connect(path)) as file, file:
        file.execute("CREATE TABLE metadata (name TEXT, value TEXT)")
        file.execute("CREATE TABLE tiles (zoom_level INT, tile_column INT, tile_row INT, tile_data BLOB)")
        file.executemany("INSERT INTO metadata VALUES (?, ?)", about.items())
        file.executemany("INSERT INTO tiles VALUES (?, ?, ?, ?)", [(*key, raw) for key, raw in tiles.items()])
    return path


def tile(zoom: int, x: int, y: int) -> SimpleNamespace:
    return SimpleNamespace(
        zoom=zoom, tile_x=x, tile_y=y, state="loading", texture=None, g_color=SimpleNamespace(a=0.0)
    )


def filled(source: MBTiles, stage, *tiles: SimpleNamespace) -> None:
    for each in tiles:
        source.fill_tile(each)
    stage.frames(2)


def test_a_file_with_bounds_and_no_center_can_be_opened(tmp_path):
    source = MBTiles(write(tmp_path / "a.mbtiles", {**PLAIN, "bounds": "-1,2,3,4"}, {}))
    assert source.box == (-1, 2, 3, 4)
    assert source.bounds is None, "mapview would fail at the first pan"
    assert (source.min_zoom, source.max_zoom) == (3, 5)


def test_a_tile_gets_its_texture_in_one_of_the_next_frames(tmp_path, stage):
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, {(4, 1, 2): picture("red")}))
    asked = tile(4, 1, 2)
    filled(source, stage, asked)
    assert asked.texture.size == (256, 256)
    assert (asked.state, asked.g_color.a) == ("animated", 1.0)


def test_a_tile_that_was_read_is_handed_over_at_once(tmp_path, stage):
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, {(4, 1, 2): picture("red")}))
    first, again = tile(4, 1, 2), tile(4, 1, 2)
    filled(source, stage, first)
    source.fill_tile(again)
    assert again.texture is first.texture


def test_two_files_do_not_show_each_others_tiles(tmp_path, stage):
    found = []
    for name in ("red", "blue"):
        source = MBTiles(write(tmp_path / f"{name}.mbtiles", PLAIN, {(4, 1, 2): picture(name)}))
        asked = tile(4, 1, 2)
        filled(source, stage, asked)
        found.append(asked.texture)
    assert found[0] is not found[1]


def test_where_there_is_no_sharp_tile_a_part_of_a_coarser_one_is_shown(tmp_path, stage):
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, {(3, 1, 1): picture("red")}))
    asked = tile(5, 7, 4)
    filled(source, stage, asked)
    assert asked.texture.size == (64, 64)


def test_a_gap_stays_a_gap(tmp_path, stage):
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, {}))
    asked = tile(5, 7, 4)
    filled(source, stage, asked)
    assert (asked.state, asked.texture) == ("done", None)


def test_many_tiles_are_read_over_several_frames(tmp_path, stage):
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, {(5, x, 0): picture("red") for x in range(8)}))
    asked = [tile(5, x, 0) for x in range(8)]
    for each in asked:
        source.fill_tile(each)
    stage.frames(1)
    assert sum(each.texture is not None for each in asked) == MAX_TILES_PER_FRAME
    stage.frames(1)
    assert all(each.texture is not None for each in asked)


def test_a_tile_that_went_out_of_sight_is_not_read(tmp_path, stage):
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, {(4, 1, 2): picture("red")}))
    asked = tile(4, 1, 2)
    source.fill_tile(asked)
    asked.state = "done"
    stage.frames(2)
    assert asked.texture is None


@pytest.mark.parametrize(
    ("about", "sentence"),
    [
        ({"format": "png", "minzoom": "3"}, "does not say its maxzoom"),
        ({**PLAIN, "format": "pbf"}, "holds pbf tiles; only png and jpg"),
    ],
)
def test_a_file_that_cannot_be_shown_says_why(tmp_path, about, sentence):
    with pytest.raises(ValueError, match=sentence):
        MBTiles(write(tmp_path / "a.mbtiles", about, {}))


def test_a_file_that_is_not_there_or_is_no_database_is_one_sentence(tmp_path):
    (tmp_path / "text.mbtiles").write_text("no database")
    for name in ("missing.mbtiles", "text.mbtiles"):
        with pytest.raises(ValueError, match=f"{name} cannot be read as an MBTiles file"):
            MBTiles(tmp_path / name)
    assert not (tmp_path / "missing.mbtiles").exists()


def test_the_shipped_file_is_small_and_goes_down_to_a_few_centimetres():
    source = MBTiles(SHIPPED)
    assert (source.min_zoom, source.max_zoom) == (17, 22)
    assert SHIPPED.stat().st_size < 1_000_000


def bomb(side: int) -> bytes:
    """A small file whose header asks for a large picture."""
    raw = io.BytesIO()
    Image.new("1", (side, side)).save(raw, "PNG")
    return raw.getvalue()


@pytest.mark.parametrize(
    "data",
    [bomb(MAX_TILE_SIDE + 1), b"", b"no picture", picture("red")[:60], "text", None, b"GIF89a" + bytes(40)],
    ids=["large", "empty", "words", "cut", "text", "null", "gif"],
)
def test_a_tile_that_is_no_small_picture_is_a_gap_and_is_not_decoded(tmp_path, stage, caplog, data):
    tiles = {(4, 1, 2): data, (4, 2, 2): data, (4, 3, 2): picture("red")}
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, tiles))
    asked = [tile(*key) for key in tiles]
    filled(source, stage, *asked)
    assert [one.texture is not None for one in asked] == [False, False, True]
    assert source.refused == 2
    assert sum("is not shown" in record.getMessage() for record in caplog.records) == 1


@pytest.mark.parametrize(("side", "a_frame"), [(256, MAX_TILES_PER_FRAME), (512, 2), (MAX_TILE_SIDE, 1)])
def test_large_tiles_are_read_over_more_frames_so_that_none_of_them_is_long(tmp_path, stage, side, a_frame):
    tiles = {(5, x, 0): picture("red", side) for x in range(8)}
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, tiles))
    asked = [tile(*key) for key in tiles]
    for each in asked:
        source.fill_tile(each)
    for frame in range(1, 9):
        stage.frames(1)
        assert sum(each.texture is not None for each in asked) == min(8, frame * a_frame)
