"""Tiles of an MBTiles file for mapview, read on the spot: no thread, no download, no folder of copies.

mapview 1.0.6 has a source of its own that fails on a file with `bounds` and shows one file's tiles for
another's; this one does neither.
"""

from __future__ import annotations

import io
import logging
import sqlite3
from collections import OrderedDict
from contextlib import closing
from pathlib import Path
from typing import Any

from kivy.clock import Clock
from kivy.core.image import Image as CoreImage
from kivy.graphics.texture import Texture
from kivy_garden.mapview.source import MapSource

from bridge.core.camera_frames import picture_size
from bridge.core.errors import ProtocolError

__all__ = ["MAX_TILE_SIDE", "MBTiles"]

log = logging.getLogger(__name__)

MAX_TILE_SIDE = 1024
"""Columns or rows of a tile that is shown [px]; tiles have 256 or 512, and each is decoded between two frames."""

MAX_TILES_PER_FRAME = 6
"""Tiles read in one frame."""
MAX_PIXELS_PER_FRAME = 2 * 512 * 512
"""When so many were decoded in one frame, the rest waits for the next [px]: 11 ms on a laptop."""
MAX_TEXTURES = 96
"""Textures kept."""


class MBTiles(MapSource):
    """One file. ValueError, in one sentence, when it is not there or holds no pictures."""

    def __init__(self, path: Path) -> None:
        self.path = path
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
        self._textures: OrderedDict[tuple[int, int, int], Texture | None] = OrderedDict()
        self._waiting: list[Any] = []
        self._decoded = 0
        """Pixels decoded in this frame."""
        self.refused = 0
        """Tiles that were no picture, or too large a one; they are shown as gaps."""
        self._read_some = Clock.create_trigger(self._read_waiting)

    def fill_tile(self, tile: Any) -> None:
        """Called by mapview for each tile in sight: hand over its picture now or in one of the next frames."""
        key = tile.zoom, tile.tile_x, tile.tile_y
        if tile.state == "done":
            return
        if key in self._textures:
            self._textures.move_to_end(key)
            self._hand_over(tile, self._textures[key])
        else:
            self._waiting.append(tile)
            self._read_some()

    def _read_waiting(self, *_: object) -> None:
        self._decoded, read = 0, 0
        with closing(self._connect()) as file:
            while self._waiting and read < MAX_TILES_PER_FRAME and self._decoded < MAX_PIXELS_PER_FRAME:
                tile, read = self._waiting.pop(0), read + 1
                if tile.state != "done":
                    self._hand_over(tile, self._texture(file, tile.zoom, tile.tile_x, tile.tile_y))
        if self._waiting:
            self._read_some()

    def _hand_over(self, tile: Any, texture: Texture | None) -> None:
        tile.state = "done" if texture is None else "animated"
        if texture is not None:
            tile.texture = texture
            tile.g_color.a = 1.0

    def _texture(self, file: sqlite3.Connection, zoom: int, x: int, y: int) -> Texture | None:
        """The picture of a tile, else the part of a coarser one that shows the same place, else None."""
        key = zoom, x, y
        if key not in self._textures:
            found = self._picture(file, zoom, x, y)
            if found is None and zoom > self.min_zoom:
                found = _quarter(self._texture(file, zoom - 1, x // 2, y // 2), x % 2, y % 2)
            self._textures[key] = found
            while len(self._textures) > MAX_TEXTURES:
                self._textures.popitem(last=False)
        return self._textures.get(key)

    def _picture(self, file: sqlite3.Connection, zoom: int, x: int, y: int) -> Texture | None:
        row = file.execute(
            "SELECT tile_data FROM tiles WHERE zoom_level = ? AND tile_column = ? AND tile_row = ?",
            (zoom, x, y),
        ).fetchone()
        if row is None:
            return None
        try:
            # Kivy keeps pictures by name, so the name must distinguish files
            texture = _decoded(row[0], f"{self.path}/{zoom}/{x}/{y}")
        except Exception as fault:  # noqa: BLE001 - decoders raise what they like at a damaged picture
            self.refused += 1
            if self.refused == 1:
                log.warning("%s: tile %d/%d/%d is not shown: %.200s", self.path, zoom, x, y, fault)
            return None
        self._decoded += texture.width * texture.height
        return texture

    def _connect(self) -> sqlite3.Connection:
        return sqlite3.connect(f"{self.path.absolute().as_uri()}?mode=ro", uri=True)

    def _metadata(self) -> dict[str, str]:
        try:
            with closing(self._connect()) as file:
                about = dict(file.execute("SELECT name, value FROM metadata"))
        except sqlite3.Error as cause:
            raise ValueError(f"{self.path} cannot be read as an MBTiles file ({cause}).") from cause
        missing = {"format", "minzoom", "maxzoom"} - about.keys()
        if missing:
            raise ValueError(f"{self.path} does not say its {', '.join(sorted(missing))}.")
        if about["format"] not in ("png", "jpg", "jpeg"):
            raise ValueError(f"{self.path} holds {about['format']} tiles; only png and jpg can be shown.")
        return about


def _quarter(texture: Texture | None, right: int, upper: int) -> Texture | None:
    """The left or right, lower or upper quarter of a tile."""
    if texture is None:
        return None
    wide, high = texture.width / 2, texture.height / 2
    return texture.get_region(right * wide, upper * high, wide, high)


def _decoded(data: object, name: str) -> Texture:
    """The texture of a tile; ProtocolError, or what the decoder raises, for what is no small JPEG or PNG picture."""
    if not isinstance(data, bytes):
        raise ProtocolError("A tile is a picture, not text.")
    kind, columns, rows = picture_size(data)
    if max(columns, rows) > MAX_TILE_SIDE:
        raise ProtocolError(f"A tile has at most {MAX_TILE_SIDE} px a side, not {columns} x {rows}.")
    ext = "png" if kind == "png" else "jpg"
    return CoreImage(io.BytesIO(data), ext=ext, filename=name, nocache=True).texture
