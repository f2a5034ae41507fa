"""Patterns that tile: the leaves of trees, and the web of light that a ripply surface throws into the water."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

__all__ = ["LEAVES_SIZE", "leaves", "web"]

LEAVES_SIZE = 256
"""Edge of the picture of leaves [px]."""

_LEAVES = 430
_LENGTH, _WIDTH = 34.0, 15.0
"""Of a leaf [px]."""
_CELLS = 42
"""Of the web."""


@lru_cache(maxsize=1)
def leaves() -> bytes:
    """Four bytes a pixel: how light the leaf there is, twice the same, and how far it lies in front, 0 where there is none."""
    rng = np.random.default_rng(7)
    picture = Image.new("LA", (LEAVES_SIZE, LEAVES_SIZE), (40, 0))
    draw = ImageDraw.Draw(picture)
    for number in range(_LEAVES):
        front = number / _LEAVES
        x, y = (rng.random(2) * LEAVES_SIZE).tolist()
        _leaf(draw, x, y, float(rng.random()) * math.tau, 60 + 110 * front + 60 * rng.random(), front)
    grey, alpha = picture.split()
    return Image.merge("RGBA", (grey, grey, grey, alpha)).tobytes()


def _leaf(draw: ImageDraw.ImageDraw, x: float, y: float, turn: float, light: float, front: float) -> None:
    """A pointed leaf with one half in the light; what reaches over an edge comes in at the other."""
    cosine, sine = math.cos(turn), math.sin(turn)

    def outline(side: float) -> list[tuple[float, float]]:
        points = []
        for part in np.linspace(0.0, 1.0, 7).tolist():
            along, across = (part - 0.5) * _LENGTH, side * math.sin(math.pi * part**0.8) * _WIDTH / 2
            points.append((along * cosine - across * sine, along * sine + across * cosine))
        return points

    depth = round(40 + 215 * front)
    for dx in (-LEAVES_SIZE, 0, LEAVES_SIZE):
        for dy in (-LEAVES_SIZE, 0, LEAVES_SIZE):
            if -_LENGTH < x + dx < LEAVES_SIZE + _LENGTH and -_LENGTH < y + dy < LEAVES_SIZE + _LENGTH:
                for side, shade in ((-1.0, light * 0.82), (1.0, light)):
                    half = [(px + x + dx, py + y + dy) for px, py in outline(side)]
                    draw.polygon(half, fill=(round(min(shade, 255.0)), depth))


def web() -> NDArray[np.floating[Any]]:
    """256 x 256 of 0 to 1: bright lines between dark cells, the same every time."""
    rng = np.random.default_rng(11)
    points = rng.random((_CELLS, 2)) * 256
    y, x = np.mgrid[0:256, 0:256].astype(np.float32)
    x, y = x + 6 * np.sin(y * (math.tau / 64)), y + 6 * np.sin(x * (math.tau / 64))
    first = np.full((256, 256), np.inf, dtype=np.float32)
    second = first.copy()
    for px, py in points.tolist():
        dx, dy = (
            np.abs(np.remainder(x - px + 128, 256) - 128),
            np.abs(np.remainder(y - py + 128, 256) - 128),
        )
        away = np.hypot(dx, dy)
        second = np.minimum(second, np.maximum(first, away))
        first = np.minimum(first, away)
    return np.asarray(np.exp(-(second - first) / 5.0))
