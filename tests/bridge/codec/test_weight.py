"""About how much memory a message takes."""

from __future__ import annotations

import pytest

from bridge.codec import weight
from bridge.msgs.arrays import Float32Array, Int8Array
from bridge.msgs.geometry_msgs import PoseStamped, Twist
from bridge.msgs.nav_msgs import OccupancyGrid, Path
from bridge.msgs.sensor_msgs import CompressedImage, LaserScan
from bridge.msgs.std_msgs import Bool, Header, String


@pytest.mark.parametrize(
    ("small", "large", "bytes"),
    [
        (String(""), String("x" * 5000), 5000),
        (CompressedImage(), CompressedImage(data=bytes(7000)), 7000),
        (LaserScan(), LaserScan(ranges=Float32Array([0.0] * 1000)), 4000),
        (OccupancyGrid(), OccupancyGrid(data=Int8Array(bytes(9000))), 9000),
        (Path(), Path(header=Header(frame_id="x" * 300)), 300),
    ],
)
def test_what_grows_counts(small, large, bytes):
    assert weight(large) - weight(small) == bytes


def test_each_message_of_a_list_counts_with_what_it_holds():
    empty, one, two = (weight(Path(poses=[PoseStamped()] * count)) for count in (0, 1, 2))
    assert two - one == one - empty > weight(PoseStamped())


def test_a_message_of_numbers_takes_as_much_whatever_they_are():
    assert weight(Twist()) == weight(Twist.planar(0.5, 1.0)) > weight(Bool(True)) > 0
