"""Strict JSON: what is wrong is named, with what is allowed; nothing wrong becomes a message."""

from __future__ import annotations

import math

import pytest

from bridge.core.errors import ProtocolError
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import MoveArmRequest, SetMissionRequest, StartTaskRequest
from bridge.msgs.std_msgs import Header
from robotside.gateways.plain.strict_json import MAX_INPUT, decode, read_message
from tests.looped import looped


def test_missing_fields_have_their_defaults_and_null_is_an_unknown_number() -> None:
    read = read_message(decode(b'{"linear": {"x": 0.2, "y": null}}'), Twist)
    assert (read.linear.x, read.angular.z) == (0.2, 0.0)
    assert math.isnan(read.linear.y)


def test_an_empty_message_is_one_of_defaults() -> None:
    assert read_message(decode(b" "), StartTaskRequest).task == "patrol"


def test_times_may_have_the_names_of_either_ros() -> None:
    for text in (b'{"stamp": {"secs": 5, "nsecs": 7}}', b'{"stamp": {"sec": 5, "nanosec": 7}}'):
        assert read_message(decode(text), Header).stamp.seconds == pytest.approx(5.000000007)


WRONG = {
    b'{"linear": {"x": "0.2"}}': "linear.x must be a number or null",
    b'{"linear": {"x": true}}': "linear.x must be a number or null",
    b'{"linear": {"w": 1}}': 'has no field "linear.w"',
    b'{"liner": {"x": 1}}': "did you mean linear",
    b'{"linear": [1, 2, 3]}': "linear must be an object",
    b'{"linear": {"x": NaN}}': "not JSON",
    b'{"linear": {"x": 1e999}}': "not JSON",
    b"[1]": "must be an object",
    b"drive": "not JSON",
    b"\xff\xfe": "not JSON",
    b'{"a": ' * 5000: "not JSON",
}


@looped("text", WRONG)
def test_what_is_wrong_is_named(text: bytes) -> None:
    with pytest.raises(ProtocolError) as error:
        read_message(decode(text), Twist)
    assert WRONG[text] in str(error.value), text


def test_a_wrong_field_is_found_in_lists_and_parts() -> None:
    with pytest.raises(ProtocolError, match=r"mission\.waypoints\[1\]\.z"):
        read_message(decode(b'{"mission": {"waypoints": [{"x": 1}, {"z": 1}]}}'), SetMissionRequest)
    with pytest.raises(ProtocolError, match=r"order\.joints"):
        read_message(decode(b'{"order": {"joints": [1]}}'), MoveArmRequest)
    with pytest.raises(ProtocolError, match="angles"):
        read_message(decode(b'{"order": {"angles": ["1"]}}'), MoveArmRequest)


def test_a_message_that_is_too_long_is_not_read() -> None:
    with pytest.raises(ProtocolError, match=f"at most {MAX_INPUT} bytes"):
        decode(b" " * (MAX_INPUT + 1))
