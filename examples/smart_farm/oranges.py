"""Places of oranges in a picture: what is orange and round, and as far away as an orange of known size looks large."""

from __future__ import annotations

import io
import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from robotside.mapping.connected_components import boxes

__all__ = ["RADIUS", "Point", "oranges"]

RADIUS = 0.035
"""Of an orange [m]."""
MIN_PIXELS = 80
"""A patch with fewer is too far away to tell how far."""
ROUND = 1.2
"""A patch whose farthest pixel is this many times as far from its middle as a disc's would be is no whole orange."""
EDGE = 1.0
"""So much of its radius is lost where a pixel is part orange and part leaf [px]."""

Point = tuple[float, float, float]
"""In `base_link` [m]."""


def oranges(jpeg: bytes, field_of_view: float, camera: Point) -> Iterator[Point]:
    """Middle of each orange in a picture of a level camera that looks ahead; `field_of_view` across the picture [rad].

    One that is hidden in part, or cut off by the edge of the picture, is left out.
    """
    with Image.open(io.BytesIO(jpeg), formats=("JPEG",)) as image:
        rgb = np.asarray(image.convert("RGB")).astype(np.int16)
    mask = _is_orange(rgb)
    high, wide = mask.shape
    focus = wide / 2 / math.tan(field_of_view / 2)
    left = (wide / 2 - 0.5 - np.arange(wide)) / focus
    up = (high / 2 - 0.5 - np.arange(high)) / focus
    for rows, columns in boxes(mask):
        if not (rows.start and columns.start and rows.stop < high and columns.stop < wide):
            continue
        found = mask[rows, columns]
        if np.count_nonzero(found) < MIN_PIXELS:
            continue
        y, z = np.meshgrid(left[columns], up[rows])
        rays = np.stack([np.ones_like(y), y, z], axis=-1)[found]
        seen = _ball(rays, focus)
        if seen is not None:
            yield tuple(float(at + way) for at, way in zip(camera, seen, strict=True))  # type: ignore[misc]


def _ball(rays: NDArray[np.float64], focus: float) -> NDArray[np.float64] | None:
    """From the camera to the middle of an orange that covers these pixels; None when they are no disc."""
    lengths = np.linalg.norm(rays, axis=1)
    angles = lengths**-3 / focus**2  # solid angle of each pixel: exact at the edge of the picture too
    middle = (rays / lengths[:, None] * angles[:, None]).sum(axis=0)
    middle /= np.linalg.norm(middle)
    opening = math.acos(1 - angles.sum() / math.tau)
    farthest = math.acos(min(1.0, float((rays @ middle / lengths).min())))
    if farthest > ROUND * opening + 1.5 / focus:
        return None
    way: NDArray[np.float64] = middle * (RADIUS / math.sin(opening + EDGE / focus))
    return way


def _is_orange(rgb: NDArray[np.int16]) -> NDArray[np.bool_]:
    red, green, blue = rgb[..., 0], rgb[..., 1], rgb[..., 2]
    mask: NDArray[np.bool_] = (
        (red > 80) & (100 * green < 64 * red) & (100 * green > 35 * red) & (3 * blue < red)
    )
    return mask
