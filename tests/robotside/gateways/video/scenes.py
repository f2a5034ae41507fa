"""Pictures that say in their colour which one they are, and film read back."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import Any, NamedTuple

from PIL import Image

from tests.lacking import package

__all__ = ["SHADES", "Seen", "numbered", "seen"]

SHADES = 16
"""Numbers from 0 to this less one are told apart."""


def numbered(number: int, width: int = 160, height: int = 120) -> bytes:
    """A grey picture, the brighter the larger `number` is."""
    file = io.BytesIO()
    Image.new("RGB", (width, height), (number * 17,) * 3).save(file, "JPEG", quality=90)
    return file.getvalue()


class Seen(NamedTuple):
    """A decoded picture."""

    number: int
    at: float
    """[s]"""
    size: tuple[int, int]


def seen(film: bytes) -> list[Seen]:
    """What a player sees of a file."""
    return [*_frames(film)]


def _frames(film: bytes) -> Iterator[Seen]:
    av: Any = package("av")
    with av.open(io.BytesIO(film)) as file:
        for frame in file.decode(video=0):
            number = round(frame.to_ndarray(format="gray").mean() / 17)
            yield Seen(number, float(frame.pts * frame.time_base), (frame.width, frame.height))
