"""One source of map pictures: a tile server, a file of tiles, a picture with its place on earth, or a floor plan."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from app.core.checked_settings import number, shown
from app.maps.tile_address import TileAddress
from widgets.core.language import mark, tr

__all__ = ["KINDS", "MAX_ZOOM", "Box", "Source"]

Box = tuple[float, float, float, float]
"""West, south, east, north [deg]; west is greater than east where it crosses the date line."""

URL, MBTILES, GEOTIFF, MAP_SERVER = "url", "mbtiles", "geotiff", "map_server"
KINDS = {
    URL: mark("Tile server"),
    MBTILES: mark("Tiles in a file"),
    GEOTIFF: mark("Picture with its place"),
    MAP_SERVER: mark("Floor plan"),
}
"""Kind of a source, and its words."""
MAX_ZOOM = 24
MAX_NAME = 60
MAX_ATTRIBUTION = 200


@dataclass(frozen=True, slots=True)
class Source:
    """Checked when it is made: ValueError, in one sentence."""

    id: str
    """Tells it from the others; not for people."""
    kind: str
    """One of `KINDS`."""
    name: str
    where: str
    """URL template, or absolute path of the file."""
    attribution: str = ""
    """Whom the pictures are of; shown on the map."""
    min_zoom: int = 0
    max_zoom: int = 19
    key: str = ""
    """What the server knows its user by."""
    from_south: bool = False
    """Rows of its tiles count from the south."""
    box: Box | None = None
    """What it covers; None for all the earth, or for a floor plan."""
    shipped: bool = False
    """It came with the app."""

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise ValueError(tr("There are no maps of the kind {kind}.").format(kind=shown(self.kind)))
        if not (self.id and 0 < len(self.name) <= MAX_NAME and len(self.attribution) <= MAX_ATTRIBUTION):
            raise ValueError(
                tr(
                    "A map's name has 1 to {name} letters and the word about its origin at most {words}."
                ).format(name=MAX_NAME, words=MAX_ATTRIBUTION)
            )
        if not 0 <= self.min_zoom <= self.max_zoom <= MAX_ZOOM:
            raise ValueError(
                tr("Zoom levels go from 0 to {most}, not from {least} to {greatest}.").format(
                    most=MAX_ZOOM, least=self.min_zoom, greatest=self.max_zoom
                )
            )
        if self.kind == URL:
            _ = self.address()

    @classmethod
    def of(cls, kept: object) -> Source:
        """From what was kept in the settings; ValueError for what is no source."""
        if not isinstance(kept, Mapping):
            raise ValueError(  # noqa: TRY004 - what a settings file holds is a value
                tr("A map is a table of values, not {value}.").format(value=shown(kept))
            )
        texts = {name: kept.get(name, "") for name in ("id", "kind", "name", "where", "attribution", "key")}
        zooms = {name: kept.get(name, usual) for name, usual in (("min_zoom", 0), ("max_zoom", 19))}
        for name, value in texts.items():
            if not isinstance(value, str):
                raise ValueError(  # noqa: TRY004 - same
                    tr("A map's {name} is a text, not {value}.").format(name=name, value=shown(value))
                )
        for name, value in zooms.items():
            if number(value, 0, MAX_ZOOM) is None or value != int(value):
                raise ValueError(
                    tr("A map's {name} is a whole number from 0 to {most}, not {value}.").format(
                        name=name, most=MAX_ZOOM, value=shown(value)
                    )
                )
        return cls(
            texts["id"],
            texts["kind"],
            texts["name"],
            texts["where"],
            texts["attribution"],
            int(zooms["min_zoom"]),
            int(zooms["max_zoom"]),
            texts["key"],
            kept.get("from_south") is True,
            _box(kept.get("box")),
        )

    def kept(self) -> dict[str, Any]:
        """As it goes into the settings."""
        values = asdict(self)
        del values["shipped"]
        return values | {"box": list(self.box) if self.box else None}

    def address(self, *, dense: bool = False) -> TileAddress:
        """Where its tiles are asked for; ValueError for one that names no tiles."""
        return TileAddress(self.where, self.key, self.from_south, dense)

    @property
    def path(self) -> Path:
        """Its file."""
        return Path(self.where)

    @property
    def detail(self) -> str:
        """Where it comes from, in one line that holds no key."""
        return self.address().shown if self.kind == URL else self.path.name

    def covers(self, latitude: float, longitude: float) -> bool:
        """There may be pictures of that place [deg]; a floor plan is where its robot is, wherever that be."""
        if self.box is None:
            return self.kind == MAP_SERVER or (math.isfinite(latitude) and math.isfinite(longitude))
        west, south, east, north = self.box
        inside = west <= longitude <= east if west <= east else longitude >= west or longitude <= east
        return south <= latitude <= north and inside

    def called(self, name: str) -> Source:
        """The same under another name."""
        return replace(self, name=name)


def _box(value: object) -> Box | None:
    if value is None:
        return None
    limits = ((-180, 180), (-90, 90), (-180, 180), (-90, 90))
    sides = (
        [number(one, *within) for one, within in zip(value, limits, strict=False)]
        if isinstance(value, list)
        else []
    )
    west, south, east, north = (*sides, None, None, None, None)[:4]
    if len(sides) != 4 or west is None or south is None or east is None or north is None or south > north:
        raise ValueError(
            tr("A map's box is west, south, east and north, not {value}.").format(value=shown(value))
        )
    return west, south, east, north
