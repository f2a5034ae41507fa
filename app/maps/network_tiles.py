"""Tiles of a server as the map wants them: from what is kept at once, from the network when it answers, in threads of its own.

reader = NetworkTiles(source_id, address, server, stores)
TilePictures(reader, name=source_id, zooms=(0, 19))
"""

from __future__ import annotations

import logging
import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Iterable
from typing import Protocol

from kivy.core.image import ImageData

from app.maps.tile_address import TileAddress
from app.maps.tile_queue import TileQueue
from app.maps.tile_server import MAX_CONNECTIONS, NoAnswer, Tile
from app.maps.tile_store import Stored
from widgets.map.tiles.tile_reader import MAX_AHEAD, Key, decoded

__all__ = ["Kept", "NetworkTiles", "Server"]

log = logging.getLogger(__name__)

MAX_ABSENT = 4096
"""Tiles remembered as ones that are not kept."""


class Server(Protocol):
    """Whom tiles are asked of."""

    def fetch(self, address: TileAddress, tile: Key, kept: Stored | None = None) -> Tile:
        """One tile; NoAnswer where none comes."""


class Kept(Protocol):
    """What is kept of a source, in any thread."""

    def get(self, tile: Key, now: float) -> Stored | None:
        """What is kept of that tile, however old; None for nothing."""

    def put(self, tile: Key, stored: Stored, now: float) -> None:
        """Keep it."""


class NetworkTiles:
    """A `widgets.map.tiles.tile_pictures.Reader`. Its threads start when there is work and end when there is none."""

    def __init__(
        self,
        address: TileAddress,
        server: Server,
        kept: Kept,
        *,
        now: Callable[[], float] = time.time,
        clock: Callable[[], float] = time.monotonic,
        decode: Callable[[object], ImageData] = decoded,
    ) -> None:
        """`server` and `kept` are others' to close; `now` is the clock by which tiles expire, `clock` that of pauses."""
        self._address, self._server, self._kept = address, server, kept
        self._now, self._clock, self._decode = now, clock, decode
        self._lock = threading.Lock()
        self._wanted: list[Key] = []
        self._absent: OrderedDict[Key, Stored | None] = OrderedDict()
        """Tiles that the network is asked for, with what is kept of them."""
        self._made: dict[Key, ImageData | None] = {}
        self._queue = TileQueue()
        self._threads: set[threading.Thread] = set()
        self._reads = self._closed = False
        self._asking = 0
        self.refused = 0
        self.trouble = ""
        """Why no new tiles come, in one sentence; empty while they do."""

    # for the UI thread

    def want(self, keys: Iterable[Key]) -> None:
        """Read these, in this order; what was wanted before and is not among them is dropped, read or not."""
        with self._lock:
            if self._closed:
                return
            wanted = dict.fromkeys(keys)
            self._made = {key: data for key, data in self._made.items() if key in wanted}
            left = [key for key in wanted if key not in self._made]
            self._wanted = [key for key in left if key not in self._absent]
            self._queue.want([key for key in left if key in self._absent])
            self._start()

    def take(self) -> tuple[Key, ImageData | None] | None:
        """A tile that was wanted and is here; its pixels are None where the server has no such tile."""
        with self._lock:
            key = next(iter(self._made), None)
            return None if key is None else (key, self._made.pop(key))

    def wait(self) -> None:
        """Until the threads have ended, which they do when nothing can be asked for now."""
        while threads := list(self._threads):
            for thread in threads:
                thread.join()

    def retry(self) -> None:
        """Ask the server at once again."""
        with self._lock:
            self._queue.retry()

    def close(self) -> None:
        """Drop everything. Nothing is waited for, which would hold up fingers: a thread ends with what it has in hand, which nobody gets."""
        with self._lock:
            self._closed = True
            self._wanted, self._made = [], {}
            self._queue.want(())

    # threads

    def _start(self) -> None:
        """As many threads as there is work for; called with the lock held."""
        if self._wanted and not self._reads and len(self._made) < MAX_AHEAD:
            self._reads = True
            self._begin(self._read, None)
        self._ask_on()

    def _ask_on(self) -> None:
        """With as many connections as are polite; called with the lock held."""
        while self._asking < MAX_CONNECTIONS and len(self._made) < MAX_AHEAD:
            key = self._queue.next(self._clock())
            if key is None:
                return
            self._asking += 1
            self._begin(self._ask, key)

    def _begin(self, work: Callable[[Key | None], None], first: Key | None) -> None:
        def run() -> None:
            try:
                work(first)
            finally:
                with self._lock:
                    self._threads.discard(thread)

        thread = threading.Thread(target=run, name="map tiles", daemon=True)
        self._threads.add(thread)
        thread.start()

    def _read(self, _: Key | None) -> None:
        """Hand over what is kept; what is not, or is too old, is for the network."""
        while True:
            with self._lock:
                self._reads = bool(self._wanted) and len(self._made) < MAX_AHEAD and not self._closed
                if not self._reads:
                    return
                key = self._wanted[0]
            now = self._now()
            stored = self._kept.get(key, now)
            picture = self._pixels(key, stored)
            fresh = stored is not None and now < stored.expires
            with self._lock:
                if key not in self._wanted:
                    continue
                self._wanted.remove(key)
                if picture is not None or (fresh and stored is not None and stored.data is None):
                    self._made[key] = picture
                elif stored is not None and stored.data is not None:
                    stored = None  # what is kept is no picture
                if not fresh or stored is None:
                    self._want_new(key, stored, shown=picture is not None)

    def _want_new(self, key: Key, stored: Stored | None, *, shown: bool) -> None:
        """It is not kept, or too old; called with the lock held."""
        self._absent[key] = stored
        while len(self._absent) > MAX_ABSENT:
            self._absent.popitem(last=False)
        if shown:  # the map has what it wants and does not ask again
            self._queue.refresh(key)
            self._ask_on()

    def _pixels(self, key: Key, stored: Stored | None) -> ImageData | None:
        if stored is None or stored.data is None:
            return None
        try:
            return self._decode(stored.data)
        except Exception as fault:  # noqa: BLE001 - decoders raise what they like at a damaged picture
            self._refuse(key, str(fault))
            return None

    def _ask(self, key: Key | None) -> None:
        """Ask for that tile, and for more while there are any."""
        while key is not None:
            with self._lock:
                stored = self._absent.get(key)
            try:
                answer = self._server.fetch(self._address, key, stored)
            except NoAnswer as none:
                self._note_failure(key, none)
            except Exception as fault:  # a thread that ends silently would leave its tile asked for ever
                log.exception("tile %s", key)
                self._note_failure(key, NoAnswer(type(fault).__name__))
            else:
                self._kept.put(key, answer.stored, self._now())
                self._note(key, answer)
            with self._lock:
                key = None
                if not self._closed and len(self._made) < MAX_AHEAD:
                    key = self._queue.next(self._clock())
                if key is None:
                    self._asking -= 1

    def _note(self, key: Key, answer: Tile) -> None:
        with self._lock:
            self._queue.answered(key)
            old = self._absent.pop(key, None)
            self.trouble = ""
            shown = old is not None and old.data is not None
            if not self._closed and not shown:
                self._made[key] = answer.picture

    def _note_failure(self, key: Key, none: NoAnswer) -> None:
        with self._lock:
            if self._closed:
                return
            self._queue.failed(key, self._clock(), none.pause)
            old = self._absent.get(key)
            if old is not None and old.data is not None:
                del self._absent[key]  # it is shown as it is, and asked for when it is looked at again
            if self._queue.troubled or none.pause:
                self.trouble = str(none)

    def _refuse(self, key: Key, why: str) -> None:
        self.refused += 1
        if self.refused == 1:
            log.warning("tile %d/%d/%d is not shown: %.200s", *key, why)
