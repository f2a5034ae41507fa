"""Pictures with a clock painted into them, that survives every codec, and how it is read back.

`python -m bench.support.painted` is a camera: it writes a picture to its standard output 30 times a second, each behind its length.
"""

from __future__ import annotations

import contextlib
import io
import sys
import time

import numpy as np
from numpy.typing import NDArray
from PIL import Image

__all__ = ["HEIGHT", "RATE", "WIDTH", "age", "paint", "read"]

WIDTH, HEIGHT = 640, 480
RATE = 30.0
"""[Hz]"""
QUALITY = 80
BITS = 32
TICKS = 10_000.0
"""Of the painted clock in a second."""
_CELL = 40
"""Side of a bit's square [px]: two rows of sixteen."""


def _scenery() -> NDArray[np.uint8]:
    """Slopes and some noise, as a camera has."""
    x, y = np.meshgrid(np.linspace(0, 200, WIDTH), np.linspace(0, 200, HEIGHT))
    rough = np.random.default_rng(1).normal(0, 6, (HEIGHT, WIDTH))
    return np.stack([x + rough, y + rough, 128 + rough], axis=2).clip(0, 255).astype(np.uint8)


_TWICE = np.concatenate([_scenery()] * 2, axis=1)


def paint(number: int) -> bytes:
    """Picture `number` of a scenery that moves, as a JPEG file that says when it was begun."""
    picture = _scene(number)
    ticks = _now()
    bits = np.array([ticks >> place & 1 for place in range(BITS)], np.uint8).reshape(2, -1) * 255
    picture[: 2 * _CELL] = bits.repeat(_CELL, axis=0).repeat(_CELL, axis=1)[:, :, None]
    file = io.BytesIO()
    Image.fromarray(picture).save(file, "JPEG", quality=QUALITY)
    return file.getvalue()


def _scene(number: int) -> NDArray[np.uint8]:
    at = 3 * number % WIDTH
    return _TWICE[:, at : at + WIDTH].copy()


def age(picture: NDArray[np.uint8]) -> float:
    """How old a decoded grey picture is [s]."""
    return ((_now() - read(picture)) & 0xFFFF_FFFF) / TICKS


def read(picture: NDArray[np.uint8]) -> int:
    """The painted clock."""
    side = picture.shape[1] * _CELL // WIDTH
    bits = picture[side // 2 : 2 * side : side, side // 2 :: side].reshape(-1) > 127
    return sum(1 << place for place, bit in enumerate(bits) if bit)


def _now() -> int:
    return int(time.monotonic() * TICKS) & 0xFFFF_FFFF


def main() -> None:
    """Film until nobody reads."""
    number, due = 0, time.monotonic()
    with contextlib.suppress(BrokenPipeError):
        while True:
            due = max(due + 1 / RATE, time.monotonic())
            time.sleep(max(0.0, due - time.monotonic()))
            number += 1
            picture = paint(number)
            sys.stdout.buffer.write(len(picture).to_bytes(4, "big") + picture)
            sys.stdout.buffer.flush()


if __name__ == "__main__":
    main()
