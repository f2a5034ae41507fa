"""Tiles for mapview from any reader: textures are made a few a frame, and what is not there yet is shown by a coarser tile."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterable
from typing import Any, ClassVar, Protocol

from kivy.clock import Clock
from kivy.core.image import ImageData
from kivy.graphics.texture import Texture
from kivy_garden.mapview.source import MapSource

from widgets.map.tiles.tile_reader import Key

__all__ = ["MAX_TILES_PER_FRAME", "Reader", "TilePictures"]

MAX_TILES_PER_FRAME = 6
"""Textures made in one frame."""
MAX_PIXELS_PER_FRAME = 2 * 512 * 512
"""When so many went into textures in one frame, the rest waits for the next [px]."""
MAX_TEXTURES = 96
"""Textures kept."""
MAX_GAPS = 4096
"""Tiles remembered as ones that the reader does not have."""


class Reader(Protocol):
    """Where decoded tiles come from. Every method returns at once but `wait`."""

    refused: int
    """Tiles that were no picture, or too large a one."""

    def want(self, keys: Iterable[Key]) -> None:
        """Read these, in this order; what was wanted before and is not among them is dropped."""

    def take(self) -> tuple[Key, ImageData | None] | None:
        """A tile that is read, its pixels None when there is none to show; None while there is no such tile."""

    def wait(self) -> None:
        """Until what can be read now is read: for whoever draws a picture of a map and not for a screen."""

    def close(self) -> None:
        """Drop everything; nothing is read any more."""


class TilePictures(MapSource):
    """The pictures of one source. Rows count from the south, as mapview's do."""

    poll_period: ClassVar[float] = 0.0
    """How long it lets pass before it asks the reader again [s]; 0 for the next frame."""

    def __init__(
        self,
        reader: Reader,
        *,
        name: str,
        zooms: tuple[int, int],
        attribution: str = "",
        tile_size: int = 256,
        image_ext: str = "png",
        poll_period: float = 0.0,
    ) -> None:
        """`name` tells it from other sources; `zooms` are the first and the last level that there are."""
        self._reader = reader
        super().__init__(
            url="",
            cache_key=name,
            min_zoom=zooms[0],
            max_zoom=zooms[1],
            tile_size=tile_size,
            image_ext=image_ext,
            attribution=attribution,
        )
        self._textures: OrderedDict[Key, Texture] = OrderedDict()
        self._gaps: OrderedDict[Key, None] = OrderedDict()
        self._waiting: list[Any] = []
        self._closed = False
        self._next_frame = Clock.create_trigger(lambda _: self._serve(), poll_period)

    @property
    def reader(self) -> Reader:
        """Where its tiles come from."""
        return self._reader

    @property
    def complete(self) -> bool:
        """Something was looked at, and no tile in sight waits for its picture."""
        return bool(self._textures) and not self._waiting

    @property
    def refused(self) -> int:
        """Tiles that were no picture, or too large a one; they are shown as gaps."""
        return self._reader.refused

    def fill_tile(self, tile: Any) -> None:
        """Called by mapview for each tile in sight: hand over its picture now or in one of the next frames."""
        if tile.state == "done" or self._closed:
            return
        if self._fill(tile) is not None:
            self._waiting.append(tile)
            self._next_frame()

    def finish(self) -> None:
        """Wait until every tile in sight has its picture: for whoever draws a picture of a map and not for a screen."""
        while self._waiting:
            self._serve()
            self._reader.wait()

    def forget(self) -> None:
        """Let go of every texture and gap: what is looked at next is read anew."""
        self._textures.clear()
        self._gaps.clear()

    def close(self) -> None:
        """Let go of every tile that waits and of the reader; asked again, it fills nothing."""
        self._closed = True
        self._waiting.clear()
        self._next_frame.cancel()
        self._reader.close()

    def _serve(self) -> None:
        """Make textures of what was read, give them to the tiles that wait, and say which are still to be read."""
        self._take_in()
        asked = [(tile, self._fill(tile)) for tile in self._waiting if tile.state != "done"]
        self._waiting = [tile for tile, missing in asked if missing is not None]
        self._reader.want(dict.fromkeys(missing for _, missing in asked if missing is not None))
        if self._waiting:
            self._next_frame()

    def _take_in(self) -> None:
        count = pixels = 0
        while count < MAX_TILES_PER_FRAME and pixels < MAX_PIXELS_PER_FRAME:
            made = self._reader.take()
            if made is None:
                return
            key, data = made
            if data is None:
                _keep(self._gaps, key, None, MAX_GAPS)
                continue
            texture = Texture.create_from_data(data)
            if data.flip_vertical:
                texture.flip_vertical()
            _keep(self._textures, key, texture, MAX_TEXTURES)
            count, pixels = count + 1, pixels + data.width * data.height

    def _fill(self, tile: Any) -> Key | None:
        """Give a tile its picture, or the part of a coarser one that shows the same place; else say what is to be read."""
        key = tile.zoom, tile.tile_x, tile.tile_y
        while key in self._gaps and key[0] > self.min_zoom:
            key = _above(key)
        if key in self._gaps:
            tile.state = "done"
            return None
        if key in self._textures:
            self._put(tile, key)
            tile.state = "animated"
            return None
        self._stand_in(tile, key)
        return key

    def _stand_in(self, tile: Any, key: Key) -> None:
        """While its picture is on the way, show the place by the sharpest of the coarser ones that are here."""
        while key[0] > self.min_zoom and key not in self._textures:
            key = _above(key)
        if key in self._textures and key[0] > getattr(tile, "shown_zoom", -1):
            tile.shown_zoom = key[0]
            self._put(tile, key)

    def _put(self, tile: Any, key: Key) -> None:
        self._textures.move_to_end(key)
        texture = self._textures[key]
        for level in range(tile.zoom - key[0] - 1, -1, -1):
            texture = _quarter(texture, tile.tile_x >> level & 1, tile.tile_y >> level & 1)
        tile.texture, tile.g_color.a = texture, 1.0


def _above(key: Key) -> Key:
    """The tile one level up that shows the same place."""
    return key[0] - 1, key[1] // 2, key[2] // 2


def _quarter(texture: Texture, right: int, upper: int) -> Texture:
    """The left or right, lower or upper quarter of a tile."""
    wide, high = texture.width / 2, texture.height / 2
    return texture.get_region(right * wide, upper * high, wide, high)


def _keep(store: OrderedDict[Key, Any], key: Key, value: object, room: int) -> None:
    """Put the newest in; what was not used for longest makes room."""
    store[key] = value
    while len(store) > room:
        store.popitem(last=False)
