"""Times in the names of ROS 2."""

from __future__ import annotations

from typing import ClassVar

import msgspec
import pytest

from bridge.codec import from_builtins, from_cbor, from_json, to_cbor, to_json
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseStamped, Twist
from bridge.msgs.nav_msgs import Path
from bridge.msgs.std_msgs import Duration, Header, String, Time


class Rates(Msg, frozen=True, gc=False):
    """A message that has a field of such a name of its own."""

    MSGTYPE: ClassVar[str] = "test_msgs/Rates"
    secs: float = 1.5
    stamp: Time = Time(1, 2)
    others: list[Time] = []


PATH = Path(header=Header(Time(1, 2)), poses=[PoseStamped(Header(Time(3, 4)))])


def stamps(obj):
    return obj["header"]["stamp"], obj["poses"][0]["header"]["stamp"]


def test_in_json_every_time_of_a_message_is_renamed_however_deep():
    obj = msgspec.json.decode(to_json(PATH, ros2=True))
    assert stamps(obj) == ({"sec": 1, "nanosec": 2}, {"sec": 3, "nanosec": 4})


def test_in_cbor_too():
    obj = from_cbor(to_cbor({"op": "publish", "msg": PATH}, ros2=True))["msg"]
    assert stamps(obj) == ({"sec": 1, "nanosec": 2}, {"sec": 3, "nanosec": 4})


def test_without_being_asked_they_have_the_names_of_ros_1():
    assert stamps(msgspec.json.decode(to_json(PATH)))[0] == {"secs": 1, "nsecs": 2}
    assert stamps(from_cbor(to_cbor(PATH)))[0] == {"secs": 1, "nsecs": 2}


@pytest.mark.parametrize("moment", [Time(5, 7), Duration(5, 7)])
def test_a_time_alone_is_renamed(moment):
    assert to_json(moment, ros2=True) == b'{"sec":5,"nanosec":7}'
    assert from_cbor(to_cbor(moment, ros2=True)) == {"sec": 5, "nanosec": 7}


def test_both_names_are_understood():
    assert from_json(to_json(PATH, ros2=True), Path) == PATH
    assert from_builtins(from_cbor(to_cbor(PATH, ros2=True)), Path) == PATH


@pytest.mark.parametrize("text", ['"secs":', '{"secs":1}', '\\"nsecs":', "\\"])
def test_a_text_that_looks_like_a_time_stays_as_it_is(text):
    header = Header(Time(1, 2), text)
    obj = msgspec.json.decode(to_json(header, ros2=True))
    assert obj == {"stamp": {"sec": 1, "nanosec": 2}, "frame_id": text}


def test_a_field_of_such_a_name_that_is_no_time_stays_as_it_is():
    msg = Rates(others=[Time(3, 4)])
    expected = {"secs": 1.5, "stamp": {"sec": 1, "nanosec": 2}, "others": [{"sec": 3, "nanosec": 4}]}
    assert msgspec.json.decode(to_json(msg, ros2=True)) == expected
    assert from_cbor(to_cbor(msg, ros2=True)) == expected


@pytest.mark.parametrize("msg", [Twist(), String("a")])
def test_a_message_without_times_is_the_same_for_both(msg):
    assert to_json(msg, ros2=True) == to_json(msg)
    assert to_cbor(msg, ros2=True) == to_cbor(msg)
