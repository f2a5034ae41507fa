from __future__ import annotations

import io
import sqlite3
import threading
from contextlib import closing
from pathlib import Path
from types import SimpleNamespace

import pytest
from kivy.core.image import ImageData
from PIL import Image

from widgets.map.tiles.mbtiles import MBTiles
from widgets.map.tiles.tile_pictures import MAX_TILES_PER_FRAME
from widgets.map.tiles.tile_reader import MAX_AHEAD, MAX_TILE_SIDE, decoded, tile_size

SHIPPED = Path(__file__).parents[4] / "widgets/data/parking_lot.mbtiles"
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


def ask(source: MBTiles, *tiles: SimpleNamespace) -> None:
    for each in tiles:
        source.fill_tile(each)


def filled(source: MBTiles, *tiles: SimpleNamespace) -> None:
    ask(source, *tiles)
    source.finish()


class Slow:
    """A decoder that takes as long as the test wants."""

    def __init__(self) -> None:
        self.may, self.begun, self.decoded = threading.Semaphore(0), threading.Semaphore(0), 0

    def __call__(self, data: object) -> ImageData:
        self.begun.release()
        self.may.acquire()
        self.decoded += 1
        return decoded(data)


def test_a_file_with_bounds_and_no_center_can_be_opened(tmp_path):
    source = MBTiles(write(tmp_path / "a.mbtiles", {**PLAIN, "bounds": "-1,2,3,4"}, {}))
    assert source.box == (-1, 2, 3, 4)
    assert source.bounds is None, "mapview would fail at the first pan"
    assert (source.min_zoom, source.max_zoom) == (3, 5)


def test_a_tile_gets_its_texture_in_one_of_the_next_frames(tmp_path, stage):
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, {(4, 1, 2): picture("red")}))
    asked = tile(4, 1, 2)
    filled(source, asked)
    assert asked.texture.size == (256, 256)
    assert (asked.state, asked.g_color.a) == ("animated", 1.0)


def test_a_tile_that_was_read_is_handed_over_at_once(tmp_path, stage):
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, {(4, 1, 2): picture("red")}))
    first, again = tile(4, 1, 2), tile(4, 1, 2)
    filled(source, first)
    source.fill_tile(again)
    assert again.texture is first.texture


def test_two_files_do_not_show_each_others_tiles(tmp_path, stage):
    found = []
    for name in ("red", "blue"):
        source = MBTiles(write(tmp_path / f"{name}.mbtiles", PLAIN, {(4, 1, 2): picture(name)}))
        asked = tile(4, 1, 2)
        filled(source, asked)
        found.append(asked.texture)
    assert found[0] is not found[1]


def test_where_there_is_no_sharp_tile_a_part_of_a_coarser_one_is_shown(tmp_path, stage):
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, {(3, 1, 1): picture("red")}))
    asked = tile(5, 7, 4)
    filled(source, asked)
    assert asked.texture.size == (64, 64)


def test_until_a_sharp_tile_is_read_a_part_of_a_coarser_one_stands_in_for_it(tmp_path, stage):
    tiles = {(3, 1, 1): picture("red"), (5, 7, 4): picture("blue")}
    slow = Slow()
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, tiles), slow)
    slow.may.release()
    filled(source, tile(3, 1, 1))
    sharp = tile(5, 7, 4)
    ask(source, sharp)
    stage.frames(1)
    assert sharp.texture.size == (64, 64)
    assert sharp.state == "loading"
    slow.may.release()
    source.finish()
    assert (sharp.texture.size, sharp.state) == ((256, 256), "animated")


@pytest.mark.parametrize("how", [{}, {"lossless": True}, {"exif": b"Exif\0\0more"}])
def test_webp_tiles_are_shown_and_their_size_is_known_before_they_are_decoded(tmp_path, stage, how):
    raw = io.BytesIO()
    Image.new("RGB", (200, 130), "red").save(raw, "WEBP", **how)
    assert tile_size(raw.getvalue()) == ("webp", 200, 130)
    file = write(tmp_path / "a.mbtiles", {**PLAIN, "format": "webp"}, {(4, 1, 2): raw.getvalue()})
    source, asked = MBTiles(file), tile(4, 1, 2)
    filled(source, asked)
    assert asked.texture.size == (200, 130)


def test_a_gap_stays_a_gap(tmp_path, stage):
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, {}))
    asked = tile(5, 7, 4)
    filled(source, asked)
    assert (asked.state, asked.texture) == ("done", None)


def test_a_tile_that_went_out_of_sight_is_not_read(tmp_path, stage):
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, {(4, 1, 2): picture("red")}))
    asked = tile(4, 1, 2)
    source.fill_tile(asked)
    asked.state = "done"
    stage.frames(2)
    source.finish()
    assert asked.texture is None


def test_a_slow_decoder_does_not_hold_a_frame(tmp_path, stage):
    slow = Slow()
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, {(4, 1, 2): picture("red")}), slow)
    asked = tile(4, 1, 2)
    ask(source, asked)
    stage.frames(1)
    slow.begun.acquire()
    stage.frames(30)  # all while the decoder is at work; it is let go by nobody but this test
    assert (asked.texture, slow.decoded) == (None, 0)
    slow.may.release()
    source.finish()
    assert asked.texture.size == (256, 256)


def test_tiles_that_scroll_out_of_sight_before_their_turn_are_not_decoded(tmp_path, stage):
    slow = Slow()
    tiles = {(5, x, 0): picture("red") for x in range(8)}
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, tiles), slow)
    gone, *others = asked = [tile(*key) for key in tiles]
    seen = others.pop()
    ask(source, *asked)
    stage.frames(1)
    slow.begun.acquire()
    for each in (gone, *others):
        each.state = "done"
    stage.frames(1)
    slow.may.release(8)
    source.finish()
    assert slow.decoded == 2, "the one at work and the one in sight"
    assert [each.texture is not None for each in asked] == [False] * 7 + [True]
    assert seen.texture is not None


def test_closing_drops_what_waits_and_leaves_no_thread(tmp_path, stage, monkeypatch):
    before = threading.active_count()
    slow = Slow()
    tiles = {(5, x, 0): picture("red") for x in range(8)}
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, tiles), slow)
    asked = [tile(*key) for key in tiles]
    ask(source, *asked)
    stage.frames(1)
    slow.begun.acquire()
    assert threading.active_count() == before + 1
    thread, joining = source._reader._thread, threading.Event()
    join = thread.join
    monkeypatch.setattr(thread, "join", lambda timeout: (joining.set(), join(timeout)))
    closing = threading.Thread(target=source.close)
    closing.start()
    assert joining.wait(60)
    slow.may.release()  # of the one at work; a second one would wait for ever
    closing.join()
    assert threading.active_count() == before
    ask(source, *asked)
    stage.frames(3)
    assert threading.active_count() == before
    assert slow.decoded == 1
    assert not any(each.texture for each in asked)


def test_the_thread_ends_when_nothing_is_left_to_read(tmp_path, stage):
    before = threading.active_count()
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, {(4, 1, 2): picture("red")}))
    filled(source, tile(4, 1, 2))
    assert threading.active_count() == before


def test_no_more_tiles_are_decoded_ahead_than_memory_is_meant_for(tmp_path, stage):
    count = MAX_AHEAD + 5
    slow = Slow()
    slow.may.release(count)
    tiles = {(5, x, 0): picture("red") for x in range(count)}
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, tiles), slow)
    asked = [tile(*key) for key in tiles]
    ask(source, *asked)
    stage.frames(1)
    source._reader.wait()
    assert slow.decoded == MAX_AHEAD
    source.finish()
    assert all(each.texture is not None for each in asked)


def test_a_file_that_goes_away_shows_gaps_and_is_said_once(tmp_path, stage, caplog):
    path = write(tmp_path / "a.mbtiles", PLAIN, {(4, 1, 2): picture("red")})
    source = MBTiles(path)
    path.unlink()
    asked = [tile(4, 1, 2), tile(4, 2, 2)]
    filled(source, *asked)
    assert [each.state for each in asked] == ["done", "done"]
    assert sum("is not shown" in record.getMessage() for record in caplog.records) == 1


@pytest.mark.parametrize(
    ("about", "sentence"),
    [
        ({"format": "png", "minzoom": "3"}, "does not say its maxzoom"),
        ({**PLAIN, "minzoom": "9"}, "the zoom levels 9 to 5; 0 to 24 can be shown"),
        ({**PLAIN, "maxzoom": "many"}, "the zoom levels 3 to many"),
        ({**PLAIN, "bounds": "1,2,3"}, "reaches to 1,2,3, which are no four angles"),
        ({**PLAIN, "bounds": "1,nan,3,4"}, "no four angles"),
        ({**PLAIN, "format": "pbf"}, "holds pbf tiles; only png, jpg and webp"),
        ({**PLAIN, "format": "p" * 5000}, "holds p{20} tiles; only png, jpg and webp"),
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
    filled(source, *asked)
    assert [one.texture is not None for one in asked] == [False, False, True]
    assert source.refused == 2
    assert sum("is not shown" in record.getMessage() for record in caplog.records) == 1


@pytest.mark.parametrize(("side", "a_frame"), [(256, MAX_TILES_PER_FRAME), (512, 2), (MAX_TILE_SIDE, 1)])
def test_textures_are_made_over_several_frames_so_that_none_of_them_is_long(tmp_path, stage, side, a_frame):
    tiles = {(5, x, 0): picture("red", side) for x in range(8)}
    source = MBTiles(write(tmp_path / "a.mbtiles", PLAIN, tiles))
    asked = [tile(*key) for key in tiles]
    ask(source, *asked)
    stage.frames(1)
    source._reader.wait()
    for frame in range(1, 9):
        stage.frames(1)
        assert sum(each.texture is not None for each in asked) == min(8, frame * a_frame)
