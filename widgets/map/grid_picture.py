"""An occupancy grid as a picture: walls with a rim, what is free, and nothing where nothing is known.

    picture = GridPicture()
    canvas.add(picture.canvas)
    picture.show(grid)             # a nav_msgs/OccupancyGrid; a large one is made ready beside the loop that draws
    picture.place(view)

Its edges are smooth at any enlargement: the shader draws them where the softened cells pass a half.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from kivy.clock import Clock
from kivy.graphics import (
    InstructionGroup,
    PopMatrix,
    PushMatrix,
    Rectangle,
    RenderContext,
    Rotate,
    Scale,
    Translate,
)
from kivy.graphics.texture import Texture
from numpy.typing import NDArray

from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid
from widgets.core.canvas_ink import shader, tint
from widgets.core.geometry import View, screen_angle, tween
from widgets.core.theme import theme
from widgets.map.grid_cells import Piece, bounds, every_piece
from widgets.map.grid_worker import GridWorker

__all__ = ["FRAGMENT", "GridPicture", "cells_of"]

AT_ONCE = 300_000
"""Cells that are made ready within the frame: some milliseconds."""
SHADE = 0.55
"""How far a cell that is a little occupied goes towards the colour of walls."""
FREE = {"dark": 0.62, "sunlight": 0.0, "night": 0.5}
"""How far what is free lies from the colour of cards towards that of things on cards."""
FREE_OVER_GROUND = 0.25
"""Opacity of what is free where pictures lie beneath the grid."""

FRAGMENT = """
$HEADER$
uniform vec4 free;
uniform vec4 wall;
uniform vec4 rim;
uniform float density;
uniform float shaded;
uniform float seen;
void main(void) {
    vec4 cell = texture2D(texture0, tex_coord0);
    float small = clamp(density, 0.12, 1.0);
    float middle = 0.5 * small;
    float soft = min(0.19 / max(density, 1.0), 0.19) + 0.19 * small * step(density, 1.0);
    soft = min(soft, middle);
    float known = smoothstep(0.5 - soft, 0.5 + soft, cell.a);
    float solid = smoothstep(middle - soft, middle + soft, cell.r);
    float edge = middle + min(0.62 / max(density, 0.12), 0.3);
    float inner = smoothstep(edge - soft, edge + soft, cell.r);
    vec4 open = vec4(mix(free.rgb, wall.rgb, shaded * cell.r), free.a * known);
    vec4 built = mix(rim, wall, inner);
    float share = solid * known;
    gl_FragColor = vec4(mix(open.rgb, built.rgb, share), mix(open.a, built.a, share) * seen);
}
"""


def cells_of(grid: OccupancyGrid) -> NDArray[np.int8]:
    """The cells of a grid as an array of shape (rows, columns)."""
    return np.frombuffer(grid.data, np.int8).reshape(grid.info.height, grid.info.width)


class _Tile(NamedTuple):
    """A piece and its texture."""

    piece: Piece
    """Without its pixels."""
    texture: Texture

    def rectangle(self) -> Rectangle:
        """What shows it where it lies among the cells."""
        one = self.piece
        wide, high = one.side
        left, low = one.left / wide, one.low / high
        right, top = (one.left + one.columns) / wide, (one.low + one.rows) / high
        shown = Rectangle(pos=(one.column, one.row), size=(one.columns, one.rows), texture=self.texture)
        shown.tex_coords = left, low, right, low, right, top, left, top
        return shown


class GridPicture:
    """Draws the newest grid; while a large one is made ready, the one before it stays."""

    def __init__(self, changed: Callable[[], object] = lambda: None) -> None:
        """`changed` is called when another grid is drawn than before: it is to be placed."""
        self.canvas, self._changed = InstructionGroup(), changed
        self.info: MapMetaData | None = None
        """Where the cells that are drawn lie; None before the first."""
        self.known: tuple[int, int, int, int] | None = None
        """First column and row of what is known of the newest grid, and those behind the last; None for nothing."""
        self.shift, self.turn, self.scale = Translate(), Rotate(axis=(0, 0, 1)), Scale(1.0)
        self._ink: RenderContext = shader(FRAGMENT, density=1, shaded=0, seen=1)
        self._worker = GridWorker()
        self._coming: OccupancyGrid | None = None
        self._tiles: list[_Tile] = []
        """Those that are drawn."""
        self._next: list[_Tile] = []
        """Those of the grid that is coming, as far as they are ready."""
        self._look: tuple[object, ...] = ()
        for part in (PushMatrix(), self.shift, self.turn, self.scale, self._ink, PopMatrix()):
            self.canvas.add(part)
        self._watch = Clock.create_trigger(self._take, 0, interval=True)

    @property
    def busy(self) -> bool:
        """A grid that came is not drawn yet."""
        return self._coming is not None

    @property
    def textures(self) -> list[Texture]:
        """Those of the grid that is drawn."""
        return [tile.texture for tile in self._tiles]

    @property
    def _drawn(self) -> set[bytes]:
        """Digests of what is drawn."""
        return {tile.piece.digest for tile in self._tiles}

    def show(self, grid: OccupancyGrid | None) -> None:
        """Draw that grid, or none; `data` has as many cells as `info` says."""
        self._next = []
        if grid is None:
            self.close()
            self.info = self.known = None
            self._put([])
            return
        cells = cells_of(grid)
        self.known, self._coming = bounds(cells), grid
        if cells.size <= AT_ONCE:
            self._worker.close()
            self._next = [self._tile(one) for one in every_piece(cells, self._drawn)]
            self._end()
        else:
            self._worker.want(cells, self._drawn)
            self._watch()

    def finish(self) -> None:
        """Wait until what came is drawn: for whoever draws a picture of a map and not for a screen."""
        self._worker.wait()
        while self.busy:  # each turn takes a piece, and nothing makes more of them
            self._take(0.0)

    def close(self) -> None:
        """End the work on a grid that came; what is drawn stays."""
        self._watch.cancel()
        self._worker.close()
        self._coming, self._next = None, []

    def place(self, view: View) -> None:
        """Bring it to where the view has it."""
        info = self.info
        if info is None:
            return
        position = info.origin.position
        self.shift.xy = view.to_screen(position.x, position.y)
        self.turn.angle = screen_angle(view.turn + info.origin.orientation.yaw)
        scale = view.scale * info.resolution
        if scale != self.scale.x:
            self.scale.x = self.scale.y = scale
            self._ink["density"] = float(scale)

    def colour(self, *, over_pictures: bool) -> None:
        """Take the roles' colours; `over_pictures` what is free lets through what lies beneath."""
        look = (theme.name, over_pictures)
        if look != self._look:
            self._look = look
            free = tween(theme.surface, theme.raised, FREE[theme.name])
            self._ink["free"] = tint(free, FREE_OVER_GROUND if over_pictures else 1.0)
            self._ink["wall"] = tint(tween(theme.line, theme.muted, 0.3), 1.0)
            self._ink["rim"] = tint(tween(theme.line, theme.muted, 0.85), 1.0)

    def see(self, opacity: float) -> None:
        """Follow the opacity of the widget, 0 to 1."""
        self._ink["seen"] = float(opacity)

    def _take(self, _: float) -> None:
        """Carry one piece over that is ready, so that no frame has more than one; with the last all are drawn at once."""
        one = self._worker.take()
        if one is not None:
            self._next.append(self._tile(one))
        if not self._worker.busy:
            self._end()

    def _tile(self, one: Piece) -> _Tile:
        """The texture of a piece; the one that is drawn already where it has the very same cells."""
        for tile in self._tiles:
            if tile.piece.digest == one.digest:
                return _Tile(replace(one, pixels=None), tile.texture)
        texture = Texture.create(size=one.side, colorfmt="luminance_alpha", mipmap=True)
        texture.min_filter, texture.mag_filter, texture.wrap = (
            "linear_mipmap_linear",
            "linear",
            "clamp_to_edge",
        )
        texture.blit_buffer(one.pixels, colorfmt="luminance_alpha", bufferfmt="ubyte")
        return _Tile(replace(one, pixels=None), texture)

    def _end(self) -> None:
        """What came is ready."""
        self._watch.cancel()
        grid, self._coming = self._coming, None
        if grid is not None:
            self.info = grid.info
            self._put(self._next)
        self._next = []

    def _put(self, tiles: list[_Tile]) -> None:
        self._tiles = tiles
        self._ink.clear()
        self._ink["shaded"] = SHADE if any(tile.piece.shaded for tile in tiles) else 0.0
        for tile in tiles:
            self._ink.add(tile.rectangle())
        self._changed()
