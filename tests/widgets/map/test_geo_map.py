from __future__ import annotations

import math
from pathlib import Path

import pytest

from bridge.core.geo import Datum
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped
from bridge.msgs.sensor_msgs import NavSatFix, NavSatStatus
from widgets.core.base import text_texture
from widgets.core.geometry import View
from widgets.map.beneath import attribution_words, scale_room
from widgets.map.geo_map import GeoMap

DATUM = Datum(45.5069, -73.579)
TILES = str(Path(__file__).parents[3] / "widgets/data/parking_lot.mbtiles")


@pytest.fixture
def map_(stage):
    made = stage.show(GeoMap(tiles=TILES, datum=DATUM), size=(600, 400))
    made.set_view(View.centred(0, 0, at=(300, 200), scale=20))
    stage.frames(3)
    return made


def on_pictures(map_: GeoMap, x: float, y: float) -> tuple[float, float]:
    """Where the pictures have a place of the map [px]."""
    latitude, longitude = map_.datum.to_geographic(x, y)
    pictures = map_.ground.pictures
    return pictures.get_window_xy_from(latitude, longitude, pictures.zoom)


def agree(map_: GeoMap, x: float, y: float) -> bool:
    """Whether picture and mark of a place agree to 0.3 % of their distance from the middle, or half a pixel."""
    picture, mark = on_pictures(map_, x, y), map_.view.to_screen(x, y)
    return math.dist(picture, mark) < 0.5 + 0.003 * math.dist(mark, map_.center)


@pytest.mark.parametrize("scale", [3.0, 8.0, 20.0, 45.0, 130.0])
@pytest.mark.parametrize("place", [(0, 0), (12, -7), (-17, 12)])
def test_pictures_and_marks_agree(map_, stage, scale, place):
    map_.set_view(View.centred(3, -2, at=(310, 190), scale=scale))
    stage.frames(2)
    assert agree(map_, *place)


def test_pictures_and_marks_agree_after_a_pan_and_a_new_place_on_the_window(map_, stage):
    stage.drag([(300, 100), (340, 130), (390, 160)])
    map_.pos = 50, 30
    map_.size = 500, 420
    stage.frames(3)
    assert agree(map_, 4, 5)


def test_a_tap_gives_metres_of_the_map(map_, stage):
    taps = []
    map_.bind(on_add=lambda _, x, y: taps.append((x, y)))
    map_.mode = "points"
    stage.tap(400, 180)
    assert taps == [pytest.approx((5, -1))]


def test_two_fingers_zoom_and_do_not_turn(map_, stage):
    one, two = stage.touch(200, 200), stage.touch(400, 200)
    one.touch_down()
    two.touch_down()
    two.touch_move(200, 500)
    one.touch_up()
    two.touch_up()
    assert map_.view.turn == 0
    assert map_.view.scale == pytest.approx(30)


def test_the_pictures_set_the_limits_of_the_zoom(map_):
    map_.set_view(View.centred(0, 0, at=(300, 200), scale=0.001))
    farthest = map_.view.scale
    map_.set_view(View.centred(0, 0, at=(300, 200), scale=9999))
    assert map_.view.scale / farthest == pytest.approx(2**5 * 8, rel=1e-3)


def test_the_zoom_level_is_the_one_whose_pictures_are_enlarged_least(map_, stage):
    for scale, zoom in ((2.0, 17), (10.0, 20), (30.0, 21), (50.0, 22), (200.0, 22)):
        map_.set_view(View.centred(0, 0, at=(300, 200), scale=scale))
        stage.frames(1)
        assert map_.ground.pictures.zoom == zoom


def test_nothing_goes_on_when_the_map_stands_still(map_, stage):
    stage.frames(20)
    waiting = [event.callback for event in stage.clock.get_events() if event.is_triggered]
    assert not [
        callback for callback in waiting if "mapview" in str(callback) or "_Pictures" in str(callback)
    ]


def test_without_a_datum_or_a_file_it_is_a_plain_map(stage):
    made = stage.show(GeoMap(tiles=TILES), size=(300, 200))
    assert made.ground is None
    made.datum = DATUM
    stage.frames()
    assert made.ground is not None
    made.tiles = ""
    stage.frames()
    assert made.ground is None


def test_a_file_that_cannot_be_read_is_said_at_once(tmp_path):
    with pytest.raises(ValueError, match="cannot be read"):
        GeoMap(tiles=str(tmp_path / "none.mbtiles"), datum=DATUM)


def test_the_default_source_of_mapview_is_never_asked(stage, monkeypatch):
    from kivy_garden.mapview.downloader import Downloader

    monkeypatch.setattr(Downloader, "instance", lambda **_: pytest.fail("a tile was asked of the internet"))
    made = stage.show(GeoMap(tiles=TILES, datum=DATUM), size=(300, 200))
    made.zoom_in()
    stage.frames(3)


@pytest.mark.parametrize("wide", [90, 150, 240, 330, 600])
@pytest.mark.parametrize("foot", [0.0, math.nan])
def test_whom_the_pictures_are_of_is_told_whole_beside_the_scale_or_above_it(stage, wide, foot):
    words = attribution_words("Drawn from the simulated world", (0, 0, wide, 400), foot, above=False)
    assert " ".join(word.text for word in words) == "Drawn from the simulated world"
    for word in words:
        long = text_texture(word.text, word.size).width
        left = word.x - word.anchor[0] * long
        assert left >= 0
        assert left + long <= wide
        assert math.isnan(foot) or left >= scale_room(wide) or word.y >= 40, "not over the scale"


def fix(east: float, north: float, status: int = 0) -> NavSatFix:
    latitude, longitude = DATUM.to_geographic(east, north)
    return NavSatFix(latitude=latitude, longitude=longitude, status=NavSatStatus(status=status))


def test_a_fix_alone_makes_a_map_whose_origin_is_where_the_first_was(stage):
    made = stage.show(GeoMap(state="live"), size=(400, 300))
    made.show(fix(0, 0, status=-1))
    assert (made.located, made.datum) == (False, None)
    made.show(fix(0, 0))
    made.show(fix(30, -20))
    stage.frames(2)
    assert made.robot[:2] == pytest.approx((30, -20), abs=1e-6)
    assert made.view.to_screen(30, -20) == pytest.approx(made.center, abs=1), "it is followed"
    assert len(made.trail) == 2
    made.show(NavSatFix(latitude=math.nan, longitude=8.0))
    assert not made.located, "no old place is shown as if it were that of now"


def test_a_fix_claims_no_heading_and_a_pose_brings_it_back(stage, monkeypatch):
    arrows = []
    monkeypatch.setattr("widgets.map.map_marks.robot_mark", lambda *_, **__: arrows.append(1))
    made = stage.show(GeoMap(datum=DATUM, state="live"), size=(400, 300))
    made.show(fix(3, 4))
    stage.frames(2)
    assert (made.located, arrows) == (True, [])
    made.show(PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(5.0, 4.0)))))
    stage.frames(2)
    assert arrows
