"""What a robot tells about itself to libraries that ask."""

from __future__ import annotations

import json
import platform

import pytest
from msgspec import Raw

from bridge.core.errors import ProtocolError
from bridge.core.topics import TOPICS
from bridge.protocol import MAX_ARGUMENT_BYTES
from bridge.server.rosapi.parameters import Parameters
from bridge.server.rosapi.services import NODE, Graph, Node, RosApi

NODES = {
    NODE: Node(["/odom"], ["/cmd_vel"], ["/stop"], ["/task/run"]),
    "/client_1": Node(["/chatter"], ["/odom"], ["/add_two_ints"], []),
}
GRAPH = Graph(
    topics=lambda: {topic.name: topic.type.MSGTYPE for topic in TOPICS},
    services=lambda: {"/stop": "pilothouse_msgs/Command", "/add_two_ints": "rospy_tutorials/AddTwoInts"},
    actions=lambda: {"/task/run": "pilothouse_msgs/RunTask"},
    nodes=lambda: NODES,
)
API = RosApi(GRAPH, Parameters({"/robot": "Patrol-1"}), lambda: 12.25)


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
        ("service_type", b'{"service":"/rosapi/topics"}', {"type": "rosapi/Topics"}),
        ("service_node", b'{"service":"/add_two_ints"}', {"node": "/client_1"}),
        ("service_node", b'{"service":"/rosapi/topics"}', {"node": NODE}),
        ("nodes", b"{}", {"nodes": [NODE, "/client_1"]}),
        ("publishers", b'{"topic":"chatter"}', {"publishers": ["/client_1"]}),
        ("subscribers", b'["/odom"]', {"subscribers": ["/client_1"]}),
        (
            "node_details",
            b'{"node":"/client_1"}',
            {"subscribing": ["/odom"], "publishing": ["/chatter"], "services": ["/add_two_ints"]},
        ),
        ("node_details", b'{"node":"/x"}', {"subscribing": [], "publishing": [], "services": []}),
        ("action_servers", b"{}", {"action_servers": ["/task/run"]}),
        ("action_type", b'{"action":"/task/run"}', {"type": "pilothouse_msgs/RunTask"}),
        ("get_ros_version", b"{}", {"version": 1, "distro": "pilothouse"}),
        ("has_param", b'{"name":"/robot"}', {"exists": True}),
        ("has_param", b'{"name":"/x"}', {"exists": False}),
        ("get_param_names", b"{}", {"names": ["/robot"]}),
        ("search_param", b'{"name":"robot"}', {"global_name": "/robot"}),
        ("search_param", b'{"name":"x"}', {"global_name": ""}),
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


@pytest.mark.parametrize(
    ("args", "value"),
    [
        (b'{"name":"/robot","default":""}', '"Patrol-1"'),
        (b'{"name":"robot"}', '"Patrol-1"'),
        (b'{"name":"/x","default":""}', "null"),
        (b'{"name":"/x","default":"5"}', "5"),
        (b'{"name":"/x","default_value":"6"}', "6"),
        (b'["/x","7"]', "7"),
    ],
)
def test_a_parameter_that_is_not_there_has_the_default_of_whoever_asks(args, value):
    assert ask("/rosapi/get_param", args)["value"] == value


def test_parameters_come_and_go():
    api = RosApi(GRAPH, Parameters(), float)
    for service, args in (("set_param", b'{"name":"/a","value":"[1]"}'), ("delete_param", b'{"name":"/a"}')):
        assert json.loads(api.answer(f"/rosapi/{service}", Raw(args)))["successful"] is True
    assert json.loads(api.answer("/rosapi/has_param", Raw(b'{"name":"/a"}'))) == {"exists": False}


def test_both_halves_of_a_service_are_told():
    names = {}
    for half in ("request", "response"):
        found = ask(f"/rosapi/service_{half}_details", b'{"type":"pilothouse_msgs/Command"}')
        names[half] = found["typedefs"][0]["fieldnames"]
    assert "command_id" in names["request"]
    assert "success" in names["response"]


def test_the_types_of_its_own_services_are_told_in_both_names_of_their_package():
    for type, service in API.types.items():
        for half in ("Request", "Response"):
            found = ask(f"/rosapi/service_{half.lower()}_details", json.dumps({"type": service}).encode())
            assert found["typedefs"][0]["type"] == f"{service}{half}", type
    for name in ("rosapi/TopicsForType", "rosapi_msgs/srv/TopicsForType"):
        found = ask("/rosapi/service_response_details", json.dumps({"type": name}).encode())
        assert found["typedefs"][0]["fieldnames"] == ["topics"]
    found = ask("/rosapi/service_response_details", b'{"type":"rosapi/MessageDetails"}')
    assert found["typedefs"][0]["fieldtypes"] == ["rosapi/TypeDef"]
    assert found["typedefs"][1]["type"] == "rosapi/TypeDef"


def test_ros_1_and_ros_2_have_headers_of_their_own():
    for name, first in (("std_msgs/Header", "seq"), ("std_msgs/msg/Header", "stamp")):
        found = ask("/rosapi/message_details", json.dumps({"type": name}).encode())
        assert found["typedefs"][0]["fieldnames"][0] == first


def test_every_service_is_on_this_machine():
    assert ask("/rosapi/service_host", b'{"service":"/stop"}') == {"host": platform.node()}
    assert ask("/rosapi/service_host", b'{"service":"/nowhere"}') == {"host": ""}


def test_types_are_told_as_ros_text_beside_their_topics():
    found = ask("/rosapi/topics_and_raw_types")
    text = dict(zip(found["topics"], found["typedefs_full_text"], strict=True))["/cmd_vel"]
    assert "linear\n" in text
    assert "MSG: geometry_msgs/Vector3\n" in text


def test_a_name_that_is_no_text_is_refused():
    with pytest.raises(ProtocolError, match="topic must be a text, not 5"):
        ask("/rosapi/topic_type", b'{"topic":5}')


def test_a_number_beyond_all_numbers_is_refused():
    with pytest.raises(ProtocolError, match="args cannot be used: Number out of range"):
        ask("/rosapi/topic_type", b'{"topic":1e999}')


def test_arguments_are_bounded():
    with pytest.raises(ProtocolError, match=f"args may have at most {MAX_ARGUMENT_BYTES} bytes"):
        ask("/rosapi/set_param", b'{"name":"/a","value":"%s"}' % (b"1" * MAX_ARGUMENT_BYTES))
