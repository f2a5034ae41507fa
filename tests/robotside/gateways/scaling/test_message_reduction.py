"""Less of a message for who asked for less."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.msgs.arrays import Float32Array, Int8Array
from bridge.msgs.geometry_msgs import Point, Pose
from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid
from bridge.msgs.sensor_msgs import CompressedImage, Image, Imu, LaserScan
from bridge.msgs.std_msgs import Header, Time
from bridge.protocol import Reduction
from robotside.gateways.scaling.message_reduction import reduce
from tests.robotside.gateways.scaling.test_picture_scaling import PHOTO, size

HEADER = Header(Time.at(12.5), "laser")


def scan(*ranges: float, intensities: tuple[float, ...] = ()) -> LaserScan:
    last = -1.0 + 0.1 * (len(ranges) - 1)
    return LaserScan(
        HEADER, -1.0, last, 0.1, 0.01, 0.1, 0.1, 10.0, Float32Array(ranges), Float32Array(intensities)
    )


def test_of_beams_that_fall_together_the_nearest_is_kept_where_they_looked() -> None:
    less = reduce(scan(3, 2, 5, 4, 9, 8, intensities=(1, 2, 3, 4, 5, 6)), Reduction(beams=3))
    assert isinstance(less, LaserScan)
    assert list(less.ranges) == [2, 4, 8]
    assert list(less.intensities) == [2, 4, 6]
    assert less.angle_min == pytest.approx(-0.95)
    assert less.angle_increment == pytest.approx(0.2)
    assert less.angle_max == pytest.approx(-0.55)
    assert less.time_increment == pytest.approx(0.02)
    assert (less.header, less.range_min, less.range_max, less.scan_time) == (HEADER, 0.1, 10.0, 0.1)


@pytest.mark.parametrize(
    ("ranges", "kept"),
    [
        ((math.nan, 4.0), 4.0),
        ((math.inf, 4.0), 4.0),
        ((math.inf, math.nan), math.inf),
        ((math.nan, math.inf), math.inf),
        ((math.nan, math.nan), math.nan),
        ((-math.inf, 4.0), -math.inf),
        ((0.0, 4.0), 4.0),
    ],
)
def test_what_is_no_distance_gives_way_to_what_is(ranges: tuple[float, ...], kept: float) -> None:
    less = reduce(scan(*ranges), Reduction(beams=1))
    assert isinstance(less, LaserScan)
    assert list(less.ranges) == [pytest.approx(kept, nan_ok=True)]


@given(st.lists(st.floats(0.125, 10, width=32), min_size=1, max_size=200), st.integers(1, 250))
def test_never_more_beams_than_asked_and_no_obstacle_is_lost(ranges: list[float], beams: int) -> None:
    full = scan(*ranges)
    less = reduce(full, Reduction(beams=beams))
    assert isinstance(less, LaserScan)
    assert len(less.ranges) <= beams
    assert min(less.ranges) == min(full.ranges)
    near = int(np.argmin(full.ranges))
    seen = full.angle_min + near * full.angle_increment
    kept = less.angle_min + int(np.argmin(less.ranges)) * less.angle_increment
    assert abs(seen - kept) <= less.angle_increment / 2 + 1e-9


@pytest.mark.parametrize("beams", [4, 5, 1000])
def test_a_scan_of_as_few_beams_stays_the_same(beams: int) -> None:
    full = scan(1, 2, 3, 4)
    assert reduce(full, Reduction(beams=beams)) is full


def test_a_scan_without_beams_stays_as_it_is() -> None:
    assert reduce(scan(), Reduction(beams=1)) == scan()


def grid(*rows: tuple[int, ...], resolution: float = 0.1) -> OccupancyGrid:
    info = MapMetaData(Time(), resolution, len(rows[0]), len(rows), Pose(Point(-3.0, -2.0)))
    return OccupancyGrid(Header(frame_id="map"), info, Int8Array([cell for row in rows for cell in row]))


def test_of_cells_that_fall_together_the_most_occupied_is_kept_and_unknown_only_where_all_is() -> None:
    full = grid((0, 0, -1, -1, 7), (0, 100, -1, 0, 8), (-1, -1, 1, 2, -1))
    less = reduce(full, Reduction(resolution=0.2))
    assert isinstance(less, OccupancyGrid)
    assert (less.info.width, less.info.height, less.info.resolution) == (3, 2, 0.2)
    assert list(less.data) == [100, 0, 8, -1, 2, -1]
    assert (less.info.origin, less.header) == (full.info.origin, full.header)


@pytest.mark.parametrize(("resolution", "columns"), [(0.1, 5), (0.05, 5), (0.15, 3), (0.3, 2), (99.0, 1)])
def test_a_cell_is_at_least_as_large_as_asked(resolution: float, columns: int) -> None:
    less = reduce(grid((0,) * 5, (0,) * 5), Reduction(resolution=resolution))
    assert isinstance(less, OccupancyGrid)
    assert less.info.width == columns


def test_a_map_that_contradicts_itself_is_left_as_it_is() -> None:
    bad = OccupancyGrid(info=MapMetaData(resolution=0.1, width=3, height=3), data=Int8Array([0]))
    assert reduce(bad, Reduction(resolution=1.0)) is bad
    without = OccupancyGrid(info=MapMetaData(width=1, height=1), data=Int8Array([0]))
    assert reduce(without, Reduction(resolution=1.0)) is without


def test_a_picture_is_made_smaller_and_keeps_its_stamp() -> None:
    full = CompressedImage(HEADER, "jpeg", PHOTO)
    less = reduce(full, Reduction(width=100, quality=500))
    assert isinstance(less, CompressedImage)
    assert (size(less.data), less.header) == ((100, 75), HEADER)
    coarse = reduce(full, Reduction(quality=0))
    assert isinstance(coarse, CompressedImage)
    assert len(coarse.data) < len(PHOTO) / 2


def test_a_picture_that_cannot_be_read_or_would_not_get_smaller_stays() -> None:
    broken = CompressedImage(data=b"no picture")
    assert reduce(broken, Reduction(width=10)) is broken
    full = CompressedImage(data=PHOTO)
    assert reduce(full, Reduction(quality=95)) is full


def test_what_is_asked_of_another_kind_of_message_changes_nothing() -> None:
    imu, full = Imu(), scan(1, 2, 3)
    assert reduce(imu, Reduction(beams=1, width=1, quality=1, resolution=1.0)) is imu
    assert reduce(full, Reduction(width=1, resolution=1.0)) is full


def picture(encoding: str, width: int, height: int, size: int, spare: int = 0) -> Image:
    """Each byte of a pixel says where it is: 16 times its row, plus its column."""
    pixel = [bytes([16 * y + x]) * size for y in range(height) for x in range(width)]
    lines = [b"".join(pixel[y * width : (y + 1) * width]) + bytes(spare) for y in range(height)]
    return Image(HEADER, height, width, encoding, False, width * size + spare, b"".join(lines))


@pytest.mark.parametrize(
    ("encoding", "size"), [("mono8", 1), ("bgr8", 3), ("rgba8", 4), ("mono16", 2), ("32FC1", 4), ("16UC3", 6)]
)
def test_a_picture_that_is_not_compressed_keeps_some_of_its_pixels(encoding: str, size: int) -> None:
    less = reduce(picture(encoding, 8, 4, size, spare=5), Reduction(width=4))
    assert isinstance(less, Image)
    assert (less.width, less.height, less.step, less.encoding) == (4, 2, 4 * size, encoding)
    assert less.data == b"".join(
        bytes([place]) * size for place in (0x11, 0x13, 0x15, 0x17, 0x31, 0x33, 0x35, 0x37)
    )
    assert less.header == HEADER


@pytest.mark.parametrize(
    ("image", "width"),
    [
        (picture("mono8", 8, 4, 1), 8),
        (picture("mono8", 8, 4, 1), 100),
        (picture("bayer_rggb8", 8, 4, 1), 4),
        (picture("bgr8", 8, 4, 1), 4),
        (Image(HEADER, 4, 8, "mono8", False, 8, bytes(31)), 4),
        (Image(HEADER, 0, 8, "mono8", False, 8, b""), 4),
        (Image(HEADER, 0, 0, "mono8", False, 0, b""), 4),
    ],
)
def test_a_picture_that_has_no_pixels_to_spare_stays_as_it_is(image: Image, width: int) -> None:
    assert reduce(image, Reduction(width=width)) is image
