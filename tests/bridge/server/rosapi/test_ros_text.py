"""Message types as text: what a reader of `cbor-raw` makes of it is what is in the bytes."""

from __future__ import annotations

import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from bridge.core.topics import TOPICS
from bridge.msgs import TYPES
from bridge.msgs.std_msgs import Header, Time
from bridge.rosbytes import serialize
from bridge.server.rosapi.ros_text import full_text
from tests.looped import looped

NAMES = sorted({topic.type.MSGTYPE for topic in TOPICS})
NOETIC = get_typestore(Stores.ROS1_NOETIC)
DIFFERENT = {
    "sensor_msgs/msg/CameraInfo",
    "shape_msgs/msg/SolidPrimitive",
    "stereo_msgs/msg/DisparityImage",
    "visualization_msgs/msg/ImageMarker",
    "visualization_msgs/msg/Marker",
}
"""Types that ROS 2 defines anew; ours are those of ROS 2."""


def read(name):
    """The types in the text of `name`, as a reader of ROS 1 has them."""
    package, _, rest = name.partition("/")
    return get_types_from_msg(full_text(name), f"{package}/msg/{rest}")


@looped("name", NAMES)
def test_a_reader_of_the_text_reads_the_bytes_of_every_topic_of_ours(name):
    store = get_typestore(Stores.EMPTY)
    store.register(read(name))
    package, _, rest = name.partition("/")
    whole = f"{package}/msg/{rest}"
    raw = serialize(TYPES[name]())
    assert bytes(store.serialize_ros1(store.deserialize_ros1(raw, whole), whole)) == raw


def test_the_count_of_a_header_comes_first():
    assert full_text("std_msgs/Header") == "uint32 seq\ntime stamp\nstring frame_id\n"
    raw = serialize(Header(Time(1, 2), "ab", seq=7))
    assert raw == b"\7\0\0\0\1\0\0\0\2\0\0\0\2\0\0\0ab"


@looped(
    "name",
    sorted(
        name for name in NOETIC.fielddefs if name.replace("/msg/", "/") in TYPES and name not in DIFFERENT
    ),
)
def test_a_type_of_ros_1_has_its_fields_and_constants(name):
    constants, fields = read(name.replace("/msg/", "/"))[name]
    there = [
        field for field in NOETIC.fielddefs[name][1] if field[0] != "structure_needs_at_least_one_member"
    ]
    assert constants == NOETIC.fielddefs[name][0]
    assert fields == there


@pytest.mark.parametrize(
    ("name", "md5"),
    [
        ("std_msgs/Header", "2176decaecbce78abc3b96ef049fabed"),
        ("sensor_msgs/LaserScan", "90c7ef2dc6895d81024acba2ac42f369"),
        ("nav_msgs/Odometry", "cd5e73d190d741a2f92e81eda573aca7"),
        ("sensor_msgs/NavSatFix", "2d3a8cd499b9b4a0249fb98fd05cfa48"),
        ("sensor_msgs/BatteryState", "4ddae7f048e32fda22cac764685e3974"),
        ("rosgraph_msgs/Log", "acffd30cd6b6de30f120938c17c593fb"),
        ("actionlib_msgs/GoalStatusArray", "8b2b82f13216d0a8ea88bd3af735e619"),
    ],
)
def test_the_text_has_the_md5_that_programs_of_ros_1_compare(name, md5):
    store = get_typestore(Stores.EMPTY)
    store.register(read(name))
    package, _, rest = name.partition("/")
    assert store.generate_msgdef(f"{package}/msg/{rest}", ros_version=1)[1] == md5
