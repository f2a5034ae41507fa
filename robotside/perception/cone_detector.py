"""The rule of colours for traffic cones in a camera picture: orange above and below white, tall and narrow."""

from __future__ import annotations

import io
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from bridge.core.camera_frames import picture_size
from bridge.core.errors import ProtocolError
from robotside.mapping.connected_components import boxes
from robotside.perception.sighting import Sighting

__all__ = ["cones_in", "find_cones"]

SEARCH_WIDTH = 320
"""Columns of the picture that is searched; larger ones are made smaller first."""

MIN_PIXELS = 12
"""Orange pixels of the searched picture that make a thing."""

MIN_PATCH = 3
"""Orange pixels that hang together and are fewer than this are noise."""

MAX_GAP = 0.6
"""Most between the two orange parts of a cone, as a part of their height together."""

MAX_BLUE, MAX_GREEN = 9, 14
"""Of a cone's red, in twentieths: skin in warm light has more blue, a yellow jacket more green."""

MIN_BAND = 0.25
"""Least part of the white band of a cone that is near."""

MIN_NARROWING = 0.65
"""Least of what is surely a cone: the jackets of people are as broad at the shoulders as at the hips, and a face as at its chin."""

UNSURE_SCORE = 0.55
"""The most for what shows no white band or does not narrow upward: a jacket, a face or a fruit far away does neither."""

Mask = NDArray[np.bool_]
Pixels = NDArray[np.int16]
Box = tuple[slice, slice]


def find_cones(jpeg: bytes) -> list[Sighting]:
    """The cones in a picture, best first; a picture that cannot be read shows none."""
    try:
        picture_size(jpeg)
        with Image.open(io.BytesIO(jpeg), formats=("JPEG",)) as image:
            image.draft("RGB", (SEARCH_WIDTH, SEARCH_WIDTH))
            rgb = np.asarray(image.convert("RGB"))
    except (ProtocolError, UnidentifiedImageError, OSError, ValueError):
        return []
    return cones_in(rgb)


def cones_in(rgb: NDArray[np.uint8]) -> list[Sighting]:
    """The cones in a picture of red, green and blue, best first."""
    step = max(1, round(rgb.shape[1] / SEARCH_WIDTH))
    return _search(rgb[::step, ::step].astype(np.int16))


def _search(rgb: Pixels) -> list[Sighting]:
    red, green, blue = rgb[..., 0], rgb[..., 1], rgb[..., 2]
    orange = (red > 90) & (red - green > 45) & (green - blue > 8) & (red - blue > 75) & (green * 20 > red * 5)
    orange &= (blue * 20 < red * MAX_BLUE) & (green * 20 < red * MAX_GREEN)
    if np.count_nonzero(orange) < MIN_PIXELS:
        return []
    low = np.minimum(np.minimum(red, green), blue)
    high = np.maximum(np.maximum(red, green), blue)
    pale = (low > 100) & (high - low < 45)
    found = []
    for box in _groups(orange):
        sighting = _judge(orange[box], pale[box], box, rgb.shape)
        if sighting is not None:
            found.append(sighting)
    return sorted(found, key=lambda sighting: -sighting.score)


def _groups(orange: Mask) -> Iterator[Box]:
    """The boxes round orange things; what stands above another across a gap, as above a white band, is one with it."""
    whole: list[Box] = []
    for box in boxes(orange):
        if np.count_nonzero(orange[box]) < MIN_PATCH:
            continue
        above = next((number for number, other in enumerate(whole) if _stands_on(other, box)), None)
        if above is None:
            whole.append(box)
        else:
            whole[above] = (_both(whole[above][0], box[0]), _both(whole[above][1], box[1]))
    yield from whole


def _both(a: slice, b: slice) -> slice:
    return slice(min(a.start, b.start), max(a.stop, b.stop))


def _stands_on(upper: Box, lower: Box) -> bool:
    """The two are parts of one narrow thing: one above the other, not far, and in line."""
    (up, across), (down, below) = upper, lower
    gap = down.start - up.stop
    tall = (up.stop - up.start) + (down.stop - down.start)
    aside = abs((across.start + across.stop) - (below.start + below.stop)) / 2
    wide = max(across.stop - across.start, below.stop - below.start)
    return bool(-2 <= gap <= MAX_GAP * tall and aside <= 0.35 * wide)


def _judge(orange: Mask, pale: Mask, box: Box, shape: tuple[int, ...]) -> Sighting | None:
    """The sighting that a group of orange pixels stands for; None when it does not look like a cone."""
    rows, columns = orange.shape
    count = int(np.count_nonzero(orange))
    if count < MIN_PIXELS or rows < 6 or not 0.9 <= rows / columns <= 5.0:
        return None
    white = _white_between(orange, pale)
    narrowing = _narrowing(orange)
    if white < MIN_BAND and rows > 14:
        return None
    score = min(1.0, 0.35 + 0.4 * min(white, 1.0) + 0.25 * narrowing)
    if white < MIN_BAND or narrowing < MIN_NARROWING:
        score = min(score, UNSURE_SCORE)
    top, left = box[0].start, box[1].start
    return Sighting(
        left / shape[1], top / shape[0], (left + columns) / shape[1], (top + rows) / shape[0], score
    )


def _white_between(orange: Mask, pale: Mask) -> float:
    """Part of the expected white band that is there: pale rows with orange above and below."""
    full = orange.sum(axis=1)
    band = (pale & ~orange).sum(axis=1)
    above = np.cumsum(full) > 0.1 * full.sum()
    below = np.cumsum(full[::-1])[::-1] > 0.1 * full.sum()
    middle = (band > full) & above & below
    return float(middle.sum() / (0.25 * len(full)))


def _narrowing(orange: Mask) -> float:
    """1 when the upper half is clearly narrower than the lower one, 0 when it is not."""
    widths = orange.sum(axis=1).astype(float)
    half = len(widths) // 2
    upper, lower = widths[:half].max(initial=0.0), widths[half:].max(initial=0.0)
    return float(np.clip(1.6 - 1.2 * upper / max(lower, 1.0), 0.0, 1.0))
