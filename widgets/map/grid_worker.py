"""Makes an occupancy grid ready to be drawn, in a thread of its own; only textures are left to the UI thread."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from widgets.map.grid_cells import Piece, layout, piece

__all__ = ["GridWorker"]

CLOSE_TIMEOUT = 5.0
"""Longest time that closing waits for the piece at work [s]."""


class GridWorker:
    """Works on the newest grid only; the thread starts with one and ends when its last piece is made."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._cells: NDArray[np.int8] | None = None
        self._drawn: frozenset[bytes] = frozenset()
        self._wanted: deque[Piece] = deque()
        self._made: deque[Piece] = deque()
        self._thread: threading.Thread | None = None
        self._runs = False

    @property
    def busy(self) -> bool:
        """Pieces are still to be made or to be taken."""
        with self._lock:
            return bool(self._wanted or self._made)

    def want(self, cells: NDArray[np.int8], drawn: Collection[bytes] = ()) -> None:
        """Make this grid ready; what is left of the one before is dropped. Pieces with a digest of `drawn` come without pixels."""
        with self._lock:
            self._drawn = frozenset(drawn)
            self._cells, self._wanted = cells, deque(layout(cells.shape[1], cells.shape[0]))
            self._made.clear()
            if not self._runs and self._wanted:
                self._runs = True
                self._thread = threading.Thread(target=self._run, name="map grid", daemon=True)
                self._thread.start()

    def take(self) -> Piece | None:
        """A piece that is ready; None while there is none."""
        with self._lock:
            return self._made.popleft() if self._made else None

    def wait(self) -> None:
        """Until all is ready: for whoever draws a picture of a map and not for a screen."""
        if self._thread is not None:
            self._thread.join()

    def close(self) -> None:
        """Drop everything, and end the thread after the piece at work."""
        with self._lock:
            self._wanted.clear()
            self._made.clear()
        if self._thread is not None:
            self._thread.join(CLOSE_TIMEOUT)

    def _run(self) -> None:
        while True:
            with self._lock:
                self._runs = bool(self._wanted)
                if not self._runs or self._cells is None:
                    return
                cells, drawn, place = self._cells, self._drawn, self._wanted[0]
            made = piece(cells, place, drawn)
            with self._lock:
                if self._wanted and self._wanted[0] is place:
                    self._wanted.popleft()
                    self._made.append(made)
