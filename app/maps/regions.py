"""Offline regions: what is seen of a tile server's map, kept whole in an MBTiles file of its own.

regions = Regions(folder)
plan = RegionPlan.of(box, (12, 18), tile_size=18_000)
region = regions.begin(source, "Harbour", plan, server)
"""

from __future__ import annotations

import contextlib
import logging
import math
import re
import secrets
import shutil
import sqlite3
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from app.maps.map_source import Box, Source
from app.maps.network_tiles import Server
from app.maps.region_file import RegionFile
from app.maps.tile_queue import FIRST_PAUSE, GREATEST_PAUSE
from app.maps.tile_server import NoAnswer
from widgets.core.language import tr
from widgets.map.tiles.tile_reader import Key

__all__ = ["MAX_TILES", "USUAL_BYTES", "Region", "RegionPlan", "Regions", "Surroundings"]

log = logging.getLogger(__name__)

MAX_TILES = 20_000
"""Of one region: more is a burden to a public server, and to a phone."""
MAX_REGIONS = 32
USUAL_BYTES = 20_000
"""Of one tile's file, while there is none to measure."""
LARGER = 3
"""A region may take so many times what was announced, for tiles differ; what is more ends the download."""
LEAST_BYTES = 50_000_000
"""So much any region may take."""
LEAST_FREE = 200_000_000
"""What a download leaves free on the disk [bytes]: settings, recordings and the system need room too."""
MEGABYTE = 1_000_000
MAX_FAILED_IN_ROW = 8
"""So many failures one after the other, and the download stops and says why."""
CLOSE_TIMEOUT = 2.0
"""Longest time that closing waits for the tile at work [s]."""


@dataclass(frozen=True, slots=True)
class RegionPlan:
    """Which tiles a region has."""

    box: Box
    least: int
    most: int
    """First and last zoom level."""
    bytes_each: int = USUAL_BYTES

    def rows(self) -> Iterator[tuple[int, range, range]]:
        """Zoom level, columns and rows from the south, level by level."""
        west, south, east, north = self.box
        for zoom in range(self.least, self.most + 1):
            first, last = _column(west, zoom), _column(east, zoom)
            if west > east:
                last += 1 << zoom
            yield zoom, range(first, last + 1), range(_row(south, zoom), _row(north, zoom) + 1)

    def tiles(self) -> Iterator[Key]:
        """Each of its tiles, the coarse ones first."""
        for zoom, columns, rows in self.rows():
            for column in columns:
                for row in rows:
                    yield zoom, column % (1 << zoom), row

    @property
    def count(self) -> int:
        """How many tiles it has."""
        return sum(len(columns) * len(rows) for _, columns, rows in self.rows())

    @property
    def size(self) -> int:
        """What they will take, roughly [bytes]."""
        return self.count * self.bytes_each

    @property
    def most_bytes(self) -> int:
        """What they may take [bytes]."""
        return max(LARGER * self.size, LEAST_BYTES)

    @property
    def refusal(self) -> str:
        """Why it is not downloaded, in one sentence; empty where it may be."""
        if self.count <= MAX_TILES:
            return ""
        return tr(
            "These are {count} tiles; a region has at most {most}. Choose a smaller area or fewer zoom levels."
        ).format(count=self.count, most=MAX_TILES)


@dataclass(frozen=True, slots=True)
class Surroundings:
    """What a download asks of the system; tests have their own."""

    wait: Callable[[threading.Event, float], bool] = threading.Event.wait
    """Waits so long [s] or until the event is set, and says whether it is."""
    now: Callable[[], float] = time.time
    """The system's clock [s]."""
    free: Callable[[Path], int] = lambda folder: shutil.disk_usage(folder).free
    """Bytes that are free on the disk of a folder."""


class Region:
    """One region: its file, and the thread that fills it while it is being downloaded. For the UI thread but for `_run`."""

    def __init__(self, file: RegionFile, system: Surroundings) -> None:
        self.file = file
        about = file.about
        self.name, self.source = about["name"], about["pilothouse_source"]
        self.plan = file.plan(RegionPlan)
        self.total = self.plan.count
        self.done = file.count()
        """Tiles that are here, or that the server does not have."""
        self.state = "done" if self.done >= self.total else "paused"
        """`done`, `paused`, `loading`, or `failed`, which can be resumed too."""
        self.problem = ""
        """Why it failed, in one sentence."""
        self._system = system
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None

    @property
    def size(self) -> int:
        """Bytes of the file."""
        with contextlib.suppress(OSError):
            return self.file.path.stat().st_size
        return 0

    def resume(self, source: Source, server: Server) -> None:
        """Go on with the download, from where it was."""
        if self.state in ("done", "loading"):
            return
        stop = self._stop = threading.Event()
        self.state, self.problem = "loading", ""
        self._thread = threading.Thread(
            target=self._run, args=(source, server, stop), name="offline map", daemon=True
        )
        self._thread.start()

    def pause(self) -> None:
        """Stop after the tile at work; what is here stays."""
        self._stop.set()
        if self.state == "loading":
            self.state = "paused"

    def wait(self, timeout: float | None = None) -> None:
        """Until the download has ended, or so long [s]."""
        if self._thread is not None:
            self._thread.join(timeout)

    def _run(self, source: Source, server: Server, stop: threading.Event) -> None:
        problem = ""
        try:
            self._load(source, server, stop)
        except (sqlite3.Error, OSError) as fault:
            problem = tr("The region cannot be kept: {fault}.").format(fault=fault)
        except (NoAnswer, _NoRoom) as none:
            problem = str(none)
        except Exception as fault:  # a thread that ends silently would be downloading for ever
            log.exception("offline map")
            problem = type(fault).__name__
        if not stop.is_set():
            self.problem, self.state = problem, "failed" if problem else "done"

    def _load(self, source: Source, server: Server, stop: threading.Event) -> None:
        address, here, failed = source.address(), self.file.keys(), 0
        left = deque(tile for tile in self.plan.tiles() if tile not in here)
        self.done = self.total - len(left)
        while left and not stop.is_set():
            self._check_room()
            try:
                answer = server.fetch(address, left[0])
            except NoAnswer as none:
                failed += 1
                if failed >= MAX_FAILED_IN_ROW:
                    raise
                left.rotate(-1)  # another tile may come
                self._system.wait(
                    stop, max(none.pause, min(FIRST_PAUSE * 2.0 ** (failed - 1), GREATEST_PAUSE))
                )
                continue
            self.file.put(left.popleft(), answer.stored.data, self._system.now())
            failed = 0
            if not stop.is_set():
                self.done += 1

    def _check_room(self) -> None:
        """_NoRoom where the next tile is not to be kept."""
        if self.size >= self.plan.most_bytes:
            raise _NoRoom(
                tr(
                    "The tiles are larger than was announced: they take {size} MB already. What is here stays."
                ).format(size=self.size // MEGABYTE)
            )
        if full := _full(self._system.free(self.file.path.parent)):
            raise _NoRoom(full)


class _NoRoom(Exception):
    """A download ends, for a reason that is one sentence for people."""


def _full(free: int, needed: int = 0) -> str:
    """Why so much is not kept where so much is free [bytes]; empty where it may be."""
    if free - needed >= LEAST_FREE:
        return ""
    return tr("The disk has {free} MB left; a download needs {needed} MB.").format(
        free=free // MEGABYTE, needed=(needed + LEAST_FREE) // MEGABYTE
    )


class Regions:
    """The regions of this handheld, one file each in `folder`. For the UI thread."""

    def __init__(self, folder: Path, system: Surroundings | None = None) -> None:
        self._folder, self._system = folder, system or Surroundings()
        self._all: list[Region] | None = None

    @property
    def all(self) -> list[Region]:
        """Every region, by name; what cannot be read is left out."""
        if self._all is None:
            self._all = []
            for path in sorted(self._folder.glob("*.mbtiles")):
                try:
                    self._all.append(Region(RegionFile.opened(path), self._system))
                except (sqlite3.Error, ValueError, KeyError, OSError) as fault:
                    log.warning("%s is no offline region: %s", path, fault)
        return self._all

    def of(self, source: str) -> list[Region]:
        """Those of that source."""
        return [one for one in self.all if one.source == source]

    def begin(self, source: Source, name: str, plan: RegionPlan, server: Server) -> Region:
        """Begin to download; ValueError, in one sentence, where that is refused or cannot be."""
        if plan.refusal:
            raise ValueError(plan.refusal)
        if len(self.all) >= MAX_REGIONS:
            raise ValueError(
                tr("There are {count} offline regions already; delete one first.").format(count=MAX_REGIONS)
            )
        plain = re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")[:40] or "region"
        path = self._folder / f"{plain}-{secrets.token_hex(3)}.mbtiles"
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            if full := _full(self._system.free(self._folder), plan.size):
                raise ValueError(full)
            region = Region(RegionFile.made(path, source, name, plan), self._system)
        except (sqlite3.Error, OSError) as fault:
            raise ValueError(tr("The region cannot be kept: {fault}.").format(fault=fault)) from fault
        self.all.append(region)
        region.resume(source, server)
        return region

    def delete(self, region: Region) -> None:
        """Stop its download and delete its file."""
        region.pause()
        region.file.delete()
        self.all.remove(region)

    def close(self) -> None:
        """Stop every download; each goes on when it is asked to, after a restart too."""
        for region in self._all or ():
            region.pause()
        for region in self._all or ():
            region.wait(CLOSE_TIMEOUT)
            region.file.close()


def _column(longitude: float, zoom: int) -> int:
    count = 1 << zoom
    return min(max(int((longitude + 180.0) / 360.0 * count), 0), count - 1)


def _row(latitude: float, zoom: int) -> int:
    """From the south."""
    count = 1 << zoom
    bent = math.asinh(math.tan(math.radians(min(max(latitude, -85.05), 85.05))))
    return min(max(int((1 + bent / math.pi) / 2 * count), 0), count - 1)
