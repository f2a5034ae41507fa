"""What a robot tells about itself to libraries that ask."""

from __future__ import annotations

import json

import pytest
from msgspec import Raw

from bridge.rosapi import RosApi
from bridge.topics import TOPICS

API = RosApi({topic.name: topic for topic in TOPICS}, {"/stop": "pilothouse_msgs/Command"}, lambda: 12.25)


def ask(service, args=b"{}"):
    return json.loads(API.answer(service, Raw(args)))


def test_the_time_is_the_robots_clock():
    assert ask("/rosapi/get_time") == {"time": {"secs": 12, "nsecs": 250_000_000}}


def test_topics_and_their_types_stand_in_the_same_order():
    found = ask("/rosapi/topics")
    assert dict(zip(found["topics"], found["types"], strict=True))["/odom"] == "nav_msgs/Odometry"
    assert len(found["topics"]) == len(TOPICS)


def test_services_include_those_that_answer_this():
    assert {"/stop", "/rosapi/topics"} <= set(ask("/rosapi/services")["services"])


@pytest.mark.parametrize(
    ("service", "args", "answer"),
    [
        ("topic_type", b'{"topic":"/odom"}', {"type": "nav_msgs/Odometry"}),
        ("topic_type", b'["/odom"]', {"type": "nav_msgs/Odometry"}),
        ("topic_type", b'{"topic":"/nowhere"}', {"type": ""}),
        ("topics_for_type", b'{"type":"sensor_msgs/msg/Imu"}', {"topics": ["/imu/data"]}),
        ("service_type", b'{"service":"/stop"}', {"type": "pilothouse_msgs/Command"}),
        ("service_type", b"null", {"type": ""}),
        ("services_for_type", b'{"type":"pilothouse_msgs/Command"}', {"services": ["/stop"]}),
        ("nodes", b"{}", {"nodes": ["/pilothouse"]}),
        ("get_param", b'{"name":"/x","default":""}', {"value": "null"}),
    ],
)
def test_questions_have_answers(service, args, answer):
    assert ask(f"/rosapi/{service}", args) == answer


def test_a_type_can_be_asked_for_in_either_spelling():
    for name in ("geometry_msgs/Twist", "geometry_msgs/msg/Twist"):
        found = ask("/rosapi/message_details", json.dumps({"type": name}).encode())
        assert [each["type"] for each in found["typedefs"]] == [
            "geometry_msgs/Twist",
            "geometry_msgs/Vector3",
        ]


def test_what_is_not_rosapi_is_left_to_others():
    assert API.answer("/stop", Raw(b"{}")) is None
