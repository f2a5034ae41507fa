"""Tiles of an MBTiles file for mapview: read by one thread, without a download and without a folder of copies.

mapview 1.0.6 has a source of its own that fails on a file with `bounds` and shows one file's tiles for
another's; this one does neither.
"""

from __future__ import annotations

import sqlite3
from collections import OrderedDict
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

from kivy.clock import Clock
from kivy.core.image import ImageData
from kivy.graphics.texture import Texture
from kivy_garden.mapview.source import MapSource

from widgets.map.tile_reader import Key, TileReader

__all__ = ["MBTiles"]

MAX_TILES_PER_FRAME = 6
"""Textures made in one frame."""
MAX_PIXELS_PER_FRAME = 2 * 512 * 512
"""When so many went into textures in one frame, the rest waits for the next [px]."""
MAX_TEXTURES = 96
"""Textures kept."""
MAX_GAPS = 4096
"""Tiles remembered as ones that the file does not have."""


class MBTiles(MapSource):
    """One file. ValueError, in one sentence, when it is not there or holds no pictures."""

    def __init__(self, path: Path, decode: Callable[[object], ImageData] | None = None) -> None:
        """`decode` makes pixels of a tile's file, in the thread that reads; Kivy's own decoder unless given."""
        self.path = path
        self._reader = TileReader(path, decode)
        about = self._metadata()
        super().__init__(
            url="",
            cache_key=str(path),
            min_zoom=int(about["minzoom"]),
            max_zoom=int(about["maxzoom"]),
            image_ext="png" if about["format"] == "png" else "jpg",
            attribution=about.get("attribution", ""),
        )
        self.box = tuple(float(part) for part in about.get("bounds", "-180,-85,180,85").split(","))
        """West, south, east, north of what it shows [deg]."""
        self._textures: OrderedDict[Key, Texture] = OrderedDict()
        self._gaps: OrderedDict[Key, None] = OrderedDict()
        self._waiting: list[Any] = []
        self._closed = False
        self._next_frame = Clock.create_trigger(lambda _: self._serve())

    @property
    def refused(self) -> int:
        """Tiles that were no picture, or too large a one; they are shown as gaps."""
        return self._reader.refused

    def fill_tile(self, tile: Any) -> None:
        """Called by mapview for each tile in sight: hand over its picture now or in one of the next frames."""
        if tile.state == "done" or self._closed:
            return
        if self._fill(tile) is not None:
            self._waiting.append(tile)
            self._next_frame()

    def finish(self) -> None:
        """Wait until every tile in sight has its picture: for whoever draws a picture of a map and not for a screen."""
        while self._waiting:
            self._serve()
            self._reader.wait()

    def close(self) -> None:
        """Let go of every tile that waits and end the thread that reads; asked again, it fills nothing."""
        self._closed = True
        self._waiting.clear()
        self._next_frame.cancel()
        self._reader.close()

    def _serve(self) -> None:
        """Make textures of what was read, give them to the tiles that wait, and say which are still to be read."""
        self._take_in()
        asked = [(tile, self._fill(tile)) for tile in self._waiting if tile.state != "done"]
        self._waiting = [tile for tile, missing in asked if missing is not None]
        self._reader.want(dict.fromkeys(missing for _, missing in asked if missing is not None))
        if self._waiting:
            self._next_frame()

    def _take_in(self) -> None:
        count = pixels = 0
        while count < MAX_TILES_PER_FRAME and pixels < MAX_PIXELS_PER_FRAME:
            made = self._reader.take()
            if made is None:
                return
            key, data = made
            if data is None:
                _keep(self._gaps, key, None, MAX_GAPS)
                continue
            texture = Texture.create_from_data(data)
            if data.flip_vertical:
                texture.flip_vertical()
            _keep(self._textures, key, texture, MAX_TEXTURES)
            count, pixels = count + 1, pixels + data.width * data.height

    def _fill(self, tile: Any) -> Key | None:
        """Give a tile its picture, or the part of a coarser one that shows the same place; else say what is to be read."""
        zoom, x, y = tile.zoom, tile.tile_x, tile.tile_y
        path = []
        while (zoom, x, y) in self._gaps and zoom > self.min_zoom:
            path.append((x % 2, y % 2))
            zoom, x, y = zoom - 1, x // 2, y // 2
        key = zoom, x, y
        if key in self._gaps:
            tile.state = "done"
            return None
        if key not in self._textures:
            return key
        self._textures.move_to_end(key)
        texture = self._textures[key]
        for right, upper in reversed(path):
            texture = _quarter(texture, right, upper)
        tile.texture, tile.state, tile.g_color.a = texture, "animated", 1.0
        return None

    def _metadata(self) -> dict[str, str]:
        try:
            with closing(self._reader.connect()) as file:
                about = dict(file.execute("SELECT name, value FROM metadata"))
        except sqlite3.Error as cause:
            raise ValueError(f"{self.path} cannot be read as an MBTiles file ({cause}).") from cause
        missing = {"format", "minzoom", "maxzoom"} - about.keys()
        if missing:
            raise ValueError(f"{self.path} does not say its {', '.join(sorted(missing))}.")
        if about["format"] not in ("png", "jpg", "jpeg"):
            raise ValueError(f"{self.path} holds {about['format']} tiles; only png and jpg can be shown.")
        return about


def _quarter(texture: Texture, right: int, upper: int) -> Texture:
    """The left or right, lower or upper quarter of a tile."""
    wide, high = texture.width / 2, texture.height / 2
    return texture.get_region(right * wide, upper * high, wide, high)


def _keep(store: OrderedDict[Key, Any], key: Key, value: object, room: int) -> None:
    """Put the newest in; what was not used for longest makes room."""
    store[key] = value
    while len(store) > room:
        store.popitem(last=False)
