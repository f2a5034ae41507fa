"""The time of now, where a client leaves it to the server."""

from __future__ import annotations

import math

import pytest

from bridge.codec import from_json, from_json_now
from bridge.core.errors import ProtocolError
from bridge.msgs import TYPES
from bridge.msgs.geometry_msgs import PointStamped, PoseStamped
from bridge.msgs.nav_msgs import Path
from bridge.msgs.std_msgs import Header, String, Time


def read(text, cls):
    return from_json_now(text, cls, lambda: 12.5)


NOW = Time(12, 500_000_000)


@pytest.mark.parametrize("text", [b"{}", b'{"header":{}}', b'{"header":{"frame_id":"map"}}'])
def test_a_header_without_a_stamp_gets_that_of_now(text):
    assert read(text, PointStamped).header.stamp == NOW


@pytest.mark.parametrize(
    ("stamp", "seconds"),
    [('{"secs":0,"nsecs":0}', 0.0), ("{}", 0.0), ('{"secs":3}', 3.0), ('{"sec":3}', 3.0)],
)
def test_a_stamp_that_is_there_stays_even_if_it_is_zero(stamp, seconds):
    text = f'{{"header":{{"stamp":{stamp}}}}}'.encode()
    assert read(text, PointStamped).header.stamp.seconds == seconds


def test_now_is_a_time_wherever_one_is_wanted():
    text = b'{"header":{"stamp":"now"},"poses":[{"header":{"stamp":"now","frame_id":"now"}},{}]}'
    assert read(text, Path) == Path(Header(NOW), [PoseStamped(Header(NOW, "now")), PoseStamped()])
    assert read(b'{"data":"now"}', TYPES["std_msgs/Time"]).data == NOW


def test_now_is_a_text_where_that_is_wanted():
    assert read(b'{"data":"now"}', String).data == "now"


def test_what_is_wrong_beside_it_is_named():
    with pytest.raises(ProtocolError, match=r'point\.x must be a number or null, not "now"'):
        read(b'{"header":{"stamp":"now"},"point":{"x":"now"}}', PointStamped)
    with pytest.raises(ProtocolError, match="is not JSON"):
        read(b'{"header":{"stamp":"now"}', PointStamped)
    with pytest.raises(ProtocolError, match="must be an object"):
        read(b'["now"]', PointStamped)


def test_a_robot_without_a_clock_stamps_nothing():
    text = b'{"header":{"frame_id":"map"},"point":{"x":1.0}}'
    assert from_json_now(text, PointStamped, lambda: math.nan) == from_json(text, PointStamped)
    asked = from_json_now(b'{"data":"now"}', TYPES["std_msgs/Time"], lambda: math.nan)
    assert asked.data == Time()
