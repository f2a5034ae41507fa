"""The map on the glass: the robot's own or the one over aerial pictures; both show the same."""

from __future__ import annotations

import math
from pathlib import Path

import widgets
from app.screens.mission.map_pointing import MapPointing
from app.session.dashboard import Dashboard
from app.session.session import Session
from bridge.core.geo import Datum
from widgets import GridMap
from widgets.map.map_overlay import MapOverlay

__all__ = ["MissionMaps"]

PICTURES = Path(widgets.__file__).parent / "data"
"""Aerial pictures, one MBTiles file a world."""


class MissionMaps:
    """One map or two, of which one is shown."""

    def __init__(self, session: Session, dashboard: Dashboard) -> None:
        self._session, self._dashboard = session, dashboard
        self.shown: MapOverlay = GridMap()
        """The map on the glass."""
        self._other: MapOverlay | None = None
        self._pointing: MapPointing | None = None

    def follow(self, pointing: MapPointing) -> None:
        """Let the maps show what the robot says, and `pointing` do what fingers on them ask for."""
        self._pointing = pointing
        self._bind(self.shown, pointing)

    def _bind(self, one: MapOverlay, pointing: MapPointing) -> None:
        bind = self._dashboard.bind
        pointing.follow(one)
        bind(one, "/places", lambda msg: pointing.places.show(one, msg), fresh=False)
        bind(one, "/pose", always=True)
        for topic in (
            "/plan",
            "/intruders",
            "/scan",
            "/limits",
            *(["/map"] if isinstance(one, GridMap) else []),
        ):
            bind(one, topic, fresh=False)

    def pictures(self) -> Path | None:
        """The file with aerial pictures of this robot's world; None when there is none or its place is unknown."""
        info = self._session.robot.info
        path = PICTURES / f"{info.world}.mbtiles"
        return path if math.isfinite(info.latitude) and info.world and path.is_file() else None

    def end(self) -> None:
        """End the thread that reads aerial pictures."""
        for one in (self.shown, self._other):
            if one is not None:
                one.close()

    def change(self) -> bool:
        """Show the other map; False when there is only one."""
        pictures = self.pictures()
        if self._other is None and pictures is not None and self._pointing is not None:
            from widgets import GeoMap

            info = self._session.robot.info
            other = self._other = GeoMap(tiles=str(pictures), datum=Datum(info.latitude, info.longitude))
            self._bind(other, self._pointing)
        if self._other is None:
            return False
        self.shown.let_go()
        self.shown, self._other = self._other, self.shown
        return True
