"""Keeps beneath a map what the operator chose and what covers the robot, opened, read and closed in time.

keeper = GroundKeeper(map_, maps, feeds.latest)
keeper.look()      # ten times a second: cheap where nothing changed
keeper.close()
"""

from __future__ import annotations

import logging
import math
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any, Protocol

from app.maps.map_source import Source
from app.maps.maps import READERS, Maps
from app.maps.network_tiles import NetworkTiles
from app.maps.placed_picture import PlacedPicture
from app.maps.robot_place import RobotPlace
from bridge.core.geo import Datum
from widgets.core.language import tr
from widgets.map.beneath import Ground

__all__ = ["GroundKeeper", "Underlaid"]

log = logging.getLogger(__name__)


class Underlaid(Protocol):
    """A map with a place for a ground, such as `widgets.GridMap`."""

    ground: Ground | None
    ground_opacity: float


class GroundKeeper:
    """Of one map. For the UI thread."""

    def __init__(
        self,
        map_: Underlaid,
        maps: Maps,
        latest: Callable[[str], Any],
        now: Callable[[], float] = time.monotonic,
    ) -> None:
        """`latest` gives the newest message of a topic, None before the first; `now` is our clock [s]."""
        self._map, self._maps, self._latest = map_, maps, latest
        self.place = RobotPlace(now)
        """Where the robot's map is on earth."""
        self.source: Source | None = None
        """What is looked at; None for the robot's own map alone."""
        self.problem = ""
        """Why it is not shown, in one sentence; empty when it is."""
        self._datum: Datum | None = None
        self._picture: PlacedPicture | None = None
        """What was read of the source, without its pixels where they are on the map."""
        self._reading: _Reading | None = None
        """The file that is being read, which may be one that is not looked at any more: never two at once."""
        self._reader: NetworkTiles | None = None
        self._said = ""

    @property
    def trouble(self) -> str:
        """Why new tiles do not come, or why nothing is shown, in one sentence; empty when all is well."""
        return self.problem or (self._reader.trouble if self._reader is not None else "")

    def news(self) -> str:
        """The trouble, where it was not told by this since `source` came beneath the map; else empty."""
        trouble = self.trouble
        if not trouble or self._said:
            return ""
        self._said = trouble
        return trouble

    def covering(self) -> list[Source]:
        """The sources that may have pictures of where the robot is."""
        return self._maps.sources.covering(*self._where())

    def look(self) -> None:
        """Take in where the robot is and what was chosen."""
        self.place.look(*(self._latest(topic) for topic in ("/robot/info", "/fix", "/pose")))
        sources = self._maps.sources
        wanted, datum = sources.pick(*self._where()), self.place.datum
        moved, self._datum = datum is not self._datum, datum
        if wanted != self.source:
            self._open(wanted)
        elif moved and wanted is not None:
            self._move()
        self._read_on()
        if self._map.ground_opacity != sources.opacity:
            self._map.ground_opacity = sources.opacity

    def close(self) -> None:
        """Take away what lies beneath the map, and end its reading."""
        self._drop()
        self.source = None
        if self._reading is not None and self._reading.over:
            self._reading = None

    def _where(self) -> tuple[float, float]:
        datum = self.place.datum
        return (math.nan, math.nan) if datum is None else (datum.latitude, datum.longitude)

    def _open(self, source: Source | None) -> None:
        self._drop()
        self._said = self.problem = ""
        self.source = source
        if source is not None and source.kind not in READERS:
            self._open_tiles(source)

    def _open_tiles(self, source: Source) -> None:
        self.problem = ""
        try:
            ground = self._maps.open(source, self._datum)
        except ValueError as fault:
            self._refuse(str(fault))
            return
        self._map.ground = ground
        reader = getattr(getattr(ground, "source", None), "reader", None)
        self._reader = reader if isinstance(reader, NetworkTiles) else None

    def _move(self) -> None:
        """Bring what lies beneath the map to where the map is now; what was read is not read again."""
        ground = self._map.ground
        if ground is not None and self._datum is not None:
            self._map.ground = self._maps.moved(ground, self._picture, self._datum)
        elif self._picture is not None:
            self._place(self._picture)
        elif self.source is not None and self.source.kind not in READERS:
            self._open_tiles(self.source)

    def _read_on(self) -> None:
        """Read the picture that is looked at; take in the one that was read."""
        source = self.source
        if self._reading is not None:
            if not self._reading.over:
                return
            reading, self._reading = self._reading, None
            if reading.source == source:
                self._show_picture(reading)
        wanted = source is not None and source.kind in READERS and self._picture is None and not self.problem
        if source is not None and wanted:
            self._reading = _Reading(source)

    def _show_picture(self, reading: _Reading) -> None:
        if reading.picture is None:
            self._refuse(reading.problem)
        else:
            self._place(reading.picture)

    def _place(self, picture: PlacedPicture) -> None:
        self._picture, self.problem = picture, ""
        try:
            if self.source is not None:
                self._map.ground = self._maps.place(picture, self.source, self._datum)
        except ValueError as fault:
            self._refuse(str(fault))
        else:
            self._picture = replace(picture, rgba=b"")

    def _refuse(self, sentence: str) -> None:
        self.problem = sentence
        log.warning("%s", sentence)

    def _drop(self) -> None:
        ground, self._map.ground = self._map.ground, None
        if ground is not None:
            ground.close()
        self._reader = self._picture = None


class _Reading:
    """A picture file that is being read in a thread of its own, whose end nobody waits for: that would hold up fingers."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.picture: PlacedPicture | None = None
        self.problem = ""
        self.over = False
        self._thread = threading.Thread(target=self._run, name="map picture", daemon=True)
        self._thread.start()

    def _run(self) -> None:
        try:
            self.picture = READERS[self.source.kind](self.source.path)
        except ValueError as fault:
            self.problem = str(fault)
        except Exception as fault:  # a thread that ends silently would be reading for ever
            log.exception("%s", self.source.name)
            self.problem = tr("{name} cannot be read ({fault}).").format(
                name=self.source.name, fault=type(fault).__name__
            )
        self.over = True
