"""Tiles of an MBTiles file for mapview: read by one thread, without a download and without a folder of copies.

mapview 1.0.6 has a source of its own that fails on a file with `bounds` and shows one file's tiles for
another's; this one does neither.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from kivy.core.image import ImageData

from widgets.map.tiles.mbtiles_file import box_of, metadata, zooms_of
from widgets.map.tiles.tile_pictures import TilePictures
from widgets.map.tiles.tile_reader import TileReader

__all__ = ["MBTiles"]


class MBTiles(TilePictures):
    """One file. ValueError, in one sentence, when it is not there or holds no pictures."""

    def __init__(self, path: Path, decode: Callable[[object], ImageData] | None = None) -> None:
        """`decode` makes pixels of a tile's file, in the thread that reads; Kivy's own decoder unless given."""
        self.path = path
        about = metadata(path)
        zooms = zooms_of(path, about)
        super().__init__(
            TileReader(path, decode),
            name=str(path),
            zooms=zooms,
            image_ext="png" if about["format"] == "png" else "jpg",
            attribution=about.get("attribution", ""),
        )
        self.box = box_of(path, about)
        """West, south, east, north of what it shows [deg]."""
