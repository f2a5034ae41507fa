"""A GeoTIFF file: its picture, read by Pillow, and its place on earth, read from its GeoKeys.

Supported are WGS 84 (EPSG:4326), Web Mercator (EPSG:3857) and UTM on WGS 84 or ETRS89 (EPSG:326xx, 327xx, 258xx); all others are
refused by name, for a map at the wrong place is worse than none.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Sequence
from numbers import Real
from pathlib import Path
from typing import Any

from app.maps.placed_picture import MAX_TEXTURE_SIDE, PlacedPicture
from widgets.core.language import tr

__all__ = ["read_geotiff", "utm_to_geographic"]

MAX_PIXELS = 80_000_000
"""Of a file that is decoded: 320 MB in memory for a moment."""
SCALE, TIEPOINT, MATRIX, KEYS, NO_DATA = 33550, 33922, 34264, 34735, 42113
"""Tags of the file."""
MODEL_TYPE, RASTER_TYPE, GEOGRAPHIC, PROJECTED = 1024, 1025, 2048, 3072
"""GeoKeys."""
A, F = 6378137.0, 1 / 298.257223563
"""Semi-major axis [m] and flattening of WGS 84."""
MODES = ("1", "L", "LA", "P", "RGB", "RGBA", "CMYK", "YCbCr")
"""Kinds of pixels that are pictures as they are; others are measurements."""

Place = tuple[float, float]


def read_geotiff(path: Path) -> PlacedPicture:
    """The whole file, made smaller where it is larger than a texture; ValueError, in one sentence, for one that cannot be shown."""
    try:
        from PIL import Image
    except ImportError:
        raise ValueError(
            tr("GeoTIFF files need Pillow, which this app was built without; MBTiles files are shown.")
        ) from None
    try:
        with Image.open(path, formats=["TIFF"]) as image:
            _check(image, path)
            corners = _corners(image, path)
            image.draft("RGB", (MAX_TEXTURE_SIDE, MAX_TEXTURE_SIDE))
            picture = _transparent(image)
    except (OSError, SyntaxError, ArithmeticError, Image.DecompressionBombError, struct.error) as fault:
        raise ValueError(
            tr("{file} cannot be read as a GeoTIFF file ({fault}).").format(
                file=path.name, fault=str(fault)[:120]
            )
        ) from fault
    if max(picture.size) > MAX_TEXTURE_SIDE:
        picture.thumbnail((MAX_TEXTURE_SIDE, MAX_TEXTURE_SIDE))
    return PlacedPicture(picture.width, picture.height, picture.tobytes(), corners)


def _check(image: Any, path: Path) -> None:
    if image.width * image.height > MAX_PIXELS:
        raise ValueError(
            tr(
                "{file} has {count} million pixels; at most {most} are read. Make tiles of it (MBTiles)."
            ).format(
                file=path.name, count=image.width * image.height // 1_000_000, most=MAX_PIXELS // 1_000_000
            )
        )
    if image.mode not in MODES:
        raise ValueError(
            tr("{file} holds measurements ({mode}), not a picture of 8 bits a colour.").format(
                file=path.name, mode=image.mode
            )
        )


def _transparent(image: Any) -> Any:
    """RGBA, with what the file says is no data let through."""
    nothing = str(image.tag_v2.get(NO_DATA, "")).strip("\0 ")
    picture = image.convert("RGBA")
    if nothing.isdecimal() and len(nothing) <= 3 and image.mode in ("L", "RGB"):
        from PIL import Image, ImageChops

        level, seen = int(nothing), Image.new("L", image.size, 0)
        for band in image.split():
            seen = ImageChops.lighter(seen, band.point(lambda value: 0 if value == level else 255))
        picture.putalpha(seen)
    return picture


def _corners(image: Any, path: Path) -> tuple[Place, Place, Place, Place]:
    tags = image.tag_v2
    keys = _keys(_numbers(tags, KEYS, path) or ())
    to_earth = _projection(keys, path)
    place = _placing(tags, path, half=0.5 if keys.get(RASTER_TYPE) == 2 else 0.0)
    wide, high = image.size
    found = tuple(to_earth(*place(x, y)) for x, y in ((0, high), (wide, high), (wide, 0), (0, 0)))
    for latitude, longitude in found:
        if not (abs(latitude) < 90 and abs(longitude) <= 360):
            raise ValueError(tr("{file} lies nowhere on earth by its own words.").format(file=path.name))
    return found  # type: ignore[return-value]


def _numbers(tags: Any, tag: int, path: Path) -> Sequence[Any] | None:
    """What the file says there; None where it does not. Pillow gives one value alone as a number, and text as text."""
    found = tags.get(tag)
    if found is None:
        return None
    if not isinstance(found, tuple) or not all(isinstance(one, Real) for one in found):
        raise ValueError(tr("{file} does not say where on earth it lies.").format(file=path.name))
    return found


def _keys(directory: Sequence[int]) -> dict[int, int]:
    """The GeoKeys that are plain numbers."""
    rows = [directory[at : at + 4] for at in range(4, len(directory), 4)]
    return {row[0]: row[3] for row in rows if len(row) == 4 and row[1] == 0}


def _placing(tags: Any, path: Path, half: float) -> Callable[[float, float], Place]:
    """From column and row of the picture's corners to the file's own coordinates."""
    matrix, scale, tie = (_numbers(tags, tag, path) for tag in (MATRIX, SCALE, TIEPOINT))
    if matrix is not None and len(matrix) == 16:
        a, b, _, c, d, e, _, f = matrix[:8]
    elif scale is not None and tie is not None and len(scale) >= 2 and len(tie) == 6:
        a, b, d, e = scale[0], 0.0, 0.0, -scale[1]
        c, f = tie[3] - a * tie[0], tie[4] - e * tie[1]
    else:
        raise ValueError(tr("{file} does not say where on earth it lies.").format(file=path.name))
    if not all(map(math.isfinite, (a, b, c, d, e, f))) or a * e - b * d == 0:
        raise ValueError(tr("{file} does not say where on earth it lies.").format(file=path.name))
    return lambda x, y: (a * (x - half) + b * (y - half) + c, d * (x - half) + e * (y - half) + f)


def _projection(keys: dict[int, int], path: Path) -> Callable[[float, float], Place]:
    """From the file's own coordinates to latitude and longitude [deg]."""
    code = keys.get(PROJECTED if keys.get(MODEL_TYPE) == 1 else GEOGRAPHIC, 0)
    if code == 4326:
        return lambda x, y: (y, x)
    if code == 3857:
        return lambda x, y: (math.degrees(math.atan(math.sinh(y / A))), math.degrees(x / A))
    for first, last, south in ((32601, 32660, False), (32701, 32760, True), (25828, 25838, False)):
        if first <= code <= last:
            zone = code % 100
            return lambda x, y: utm_to_geographic(x, y, zone, south=south)
    raise ValueError(
        tr("{file} lies in EPSG:{code}; 4326, 3857 and UTM (326xx, 327xx, 258xx) are known. gdalwarp -t_srs EPSG:3857 changes it.").format(
            file=path.name, code=code or "?"
        )
    )  # fmt: skip


def utm_to_geographic(easting: float, northing: float, zone: int, *, south: bool = False) -> Place:
    """Latitude and longitude [deg] of a place in UTM `zone` 1 to 60 [m], by Krüger's series: to a millimetre within the zone."""
    n = F / (2 - F)
    radius = 0.9996 * A / (1 + n) * (1 + n**2 / 4 + n**4 / 64)
    beta = (n / 2 - 2 * n**2 / 3 + 37 * n**3 / 96, n**2 / 48 + n**3 / 15, 17 * n**3 / 480)
    delta = (2 * n - 2 * n**2 / 3 - 2 * n**3, 7 * n**2 / 3 - 8 * n**3 / 5, 56 * n**3 / 15)
    xi, eta = (northing - (10_000_000 if south else 0)) / radius, (easting - 500_000) / radius
    turns = [(beta[j] * 1.0, 2 * (j + 1)) for j in range(3)]
    xi_1 = xi - sum(b * math.sin(m * xi) * math.cosh(m * eta) for b, m in turns)
    eta_1 = eta - sum(b * math.cos(m * xi) * math.sinh(m * eta) for b, m in turns)
    chi = math.asin(math.sin(xi_1) / math.cosh(eta_1))
    latitude = chi + sum(delta[j] * math.sin(2 * (j + 1) * chi) for j in range(3))
    longitude = math.radians(6 * zone - 183) + math.atan2(math.sinh(eta_1), math.cos(xi_1))
    return math.degrees(latitude), math.degrees(longitude)
