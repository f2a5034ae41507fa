"""The file of one offline region: MBTiles, as any other program reads it, with what is needed to go on with its download."""

from __future__ import annotations

import contextlib
import json
import sqlite3
import threading
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TypeVar

from app.maps.map_source import Box, Source
from app.maps.tile_store import Stored
from widgets.map.tiles.mbtiles_file import metadata, zooms_of
from widgets.map.tiles.tile_reader import Key

__all__ = ["GOOD_FOR", "RegionFile"]

P = TypeVar("P")

GOOD_FOR = 30 * 86400.0
"""How long a tile of a region is shown without asking the server for a newer one [s]."""
MAX_LONGITUDE = 540.0
"""Of a side of a box [deg]: a map that was dragged round the earth goes on counting."""
FETCHED = """
CREATE TABLE IF NOT EXISTS pilothouse_fetched (zoom_level INTEGER, tile_column INTEGER, tile_row INTEGER, at REAL,
  PRIMARY KEY (zoom_level, tile_column, tile_row)) WITHOUT ROWID;
"""
"""When each tile was fetched [s]; files of an earlier version lack it."""
ABOUT = "zoom_level=? AND tile_column=? AND tile_row=?"
TABLES = """
CREATE TABLE metadata (name TEXT PRIMARY KEY, value TEXT);
CREATE TABLE tiles (zoom_level INTEGER, tile_column INTEGER, tile_row INTEGER, tile_data BLOB,
  PRIMARY KEY (zoom_level, tile_column, tile_row)) WITHOUT ROWID;
CREATE TABLE pilothouse_gaps (zoom_level INTEGER, tile_column INTEGER, tile_row INTEGER,
  PRIMARY KEY (zoom_level, tile_column, tile_row)) WITHOUT ROWID;
"""


class RegionFile:
    """Every method may be called from any thread. One connection, opened when it is first needed and kept until `close`."""

    def __init__(self, path: Path, about: Mapping[str, str]) -> None:
        self.path, self.about = path, about
        self._lock = threading.Lock()
        self._file: sqlite3.Connection | None = None
        self._written = 0.0
        """When the file was written last before it was opened [s]: so old are tiles of which nothing better is known, at most."""
        self._dated = self._closed = False

    @classmethod
    def made(cls, path: Path, source: Source, name: str, plan: object) -> RegionFile:
        """A new file with nothing in it; sqlite3.Error or OSError where it cannot be."""
        box, least, most = plan.box, plan.least, plan.most  # type: ignore[attr-defined]
        about = {
            "name": name,
            "format": "png",
            "minzoom": str(least),
            "maxzoom": str(most),
            "bounds": ",".join(f"{side:.7f}" for side in box),
            "attribution": source.attribution,
            "type": "baselayer",
            "pilothouse_source": source.id,
            "pilothouse_box": json.dumps(box),
        }
        path.parent.mkdir(parents=True, exist_ok=True)
        with contextlib.closing(sqlite3.connect(path)) as file, file:
            file.executescript(TABLES)
            file.executemany("INSERT INTO metadata VALUES (?, ?)", about.items())
        return cls(path, about)

    @classmethod
    def opened(cls, path: Path) -> RegionFile:
        """A file of an earlier session; ValueError or KeyError for one that is none of ours."""
        about = metadata(path)
        try:
            _ = about["name"], about["pilothouse_source"], _box(about)
        except (TypeError, OverflowError, RecursionError) as fault:
            raise ValueError(f"its box is {type(fault).__name__}") from fault
        zooms_of(path, about)
        return cls(path, about)

    def plan(self, make: Callable[[Box, int, int], P]) -> P:
        """What it is to hold."""
        return make(_box(self.about), int(self.about["minzoom"]), int(self.about["maxzoom"]))

    def keys(self) -> set[Key]:
        """The tiles that are here, or that the server does not have."""
        columns = "zoom_level, tile_column, tile_row"
        with self._lock:
            rows = self._open().execute(
                f"SELECT {columns} FROM tiles UNION SELECT {columns} FROM pilothouse_gaps"  # noqa: S608
            )
            return {(zoom, column, row) for zoom, column, row in rows}

    def count(self) -> int:
        """How many those are."""
        with self._lock:
            both = "SELECT (SELECT COUNT(*) FROM tiles) + (SELECT COUNT(*) FROM pilothouse_gaps)"
            return int(self._open().execute(both).fetchone()[0])

    def put(self, tile: Key, data: bytes | None, at: float) -> None:
        """Keep a tile, or that there is none, fetched at `at` [s], by the system's clock; sqlite3.Error where that cannot be."""
        with self._lock, self._open() as file:
            if data is None:
                file.execute("INSERT OR REPLACE INTO pilothouse_gaps VALUES (?, ?, ?)", tile)
            else:
                file.execute("INSERT OR REPLACE INTO tiles VALUES (?, ?, ?, ?)", (*tile, data))
            if self._dated:
                file.execute("INSERT OR REPLACE INTO pilothouse_fetched VALUES (?, ?, ?, ?)", (*tile, at))

    def get(self, tile: Key) -> Stored | None:
        """That tile; None where it is not here."""
        try:
            with self._lock:
                file = self._open()
                row = file.execute(f"SELECT tile_data FROM tiles WHERE {ABOUT}", tile).fetchone()  # noqa: S608
                fetched = self._fetched(file, tile)
        except (sqlite3.Error, OSError):
            return None  # deleted, or damaged: the network has it
        return Stored(bytes(row[0]), expires=fetched + GOOD_FOR) if row else None

    def _fetched(self, file: sqlite3.Connection, tile: Key) -> float:
        when = f"SELECT at FROM pilothouse_fetched WHERE {ABOUT}"  # noqa: S608
        row = file.execute(when, tile).fetchone() if self._dated else None
        return float(row[0]) if row else self._written

    def delete(self) -> None:
        """Delete the file."""
        self.close()
        with contextlib.suppress(OSError):
            self.path.unlink()

    def close(self) -> None:
        """Let go of the file; what comes later is neither found nor kept."""
        with self._lock:
            self._closed = True
            if self._file is not None:
                self._file.close()
                self._file = None

    def _open(self) -> sqlite3.Connection:
        """With the lock held."""
        if self._closed:
            raise sqlite3.ProgrammingError(f"{self.path.name} is closed")
        if self._file is None:
            self._written = self.path.stat().st_mtime
            uri = f"{self.path.absolute().as_uri()}?mode=rw"
            file = sqlite3.connect(uri, uri=True, check_same_thread=False)
            try:
                with contextlib.suppress(sqlite3.OperationalError):  # a card that cannot be written is read
                    file.executescript(FETCHED)
                known = "SELECT 1 FROM sqlite_master WHERE name='pilothouse_fetched'"
                self._dated = bool(file.execute(known).fetchone())
            except sqlite3.Error:
                file.close()
                raise
            self._file = file
        return self._file


def _box(about: Mapping[str, str]) -> Box:
    west, south, east, north = (float(side) for side in json.loads(about["pilothouse_box"]))
    if not (max(abs(west), abs(east)) <= MAX_LONGITUDE and -90 <= south <= north <= 90):
        raise ValueError(f"its box is {about['pilothouse_box']:.80}, which is no place on earth")
    return west, south, east, north
