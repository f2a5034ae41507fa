"""Reads and decodes the tiles of an MBTiles file in a thread of its own; only textures are left to the UI thread."""

from __future__ import annotations

import io
import logging
import sqlite3
import threading
from collections.abc import Callable, Iterable
from contextlib import closing
from pathlib import Path

from kivy.core.image import ImageData, ImageLoader

from bridge.core.camera_frames import picture_size
from bridge.core.errors import ProtocolError

__all__ = ["MAX_AHEAD", "MAX_TILE_SIDE", "Key", "TileReader", "decoded", "pixels_of", "tile_size"]

log = logging.getLogger(__name__)

MAX_TILE_SIDE = 1024
"""Columns or rows of a tile that is decoded [px]; tiles have 256 or 512."""
MAX_AHEAD = 12
"""Decoded tiles that wait for the UI thread; at the largest size they take 48 MB."""
WEBP_HEAD = 30
"""Bytes of a WebP file that tell its size."""
CLOSE_TIMEOUT = 5.0
"""Longest time that closing waits for the tile at work [s]."""

Key = tuple[int, int, int]
"""Zoom level, column, row."""


class TileReader:
    """What is wanted is read one tile after the other; the thread starts with the first and ends when none is left."""

    def __init__(self, path: Path, decode: Callable[[object], ImageData] | None = None) -> None:
        """`decode` makes pixels of what a file has as a tile's picture, raising what it likes; `decoded` unless given."""
        self.path, self._decode = path, decode or decoded
        self._lock = threading.Lock()
        self._wanted: list[Key] = []
        self._made: dict[Key, ImageData | None] = {}
        self._thread: threading.Thread | None = None
        self._runs = self._closed = False
        self.refused = 0
        """Tiles that were no picture, or too large a one."""

    def connect(self) -> sqlite3.Connection:
        """The file, only to be read."""
        return sqlite3.connect(f"{self.path.absolute().as_uri()}?mode=ro", uri=True)

    def want(self, keys: Iterable[Key]) -> None:
        """Read these, in this order; what was wanted before and is not among them is dropped, read or not."""
        with self._lock:
            if self._closed:
                return
            wanted = list(keys)
            self._made = {key: data for key, data in self._made.items() if key in wanted}
            self._wanted = [key for key in wanted if key not in self._made]
            if not self._runs and self._has_work():
                self._runs = True
                self._thread = threading.Thread(target=self._run, name="map tiles", daemon=True)
                self._thread.start()

    def take(self) -> tuple[Key, ImageData | None] | None:
        """A tile that was wanted and is read, the pixels None when there is none to show; None while there is no such tile."""
        with self._lock:
            key = next(iter(self._made), None)
            return None if key is None else (key, self._made.pop(key))

    def wait(self) -> None:
        """Until the thread has ended, which it does by itself: for whoever draws a picture of a map and not for a screen."""
        if self._thread is not None:
            self._thread.join()

    def close(self) -> None:
        """Drop everything, and end the thread after the tile at work; nothing is read any more."""
        with self._lock:
            self._closed = True
            self._wanted, self._made = [], {}
        if self._thread is not None:
            self._thread.join(CLOSE_TIMEOUT)

    def _has_work(self) -> bool:
        return bool(self._wanted) and len(self._made) < MAX_AHEAD

    def _run(self) -> None:
        while True:
            with self._lock:
                self._runs = self._has_work()
                if not self._runs:
                    return
                key = self._wanted[0]
            data = self._picture(key)
            with self._lock:
                if key in self._wanted:
                    self._wanted.remove(key)
                    self._made[key] = data

    def _picture(self, key: Key) -> ImageData | None:
        try:
            with closing(self.connect()) as file:
                row = file.execute(
                    "SELECT tile_data FROM tiles WHERE zoom_level = ? AND tile_column = ? AND tile_row = ?",
                    key,
                ).fetchone()
            return row and self._decode(row[0])
        except Exception as fault:  # noqa: BLE001 - decoders raise what they like at a damaged picture
            self.refused += 1
            if self.refused == 1:
                log.warning("%s: tile %d/%d/%d is not shown: %.200s", self.path, *key, fault)
            return None


def tile_size(data: bytes) -> tuple[str, int, int]:
    """Kind (`jpeg`, `png` or `webp`), columns and rows of a picture, by its head alone; ProtocolError for anything else."""
    if not (data[:4] == b"RIFF" and data[8:12] == b"WEBP" and len(data) >= WEBP_HEAD):
        return picture_size(data)
    form = data[12:16]
    if form == b"VP8X":
        return "webp", 1 + int.from_bytes(data[24:27], "little"), 1 + int.from_bytes(data[27:30], "little")
    if form == b"VP8L":
        packed = int.from_bytes(data[21:25], "little")
        return "webp", 1 + (packed & 0x3FFF), 1 + (packed >> 14 & 0x3FFF)
    columns, rows = (int.from_bytes(data[at : at + 2], "little") & 0x3FFF for at in (26, 28))
    return "webp", columns, rows


def decoded(data: object) -> ImageData:
    """Pixels of a tile, by Kivy's own decoder and without a texture, in any thread; ProtocolError, or what the decoder
    raises, for what is no small JPEG, PNG or WebP picture."""
    if not isinstance(data, bytes):
        raise ProtocolError("A tile is a picture, not text.")
    kind, columns, rows = tile_size(data)
    if max(columns, rows) > MAX_TILE_SIDE:
        raise ProtocolError(f"A tile has at most {MAX_TILE_SIDE} px a side, not {columns} x {rows}.")
    return pixels_of(data, {"png": "png", "webp": "webp"}.get(kind, "jpg"))


def pixels_of(data: bytes, ext: str = "png") -> ImageData:
    """Pixels of a picture whose size was looked at, by Kivy's own decoder, in any thread; it raises what it likes."""
    able = next(each for each in ImageLoader.loaders if each.can_load_memory() and ext in each.extensions())
    loaded = able(f"tile.{ext}", ext=ext, rawdata=io.BytesIO(data), inline=True, nocache=True, keep_data=True)
    pixels: ImageData = loaded._data[0]  # noqa: SLF001 - the public way makes a texture, which only the UI thread may
    pixels.source = None  # a texture would keep the file for it
    return pixels
