"""The count of messages in a header: ROS 1 has it in text and bytes alike, ROS 2 in neither."""

from __future__ import annotations

import json
from typing import ClassVar

import pytest

from bridge.codec import from_cbor, from_json, to_cbor, to_json, to_server_json
from bridge.codec.fields import ros_fields
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseStamped, Twist
from bridge.msgs.nav_msgs import Path
from bridge.msgs.std_msgs import Header, Time

TEXT = 'a,"seq":0} of a text'
PATH = Path(Header(Time(1, 2), TEXT), [PoseStamped(Header(Time(3, 4), "map", seq=7))])


class Counted(Msg, frozen=True, gc=False):
    """A message with a field of the same name of its own."""

    MSGTYPE: ClassVar[str] = "test_msgs/Counted"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "std_msgs/Header[]", "uint32")
    header: Header = Header()
    others: list[Header] = []
    seq: int = 0


def headers(obj):
    return obj["header"], obj["poses"][0]["header"]


@pytest.mark.parametrize(
    "written", [lambda msg: json.loads(to_json(msg)), lambda msg: from_cbor(to_cbor(msg))]
)
def test_in_ros_1_every_header_has_a_count(written):
    first, second = headers(written(PATH))
    assert (first["seq"], first["frame_id"], second["seq"]) == (0, TEXT, 7)


@pytest.mark.parametrize(
    "written",
    [
        lambda msg: json.loads(to_json(msg, ros2=True)),
        lambda msg: from_cbor(to_cbor(msg, ros2=True)),
        lambda msg: json.loads(to_server_json(msg)),
        lambda msg: json.loads(to_server_json(msg, ros2=True)),
    ],
)
def test_in_ros_2_and_for_other_makers_servers_none_has(written):
    first, second = headers(written(PATH))
    assert first.keys() == second.keys() == {"stamp", "frame_id"}
    assert first["frame_id"] == TEXT


def test_the_count_of_a_client_is_read():
    assert from_json(b'{"header":{"seq":9}}', PoseStamped).header == Header(seq=9)


def test_a_field_of_the_same_name_stays():
    msg = Counted(Header(seq=1), [Header(seq=2)], 3)
    found = json.loads(to_json(msg, ros2=True))
    assert found["seq"] == 3
    assert "seq" not in found["header"]
    assert "seq" not in found["others"][0]
    assert json.loads(to_json(msg))["others"][0]["seq"] == 2


def test_a_message_without_a_header_is_left_alone():
    assert to_server_json(Twist()) == to_json(Twist())


def test_the_count_is_the_first_field_of_ros_1():
    assert [field.key for field in ros_fields(Header, False)] == ["seq", "stamp", "frame_id"]
    assert [field.key for field in ros_fields(Header, True)] == ["stamp", "frame_id"]
