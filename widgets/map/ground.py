"""What may lie beneath a map: tiles, or one picture, placed in the `map` frame.

map.ground = TileGround(MBTiles(Path("town.mbtiles")), Datum(45.5069, -73.579))
map.ground = PictureGround(picture, corners=[(0, 0), (20, 0), (20, 10), (0, 10)])
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from kivy.clock import Clock
from kivy.graphics import Color, PopMatrix, PushMatrix, Quad, Rotate
from kivy.graphics.texture import Texture
from kivy.input import MotionEvent
from kivy_garden.mapview import MapView

from bridge.core.geo import Datum
from widgets.core.canvas_ink import tint
from widgets.core.geometry import View
from widgets.core.theme import theme
from widgets.map.beneath import Box, Ground
from widgets.map.tiles.tile_pictures import TilePictures

__all__ = ["PictureGround", "TileGround"]

PROBE_LENGTH = 100.0
"""Length of the ways by which the scale of the pictures is measured [m]."""
MAX_ENLARGEMENT = 128.0
"""How far the sharpest tiles may be enlarged."""
MAX_LATITUDE = 85.0
"""North and south of it Mercator's projection has no tiles [deg]."""
LEAST_SHARE = 0.3
"""Tiles that would be drawn at less of their size than this are too many, and are not drawn."""


class TileGround(Ground):
    """Tiles in Mercator's projection, turned with the map.

    The map is a plane: a tile is off by at most 0.3 % of its distance from the middle of the glass, which is some
    pixels at the edge of a tablet.
    """

    def __init__(self, source: TilePictures, datum: Datum) -> None:
        """`source` is closed with this; `datum` is where the map's origin is on earth."""
        super().__init__()
        self.source, self.datum = source, datum
        self.attribution = source.attribution
        self.pictures = _Pictures(map_source=source)
        self._turn = Rotate(axis=(0, 0, 1), angle=0.0)
        for part in (PushMatrix(), self._turn, self.pictures.canvas, PopMatrix()):
            self.canvas.add(part)

    def scale_at(self, zoom: float) -> float:
        """Pixels to a metre at a zoom level: the mean of east and north, which differ a little."""
        source, latitude = self.source, min(max(self.datum.latitude, -MAX_LATITUDE), MAX_LATITUDE)
        datum = Datum(latitude, 0.0)  # each longitude has the same scale, and 0 is far from the date line
        near, east, north = (
            datum.to_geographic(*place) for place in ((0, 0), (PROBE_LENGTH, 0), (0, PROBE_LENGTH))
        )
        wide = source.get_x(zoom, east[1]) - source.get_x(zoom, near[1])
        high = source.get_y(zoom, north[0]) - source.get_y(zoom, near[0])
        return math.sqrt(wide * high) / PROBE_LENGTH

    def place(self, view: View, box: Box) -> bool:
        """Tiles of the level that is enlarged least."""
        if abs(self.datum.latitude) > MAX_LATITUDE:
            return False
        source, (x, y, wide, high) = self.source, box
        least = self.scale_at(source.min_zoom)
        steps = math.log2(max(view.scale / least, 1.0))
        zoom = min(source.min_zoom + int(steps + 1e-6), source.max_zoom)
        scale = view.scale / (least * 2.0 ** (zoom - source.min_zoom))
        if not LEAST_SHARE <= scale <= MAX_ENLARGEMENT:
            return False
        middle = x + wide / 2, y + high / 2
        self._turn.angle, self._turn.origin = math.degrees(view.turn), middle
        if view.turn:  # a square that covers the box however it is turned
            wide = high = math.hypot(wide, high)
        self.pictures.pos, self.pictures.size = (middle[0] - wide / 2, middle[1] - high / 2), (wide, high)
        self.pictures.look_at(*self.datum.to_geographic(*view.to_world(*middle)), zoom, scale)
        return True

    def moved(self, datum: Datum) -> TileGround:
        """The same tiles, none of them read again, for a map whose origin is at `datum`; it takes the place of this one."""
        self.pictures.unload()
        return TileGround(self.source, datum)

    def finish(self) -> None:
        """Wait until the tiles in sight are there."""
        self.source.finish()

    def close(self) -> None:
        """End the reading of tiles."""
        self.source.close()
        self.pictures.unload()


class PictureGround(Ground):
    """One picture between four corners of the map, as a floor plan or an aerial photograph."""

    def __init__(
        self, texture: Texture, corners: Sequence[tuple[float, float]], attribution: str = ""
    ) -> None:
        """`corners` are places of the map [m]: of the picture's lower left, lower right, upper right and upper left."""
        super().__init__()
        self.corners, self.attribution = tuple(corners), attribution
        self._texture, self._quad = texture, Quad(texture=texture)
        self.canvas.add(Color(1, 1, 1, 1))
        self.canvas.add(self._quad)

    def moved(self, corners: Sequence[tuple[float, float]]) -> PictureGround:
        """The same picture at other places of the map; it takes the place of this one."""
        return PictureGround(self._texture, corners, self.attribution)

    def place(self, view: View, box: Box) -> bool:
        """Bring the corners to their places."""
        places = [view.to_screen(*corner) for corner in self.corners]
        self._quad.points = [number for place in places for number in place]
        across, up = [place[0] for place in places], [place[1] for place in places]
        x, y, wide, high = box
        return min(across) < x + wide and max(across) > x and min(up) < y + high and max(up) > y


class _Pictures(MapView):
    """mapview's tiles and nothing else of it: no touch, no fade, no clock of its own."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(size_hint=(None, None), animation_duration=0, **kwargs)
        # it would look for tiles to fade in sixty times a second for ever
        Clock.unschedule(self._animate_color)
        self._scatter.scale_max = 2 * MAX_ENLARGEMENT
        self.background_color = tint(theme.bg, 0.0)
        for child in self.children[:]:
            if child is not self._scatter:
                self.remove_widget(child)  # its label for the attribution; the map says it in its own words

    def look_at(self, latitude: float, longitude: float, zoom: int, scale: float) -> None:
        """Show a place [deg] in the middle, at a zoom level enlarged `scale` times."""
        if (zoom, scale) != (self._zoom, self._scatter.scale):
            self._transform_lock = True  # else it would choose a zoom of its own
            self._scatter.scale, self._scale, self._invalid_scale = scale, scale, False
            self._zoom = self.zoom = zoom
            self._transform_lock = False
        self.center_on(latitude, longitude)

    def on_touch_down(self, touch: MotionEvent) -> bool:
        """Leave every finger to the map above."""
        return False

    on_touch_move = on_touch_up = on_touch_down
