from __future__ import annotations

import math
import shutil
import threading
from pathlib import Path

import pytest

import widgets
from app.core.settings_store import Settings
from app.maps.ground_keeper import GroundKeeper
from app.maps.map_source import Source
from app.maps.maps import READERS, KeptTiles, Maps, described
from app.maps.placed_picture import PlacedPicture
from app.maps.robot_place import PLACE_PERIOD
from app.maps.sources import NO_MAP
from app.maps.tile_store import Stored
from bridge.core.geo import Datum
from bridge.msgs.pilothouse_msgs import RobotInfo
from tests.app.maps.test_floor_plan import write as write_plan
from widgets.map.ground import PictureGround, TileGround

SHIPPED = Path(widgets.__file__).parent / "data" / "parking_lot.mbtiles"
HERE = RobotInfo(latitude=45.5069, longitude=-73.579)


class Map:
    ground = None
    ground_opacity = 1.0


@pytest.fixture
def maps(tmp_path, stage):
    before = threading.active_count()
    settings = Settings(tmp_path)
    made = Maps(settings, tmp_path)
    yield made
    made.close()
    settings.close()
    assert threading.active_count() == before


@pytest.fixture
def told():
    return {}


@pytest.fixture
def clock():
    return [100.0]


@pytest.fixture
def keeper(maps, told, clock):
    made = GroundKeeper(Map(), maps, told.get, lambda: clock[0])
    yield made
    made.close()
    while any(thread.name == "map picture" for thread in threading.enumerate()):
        threading.Event().wait(0.001)


def read(keeper):
    keeper.look()
    while keeper._reading is not None:
        keeper.look()


def test_nothing_lies_beneath_a_map_before_it_is_known_where_it_is(keeper, told):
    keeper.look()
    assert (keeper.source, keeper._map.ground) == (None, None)
    told["/robot/info"] = HERE
    keeper.look()
    assert isinstance(keeper._map.ground, TileGround)
    first = keeper._map.ground
    keeper.look()
    assert keeper._map.ground is first, "nothing changed"


def test_nothing_is_asked_of_the_network_before_an_operator_gave_an_address(keeper, told, maps, monkeypatch):
    monkeypatch.setattr(maps.server, "fetch", lambda *_: pytest.fail("a tile was asked for"))
    told["/robot/info"] = HERE
    keeper.look()
    keeper._map.ground.finish()
    assert not maps.folder.exists(), "and nothing is kept"


def test_a_robot_that_comes_to_be_elsewhere_has_the_map_of_that_place(keeper, told, clock):
    told["/robot/info"] = HERE
    keeper.look()
    ground = keeper._map.ground
    told["/robot/info"] = RobotInfo(latitude=47.0, longitude=8.0)
    clock[0] += PLACE_PERIOD
    keeper.look()
    assert keeper._map.ground is None
    assert ground.source.reader._closed


def test_tiles_are_opened_once_and_follow_a_place_that_jumps(keeper, told, clock, maps, monkeypatch):
    told["/robot/info"] = HERE
    keeper.look()
    source = keeper._map.ground.source
    monkeypatch.setattr(maps, "open", lambda *_: pytest.fail("it is opened again"))
    for number in range(1, 11):
        clock[0] += PLACE_PERIOD
        told["/robot/info"] = RobotInfo(latitude=HERE.latitude + number * 1e-5, longitude=HERE.longitude)
        keeper.look()
        ground = keeper._map.ground
        assert (ground.source, ground.datum.latitude) == (source, told["/robot/info"].latitude)
    assert not source.reader._closed


def test_a_picture_on_earth_is_read_once_and_follows_a_place_that_jumps_while_it_is_read(
    keeper, told, clock, maps, monkeypatch
):
    """A picture of a square of 0.01 degrees, read for as long as the robot's place jumps."""
    reads, may_end = [], threading.Event()
    corners = ((45.5, -73.58), (45.5, -73.57), (45.51, -73.57), (45.51, -73.58))

    def slowly(path):
        reads.append(path)
        may_end.wait(60)
        return PlacedPicture(1, 1, b"grey", corners)

    monkeypatch.setitem(READERS, "geotiff", slowly)
    maps.sources.put(Source("g", "geotiff", "Aerial", "/nowhere/a.tif", box=(-73.58, 45.5, -73.57, 45.51)))
    for number in range(20):
        told["/robot/info"] = RobotInfo(latitude=45.506 + number % 2 * 1e-3, longitude=-73.575)
        clock[0] += PLACE_PERIOD
        keeper.look()
    may_end.set()
    read(keeper)
    assert len(reads) == 1
    told["/robot/info"] = RobotInfo(latitude=45.508, longitude=-73.575)
    clock[0] += PLACE_PERIOD
    keeper.look()
    assert len(reads) == 1
    assert keeper._map.ground.corners[0] == pytest.approx(Datum(45.508, -73.575).to_local(*corners[0]))


def test_no_second_picture_is_read_while_one_that_is_not_looked_at_any_more_still_is(
    keeper, told, clock, maps, monkeypatch
):
    reads, may_end = [], threading.Event()

    def slowly(path):
        reads.append(path.name)
        may_end.wait(60)
        return PlacedPicture(1, 1, b"grey", ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)), on_earth=False)

    monkeypatch.setitem(READERS, "map_server", slowly)
    for name in ("b", "a"):
        maps.sources.put(Source(name, "map_server", name, f"/nowhere/{name}.yaml"))
    for number in range(20):
        maps.sources.choose("ab"[number % 2])
        keeper.look()
    assert reads == ["a.yaml"]
    may_end.set()
    read(keeper)
    assert (reads, keeper.source.id, keeper.problem) == (["a.yaml", "b.yaml"], "b", "")
    assert isinstance(keeper._map.ground, PictureGround)


def test_a_floor_plan_is_read_in_a_thread_and_lies_in_the_frame_of_the_map(keeper, maps, tmp_path):
    maps.sources.put(described(write_plan(tmp_path)))
    read(keeper)
    assert isinstance(keeper._map.ground, PictureGround)
    assert keeper._map.ground.corners[1] == (1.0, 2.0)
    assert keeper.trouble == ""


def test_a_file_that_went_away_is_said_once(keeper, maps, told, tmp_path):
    told["/robot/info"] = HERE
    copy = shutil.copy(SHIPPED, tmp_path / "town.mbtiles")
    maps.sources.put(described(copy))
    copy.unlink()
    keeper.look()
    assert keeper._map.ground is None
    assert "cannot be read as an MBTiles file" in keeper.news()
    keeper.look()
    assert keeper.news() == ""
    assert "cannot be read" in keeper.trouble


def test_a_plan_that_was_damaged_since_it_was_added_is_said(keeper, maps, tmp_path):
    path = write_plan(tmp_path)
    maps.sources.put(described(path))
    (tmp_path / "a.pgm").write_bytes(b"words")
    read(keeper)
    assert "is no PGM, PNG or JPEG picture" in keeper.news()


def test_what_is_chosen_and_how_plainly_it_is_seen_holds_at_the_next_look(keeper, maps, told):
    told["/robot/info"] = HERE
    maps.sources.set_opacity(0.3)
    keeper.look()
    assert keeper._map.ground_opacity == 0.3
    maps.sources.choose(NO_MAP)
    keeper.look()
    assert keeper._map.ground is None


def test_a_file_is_described_by_what_it_holds(tmp_path):
    source = described(SHIPPED)
    assert (source.kind, source.min_zoom, source.max_zoom) == ("mbtiles", 17, 22)
    assert source.covers(45.5069, -73.579)
    assert not source.covers(47.0, 8.0)
    plan = described(write_plan(tmp_path))
    assert (plan.kind, plan.name, plan.covers(math.nan, math.nan)) == ("map_server", "a", True)
    with pytest.raises(ValueError, match=r"notes.txt is no map: .mbtiles, .tif"):
        described(tmp_path / "notes.txt")


def test_a_tile_of_an_offline_region_is_there_without_the_network_and_a_newer_one_wins(maps):
    class Region:
        class file:
            @staticmethod
            def get(tile):
                return Stored(b"region", expires=100.0)

    kept = KeptTiles("s", maps.store, [Region])
    assert kept.get((1, 0, 0), 50.0).data == b"region"
    kept.put((1, 0, 0), Stored(b"newer", expires=80.0), 50.0)
    assert kept.get((1, 0, 0), 50.0).data == b"newer"
    assert kept.get((1, 0, 0), 90.0).data == b"region"
