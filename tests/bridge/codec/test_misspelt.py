"""Fields that a type does not have."""

from __future__ import annotations

from bridge.codec import unknown_fields
from bridge.codec.misspelt import MAX_NAMED
from bridge.msgs.geometry_msgs import PoseStamped, Twist
from bridge.msgs.nav_msgs import Path


def test_a_misspelt_field_is_named_with_its_place():
    assert unknown_fields({"linaer": {"x": 1}, "angular": {"zz": 1}}, Twist) == ["linaer", "angular.zz"]
    assert unknown_fields({"poses": [{"pos": {}}]}, Path) == ["poses[].pos"]


def test_both_spellings_of_a_time_and_a_count_are_known():
    for stamp in ({"secs": 1, "nsecs": 2}, {"sec": 1, "nanosec": 2}):
        assert unknown_fields({"header": {"stamp": stamp, "seq": 1, "frame_id": ""}}, PoseStamped) == []


def test_few_are_named():
    assert len(unknown_fields({f"a{number}": 1 for number in range(100)}, Twist)) == MAX_NAMED


def test_what_is_no_message_has_none():
    assert unknown_fields([1], Twist) == unknown_fields({"linear": 5, "angular": None}, Twist) == []
