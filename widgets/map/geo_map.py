"""Map over aerial pictures from an MBTiles file; nothing is requested from the internet.

map = GeoMap(tiles="parking_lot.mbtiles", datum=Datum(45.5069, -73.579))
robot.on("/pose", map.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, ClassVar

from kivy.clock import Clock
from kivy.graphics import Color, Rectangle
from kivy.input import MotionEvent
from kivy.metrics import dp, sp
from kivy.properties import ObjectProperty, StringProperty
from kivy.uix.widget import Widget
from kivy_garden.mapview import MapView

from bridge.core.geo import Datum
from widgets.core.canvas_ink import Word, tint
from widgets.core.geometry import View, tween
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map.grid_map import fenced, patrol
from widgets.map.map_marks import outlined
from widgets.map.map_overlay import MapOverlay
from widgets.map.mbtiles import MBTiles

__all__ = ["GeoMap", "samples"]

PROBE_LENGTH = 100.0
"""Length of the ways by which the scale of the pictures is measured [m]."""
NARROW = 520
"""Where there is less room, the word about the pictures' origin and the legend stand one above the other [dp]."""
MAX_ENLARGEMENT = 8.0
"""How far the sharpest pictures may be enlarged."""
HAZE = {"dark": 0.24, "sunlight": 0.52, "night": 0.70}
"""How much of the window's colour lies over the pictures, so that marks stand out, 0 to 1."""


class GeoMap(MapOverlay):
    """The map of `MapOverlay` on aerial pictures, north up.

    The pictures are Mercator's on a sphere and the map is a plane: a picture is off by at most 0.3 % of its distance
    from the middle of the glass, which is some pixels at the edge of a tablet.
    """

    drawn_from: ClassVar[tuple[str, ...]] = (*MapOverlay.drawn_from, "tiles", "datum")
    may_turn = False

    tiles = StringProperty("")
    """Path of the MBTiles file; empty shows a plain ground. `MBTiles` says what is wrong with a file."""
    datum: ObjectProperty[Datum | None] = ObjectProperty(None, allownone=True)
    """Where the map's origin is on earth, a `bridge.core.geo.Datum`; None while that is not known."""

    def __init__(self, **kwargs: Any) -> None:
        self._pictures: _Pictures | None = None
        self._colour, self._ground = Color(), Rectangle()
        self._haze_colour, self._haze = Color(), Rectangle(size=(0, 0))
        super().__init__(**kwargs)
        self.canvas.before.add(self._colour)
        self.canvas.before.add(self._ground)
        self.over_ground.add(self._haze_colour)
        self.over_ground.add(self._haze)
        self.bind(tiles=self._open, datum=self._open)
        self._open()

    def finish_pictures(self) -> None:
        """Wait until the pictures in sight are there: for whoever draws a picture of the map and not for a screen."""
        if self._pictures is not None:
            self._pictures.map_source.finish()

    def close(self) -> None:
        """Take the pictures away and end the thread that reads them."""
        if self._pictures is not None:
            self._pictures.map_source.close()
            self.remove_widget(self._pictures)
            self._pictures = None

    def _open(self, *_: object) -> None:
        self.close()
        if self.tiles and self.datum is not None:
            self._pictures = _Pictures(map_source=MBTiles(Path(self.tiles)))
            self.add_widget(self._pictures, canvas="before")
            self.view = self.limited(self.view)
            self._fit_until_touched()

    def limited(self, view: View) -> View:
        """The view north up, with a scale at which there are pictures."""
        if self._pictures is None or self.datum is None:
            return super().limited(view)
        source, datum, middle = self._pictures.map_source, self.datum, self._free_middle()
        least, most = (
            _scale_at(source, datum, source.min_zoom),
            _scale_at(source, datum, source.max_zoom) * MAX_ENLARGEMENT,
        )
        upright = View.centred(*view.to_world(*middle), at=middle, scale=view.scale)
        return upright.within(least, most, *middle)

    def draw_ground(self) -> None:
        """Bring the pictures below the marks."""
        self._ground.pos, self._ground.size = self.pos, self.size
        self._colour.rgba = tween(theme.bg, theme.surface, 0.6)
        if self._pictures is None or self.datum is None:
            self._haze.size = 0, 0
            return
        self._haze.pos, self._haze.size = self.pos, self.size
        self._haze_colour.rgba = tint(theme.bg, HAZE[theme.name])
        source, datum = self._pictures.map_source, self.datum
        scale = self.view.scale / _scale_at(source, datum, source.min_zoom)
        zoom = min(source.min_zoom + int(math.log2(max(scale, 1.0)) + 1e-6), source.max_zoom)
        latitude, longitude = datum.to_geographic(*self.view.to_world(*self.center))
        self._pictures.pos, self._pictures.size = self.pos, self.size
        self._pictures.look_at(latitude, longitude, zoom, self.view.scale / _scale_at(source, datum, zoom))

    def _fill_robot(self, shapes: Shapes) -> Iterator[Word]:
        yield from super()._fill_robot(shapes)
        if self._pictures is not None and self._pictures.map_source.attribution:
            x, y, wide, _ = self.free_box
            low = dp(8) + (0 if math.isnan(self.foot) else self.foot)
            if self.fence and wide < dp(NARROW):
                low += dp(24)  # above the legend
            text = self._pictures.map_source.attribution
            yield from outlined(Word(text, x + wide - dp(10), y + low, sp(11), theme.text, anchor=(1, 0)))


def _scale_at(source: MBTiles, datum: Datum, zoom: float) -> float:
    """Pixels to a metre at a zoom level of the pictures: the mean of east and north, which differ a little."""
    near, east, north = (
        datum.to_geographic(*place) for place in ((0, 0), (PROBE_LENGTH, 0), (0, PROBE_LENGTH))
    )
    wide = source.get_x(zoom, east[1]) - source.get_x(zoom, near[1])
    high = source.get_y(zoom, north[0]) - source.get_y(zoom, near[0])
    return math.sqrt(wide * high) / PROBE_LENGTH


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


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the map by name."""
    file = Path(__file__).parents[1] / "data" / "parking_lot.mbtiles"

    def made(
        *, size: tuple[float, float] = (760, 500), fence: bool = False, **more: Any
    ) -> Callable[[], Widget]:
        def build() -> GeoMap:
            map_ = GeoMap(
                size_hint=(None, None),
                size=(dp(size[0]), dp(size[1])),
                tiles=str(file),
                datum=Datum(45.5069, -73.579),
                **more,
            )
            if map_.state != "never":
                patrol(map_)
            if fence:
                fenced(map_)
            map_.fit()
            return map_

        return build

    return {
        "never": made(size=(380, 300)),
        "live": made(state="live"),
        "points": made(state="live", mode="points", selected=3, size=(412, 480)),
        "fence": made(state="live", mode="points", fence=True),
        "stale": made(state="stale", age=12.0, size=(380, 300)),
        "alarm": made(state="alarm", size=(380, 300)),
        "disabled": made(state="disabled", size=(380, 300)),
    }
