"""Keeps beneath a map what the operator chose and what covers the robot, opened, read and closed in time.

keeper = GroundKeeper(map_, maps, feeds.latest)
keeper.look()      # ten times a second: cheap where nothing changed
keeper.close()
"""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Callable
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

    def __init__(self, map_: Underlaid, maps: Maps, latest: Callable[[str], Any]) -> None:
        """`latest` gives the newest message of a topic, None before the first."""
        self._map, self._maps, self._latest = map_, maps, latest
        self.place = RobotPlace()
        """Where the robot's map is on earth."""
        self.source: Source | None = None
        """What is looked at; None for the robot's own map alone."""
        self.problem = ""
        """Why it is not shown, in one sentence; empty when it is."""
        self._datum: Datum | None = None
        self._reading: _Reading | None = None
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
        wanted = sources.pick(*self._where())
        datum = self.place.datum
        if wanted != self.source or (datum is not self._datum and wanted is not None):
            self._open(wanted, datum)
        if self._reading is not None and self._reading.over:
            self._show_picture(self._reading)
        if self._map.ground_opacity != sources.opacity:
            self._map.ground_opacity = sources.opacity

    def close(self) -> None:
        """Take away what lies beneath the map, and end its reading."""
        self._drop()
        self.source = None

    def _where(self) -> tuple[float, float]:
        datum = self.place.datum
        return (math.nan, math.nan) if datum is None else (datum.latitude, datum.longitude)

    def _open(self, source: Source | None, datum: Datum | None) -> None:
        self._drop()
        if source != self.source:
            self._said = ""
        self.source, self._datum, self.problem = source, datum, ""
        if source is None:
            return
        if source.kind in READERS:
            self._reading = _Reading(source)
            return
        try:
            ground = self._maps.open(source, datum)
        except ValueError as fault:
            self._refuse(str(fault))
            return
        self._map.ground = ground
        reader = getattr(getattr(ground, "source", None), "reader", None)
        self._reader = reader if isinstance(reader, NetworkTiles) else None

    def _show_picture(self, reading: _Reading) -> None:
        self._reading = None
        if reading.picture is None:
            self._refuse(reading.problem)
            return
        try:
            self._map.ground = self._maps.place(reading.picture, reading.source, self._datum)
        except ValueError as fault:
            self._refuse(str(fault))

    def _refuse(self, sentence: str) -> None:
        self.problem = sentence
        log.warning("%s", sentence)

    def _drop(self) -> None:
        ground, self._map.ground = self._map.ground, None
        if ground is not None:
            ground.close()
        if self._reading is not None:
            self._reading.close()
        self._reading = self._reader = None


class _Reading:
    """A picture file that is being read in a thread of its own."""

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

    def close(self) -> None:
        """What it reads is not shown. Its end is not waited for, which would hold up fingers."""
        self.over = True
