"""The last picture of each robot that was seen, small: by it two robots of one name are told apart."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from app.link.camera_decoder import Picture

__all__ = ["LastPictures", "Thumb"]

MAX_ROBOTS = 20
"""So many are kept; the one that was seen longest ago makes room."""
TAKE_PERIOD = 3.0
"""A robot's is made anew after this [s]."""
MAX_WIDTH = 160
"""[px]"""
MAX_PIXELS = 160 * 160
"""Of one that is kept: a picture may be far higher than wide."""


class Thumb(NamedTuple):
    """A small picture."""

    width: int
    height: int
    rgba: bytes
    """Rows from the top, four bytes a pixel."""
    at: float
    """When it was taken [s], our clock."""


class LastPictures:
    """By address. Everything here happens in the UI thread."""

    def __init__(self, now: Callable[[], float]) -> None:
        """`now` is our clock [s]."""
        self._now = now
        self._kept: dict[str, Thumb] = {}

    def take(self, url: str, picture: Picture) -> None:
        """A picture of the robot at `url` is on the glass: keep it small, where the last one is old."""
        last, now = self._kept.get(url), self._now()
        if last is not None and now - last.at < TAKE_PERIOD:
            return
        if min(picture.width, picture.height) < 1 or len(picture.rgba) != 4 * picture.width * picture.height:
            return
        pixels = picture.width * picture.height
        step = max(1, math.ceil(picture.width / MAX_WIDTH), math.ceil(math.sqrt(pixels / MAX_PIXELS)))
        import numpy as np  # with the first picture, for a quick start

        whole = np.frombuffer(picture.rgba, np.uint8).reshape(picture.height, picture.width, 4)
        small = np.ascontiguousarray(whole[::step, ::step])
        self._kept.pop(url, None)
        self._kept[url] = Thumb(small.shape[1], small.shape[0], small.tobytes(), now)
        while len(self._kept) > MAX_ROBOTS:
            del self._kept[next(iter(self._kept))]

    def of(self, url: str) -> Thumb | None:
        """Of the robot at `url`; None where it was not seen since the app began."""
        return self._kept.get(url)
