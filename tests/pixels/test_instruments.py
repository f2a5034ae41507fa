"""What only the finished picture can tell: which way is up, and what lies over what."""

from __future__ import annotations

import io
import math
import sqlite3
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from bridge.core.geo import Datum
from widgets.core.canvas_ink import Ink
from widgets.core.geometry import View
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.instruments.compass import Compass
from widgets.instruments.horizon import ArtificialHorizon
from widgets.map.geo_map import GeoMap
from widgets.map.grid_map import GridMap
from widgets.sensors.video import Video

DATUM = Datum(45.5069, -73.579)


@pytest.fixture(autouse=True)
def dark():
    theme.name = "dark"


def like(pixel: np.ndarray, role: list[float], tolerance: int = 40) -> bool:
    """Whether a pixel has about the colour of a role."""
    return bool(np.abs(pixel[:3].astype(int) - np.array(role[:3]) * 255).max() < tolerance)


def at(picture: np.ndarray, x: float, y: float) -> np.ndarray:
    """The pixel at (x, y) counted from the lower left corner."""
    return picture[picture.shape[0] - 1 - round(y), round(x)]


def test_with_the_right_side_down_the_ground_stands_up_on_the_right(stage):
    picture = stage.pixels(stage.show(ArtificialHorizon(roll=0.5, pitch=0.0, state="live"), size=(200, 200)))
    assert like(at(picture, 30, 90), theme.sky)
    assert like(at(picture, 170, 110), theme.ground)


def test_with_the_nose_down_the_middle_is_ground(stage):
    picture = stage.pixels(stage.show(ArtificialHorizon(roll=0.0, pitch=0.3, state="live"), size=(200, 200)))
    assert like(at(picture, 50, 112), theme.ground)
    assert like(at(picture, 50, 165), theme.sky, 60)


def test_level_is_sky_above_ground_and_nothing_outside_the_disc(stage):
    picture = stage.pixels(stage.show(ArtificialHorizon(roll=0.0, pitch=0.0, state="live"), size=(200, 200)))
    assert like(at(picture, 40, 130), theme.sky)
    assert like(at(picture, 40, 70), theme.ground)
    assert at(picture, 4, 4)[3] == 0


def test_the_red_of_north_is_where_north_is(stage):
    picture = stage.pixels(stage.show(Compass(heading=90.0, state="live"), size=(220, 220)))
    rows, columns = np.nonzero(
        (np.abs(picture[..., :3] - np.array(theme.danger[:3]) * 255) < 30).all(axis=-1)
    )
    assert columns.mean() < 60
    assert rows.mean() == pytest.approx(110, abs=6)


def test_the_top_row_of_a_frame_is_on_top_and_its_left_column_on_the_left(stage):
    frame = np.zeros((40, 40, 4), np.uint8)
    frame[..., 3] = 255
    frame[:20, :20] = 255
    video = stage.show(Video(state="live", corner=0, show_chip=False), size=(80, 80))
    video.show_frame(40, 40, frame.tobytes())
    stage.frames()
    picture = stage.pixels(video)
    assert at(picture, 10, 70)[0] > 240
    assert max(at(picture, x, y)[0] for x, y in ((70, 70), (10, 10), (70, 10))) < 10


def test_a_covering_frame_loses_its_sides_and_not_its_shape(stage):
    frame = np.zeros((40, 80, 4), np.uint8)
    frame[..., 3] = 255
    frame[:, 30:50] = 255
    video = stage.show(Video(state="live", corner=0, show_chip=False), size=(80, 80))
    video.show_frame(80, 40, frame.tobytes())
    stage.frames()
    row = stage.pixels(video)[40, :, 0]
    assert np.flatnonzero(row > 128)[[0, -1]] == pytest.approx([20, 59], abs=1)


@pytest.mark.parametrize("corner", [0, 12])
def test_at_night_the_video_is_dim_and_red_and_by_day_as_it_was_taken(stage, corner):
    shades = np.zeros((40, 40, 4), np.uint8)
    shades[:20, :20], shades[:20, 20:], shades[20:, :20] = (255,) * 4, (40, 90, 250, 255), (30, 240, 60, 255)
    shades[..., 3] = 255
    video = stage.show(Video(state="live", corner=corner, show_chip=False), size=(80, 80))
    video.show_frame(40, 40, shades.tobytes())
    places = {"white": (30, 50), "blue": (50, 50), "green": (30, 30), "black": (50, 30)}

    def seen():
        stage.frames(2)
        picture = stage.pixels(video).astype(float)
        return {name: at(picture, *place)[:3] for name, place in places.items()}

    day = seen()
    assert day["white"].min() > 250
    assert day["blue"][2] > 240
    try:
        theme.name = "night"
        night = seen()
    finally:
        theme.name = "dark"
    for name in ("white", "blue", "green"):
        red, green, blue = night[name]
        assert red > 2 * max(green, blue) > 0, name
        assert red <= 0.62 * 255, name
    assert night["white"][0] > night["green"][0] > night["blue"][0] > 20 > night["black"].max(), (
        "light stays apart"
    )
    assert {name: tuple(colour) for name, colour in seen().items()} == {
        name: tuple(colour) for name, colour in day.items()
    }


def test_a_disc_is_round_and_its_edge_is_smooth(stage):
    class Dot(Video):
        def draw(self) -> None:
            shapes, ink = Shapes(), Ink()
            shapes.disc(30, 30, 20, (1, 1, 1, 1))
            ink.fill(shapes)
            self.canvas.add(ink)

    picture = stage.pixels(stage.show(Dot(), size=(60, 60)))[..., 3].astype(float) / 255
    assert picture.sum() == pytest.approx(math.pi * 20**2, rel=0.01)
    assert ((picture > 0.05) & (picture < 0.95)).sum() > 60


def test_a_grid_has_its_first_cell_in_the_south_west(stage):
    from bridge.msgs.arrays import Int8Array
    from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid

    made = stage.show(GridMap(state="live"), size=(200, 200))
    cells = Int8Array([100, 0, 0, 0])
    made.show(OccupancyGrid(info=MapMetaData(resolution=4.0, width=2, height=2), data=cells))
    made.set_view(View.centred(4, 4, at=(100, 100), scale=20))
    stage.frames()
    picture = stage.pixels(made)
    wall = at(picture, 50, 60)[:3].astype(int).sum()
    assert wall > at(picture, 150, 60)[:3].astype(int).sum() + 60
    assert wall > at(picture, 50, 150)[:3].astype(int).sum() + 60


def colours_file(path, tiles) -> str:
    """An MBTiles file with tiles of one colour, or of four quarters."""
    with closing(sqlite3.connect(path)) as file, file:
        file.execute("CREATE TABLE metadata (name TEXT, value TEXT)")
        file.execute("CREATE TABLE tiles (zoom_level INT, tile_column INT, tile_row INT, tile_data BLOB)")
        about = {"format": "png", "minzoom": "19", "maxzoom": "22"}
        file.executemany("INSERT INTO metadata VALUES (?, ?)", about.items())
        for key, image in tiles.items():
            raw = io.BytesIO()
            image.save(raw, "PNG")
            file.execute("INSERT INTO tiles VALUES (?, ?, ?, ?)", (*key, raw.getvalue()))
    return str(path)


def quarters() -> Image.Image:
    """White in the north-west, black elsewhere."""
    image = Image.new("RGB", (256, 256), "black")
    image.paste("white", (0, 0, 128, 128))
    return image


@pytest.mark.parametrize("zoom", [19, 20, 21])
def test_a_coarse_tile_stands_in_for_finer_ones_the_right_way_round(stage, tmp_path, zoom):
    from scripts.make_mbtiles import Mercator

    grid = Mercator(DATUM, 19)
    column, row, west, north = next(grid.tiles(0.1))
    path = colours_file(tmp_path / "q.mbtiles", {(19, column, 2**19 - 1 - row): quarters()})
    made = stage.show(GeoMap(tiles=path, datum=DATUM, state="live"), size=(400, 400))
    middle = west + grid.metres / 2, north - grid.metres / 2
    scale = 256 / grid.metres * 2 ** (zoom - 19)
    made.set_view(View.centred(*middle, at=(200, 200), scale=scale * 1.01))
    stage.frames(6)
    made.finish_pictures()
    assert made.ground.pictures.zoom == zoom
    picture = stage.pixels(made)
    light = {name: int(at(picture, x, y)[0]) for name, x, y in (
        ("north-west", 170, 250), ("north-east", 250, 250), ("south-west", 150, 150), ("south-east", 250, 150),
    )}  # fmt: skip
    assert light.pop("north-west") > 150
    assert max(light.values()) < 40


@pytest.mark.parametrize("turn", [0.0, 0.5, 2.0])
def test_pictures_beneath_a_map_turn_with_it(stage, tmp_path, turn):
    from scripts.make_mbtiles import Mercator
    from widgets.map.ground import TileGround
    from widgets.map.tiles.mbtiles import MBTiles

    grid = Mercator(DATUM, 19)
    column, row, west, north = next(grid.tiles(0.1))
    path = colours_file(tmp_path / "q.mbtiles", {(19, column, 2**19 - 1 - row): quarters()})
    made = stage.show(GridMap(state="live"), size=(400, 400))
    made.ground = ground = TileGround(MBTiles(Path(path)), DATUM)
    x, y = west + grid.metres / 2, north - grid.metres / 2
    made.set_view(View.centred(x, y, at=(200, 200), scale=256 / grid.metres * 1.01, turn=turn))
    stage.frames(6)
    ground.finish()
    picture = stage.pixels(made)
    light = {}
    for east in (-1, 1):
        for up in (-1, 1):
            px, py = made.view.to_screen(x + east * grid.metres / 5, y + up * grid.metres / 5)
            light[east, up] = int(at(picture, round(px), round(py))[0])
    ground.close()
    assert light.pop((-1, 1)) > 150
    assert max(light.values()) < 60


def test_a_picture_beneath_a_map_lies_between_its_corners(stage):
    from kivy.graphics.texture import Texture

    from widgets.map.ground import PictureGround

    texture = Texture.create(size=(2, 2), colorfmt="rgba")
    white, black = bytes([255] * 4), bytes([0, 0, 0, 255])
    texture.blit_buffer(white + black + black + black, colorfmt="rgba", bufferfmt="ubyte")
    texture.mag_filter = "nearest"
    made = stage.show(GridMap(state="live"), size=(400, 400))
    made.ground = PictureGround(texture, [(0, 0), (0, 10), (-10, 10), (-10, 0)])
    made.set_view(View.centred(-5, 5, at=(200, 200), scale=20))
    stage.frames(2)
    picture = stage.pixels(made)
    light = {place: int(at(picture, *place)[0]) for place in ((130, 130), (270, 130), (130, 270), (270, 270))}
    assert light.pop((270, 130)) > 150, (
        "its lower left corner lies in the south-east, as it is turned by a quarter"
    )
    assert max(light.values()) < 60


def test_two_files_at_once_show_each_their_own_pictures(stage, tmp_path):
    from scripts.make_mbtiles import Mercator

    seen = []
    for name in ("red", "blue"):
        tiles = {
            (19, column, 2**19 - 1 - row): Image.new("RGB", (256, 256), name)
            for column, row, _, _ in Mercator(DATUM, 19).tiles(100.0)
        }
        path = colours_file(tmp_path / f"{name}.mbtiles", tiles)
        made = stage.show(GeoMap(tiles=path, datum=DATUM, state="live"), size=(200, 200))
        stage.frames(6)
        made.finish_pictures()
        seen.append(at(stage.pixels(made), 30, 150)[:3].astype(int))
    red, blue = seen
    assert red[0] > 150 > 60 > red[2]
    assert blue[2] > 150 > 60 > blue[0]


def test_what_a_map_shows_stays_inside_it(stage):
    from kivy.uix.floatlayout import FloatLayout

    root = FloatLayout(size_hint=(None, None), size=(300, 200))
    made = GridMap(size_hint=(None, None), size=(150, 200), state="live")
    made.waypoints = [(0.0, 0.0), (30.0, 0.0)]
    root.add_widget(made)
    stage.show(root)
    made.set_view(View.centred(0, 0, at=(75, 100), scale=20))
    stage.frames(2)
    assert stage.pixels(root)[:, 152:, 3].max() == 0


@pytest.mark.parametrize("change", [{"show_chip": False}, {"state": "stale", "age": 3.0}])
def test_a_chip_with_nothing_to_say_leaves_no_ground_behind(stage, change):
    video = stage.show(Video(state="live", corner=0, rate=15.0), size=(320, 240))
    video.show_frame(320, 240, bytes([255, 255, 255, 255]) * 320 * 240)
    stage.frames(3)
    there = video._chip.ground.pos[0] + 4, video._chip.ground.pos[1] + video._chip.ground.size[1] / 2
    assert at(stage.pixels(video), *there)[0] < 100
    for name, value in change.items():
        setattr(video, name, value)
    stage.frames(3)
    picture = stage.pixels(video)
    assert (at(picture, *there) == at(picture, 310, there[1])).all()


def test_a_veil_that_is_taken_away_covers_nothing(stage):
    video = stage.show(Video(state="disabled", corner=0), size=(320, 240))
    stage.frames(3)
    covers = tuple(video.veil_box[2:])
    (veil,) = (one for one in video.canvas.after.children if getattr(one, "size", None) == covers)
    video.state = "live"
    stage.frames(3)
    assert not veil.drawn
