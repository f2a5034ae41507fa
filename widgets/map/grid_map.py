"""Map of the robot's own world in metres: its occupancy grid, or a plain squared ground where it has none.

map = GridMap(mode="points")
robot.on("/map", map.show), robot.on("/pose", map.show)
"""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.graphics import Color, Rectangle
from kivy.metrics import dp
from kivy.properties import NumericProperty, ObjectProperty
from kivy.uix.widget import Widget

from bridge.core.camera_frames import MAX_PIXELS, MAX_SIDE
from bridge.msgs import Msg
from bridge.msgs.arrays import Int8Array
from bridge.msgs.geometry_msgs import (
    Point,
    Point32,
    Polygon,
    Pose,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
)
from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid
from bridge.msgs.pilothouse_msgs import Limits
from widgets.core.canvas_ink import Ink, Word, tint
from widgets.core.geometry import Points, spread, tween
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map.beneath import Beneath, Ground, attribution_words
from widgets.map.grid_picture import GridPicture
from widgets.map.map_marks import grid_lines, outlined
from widgets.map.map_overlay import MapOverlay
from widgets.map.map_viewport import SMALL

__all__ = ["GridMap", "fenced", "patrol", "samples"]

log = logging.getLogger(__name__)


UNKNOWN = {"dark": 0.0, "sunlight": 0.16, "night": 0.0}
"""How far what is unknown lies from the window's colour towards that of muted words."""
MIN_RESOLUTION, MAX_RESOLUTION = 1e-3, 1e3
"""Of a grid that is shown [m to a cell]."""
MAX_PLACE = 1e7
"""Farthest that its origin may lie from that of `map` [m]."""


class GridMap(MapOverlay):
    """The local map. Two fingers move, enlarge and turn it."""

    accepts: ClassVar[tuple[type[Msg], ...]] = (OccupancyGrid, *MapOverlay.accepts)
    drawn_from: ClassVar[tuple[str, ...]] = (*MapOverlay.drawn_from, "grid", "ground", "ground_opacity")

    grid: ObjectProperty[OccupancyGrid | None] = ObjectProperty(None, allownone=True, force_dispatch=True)
    """The newest OccupancyGrid; None before the first."""
    ground: ObjectProperty[Ground | None] = ObjectProperty(None, allownone=True)
    """Tiles or a picture beneath the grid, of `widgets.map.ground`; whoever sets it closes it."""
    ground_opacity = NumericProperty(1.0)
    """How plainly that is seen, 0 to 1."""

    def __init__(self, **kwargs: Any) -> None:
        self._beneath = Beneath()
        self._squares = Ink()
        self._ground = Rectangle()
        self._ground_colour = Color()
        self.picture = GridPicture(changed=self._grid_drawn)
        """The grid as it is drawn."""
        self._too_large = False
        """The last grid was not shown for its size."""
        super().__init__(**kwargs)
        for part in (
            self._ground_colour,
            self._ground,
            self._beneath.canvas,
            self.picture.canvas,
            self._squares,
        ):
            self.canvas.before.add(part)

    def show(self, msg: Msg) -> None:
        """Take over a grid, or what every map shows."""
        if not isinstance(msg, OccupancyGrid):
            super().show(msg)
            return
        if msg is self.grid:
            return  # a screen that comes back shows the newest again
        wide, high = msg.info.width, msg.info.height
        if max(wide, high) > MAX_SIDE or wide * high > MAX_PIXELS:
            if self.grid is not None or not self._too_large:
                log.warning(
                    "the map is not shown: %d x %d cells, at most %d a side and %d are",
                    wide,
                    high,
                    MAX_SIDE,
                    MAX_PIXELS,
                )
            self._too_large, self.grid = True, None
            return
        self._too_large = False
        self.grid = msg if len(msg.data) == wide * high > 0 and _placed(msg.info) else None
        self._fit_until_touched()

    def on_opacity(self, *_: object) -> None:
        """The grid has a shader of its own, which knows nothing of opacity."""
        self.picture.see(self.opacity)

    def on_grid(self, *_: object) -> None:
        """Have it made ready and drawn."""
        self.picture.show(self.grid)

    def _grid_drawn(self) -> None:
        self.redraw()

    def finish_pictures(self) -> None:
        """Wait until the grid and the pictures in sight are there: for whoever draws a picture of the map."""
        self.picture.finish()

    def close(self) -> None:
        """End the work on a grid that came."""
        self.picture.close()
        super().close()

    def on_ground(self, *_: object) -> None:
        """Have it drawn."""
        self._beneath.lay(self.ground)

    def _fill_robot(self, shapes: Shapes) -> Iterator[Word]:
        yield from super()._fill_robot(shapes)
        large = min(self.size) > dp(
            SMALL
        )  # on a smaller one they would cover what is seen; a tap makes it large
        if large and self._beneath.shown and self.ground is not None and self.ground.attribution:
            words = self.ground.attribution
            for word in attribution_words(words, self.free_box, self.foot, above=bool(self.fence)):
                yield from outlined(word)

    def extent(self) -> Points:
        """The marks and what the grid knows."""
        return np.concatenate([super().extent(), self._corners()])

    def _corners(self) -> Points:
        if self.grid is None:
            return spread([])
        info, known = self.grid.info, self.picture.known
        if known is None:
            return spread([])
        low_column, low_row, column, row = known
        yaw = info.origin.orientation.yaw
        ahead = info.resolution * complex(math.cos(yaw), math.sin(yaw))
        origin = complex(info.origin.position.x, info.origin.position.y)
        corners = [origin + ahead * complex(c, r) for c in (low_column, column) for r in (low_row, row)]
        return spread((z.real, z.imag) for z in corners)

    def draw_ground(self) -> None:
        """Bring the ground, the grid and the squares up to date."""
        self._ground.pos, self._ground.size = self.pos, self.size
        self._ground_colour.rgba = tween(theme.bg, theme.muted, UNKNOWN[theme.name])
        self._beneath.draw(self.view, (*self.pos, *self.size), self.ground_opacity)
        shapes = Shapes()
        grid_lines(shapes, self.view, (*self.pos, *self.size), tint(theme.muted, 0.13))
        self._squares.fill(shapes)
        self.picture.colour(over_pictures=self._beneath.shown)
        self.picture.place(self.view)


def _placed(info: MapMetaData) -> bool:
    """It says where it lies, in numbers that are some."""
    place, turn = info.origin.position, info.origin.orientation
    numbers = (place.x, place.y, turn.x, turn.y, turn.z, turn.w)
    return MIN_RESOLUTION <= info.resolution <= MAX_RESOLUTION and all(
        abs(one) <= MAX_PLACE for one in numbers
    )


def _parking_lot() -> OccupancyGrid:
    """A walled lot of 36 m x 24 m with two rows of parked cars, at 0.1 m a cell."""
    cells = np.full((240, 360), 0, np.int8)
    cells[:4], cells[-4:], cells[:, :4], cells[:, -4:] = 100, 100, 100, 100
    for row in (18, 178):
        for bay in (1, 2, 4, 7, 8, 10):
            column = 16 + bay * 27
            cells[row : row + 42, column : column + 18] = 100
            cells[row + 2 : row + 40, column + 2 : column + 16] = 84
    info = MapMetaData(resolution=0.1, width=360, height=240, origin=Pose(Point(-18.0, -12.0)))
    return OccupancyGrid(info=info, data=Int8Array(cells.tobytes()))


def patrol(map_: MapOverlay) -> None:
    """Put a patrol half done onto a map."""
    map_.waypoints = [(-11.0, 3.0), (-2.0, 3.6), (7.5, 2.6), (11.0, -2.6), (0.5, -3.4), (-9.0, -2.8)]
    map_.home, map_.visited, map_.coming = [-15.5, -4.0], 2, 2
    steps = np.linspace(0.0, 1.0, 240)
    for share in steps:
        bend = math.sin(share * math.pi)
        place = Point(-15.5 + 19.0 * share, -4.0 + 7.0 * share + 2.4 * bend)
        pose = Pose(place, Quaternion.from_yaw(-0.06))
        map_.show(PoseWithCovarianceStamped(pose=PoseWithCovariance(pose)))
    map_.camera_fov = 1.2
    map_.plan = np.stack([3.5 + 4 * steps, 3.0 - 0.4 * np.sin(steps * math.pi / 2)], axis=1)
    map_.intruders = [(5.8, -0.4, "Intruder 1")]


def fenced(map_: MapOverlay) -> None:
    """Put a fence onto a map that leaves some of its waypoints out."""
    corners = [(-16.5, -10.5), (9.0, -10.5), (9.0, -1.0), (16.5, -1.0), (16.5, 10.5), (-16.5, 10.5)]
    hole = [(-3.0, -1.2), (3.0, -4.8), (5.4, -1.0), (1.2, 0.4)]
    map_.show(Limits(keep_in=[_area(corners)], keep_out=[_area(hole)]))


def _area(corners: list[tuple[float, float]]) -> Polygon:
    return Polygon([Point32(x, y) for x, y in corners])


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the map by name."""

    def made(
        *,
        driven: bool = True,
        grid: bool = True,
        fence: bool = False,
        size: tuple[float, float] = (760, 500),
        **more: Any,
    ) -> Callable[[], GridMap]:
        def build() -> GridMap:
            map_ = GridMap(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            if grid:
                map_.show(_parking_lot())
            if driven:
                patrol(map_)
            if fence:
                fenced(map_)
            map_.fit()
            return map_

        return build

    def placing() -> GridMap:
        map_ = made(state="live")()
        map_.mode = "place_robot"
        map_.placed = [1.0, 0.5, 0.7]
        return map_

    return {
        "never": made(driven=False, grid=False, size=(380, 300)),
        "live": made(state="live"),
        "points": made(state="live", mode="points", selected=3),
        "fence": made(state="live", mode="points", selected=3, fence=True),
        "fence phone": made(state="live", size=(412, 480), fence=True),
        "place": placing,
        "phone": made(state="live", size=(412, 480)),
        "stale": made(state="stale", age=12.0, size=(380, 300)),
        "alarm": made(state="alarm", size=(380, 300)),
        "disabled": made(state="disabled", size=(380, 300)),
    }
