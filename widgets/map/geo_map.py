"""Map over aerial pictures from an MBTiles file; nothing is requested from the internet.

map = GeoMap(tiles="parking_lot.mbtiles", datum=Datum(45.5069, -73.579))
robot.on("/pose", map.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, ClassVar

from kivy.graphics import Color, Rectangle
from kivy.metrics import dp
from kivy.properties import ObjectProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.core.geo import Datum
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped
from bridge.msgs.sensor_msgs import NavSatFix
from widgets.core.canvas_ink import Word
from widgets.core.geometry import View, tween
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map.beneath import Beneath, attribution_words
from widgets.map.grid_map import fenced, patrol
from widgets.map.ground import TileGround
from widgets.map.map_marks import outlined
from widgets.map.map_overlay import MapOverlay
from widgets.map.tiles.mbtiles import MBTiles

__all__ = ["GeoMap", "samples"]

MAX_ENLARGEMENT = 8.0
"""How far the sharpest pictures may be enlarged."""


class GeoMap(MapOverlay):
    """The map of `MapOverlay` on aerial pictures, north up."""

    accepts: ClassVar[tuple[type[Msg], ...]] = (*MapOverlay.accepts, NavSatFix)
    specificity: ClassVar[float | None] = 0.25
    drawn_from: ClassVar[tuple[str, ...]] = (*MapOverlay.drawn_from, "tiles", "datum")
    may_turn = False

    tiles = StringProperty("")
    """Path of the MBTiles file; empty shows a plain ground. `MBTiles` says what is wrong with a file."""
    datum: ObjectProperty[Datum | None] = ObjectProperty(None, allownone=True)
    """Where the map's origin is on earth, a `bridge.core.geo.Datum`; None while that is not known."""

    def __init__(self, **kwargs: Any) -> None:
        self._beneath = Beneath()
        self._by_fix = False
        self._colour, self._ground = Color(), Rectangle()
        super().__init__(**kwargs)
        for part in (self._colour, self._ground, self._beneath.canvas):
            self.canvas.before.add(part)
        self.bind(tiles=self._open, datum=self._open)
        self._open()

    def show(self, msg: Msg) -> None:
        """Take over what `MapOverlay` does, and a fix by satellite: a place without a heading, which no fix tells.

        Without a datum the map's origin is where the first fix was. Without a fix the place is not known.
        """
        if isinstance(msg, NavSatFix):
            self._show_fix(msg)
            return
        if isinstance(msg, PoseWithCovarianceStamped):
            self._by_fix = False
        super().show(msg)

    def _show_fix(self, fix: NavSatFix) -> None:
        known = fix.status.status >= 0 and abs(fix.latitude) < 90 and abs(fix.longitude) <= 180
        if not known:
            self.robot = [math.nan] * 3
            return
        first = self.datum is None
        if self.datum is None:
            self.datum = Datum(fix.latitude, fix.longitude)
        x, y = self.datum.to_local(fix.latitude, fix.longitude)
        self._by_fix = True
        self._show_pose(PoseWithCovarianceStamped(fix.header, PoseWithCovariance(Pose(Point(x, y)))))
        if first:
            self.centre_on_robot()

    def _robot_shapes(
        self, shapes: Shapes, pose: tuple[float, float, float], *, faded: bool, alarm: bool
    ) -> None:
        if not self._by_fix:
            super()._robot_shapes(shapes, pose, faded=faded, alarm=alarm)
            return
        x, y = self.view.to_screen(*pose[:2])
        shapes.disc(x, y, self.mark_radius + dp(1), theme.danger if alarm else theme.text)
        shapes.disc(x, y, self.mark_radius - dp(2), theme.muted if faded else theme.accent)

    @property
    def ground(self) -> TileGround | None:
        """The pictures; None where there is no file or no datum."""
        ground = self._beneath.ground
        return ground if isinstance(ground, TileGround) else None

    def finish_pictures(self) -> None:
        """Wait until the pictures in sight are there: for whoever draws a picture of the map and not for a screen."""
        if self.ground is not None:
            self.ground.finish()

    def close(self) -> None:
        """Take the pictures away and end the thread that reads them."""
        if self.ground is not None:
            self.ground.close()
            self._beneath.lay(None)

    def _open(self, *_: object) -> None:
        self.close()
        if self.tiles and self.datum is not None:
            self._beneath.lay(TileGround(MBTiles(Path(self.tiles)), self.datum))
            self.view = self.limited(self.view)
            self._fit_until_touched()

    def limited(self, view: View) -> View:
        """The view north up, with a scale at which there are pictures."""
        ground = self.ground
        if ground is None:
            return super().limited(view)
        source, middle = ground.source, self._free_middle()
        least = ground.scale_at(source.min_zoom)
        most = ground.scale_at(source.max_zoom) * MAX_ENLARGEMENT
        upright = View.centred(*view.to_world(*middle), at=middle, scale=view.scale)
        return upright.within(least, most, *middle)

    def draw_ground(self) -> None:
        """Bring the pictures below the marks."""
        self._ground.pos, self._ground.size = self.pos, self.size
        self._colour.rgba = tween(theme.bg, theme.surface, 0.6)
        self._beneath.draw(self.view, (*self.pos, *self.size), 1.0)

    def _fill_robot(self, shapes: Shapes) -> Iterator[Word]:
        yield from super()._fill_robot(shapes)
        if self.ground is not None and self.ground.attribution:
            words = self.ground.attribution
            for word in attribution_words(words, self.free_box, self.foot, above=bool(self.fence)):
                yield from outlined(word)


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
