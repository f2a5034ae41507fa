"""Which tile is asked for next, and when again after a failure: plain arithmetic on a clock that is given."""

from __future__ import annotations

from collections.abc import Iterable

from widgets.map.tiles.tile_reader import Key

__all__ = ["FIRST_PAUSE", "GREATEST_PAUSE", "TileQueue"]

FIRST_PAUSE, GREATEST_PAUSE = 2.0, 120.0
"""How long a server, or a tile, is left alone after a failure [s]: at first, then twice as long each time, and at most."""
MAX_FAILED, MAX_OLD = 4096, 256
"""Tiles of which it is remembered that they failed, and that are there but old."""


class TileQueue:
    """Not for several threads at once."""

    def __init__(self) -> None:
        self._wanted: list[Key] = []
        self._old: list[Key] = []
        self._asked: set[Key] = set()
        self._failed: dict[Key, tuple[int, float]] = {}
        self._streak = 0
        self._rests_until = 0.0

    def want(self, tiles: Iterable[Key]) -> None:
        """These, in this order; what was wanted before and is not among them is not asked for any more."""
        self._wanted = [tile for tile in tiles if tile not in self._asked]

    def refresh(self, tile: Key) -> None:
        """It is shown, but old: ask for it once, after what is missing."""
        if tile not in self._old and tile not in self._asked and len(self._old) < MAX_OLD:
            self._old.append(tile)

    def next(self, now: float) -> Key | None:
        """A tile to be asked for now, which then counts as asked; None while there is none, or the server rests."""
        if now < self._rests_until or (self._streak and self._asked):
            return None  # a server that failed is tried by one tile
        for tiles in (self._wanted, self._old):
            for tile in tiles:
                if now >= self._failed.get(tile, (0, 0.0))[1]:
                    tiles.remove(tile)
                    self._asked.add(tile)
                    return tile
        return None

    def answered(self, tile: Key) -> None:
        """The server answered."""
        self._asked.discard(tile)
        self._failed.pop(tile, None)
        self._streak = 0

    def failed(self, tile: Key, now: float, pause: float = 0.0) -> None:
        """No tile came; the server asks for a `pause` [s], 0 where it did not say."""
        self._asked.discard(tile)
        tries = self._failed.pop(tile, (0, 0.0))[0] + 1
        self._failed[tile] = tries, now + _pause(tries)
        while len(self._failed) > MAX_FAILED:
            del self._failed[next(iter(self._failed))]
        self._streak += 1
        # one bad tile is no bad server: the first failure lets the others go on
        rest = pause or (0.0 if self._streak == 1 else _pause(self._streak - 1))
        self._rests_until = max(self._rests_until, now + rest)

    @property
    def troubled(self) -> bool:
        """The last that was heard of the server were two failures or more in a row."""
        return self._streak > 1

    def retry(self) -> None:
        """Try at once again, as after a change of the address."""
        self._failed.clear()
        self._streak, self._rests_until = 0, 0.0


def _pause(tries: int) -> float:
    return float(min(FIRST_PAUSE * 2.0 ** min(tries - 1, 16), GREATEST_PAUSE))
