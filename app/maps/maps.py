"""All of the maps that an operator has: the table of sources, what is kept of them, offline regions, and the way to servers.

maps = Maps(settings, folder)
ground = maps.open(maps.sources.pick(latitude, longitude), datum)
maps.close()
"""

from __future__ import annotations

import secrets
from collections.abc import Callable
from pathlib import Path

import widgets
from app.core.settings_store import Settings
from app.maps.floor_plan import read_floor_plan
from app.maps.geotiff import read_geotiff
from app.maps.map_source import GEOTIFF, MAP_SERVER, MBTILES, Source
from app.maps.network_tiles import NetworkTiles
from app.maps.placed_picture import PlacedPicture
from app.maps.regions import Region, Regions
from app.maps.sources import Sources
from app.maps.tile_server import TileServer
from app.maps.tile_store import Stored, TileStore
from bridge.core.geo import Datum
from widgets.core.language import mark, tr
from widgets.map.beneath import Ground
from widgets.map.tiles.mbtiles_file import box_of, metadata, zooms_of
from widgets.map.tiles.tile_reader import Key

__all__ = ["READERS", "SUFFIXES", "KeptTiles", "Maps", "described", "shipped"]

POLL_PERIOD = 0.1
"""How often a map asks whether tiles of a server have come [s]."""
MEGABYTE = 1_000_000
SUFFIXES = {
    ".mbtiles": MBTILES,
    ".tif": GEOTIFF,
    ".tiff": GEOTIFF,
    ".yaml": MAP_SERVER,
    ".yml": MAP_SERVER,
}
"""What a file is, by the end of its name."""
READERS: dict[str, Callable[[Path], PlacedPicture]] = {GEOTIFF: read_geotiff, MAP_SERVER: read_floor_plan}
"""How a picture of a kind is read; in a thread, for it may take seconds."""


def described(path: Path) -> Source:
    """A source of that file, which is read to see whether it can be shown; ValueError, in one sentence. It may take seconds."""
    kind = SUFFIXES.get(path.suffix.lower())
    if kind is None:
        raise ValueError(
            tr("{file} is no map: {suffixes} can be shown.").format(
                file=path.name, suffixes=", ".join(SUFFIXES)
            )
        )
    id_, where = secrets.token_hex(4), str(path.absolute())
    if kind == MBTILES:
        return _tiles(id_, path)
    return Source(id_, kind, path.stem[:60], where, box=READERS[kind](path).box)


def shipped() -> list[Source]:
    """What came with the app."""
    files = sorted((Path(widgets.__file__).parent / "data").glob("*.mbtiles"))
    return [_tiles(path.stem, path, name=mark("Drawn from above"), shipped=True) for path in files]


def _tiles(id_: str, path: Path, name: str = "", *, shipped: bool = False) -> Source:
    about = metadata(path)
    least, most = zooms_of(path, about)
    return Source(
        id_, MBTILES, (name or about.get("name", "").strip() or path.stem)[:60], str(path.absolute()),
        about.get("attribution", "")[:200], least, most, box=box_of(path, about), shipped=shipped,
    )  # fmt: skip


class KeptTiles:
    """What is kept of one tile server: its offline regions, and what was looked at before. In any thread."""

    def __init__(self, source: str, store: TileStore, regions: list[Region]) -> None:
        self._source, self._store, self._regions = source, store, regions

    def get(self, tile: Key, now: float) -> Stored | None:
        """The newest of it that is kept."""
        kept = self._store.get(self._source, tile, now)
        if kept is not None and now < kept.expires:
            return kept
        for region in self._regions:
            found = region.file.get(tile)
            if found is not None:
                return found
        return kept

    def put(self, tile: Key, stored: Stored, now: float) -> None:
        """Keep it."""
        self._store.put(self._source, tile, stored, now)


class Maps:
    """Made once, closed at the end. For the UI thread."""

    def __init__(self, settings: Settings, folder: Path) -> None:
        """`folder` is where the app keeps its files; maps have one of their own in it."""
        self.folder = folder / "maps"
        self._settings = settings
        self._sources: Sources | None = None
        self.regions = Regions(self.folder / "regions")
        """Offline regions."""
        self.server = TileServer()
        """The way to tile servers."""
        self._store: TileStore | None = None

    @property
    def sources(self) -> Sources:
        """The table of sources, read when it is first looked at."""
        if self._sources is None:
            self._sources = Sources(self._settings, shipped())
            self._sources.bind(lambda: self.store.set_limit(self._limit()))
        return self._sources

    @property
    def store(self) -> TileStore:
        """Tiles of servers that were looked at."""
        if self._store is None:
            self._store = TileStore(self.folder / "tiles.sqlite3", self._limit())
        return self._store

    def _limit(self) -> int:
        return int(self.sources.cache_megabytes * MEGABYTE)

    def open(self, source: Source, datum: Datum | None) -> Ground:
        """Tiles as the ground of a map whose origin is at `datum`; ValueError, in one sentence, where that cannot be."""
        from widgets.map.ground import TileGround
        from widgets.map.tiles.mbtiles import MBTiles
        from widgets.map.tiles.tile_pictures import TilePictures

        if datum is None:
            raise ValueError(tr("It is not known where on earth the robot is."))
        if source.kind == MBTILES:
            return TileGround(MBTiles(source.path), datum)
        return TileGround(
            TilePictures(
                self.reader(source),
                name=source.id,
                zooms=(source.min_zoom, source.max_zoom),
                attribution=source.attribution,
                poll_period=POLL_PERIOD,
            ),
            datum,
        )

    def reader(self, source: Source) -> NetworkTiles:
        """Tiles of a server; whoever takes it closes it."""
        from kivy.metrics import Metrics

        dense = Metrics.density >= 1.5
        kept = KeptTiles(source.id, self.store, self.regions.of(source.id))
        return NetworkTiles(source.address(dense=dense), self.server, kept)

    @staticmethod
    def place(picture: PlacedPicture, source: Source, datum: Datum | None) -> Ground:
        """A picture as the ground of a map; ValueError where it cannot be placed."""
        from kivy.graphics.texture import Texture

        from widgets.map.ground import PictureGround

        corners = picture.corners_on(datum)
        texture = Texture.create(size=(picture.width, picture.height), colorfmt="rgba")
        texture.blit_buffer(picture.rgba, colorfmt="rgba", bufferfmt="ubyte")
        texture.flip_vertical()
        return PictureGround(texture, corners, source.attribution)

    @staticmethod
    def moved(ground: Ground, picture: PlacedPicture | None, datum: Datum) -> Ground:
        """The same ground for a map whose origin is at `datum`, nothing of it read again; `picture` is what it was made of, None for tiles."""
        from widgets.map.ground import PictureGround, TileGround

        if isinstance(ground, TileGround):
            return ground.moved(datum)
        if picture is not None and picture.on_earth and isinstance(ground, PictureGround):
            return ground.moved(picture.corners_on(datum))
        return ground

    def size(self) -> float:
        """What is kept of servers, offline regions left out [MB]; NaN while it is being counted."""
        return self.store.size / MEGABYTE if (self.folder / "tiles.sqlite3").exists() else 0.0

    def close(self) -> None:
        """End every connection and download, and close what is kept."""
        self.server.close()
        self.regions.close()
        if self._store is not None:
            self._store.close()
