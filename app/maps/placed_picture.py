"""A picture and where its four corners are: on earth, or in a robot's `map` frame."""

from __future__ import annotations

from dataclasses import dataclass

from app.maps.map_source import Box
from bridge.core.geo import Datum
from widgets.core.language import tr

__all__ = ["MAX_TEXTURE_SIDE", "PlacedPicture"]

MAX_TEXTURE_SIDE = 4096
"""Columns or rows of a picture that is shown [px]: what every phone's graphics take."""

Place = tuple[float, float]


@dataclass(frozen=True, slots=True)
class PlacedPicture:
    """Decoded, in any thread."""

    width: int
    height: int
    """[px]"""
    rgba: bytes
    """Rows from the top."""
    corners: tuple[Place, Place, Place, Place]
    """Lower left, lower right, upper right and upper left of the picture: latitude and longitude [deg], or x and y in `map` [m]."""
    on_earth: bool = True
    """The corners are latitudes and longitudes."""

    @property
    def box(self) -> Box | None:
        """What it covers of the earth [deg]; None for one that lies in a `map` frame."""
        if not self.on_earth:
            return None
        north, east = [one[0] for one in self.corners], [one[1] for one in self.corners]
        return min(east), min(north), max(east), max(north)

    def corners_on(self, datum: Datum | None) -> list[Place]:
        """Where its corners are in the `map` frame [m]; ValueError where that needs a place on earth that is not known."""
        if not self.on_earth:
            return list(self.corners)
        if datum is None:
            raise ValueError(tr("The picture has a place on earth, and the robot's is not known."))
        return [datum.to_local(*corner) for corner in self.corners]
