"""Less of a message, for a subscriber who asked for less: fewer beams, a smaller picture, a coarser map."""

from __future__ import annotations

import math
import re

import msgspec
import numpy as np
from numpy.typing import NDArray

from bridge.core.errors import BridgeError
from bridge.msgs import Msg
from bridge.msgs.arrays import Float32Array, Int8Array
from bridge.msgs.nav_msgs import OccupancyGrid
from bridge.msgs.sensor_msgs import CompressedImage, Image, LaserScan
from bridge.protocol import Reduction
from robotside.gateways.scaling.picture_scaling import DEFAULT_QUALITY, smaller

__all__ = ["reduce"]

_ABOUT = 1e-3
"""Part by which a map's cell may be smaller than was asked: 0.1 m is not written exactly."""

_COLOURS = {"mono": 1, "rgb": 3, "bgr": 3, "rgba": 4, "bgra": 4}
_NAMED = re.compile(rf"({'|'.join(_COLOURS)})(8|16)")
_COUNTED = re.compile(r"(8|16|32|64)[USF]C([1-4])")
"""Encodings of a picture that is not compressed, as ROS names them: by colours or by channels, with their bits."""


def reduce(msg: Msg, wanted: Reduction) -> Msg:
    """`msg` with as much as is `wanted`; itself where nothing of it can be made less. `fields` is not looked at.

    Never finer, wider or better than it was. What contradicts itself (a map of fewer cells than its size says, a
    broken picture) is left as it is.
    """
    if isinstance(msg, LaserScan) and wanted.beams is not None:
        return _fewer_beams(msg, wanted.beams)
    if isinstance(msg, CompressedImage) and (wanted.width is not None or wanted.quality is not None):
        return _smaller_picture(msg, wanted)
    if isinstance(msg, Image) and wanted.width is not None:
        return _fewer_pixels(msg, max(1, wanted.width))
    if isinstance(msg, OccupancyGrid) and wanted.resolution is not None:
        return _coarser_map(msg, wanted.resolution)
    return msg


def _fewer_beams(scan: LaserScan, beams: int) -> LaserScan:
    """The nearest of each group of neighbours, in the direction of the group's middle."""
    count = len(scan.ranges)
    group = math.ceil(count / max(1, beams))
    if group <= 1:
        return scan
    groups = math.ceil(count / group)
    ranges = np.full(groups * group, np.nan, dtype=np.float32)
    ranges[:count] = scan.ranges
    # many lasers write 0 where nothing came back; -inf is something too near to be measured, and stays
    ranges[(ranges > -math.inf) & (ranges < scan.range_min)] = np.nan
    rows = ranges.reshape(groups, group)
    nearest = np.where(np.isnan(rows), np.inf, rows).argmin(axis=1) + np.arange(groups) * group
    kept = ranges[nearest]
    none = np.isnan(rows).all(axis=1)
    kept[~none & np.isnan(kept)] = np.inf  # beside a beam that saw nothing, one that failed does not count
    first = scan.angle_min + scan.angle_increment * (group - 1) / 2
    increment = scan.angle_increment * group
    return msgspec.structs.replace(
        scan,
        angle_min=first,
        angle_max=first + increment * (groups - 1),
        angle_increment=increment,
        time_increment=scan.time_increment * group,
        ranges=Float32Array(kept.tobytes()),
        intensities=_of_the_same(scan.intensities, nearest, count),
    )


def _of_the_same(intensities: Float32Array, nearest: NDArray[np.intp], count: int) -> Float32Array:
    if len(intensities) != count:
        return Float32Array()
    kept = np.asarray(intensities, dtype=np.float32)[np.minimum(nearest, count - 1)]
    return Float32Array(kept.tobytes())


def _smaller_picture(image: CompressedImage, wanted: Reduction) -> CompressedImage:
    quality = DEFAULT_QUALITY if wanted.quality is None else min(95, max(1, wanted.quality))
    width = None if wanted.width is None else max(1, wanted.width)
    try:
        data = smaller(image.data, width, quality)
    except BridgeError:
        return image
    return msgspec.structs.replace(image, data=data) if len(data) < len(image.data) else image


def _fewer_pixels(image: Image, columns: int) -> Image:
    """Some of the pixels as they are: between two depths there may be nothing."""
    size, length = _pixel(image.encoding), image.step * image.height
    whole = 0 < image.width * size <= image.step and 0 < length <= len(image.data)
    if not whole or columns >= image.width:
        return image
    rows = max(1, round(image.height * columns / image.width))
    lines = np.frombuffer(image.data, np.uint8, length).reshape(image.height, image.step)
    pixels = lines[:, : image.width * size].reshape(image.height, image.width, size)
    kept = pixels[np.ix_(_spread(rows, image.height), _spread(columns, image.width))]
    return msgspec.structs.replace(
        image, height=rows, width=columns, step=columns * size, data=kept.tobytes()
    )


def _spread(count: int, among: int) -> NDArray[np.intp]:
    """`count` of the first `among` numbers, evenly."""
    return np.asarray((2 * np.arange(count) + 1) * among // (2 * count), dtype=np.intp)


def _pixel(encoding: str) -> int:
    """Bytes of one pixel; 0 where pixels do not stand alone or the encoding is not known."""
    if named := _NAMED.fullmatch(encoding):
        return _COLOURS[named[1]] * int(named[2]) // 8
    if counted := _COUNTED.fullmatch(encoding):
        return int(counted[1]) * int(counted[2]) // 8
    return 0


def _coarser_map(grid: OccupancyGrid, resolution: float) -> OccupancyGrid:
    """The most occupied of each square of cells; unknown only where all of it is."""
    info = grid.info
    if not (info.resolution > 0 and math.isfinite(resolution)) or len(grid.data) != info.width * info.height:
        return grid
    factor = min(math.ceil(resolution / info.resolution - _ABOUT), max(info.width, info.height))
    if factor <= 1:
        return grid
    cells = np.asarray(grid.data, dtype=np.int8).reshape(info.height, info.width)
    padded = np.pad(cells, ((0, -info.height % factor), (0, -info.width % factor)), constant_values=-1)
    rows, columns = padded.shape[0] // factor, padded.shape[1] // factor
    most = padded.reshape(rows, factor, columns, factor).max(axis=(1, 3))
    size = msgspec.structs.replace(info, resolution=info.resolution * factor, width=columns, height=rows)
    return msgspec.structs.replace(grid, info=size, data=Int8Array(most.tobytes()))
