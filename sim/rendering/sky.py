"""The sky, once round: a clear day with thin clouds over two chains of hills, painted once and hung on a dome."""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from sim.core.shapes import Colour

__all__ = ["HORIZON", "SIZE", "ZENITH", "dome", "grain", "panorama", "seen"]

ZENITH: Colour = (0.33, 0.58, 0.86)
HORIZON: Colour = (0.84, 0.91, 0.96)
SIZE = (2048, 384)
"""Of the panorama [px]: all round, and from the horizon to the zenith."""

_HALF_WAY = 0.35
"""Rise (tangent of the elevation) at half the height of the panorama: its lower part has most of the pixels."""
_SECTORS, _RINGS = 48, 24

Grey = NDArray[np.floating[Any]]


def panorama() -> bytes:
    """Four bytes a pixel, row by row from the horizon up; column 0 is west, going on to the south."""
    return zlib.decompress(_painted())


@lru_cache(maxsize=1)
def _painted() -> bytes:
    """The same, compressed to a twentieth, to be kept while no camera needs it."""
    picture = _column(lambda rise: _between(HORIZON, ZENITH, 1 - math.exp(-2.6 * rise)))
    picture.paste(_rgb((0.97, 0.98, 0.99)), mask=_clouds())
    for hills in (_FAR, _NEAR):
        picture.paste(_column(hills.colour), mask=hills.mask())
    return zlib.compress(picture.convert("RGBA").tobytes(), 1)


def dome() -> tuple[bytes, bytes]:
    """Corners of the dome, float32 direction (3) and place in the panorama (2) each, and three indices (int32) a triangle.

    The triangles go round twice, so that any part of the round lies in one piece, see `seen`.
    """
    turns = np.linspace(0, 1, _SECTORS + 1)
    levels = np.concatenate(([-0.05], np.linspace(0, 0.97, _RINGS)))
    corners = [_corner(float(turn), float(level)) for turn in turns for level in levels]
    order: list[int] = []
    for right in range(0, _SECTORS * len(levels), len(levels)):
        for a in range(right, right + _RINGS):
            b, c, d = a + len(levels), a + len(levels) + 1, a + 1
            order += [a, b, c, a, c, d]
    return np.array(corners, dtype=np.float32).tobytes(), np.array(order * 2, dtype=np.int32).tobytes()


def seen(yaw: float, half: float) -> tuple[int, int]:
    """First index and number of indices of the dome's triangles that lie at most `half` [rad] beside `yaw` [rad]."""
    sector = math.tau / _SECTORS
    first = math.floor((yaw - half + math.pi) / sector)
    count = min(math.floor((yaw + half + math.pi) / sector) - first + 1, _SECTORS)
    each = 6 * _RINGS
    return first % _SECTORS * each, count * each


def grain() -> Grey:
    """A pattern of 256 x 256 that tiles: soft blotches with fine grain round 0.5, the same every time."""
    rng = np.random.default_rng(20)
    white = rng.standard_normal((256, 256))
    fy, fx = np.meshgrid(np.fft.fftfreq(256) * 256, np.fft.fftfreq(256) * 256, indexing="ij")
    soft = np.fft.ifft2(np.fft.fft2(white) / np.maximum(np.hypot(fx, fy), 2.0) ** 1.1).real
    return np.asarray(np.clip(0.5 + 0.165 * soft / soft.std(), 0, 1))


def _corner(turn: float, level: float) -> tuple[float, ...]:
    rise, angle = _rise(level), (turn - 0.5) * math.tau
    length = math.hypot(1.0, rise)
    return (math.cos(angle) / length, math.sin(angle) / length, rise / length, turn, level)


def _between(low: Colour, high: Colour, part: float) -> Colour:
    part = min(part, 1.0)
    red, green, blue = (a + (b - a) * part for a, b in zip(low, high, strict=True))
    return red, green, blue


def _rgb(colour: Colour) -> tuple[int, int, int]:
    red, green, blue = (round(part * 255) for part in colour)
    return red, green, blue


def _column(colour_at: Callable[[float], Colour]) -> Image.Image:
    """A picture whose colour depends on the rise alone."""
    column = Image.new("RGB", (1, SIZE[1]))
    column.putdata([_rgb(colour_at(_rise((row + 0.5) / SIZE[1]))) for row in range(SIZE[1])])
    return column.resize(SIZE, Image.Resampling.NEAREST)


def _rise(level: float) -> float:
    return _HALF_WAY * level / (1 - level)


@dataclass(frozen=True)
class _Hills:
    """A chain of hills: straight slopes between peaks of different height, once round."""

    height: float
    """Rise of the lowest peak."""
    spread: float
    """Rise of the highest over the lowest."""
    peaks: int
    foot: Colour
    top: Colour

    def colour(self, rise: float) -> Colour:
        return _between(self.foot, self.top, rise / (self.height + self.spread))

    def mask(self) -> Image.Image:
        """Mask of the pixels in which they hide the sky."""
        width, height = SIZE[0] * 2, SIZE[1] * 2  # twice as large, for smooth edges
        heights = np.random.default_rng(self.peaks).random(self.peaks)
        tops = [self.height + self.spread * float(top) for top in (*heights, heights[0])]
        outline = [(i * width / self.peaks, top / (top + _HALF_WAY) * height) for i, top in enumerate(tops)]
        mask = Image.new("L", (width, height), 0)
        ImageDraw.Draw(mask).polygon([(0, 0), *outline, (width, 0)], fill=255)
        return mask.resize(SIZE, Image.Resampling.BOX)


_FAR = _Hills(0.045, 0.10, 19, (0.52, 0.62, 0.62), (0.40, 0.53, 0.45))
_NEAR = _Hills(0.020, 0.075, 29, (0.38, 0.50, 0.33), (0.30, 0.44, 0.29))


def _clouds() -> Image.Image:
    """Density of the clouds: the pattern seen from below, farther away towards the horizon."""
    width, height = SIZE[0] // 4, SIZE[1] // 2
    angle = ((np.arange(width) + 0.5) / width - 0.5)[None, :] * math.tau
    level = ((np.arange(height) + 0.5) / height)[:, None]
    rise = _HALF_WAY * level / (1 - level)
    away, pattern = 0.045 / (rise + 0.12), grain()
    cover = _sample(pattern, np.cos(angle) * away, np.sin(angle) * away)
    fine = _sample(pattern, np.cos(angle) * away * 3.1, np.sin(angle) * away * 3.1)
    thick = np.clip((0.7 * cover + 0.3 * fine - 0.54) / 0.28, 0, 1) * np.clip((rise - 0.03) / 0.3, 0, 1)
    mask = Image.fromarray((thick * 0.75 * 255).astype(np.uint8))
    return mask.resize(SIZE, Image.Resampling.BICUBIC)


def _sample(pattern: Grey, u: Grey, v: Grey) -> Grey:
    """The tiling `pattern` at places where 1 is its whole breadth, smooth between its cells."""
    x, y = u * 256 % 256, v * 256 % 256
    column, row = x.astype(int), y.astype(int)
    right, down = x - column, y - row
    next_column, next_row = (column + 1) % 256, (row + 1) % 256
    upper = pattern[row % 256, column % 256] * (1 - right) + pattern[row % 256, next_column] * right
    lower = pattern[next_row, column % 256] * (1 - right) + pattern[next_row, next_column] * right
    return np.asarray(upper * (1 - down) + lower * down)
