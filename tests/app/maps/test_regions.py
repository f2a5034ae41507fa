from __future__ import annotations

import os
import sqlite3
import threading
from contextlib import closing
from types import SimpleNamespace

import pytest

from app.maps import regions as regions_module
from app.maps.map_source import URL, Source
from app.maps.region_file import GOOD_FOR, TABLES, RegionFile
from app.maps.regions import LEAST_FREE, MAX_FAILED_IN_ROW, MAX_TILES, RegionPlan, Regions, Surroundings
from app.maps.tile_server import NoAnswer, Tile
from app.maps.tile_store import Stored

STREETS = Source("s", URL, "Streets", "https://a.org/{z}/{x}/{y}.png", "© A")
PLAN = RegionPlan((8.0, 47.0, 8.05, 47.05), 10, 13)


class Server:
    """Answers with a tile, as often as it may; then it hangs until it may again."""

    def __init__(self) -> None:
        self.may = threading.Semaphore(10_000)
        self.came = threading.Semaphore(0)
        """Once for each tile that is asked for."""
        self.asked: list[tuple[int, int, int]] = []
        self.faults: list[NoAnswer] = []
        self.gaps: set[tuple[int, int, int]] = set()

    def fetch(self, address, tile, kept=None):
        self.came.release()
        self.may.acquire()
        self.asked.append(tile)
        if self.faults:
            raise self.faults.pop()
        return Tile(Stored(None if tile in self.gaps else b"picture"), None)

    def until_done(self, count):
        """Wait until so many are here, and the next one is asked for."""
        for _ in range(count + 1):
            assert self.came.acquire(timeout=60)


@pytest.fixture
def waits():
    return []


@pytest.fixture
def disk():
    """What is free, and what time it is."""
    return SimpleNamespace(free=10 * LEAST_FREE, now=1000.0)


@pytest.fixture
def regions(tmp_path, waits, disk):
    def wait(stop, seconds):
        waits.append(seconds)
        return stop.is_set()

    made = Regions(tmp_path, Surroundings(wait, lambda: disk.now, lambda _: disk.free))
    yield made
    made.close()


def test_a_plan_has_the_tiles_of_the_box_level_by_level():
    assert list(RegionPlan((-180.0, -85.0, 180.0, 85.0), 0, 1).tiles()) == [
        (0, 0, 0), (1, 0, 0), (1, 0, 1), (1, 1, 0), (1, 1, 1)
    ]  # fmt: skip
    assert PLAN.count == len(list(PLAN.tiles())) == len(set(PLAN.tiles()))
    assert PLAN.size == PLAN.count * PLAN.bytes_each


def test_a_plan_may_cross_the_date_line():
    tiles = list(RegionPlan((179.0, -1.0, -179.0, 1.0), 8, 8).tiles())
    assert {column for _, column, _ in tiles} == {255, 0}


def test_more_tiles_than_are_polite_are_refused_in_one_sentence(regions):
    plan = RegionPlan((8.0, 47.0, 8.5, 47.5), 10, 18)
    with pytest.raises(
        ValueError, match=rf"These are {plan.count} tiles; a region has at most {MAX_TILES}\. Choose"
    ):
        regions.begin(STREETS, "All", plan, Server())
    assert regions.all == []


def test_a_download_becomes_an_mbtiles_file_that_any_program_reads(regions, stage):
    from widgets.map.tiles.mbtiles import MBTiles

    server = Server()
    region = regions.begin(STREETS, "Harbour & more", PLAN, server)
    region.wait()
    assert (region.state, region.done, region.problem) == ("done", PLAN.count, "")
    assert region.file.path.name.startswith("harbour-more-")
    tiles = MBTiles(region.file.path)
    assert (tiles.min_zoom, tiles.max_zoom, tiles.attribution) == (10, 13, "© A")
    with closing(sqlite3.connect(region.file.path)) as file:
        assert file.execute("SELECT COUNT(*) FROM tiles").fetchone() == (PLAN.count,)
    tiles.close()
    assert region.file.get(next(PLAN.tiles())).data == b"picture"
    assert region.file.get((3, 1, 1)) is None


def test_a_pause_keeps_what_is_here_and_a_restart_goes_on_from_there(regions, tmp_path, waits):
    server = Server()
    server.may = threading.Semaphore(5)
    region = regions.begin(STREETS, "Harbour", PLAN, server)
    server.until_done(5)
    region.pause()
    assert region.state == "paused"
    server.may.release()  # the tile at work
    region.wait()
    again = Regions(tmp_path)
    (kept,) = again.of("s")
    assert (kept.name, kept.state, kept.done) == ("Harbour", "paused", 6)
    other = Server()
    kept.resume(STREETS, other)
    kept.wait()
    assert (kept.state, len(other.asked)) == ("done", PLAN.count - 6)
    again.close()
    last = Regions(tmp_path)
    assert last.all[0].state == "done"
    last.close()


def test_a_tile_that_fails_is_tried_again_later_with_longer_and_longer_pauses(regions, waits):
    server = Server()
    server.faults = [NoAnswer("Slow.", 50.0), NoAnswer("Slow."), NoAnswer("Slow.")]
    region = regions.begin(STREETS, "Harbour", PLAN, server)
    region.wait()
    assert region.state == "done"
    assert waits == [2.0, 4.0, 50.0]


def test_a_server_that_goes_on_failing_stops_the_download_which_says_why_and_can_go_on(regions):
    server = Server()
    server.faults = [NoAnswer("It is gone.")] * MAX_FAILED_IN_ROW
    region = regions.begin(STREETS, "Harbour", PLAN, server)
    region.wait()
    assert (region.state, region.problem) == ("failed", "It is gone.")
    region.resume(STREETS, server)
    region.wait()
    assert (region.state, region.problem) == ("done", "")


def test_tiles_that_a_server_does_not_have_count_as_done_and_are_not_asked_for_again(regions, tmp_path):
    server = Server()
    server.gaps = set(PLAN.tiles())
    region = regions.begin(STREETS, "Sea", PLAN, server)
    region.wait()
    again = Regions(tmp_path)
    assert again.all[0].state == "done"
    again.close()
    assert region.file.get(next(PLAN.tiles())) is None


def test_deleting_takes_the_file_away_even_in_the_middle_of_a_download(regions):
    server = Server()
    server.may = threading.Semaphore(2)
    region = regions.begin(STREETS, "Harbour", PLAN, server)
    server.until_done(2)
    regions.delete(region)
    server.may.release(10_000)
    region.wait()
    assert regions.all == []
    assert not region.file.path.exists()


def test_a_file_that_is_no_region_is_left_out(regions, tmp_path, caplog):
    (tmp_path / "x.mbtiles").write_text("no database")
    assert regions.all == []
    assert "is no offline region" in caplog.text


ODD = [
    *(
        {"pilothouse_box": box}
        for box in ("7", "null", "[1, 2, 3]", "[null, 1, 2, 3]", "[NaN, 0, 1, 1]", "[")
    ),
    *({"pilothouse_box": box} for box in ("[1, 2, 3, " + "9" * 400 + "]", "[" * 100_000, "[[], 0, 1, 1]")),
    *({"pilothouse_box": box} for box in ("[-Infinity, 0, Infinity, 1]", "[0, -91, 1, 1]", "[0, 2, 1, 1]")),
    *({"pilothouse_box": box} for box in ("[0, 0, 1, 1e300]", "[0, 0, 1e300, 1]")),
    *({"maxzoom": zoom} for zoom in ("3000", "60", "9", "many", "1e3")),
    {"minzoom": "-1"},
]


@pytest.mark.parametrize("odd", ODD, ids=lambda odd: str(odd)[:50])
def test_a_region_whose_place_or_zoom_levels_are_none_is_left_out_and_named(regions, tmp_path, caplog, odd):
    about = {"format": "png", "minzoom": "10", "maxzoom": "13", "pilothouse_box": "[8.0, 47.0, 8.1, 47.1]"}
    for name, more in (("odd", odd), ("sound", {})):
        said = {**about, "name": name, "pilothouse_source": "s", **more}
        with closing(sqlite3.connect(tmp_path / f"{name}.mbtiles")) as file, file:
            file.executescript(TABLES)
            file.executemany("INSERT INTO metadata VALUES (?, ?)", said.items())
    assert [one.name for one in regions.all] == ["sound"]
    assert "odd.mbtiles is no offline region" in caplog.text


def test_where_nothing_can_be_kept_it_is_one_sentence(tmp_path):
    (tmp_path / "regions").write_text("a file where the folder should be")
    with pytest.raises(ValueError, match="The region cannot be kept"):
        Regions(tmp_path / "regions").begin(STREETS, "Harbour", PLAN, Server())


def test_a_download_leaves_room_on_the_disk_and_keeps_what_it_has(regions, disk):
    server = Server()
    server.may = threading.Semaphore(5)
    region = regions.begin(STREETS, "Harbour", PLAN, server)
    server.until_done(5)
    disk.free = LEAST_FREE - 1
    server.may.release()  # the tile at work
    region.wait()
    assert (region.state, region.done) == ("failed", 6)
    assert region.problem == "The disk has 199 MB left; a download needs 200 MB."
    disk.free = LEAST_FREE
    server.may.release(10_000)
    region.resume(STREETS, server)
    region.wait()
    assert (region.state, region.problem) == ("done", "")


def test_a_download_for_which_the_disk_has_no_room_is_not_begun(regions, disk):
    disk.free = LEAST_FREE + PLAN.size - 1
    with pytest.raises(ValueError, match=r"The disk has \d+ MB left; a download needs \d+ MB\."):
        regions.begin(STREETS, "Harbour", PLAN, Server())
    assert regions.all == []


def test_tiles_far_larger_than_was_announced_end_the_download_which_keeps_what_it_has(regions, monkeypatch):
    monkeypatch.setattr(regions_module, "LEAST_BYTES", 0)
    monkeypatch.setattr(regions_module, "LARGER", 2)
    region = regions.begin(STREETS, "Harbour", PLAN, LargeTiles())
    region.wait()
    assert region.state == "failed"
    assert region.problem.startswith("The tiles are larger than was announced")
    assert 0 < region.done < PLAN.count
    assert region.size < (regions_module.LARGER + 1) * PLAN.size
    assert region.file.get(next(PLAN.tiles())) is not None


class LargeTiles(Server):
    def fetch(self, address, tile, kept=None):
        return Tile(Stored(bytes(100_000)), None)


def test_each_tile_is_as_old_as_it_was_when_it_was_fetched(regions, disk):
    server = Server()
    server.may = threading.Semaphore(5)
    region = regions.begin(STREETS, "Harbour", PLAN, server)
    server.until_done(5)
    region.pause()
    server.may.release(10_000)
    region.wait()
    disk.now += 50 * 86400.0
    region.resume(STREETS, server)
    region.wait()
    first, last = (region.file.get(tile).expires for tile in (server.asked[0], server.asked[-1]))
    assert (first, last) == (1000.0 + GOOD_FOR, disk.now + GOOD_FOR)


def test_tiles_of_an_earlier_versions_file_are_as_old_as_the_file(regions, tmp_path):
    region = regions.begin(STREETS, "Harbour", PLAN, Server())
    region.wait()
    regions.close()
    with closing(sqlite3.connect(region.file.path)) as file, file:
        file.execute("DROP TABLE pilothouse_fetched")
    os.utime(region.file.path, (500.0, 500.0))
    again = RegionFile.opened(region.file.path)
    assert again.get(next(PLAN.tiles())).expires == 500.0 + GOOD_FOR
    again.put(next(PLAN.tiles()), b"newer", 700.0)
    assert again.get(next(PLAN.tiles())).expires == 700.0 + GOOD_FOR
    again.close()


def test_a_file_is_opened_once_however_many_tiles_are_asked_for(regions, monkeypatch):
    region = regions.begin(STREETS, "Harbour", PLAN, Server())
    region.wait()
    monkeypatch.setattr(sqlite3, "connect", lambda *_, **__: pytest.fail("opened again"))
    assert all(region.file.get(tile) for tile in PLAN.tiles())
