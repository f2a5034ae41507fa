"""What an MBTiles file says about itself; no map is drawn here, and nothing of mapview is imported."""

from __future__ import annotations

import math
import sqlite3
from contextlib import closing
from pathlib import Path

from widgets.core.language import tr

__all__ = ["box_of", "metadata", "zooms_of"]

WORLD = (-180.0, -85.0, 180.0, 85.0)
MAX_ZOOM = 24
FORMATS = ("png", "jpg", "jpeg", "webp")


def metadata(path: Path) -> dict[str, str]:
    """What the file says about itself; ValueError, in one sentence, for one that cannot be shown."""
    try:
        with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as file:
            about = {
                str(name): str(value) for name, value in file.execute("SELECT name, value FROM metadata")
            }
    except sqlite3.Error as cause:
        raise ValueError(
            tr("{path} cannot be read as an MBTiles file ({cause}).").format(path=path, cause=cause)
        ) from cause
    missing = {"format", "minzoom", "maxzoom"} - about.keys()
    if missing:
        raise ValueError(
            tr("{path} does not say its {missing}.").format(path=path, missing=", ".join(sorted(missing)))
        )
    if about["format"] not in FORMATS:
        raise ValueError(
            tr("{path} holds {format:.20} tiles; only png, jpg and webp can be shown.").format(
                path=path, format=about["format"]
            )
        )
    return about


def zooms_of(path: Path, about: dict[str, str]) -> tuple[int, int]:
    """Its first and its last zoom level; ValueError for what is none."""
    try:
        least, most = int(about["minzoom"]), int(about["maxzoom"])
    except ValueError:
        least, most = 1, 0
    if not 0 <= least <= most <= MAX_ZOOM:
        raise ValueError(
            tr(
                "{path} says that it has the zoom levels {least:.20} to {most:.20}; 0 to {limit} can be shown."
            ).format(path=path, least=about["minzoom"], most=about["maxzoom"], limit=MAX_ZOOM)
        )
    return least, most


def box_of(path: Path, about: dict[str, str]) -> tuple[float, float, float, float]:
    """West, south, east and north of what it covers [deg]; ValueError for what is none."""
    if "bounds" not in about:
        return WORLD
    try:
        west, south, east, north = (float(part) for part in about["bounds"].split(","))
    except ValueError:
        west = south = east = north = math.nan
    if not (-180 <= west <= 180 and -180 <= east <= 180 and -90 <= south <= north <= 90):
        raise ValueError(
            tr("{path} says that it reaches to {about:.60}, which are no four angles.").format(
                path=path, about=about["bounds"]
            )
        )
    return west, south, east, north
