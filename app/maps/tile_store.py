"""Tiles that were fetched, in one file of bounded size; what was not looked at for longest makes room.

Every method may be called from any thread; `set_limit`, `clear` and `size` wait for no file, so that they may be called where fingers
are served. A file that is damaged is begun anew: it holds nothing that cannot be fetched again. One that is locked, or on a full disk,
keeps what it has.
"""

from __future__ import annotations

import contextlib
import logging
import math
import sqlite3
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from widgets.core.language import tr
from widgets.map.tiles.tile_reader import Key

__all__ = ["LOOKED_PERIOD", "Stored", "TileStore"]

log = logging.getLogger(__name__)

LOOKED_PERIOD = 3600.0
"""How exactly it is remembered when a tile was last looked at [s]: each note of it is a write."""
SPARE = 0.9
"""When it is full, the oldest go until this share of the limit is left."""
BUSY_TIMEOUT = 0.5
"""How long another process may hold the file [s]; then a tile is not kept."""
RETRY_PERIOD = 30.0
"""A file that could not be opened is tried again after this [s]."""
GAP_BYTES = 500
"""What is counted for a tile that its server does not have: its row in the file, roughly."""
ROWS_AT_ONCE = 64
"""Tiles that make room before others who wait for the file have their turn."""
VERSION = 1
TABLES = """
CREATE TABLE IF NOT EXISTS tiles (source TEXT, zoom INT, x INT, y INT, data BLOB, etag TEXT, modified TEXT,
  expires REAL, looked REAL, size INT, PRIMARY KEY (source, zoom, x, y)) WITHOUT ROWID;
CREATE INDEX IF NOT EXISTS by_look ON tiles (looked);
"""


@dataclass(frozen=True, slots=True)
class Stored:
    """A tile as it was fetched."""

    data: bytes | None
    """The picture's file; None where the server has none."""
    etag: str = ""
    modified: str = ""
    """The server's `ETag` and `Last-Modified`; empty for none."""
    expires: float = 0.0
    """Until when it need not be asked for again [s], by the system's clock."""


class TileStore:
    """One file, opened when it is first needed. Where it cannot be used, nothing new is kept and `problem` says so."""

    def __init__(self, path: Path, limit: int, clock: Callable[[], float] = time.monotonic) -> None:
        """`limit` is in bytes of pictures; `clock` is that of pauses [s]."""
        self.path, self._limit, self._clock = path, limit, clock
        self.problem = ""
        """Why nothing is kept, in one sentence; empty when all is well."""
        self._lock = threading.Lock()
        self._file: sqlite3.Connection | None = None
        self._size = 0
        self._counted = self._closed = False
        self._again = -math.inf
        """When a file that could not be opened is tried again."""
        self._work: list[Callable[[], object]] = []
        self._thread: threading.Thread | None = None
        self._works = False
        self._work_lock = threading.Lock()

    @property
    def size(self) -> float:
        """Bytes of pictures in it; NaN while they are being counted."""
        if not self._counted:
            self._later(self._count)
        return self._size if self._counted else math.nan

    def get(self, source: str, tile: Key, now: float) -> Stored | None:
        """What is kept of that tile, however old; None for nothing."""
        with self._lock:
            row = self._ask(
                "SELECT data, etag, modified, expires, looked FROM tiles WHERE source=? AND zoom=? AND x=? AND y=?",
                (source, *tile),
            )
            if not row:
                return None
            data, etag, modified, expires, looked = row[0]
            if abs(now - looked) > LOOKED_PERIOD:
                self._ask(
                    "UPDATE tiles SET looked=? WHERE source=? AND zoom=? AND x=? AND y=?",
                    (now, source, *tile),
                )
            return Stored(data, etag, modified, expires)

    def put(self, source: str, tile: Key, stored: Stored, now: float) -> None:
        """Keep it, in place of what was kept of that tile."""
        size = len(stored.data or b"") or GAP_BYTES
        with self._lock:
            if size > self._limit:
                return
            self._delete("source=? AND zoom=? AND x=? AND y=?", (source, *tile))
            kept = self._ask(
                "INSERT INTO tiles VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                (source, *tile, stored.data, stored.etag, stored.modified, stored.expires, now, size),
            )
            if kept is None:
                return
            self._size += size
            self.problem = ""
        self._make_room()

    def set_limit(self, limit: int) -> None:
        """Keep no more than so many bytes of pictures; what is too much goes soon."""
        if limit != self._limit:
            self._limit = limit
            self._later(self._make_room)

    def clear(self, source: str = "") -> None:
        """Forget the tiles of that source, or all, soon."""
        self._later(lambda: self._forget(source))

    def wait(self) -> None:
        """Until what was to be done soon is done."""
        if self._thread is not None:
            self._thread.join()

    def close(self) -> None:
        """Close the file; what comes later is neither found nor kept, and what was to be done soon is not."""
        self._closed = True
        self.wait()
        with self._lock:
            if self._file is not None:
                self._file.close()
                self._file = None

    # soon, in a thread of its own

    def _later(self, work: Callable[[], object]) -> None:
        with self._work_lock:
            if self._closed:
                return
            self._work.append(work)
            if not self._works:
                self._works = True
                self._thread = threading.Thread(target=self._run, name="kept tiles", daemon=True)
                self._thread.start()

    def _run(self) -> None:
        while True:
            with self._work_lock:
                self._works = bool(self._work) and not self._closed
                if not self._works:
                    return
                work = self._work.pop(0)
            work()

    def _count(self) -> None:
        with self._lock:
            self._open()

    def _forget(self, source: str) -> None:
        where, values = ("WHERE source=?", (source,)) if source else ("", ())
        some = f"SELECT source, zoom, x, y FROM tiles {where} LIMIT {ROWS_AT_ONCE}"  # noqa: S608
        while self._delete_some(some, values):
            pass
        self._give_back()

    def _make_room(self) -> None:
        if self._size <= self._limit:
            return
        oldest = f"SELECT source, zoom, x, y FROM tiles ORDER BY looked LIMIT {ROWS_AT_ONCE}"  # noqa: S608
        while self._size > SPARE * self._limit and self._delete_some(oldest, (), down_to=SPARE * self._limit):
            pass
        self._give_back()

    def _delete_some(self, which: str, values: tuple[object, ...], *, down_to: float = -1.0) -> bool:
        """Delete those tiles until so few bytes are left; False where there is none, or none that can be deleted."""
        with self._lock:
            if self._closed:
                return False
            rows, before = self._ask(which, values), self._size
            for row in rows or ():
                if self._size <= down_to:
                    break
                self._delete("source=? AND zoom=? AND x=? AND y=?", row)
            return self._size < before

    def _give_back(self) -> None:
        """Make the file smaller."""
        with self._lock:
            self._ask("PRAGMA incremental_vacuum", ())

    # with the lock held

    def _delete(self, where: str, values: tuple[object, ...]) -> None:
        """`where` is one of this file's own."""
        row = self._ask(f"SELECT COALESCE(SUM(size), 0) FROM tiles WHERE {where}", values)  # noqa: S608
        if row and self._ask(f"DELETE FROM tiles WHERE {where}", values) is not None:  # noqa: S608
            self._size -= row[0][0]

    def _ask(self, statement: str, values: tuple[object, ...]) -> list[tuple[Any, ...]] | None:
        """Rows; None where the file cannot be used."""
        file = self._open()
        if file is None:
            return None
        try:
            return file.execute(statement, values).fetchall()
        except sqlite3.OperationalError as fault:  # the disk is full or the file is locked
            self._say(fault)
            return None
        except sqlite3.DatabaseError as fault:
            self._begin_anew(fault)
            return None

    def _open(self) -> sqlite3.Connection | None:
        if self._file is not None or self._closed or self._clock() < self._again:
            return self._file
        try:
            self._file = self._connect()
        except (sqlite3.OperationalError, OSError) as fault:  # same, or there is no way to it
            self._put_off(fault)
        except sqlite3.Error as fault:
            self._begin_anew(fault)
        return self._file

    def _connect(self) -> sqlite3.Connection:
        self.path.parent.mkdir(parents=True, exist_ok=True)
        file = sqlite3.connect(self.path, timeout=BUSY_TIMEOUT, isolation_level=None, check_same_thread=False)
        try:
            file.execute("PRAGMA auto_vacuum=INCREMENTAL")
            file.execute("PRAGMA journal_mode=WAL")
            file.execute("PRAGMA synchronous=NORMAL")
            (version,) = file.execute("PRAGMA user_version").fetchone()
            if version not in (0, VERSION):
                raise sqlite3.DatabaseError(
                    tr("version {version} of the file is not known").format(version=version)
                )
            file.executescript(TABLES)
            file.execute(f"PRAGMA user_version={VERSION}")
            file.execute(f"UPDATE tiles SET size={GAP_BYTES} WHERE size=0")  # noqa: S608 - of an earlier version, which did not count them
            (self._size,) = file.execute("SELECT COALESCE(SUM(size), 0) FROM tiles").fetchone()
        except sqlite3.Error:
            file.close()
            raise
        self._counted, self.problem = True, ""
        return file

    def _begin_anew(self, fault: Exception) -> None:
        """A damaged file is deleted, once; where that does not help, nothing is kept."""
        if self._file is not None:
            self._file.close()
            self._file = None
        log.warning("the tiles that were kept are forgotten: %s: %s", self.path, fault)
        self._size = 0
        try:
            for name in (self.path, *(self.path.with_name(self.path.name + end) for end in ("-wal", "-shm"))):
                with contextlib.suppress(FileNotFoundError):
                    name.unlink()
            self._file = self._connect()
        except (sqlite3.Error, OSError) as second:
            self._put_off(second)

    def _put_off(self, fault: Exception) -> None:
        self._say(fault)
        self._again, self._counted = self._clock() + RETRY_PERIOD, True

    def _say(self, fault: Exception) -> None:
        said = tr("Tiles of maps cannot be kept: {second}.").format(second=fault)
        if said != self.problem:
            log.warning("%s: %s", self.path, said)
        self.problem = said
