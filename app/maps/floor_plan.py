"""A floor plan as ROS's map_server keeps it: a YAML file with resolution, origin and thresholds, and a picture beside it."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.checked_settings import number, shown
from app.maps.placed_picture import MAX_TEXTURE_SIDE, PlacedPicture
from bridge.core.camera_frames import MAX_PIXELS, picture_size
from bridge.core.errors import ProtocolError
from widgets.core.language import tr

__all__ = ["picture_of", "read_floor_plan"]

MAX_TEXT = 65_536
"""Of the YAML file [bytes]."""
MAX_PICTURE_BYTES = 64_000_000
MAX_PATH = 255
"""Of the picture's name [letter]."""
FREE, WALL = (232, 234, 238, 255), (64, 70, 80, 255)
"""How floor and walls look; what is unknown is let through."""
FREE_BELOW, WALL_ABOVE = 0.196, 0.65
"""map_server's own thresholds where the file has none."""


def read_floor_plan(path: Path) -> PlacedPicture:
    """ValueError, in one sentence, for one that cannot be shown."""
    about = _about(path)
    values = _values(path, about)
    grey = _grey(picture_of(path, about))
    shade = grey / 255.0 if values["negate"] else 1.0 - grey / 255.0
    pixels = np.zeros((*shade.shape, 4), np.uint8)
    pixels[shade < values["free_thresh"]] = FREE
    pixels[shade > values["occupied_thresh"]] = WALL
    step = -(-max(shade.shape) // MAX_TEXTURE_SIDE)
    if step > 1:
        pixels = _smaller(pixels, step)
    x, y, yaw = _origin(path, about)
    ahead = values["resolution"] * complex(math.cos(yaw), math.sin(yaw))
    high, wide = shade.shape
    at = [
        complex(x, y) + ahead * complex(column, row)
        for column, row in ((0, 0), (wide, 0), (wide, high), (0, high))
    ]
    lower_left, lower_right, upper_right, upper_left = ((place.real, place.imag) for place in at)
    return PlacedPicture(
        pixels.shape[1], pixels.shape[0], pixels.tobytes(),
        (lower_left, lower_right, upper_right, upper_left), on_earth=False,
    )  # fmt: skip


def _smaller(pixels: NDArray[np.uint8], step: int) -> NDArray[np.uint8]:
    """Every so many pixels one, walls first: none of them may vanish."""
    down, across = (min(step, side) for side in pixels.shape[:2])  # a plan may be long and narrow
    high, wide = -(-pixels.shape[0] // down) * down, -(-pixels.shape[1] // across) * across
    padded = np.zeros((high, wide, 4), np.uint8)
    padded[: pixels.shape[0], : pixels.shape[1]] = pixels
    cells = padded.reshape(high // down, down, wide // across, across, 4)
    wall = (cells == WALL).all(axis=-1).any(axis=(1, 3))
    fewer = cells[:, 0, :, 0].copy()
    fewer[wall] = WALL
    return fewer


def picture_of(path: Path, about: Mapping[str, Any] | None = None) -> Path:
    """The picture that the YAML file names; ValueError where it names none.

    It lies beside the file or below: of a path that leads elsewhere the name alone counts, so that no file shows another's.
    """
    name = (about or _about(path)).get("image")
    if not isinstance(name, str) or not name:
        raise ValueError(tr("{file} does not name its picture (image:).").format(file=path.name))
    if len(name) > MAX_PATH or "\0" in name:
        raise ValueError(tr("{file} does not name its picture (image:).").format(file=path.name))
    folder = Path(os.path.normpath(path.parent.absolute()))
    found = Path(os.path.normpath(folder / name))
    beside = folder / found.name  # of one that was copied here together with its picture
    return found if found.is_relative_to(folder) and (found.is_file() or not beside.is_file()) else beside


def _about(path: Path) -> Mapping[str, Any]:
    from ruamel.yaml import YAML
    from ruamel.yaml.error import YAMLError

    try:
        with path.open("rb") as file:
            raw = file.read(MAX_TEXT + 1)
        text = raw.decode()
        about = YAML(typ="safe", pure=True).load(text) if len(raw) <= MAX_TEXT else None
    except (OSError, ValueError, RecursionError, YAMLError) as fault:
        raise ValueError(
            tr("{file} cannot be read as a floor plan ({fault}).").format(
                file=path.name, fault=str(fault).splitlines()[0][:120] if str(fault) else type(fault).__name__
            )
        ) from fault
    if not isinstance(about, Mapping):
        raise ValueError(  # noqa: TRY004 - what a file holds is a value
            tr("{file} is no floor plan: it has no resolution, origin and image.").format(file=path.name)
        )
    return about


def _values(path: Path, about: Mapping[str, Any]) -> dict[str, float]:
    usual = {"resolution": None, "negate": 0, "free_thresh": FREE_BELOW, "occupied_thresh": WALL_ABOVE}
    limits = {
        "resolution": (0.001, 100.0),
        "negate": (0, 1),
        "free_thresh": (0.0, 1.0),
        "occupied_thresh": (0.0, 1.0),
    }
    found: dict[str, float] = {}
    for name, (least, most) in limits.items():
        raw = about.get(name, usual[name])
        value = number(int(raw) if isinstance(raw, bool) else raw, least, most)
        if value is None:
            raise ValueError(
                tr("{file} has {name} {value}; {least} to {most} are allowed.").format(
                    file=path.name, name=name, value=shown(raw), least=least, most=most
                )
            )
        found[name] = value
    return found


def _origin(path: Path, about: Mapping[str, Any]) -> tuple[float, float, float]:
    raw = about.get("origin")
    parts = [number(part, -1e6, 1e6) for part in raw] if isinstance(raw, list) else []
    if len(parts) not in (2, 3) or any(part is None for part in parts):
        raise ValueError(
            tr("{file} has the origin {value}, which is not x, y and yaw.").format(
                file=path.name, value=shown(raw)
            )
        )
    x, y, yaw = (*(part or 0.0 for part in parts), 0.0)[:3]
    return x, y, yaw


def _grey(path: Path) -> NDArray[np.float64]:
    """Brightness of each pixel, rows from the top, 0 to 255; NaN-free."""
    try:
        if not path.is_file() or path.stat().st_size > MAX_PICTURE_BYTES:
            raise OSError(tr("no file of at most {size} MB").format(size=MAX_PICTURE_BYTES // 1_000_000))
        data = path.read_bytes()
    except OSError as fault:
        raise ValueError(
            tr("The floor plan's picture {file} cannot be read ({fault}).").format(
                file=path.name, fault=fault.strerror or fault
            )
        ) from fault
    try:
        return _pgm(data) if data[:2] in (b"P5", b"P2") else _decoded(data)
    except (ValueError, ProtocolError, IndexError) as fault:
        raise ValueError(
            tr(
                "The floor plan's picture {file} is no PGM, PNG or JPEG picture that can be shown ({fault})."
            ).format(file=path.name, fault=str(fault)[:120])
        ) from fault


def _pgm(data: bytes) -> NDArray[np.float64]:
    """Netpbm's grey pictures, in bytes or in words."""
    fields, at = list[int](), 2
    while len(fields) < 3:
        if data[at : at + 1] == b"#":
            at = data.index(b"\n", at)
        elif data[at : at + 1].isspace():
            at += 1
        else:
            end = at
            while data[end : end + 1].isdigit():
                end += 1
            fields.append(int(data[at:end][:9]))
            at = end
    wide, high, most = fields
    if not (0 < wide * high <= MAX_PIXELS and 0 < most < 65536):
        raise ValueError(f"{wide} x {high} pixels")
    if data[:2] == b"P2":
        levels = np.fromstring(data[at:], np.float64, wide * high, sep=" ")  # no object for each number
    else:
        kind = np.dtype(np.uint8) if most < 256 else np.dtype(">u2")
        levels = np.frombuffer(data, kind, wide * high, at + 1).astype(np.float64)
    return levels.reshape(high, wide) * (255.0 / most)


def _decoded(data: bytes) -> NDArray[np.float64]:
    from widgets.map.tiles.tile_reader import pixels_of

    kind, wide, high = picture_size(data)
    if wide * high > MAX_PIXELS:
        raise ValueError(f"{wide} x {high} pixels")
    picture = pixels_of(data, "jpg" if kind == "jpeg" else "png")
    channels = len(picture.fmt)
    rows = (
        np.frombuffer(picture.data, np.uint8)
        .reshape(high, -1)[:, : wide * channels]
        .reshape(high, wide, channels)
    )
    grey: NDArray[np.float64] = rows[:, :, : min(channels, 3)].mean(axis=2)
    return grey
