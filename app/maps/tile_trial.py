"""Tries an address by one tile, in a thread of its own, so that an operator sees what comes before it is kept."""

from __future__ import annotations

import logging
import math
import threading

from kivy.core.image import ImageData

from app.maps.network_tiles import Server
from app.maps.tile_address import TileAddress
from app.maps.tile_server import NoAnswer
from widgets.core.language import tr
from widgets.map.tiles.tile_reader import Key

__all__ = ["TileTrial", "tile_at"]

log = logging.getLogger(__name__)

SHOWN_ZOOM = 16
"""Level of the tile that is asked for where the robot's place is known."""
SOMEWHERE = (3, 4, 5)
"""The tile that is asked for where it is not: much of Europe."""


def tile_at(latitude: float, longitude: float, least: int, most: int) -> Key:
    """A tile about that place [deg], NaN for anywhere, at one of the zoom levels from `least` to `most`."""
    if not (math.isfinite(latitude) and math.isfinite(longitude)):
        zoom = min(max(SOMEWHERE[0], least), most)
        share = 2.0 ** (zoom - SOMEWHERE[0])
        return zoom, int(SOMEWHERE[1] * share), int(SOMEWHERE[2] * share)
    zoom = min(max(SHOWN_ZOOM, least), most)
    count = 1 << zoom
    bent = math.asinh(math.tan(math.radians(min(max(latitude, -85.0), 85.0))))
    return (
        zoom,
        min(int((longitude + 180) / 360 * count), count - 1),
        min(int((1 + bent / math.pi) / 2 * count), count - 1),
    )


class TileTrial:
    """One try. What came is looked at in the UI thread."""

    def __init__(self, server: Server, address: TileAddress, tile: Key) -> None:
        self._server, self._address, self._tile = server, address, tile
        self.picture: ImageData | None = None
        """The tile that came; None for none."""
        self.problem = ""
        """Why none came, in one sentence."""
        self.over = False
        self._thread = threading.Thread(target=self._run, name="map trial", daemon=True)
        self._thread.start()

    def _run(self) -> None:
        try:
            self.picture = self._server.fetch(self._address, self._tile).picture
            if self.picture is None:
                self.problem = tr("The server has no tile of this place at zoom level {zoom}.").format(
                    zoom=self._tile[0]
                )
        except NoAnswer as none:
            self.problem = str(none)
        except Exception as fault:  # a thread that ends silently would be trying for ever
            log.exception("a tile that was tried")
            self.problem = tr("The tile cannot be shown ({fault}).").format(fault=type(fault).__name__)
        self.over = True

    def wait(self, timeout: float | None = None) -> None:
        """Until it is over, or so long [s]."""
        self._thread.join(timeout)
