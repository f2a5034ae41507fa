"""What is passed on as it came: only what reading and writing it again would not change."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec import Raw

from bridge.codec import from_json, to_json, unread
from bridge.core.errors import ProtocolError
from bridge.msgs import TYPES, geometry_msgs, nav_msgs, sensor_msgs, std_msgs
from bridge.server.flow.outgoing_messages import Form, OutgoingMessage
from tests.bridge.strategies import messages


def text_of(msg):
    return Raw(to_json(msg))


CLASSES = sorted(set(TYPES.values()), key=lambda kind: kind.MSGTYPE)


@given(st.sampled_from(CLASSES).flatmap(messages))
def test_what_we_write_ourselves_is_passed_on_as_it_is(msg):
    found = unread(text_of(msg), type(msg))
    if found is not None:  # numbers above 2**63 are for the codec's own reader
        assert found.text == to_json(msg) == to_json(found.read())


@pytest.mark.parametrize("kind", [nav_msgs.Odometry, sensor_msgs.LaserScan, sensor_msgs.CompressedImage])
def test_the_usual_ones_need_no_reading(kind):
    assert unread(text_of(kind()), kind) is not None


def test_null_among_numbers_is_what_it_would_be_again():
    scan = json.loads(to_json(sensor_msgs.LaserScan()))
    text = json.dumps({**scan, "ranges": [1.0, None, 2], "range_max": None}).encode()
    assert unread(Raw(text), sensor_msgs.LaserScan).text == text


@pytest.mark.parametrize(
    "text",
    [
        "{}",
        '{"data": 5}',
        '{"data": null}',
        '{"data": "a", "other": 1}',
        '{"data": "a", "data": 1}',
        '{"data": "\\ud800"}',
        '["a"]',
        "null",
        '{"data": "a"',
    ],
)
def test_what_lacks_something_or_has_too_much_must_be_read(text):
    assert unread(Raw(text.encode()), std_msgs.String) is None


def test_times_of_ros_2_must_be_read():
    header = {"stamp": {"sec": 1, "nanosec": 2}, "frame_id": "map"}
    assert unread(Raw(json.dumps(header).encode()), std_msgs.Header) is None
    header["stamp"] = {"secs": 1, "nsecs": 2}
    assert unread(Raw(json.dumps({**header, "seq": 3}).encode()), std_msgs.Header) is not None


HEADER = {"stamp": {"secs": 1, "nsecs": 2}, "frame_id": 'a "header":{'}


@pytest.mark.parametrize(
    ("kind", "text"),
    [
        (geometry_msgs.PointStamped, {"header": HEADER, "point": {"x": 1.0, "y": 2.0, "z": None}}),
        (
            nav_msgs.Path,
            {
                "header": HEADER,
                "poses": [{**json.loads(to_json(geometry_msgs.PoseStamped())), "header": HEADER}],
            },
        ),
    ],
)
def test_a_header_without_a_count_gets_one_and_needs_no_reading(kind, text):
    for spaces in (None, (",", ":")):
        raw = Raw(json.dumps(text, separators=spaces).encode())
        found = unread(raw, kind)
        assert found is not None
        assert json.loads(found.text) == json.loads(to_json(from_json(raw, kind)))


def test_headers_of_which_some_count_must_be_read():
    pose = json.loads(to_json(geometry_msgs.PoseStamped()))
    path = {"header": HEADER, "poses": [pose]}
    assert unread(Raw(json.dumps(path).encode()), nav_msgs.Path) is None
    assert unread(Raw(json.dumps(HEADER).encode()), std_msgs.Header) is None


@pytest.mark.parametrize(
    ("kind", "field", "value"),
    [
        (std_msgs.UInt8, "data", 256),
        (std_msgs.Int32, "data", 1.5),
        (std_msgs.Float64, "data", "1"),
        (std_msgs.Bool, "data", 1),
        (sensor_msgs.JointState, "name", [1]),
        (nav_msgs.OccupancyGrid, "data", [128]),
        (sensor_msgs.LaserScan, "ranges", [1.0, "2"]),
        (sensor_msgs.CompressedImage, "data", "&"),
    ],
)
def test_what_reading_refuses_is_not_passed_on(kind, field, value):
    whole = json.loads(to_json(kind()))
    raw = Raw(json.dumps({**whole, field: value}).encode())
    assert unread(raw, kind) is None
    with pytest.raises(ProtocolError):
        from_json(raw, kind)


def test_a_fixed_array_of_another_length_is_not_passed_on():
    odometry = json.loads(to_json(nav_msgs.Odometry()))
    odometry["pose"]["covariance"] = [0.0] * 35
    assert unread(Raw(json.dumps(odometry).encode()), nav_msgs.Odometry) is None


def test_a_form_that_the_text_does_not_have_is_made_of_what_it_says():
    raw = text_of(std_msgs.Header(stamp=std_msgs.Time(1, 2), frame_id="map"))
    message = OutgoingMessage("/h", unread(raw, std_msgs.Header))
    assert bytes(raw) in message.frame(Form("/h"))
    assert b'"sec":1,"nanosec":2' in message.frame(Form("/h", ros2=True))
    assert message.msg == std_msgs.Header(stamp=std_msgs.Time(1, 2), frame_id="map")
