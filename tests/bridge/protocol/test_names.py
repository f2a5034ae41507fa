"""Names of topics, services and types, and ids."""

from __future__ import annotations

import pytest
from msgspec import UNSET

from bridge.core.errors import ProtocolError
from bridge.protocol import CallService, Subscribe, absolute, ros2_name, service_and_id, spells_ros2
from bridge.protocol.names import checked_id, checked_name, wrong


def test_a_relative_name_is_resolved():
    assert (absolute("rosapi/topics"), absolute("/odom")) == ("/rosapi/topics", "/odom")


@pytest.mark.parametrize(
    ("service", "id", "name", "answered_with"),
    [
        ("/rosapi/topics", 7, "/rosapi/topics", 7),
        ("/rosapi/topics#33", UNSET, "/rosapi/topics", "33"),
        ("rosapi/topics#33", None, "/rosapi/topics", "33"),
        ("/rosapi/topics#33", "new", "/rosapi/topics", "new"),
        ("/rosapi/topics", UNSET, "/rosapi/topics", UNSET),
        ("/rosapi/topics#", UNSET, "/rosapi/topics", ""),
    ],
)
def test_an_id_behind_the_name_counts_where_there_is_no_other(service, id, name, answered_with):
    assert service_and_id(CallService(service=service, id=id)) == (name, answered_with)


@pytest.mark.parametrize(
    ("type", "ros2"),
    [
        ("sensor_msgs/msg/Imu", True),
        ("std_srvs/srv/Trigger", True),
        ("dock_msgs/action/Dock", True),
        ("sensor_msgs/Imu", False),
        ("*", False),
        ("", False),
        (None, False),
        ("a/b/c", False),
        ("a/msg/b/c", False),
    ],
)
def test_a_type_tells_whose_names_it_follows(type, ros2):
    assert spells_ros2(type) is ros2


@pytest.mark.parametrize(
    ("type", "kind", "expected"),
    [
        ("sensor_msgs/Imu", "msg", "sensor_msgs/msg/Imu"),
        ("std_srvs/Trigger", "srv", "std_srvs/srv/Trigger"),
        ("dock_msgs/Dock", "action", "dock_msgs/action/Dock"),
        ("sensor_msgs/msg/Imu", "msg", "sensor_msgs/msg/Imu"),
        ("*", "msg", "*"),
        ("", "msg", ""),
    ],
)
def test_a_types_name_can_be_given_its_ros_2_form(type, kind, expected):
    assert ros2_name(type, kind) == expected


@pytest.mark.parametrize("name", ["", "/" + "x" * 256])
def test_a_name_that_cannot_be_kept_is_refused(name):
    with pytest.raises(
        ProtocolError, match=f"topic must have 1 to 256 characters, not {len(name)}"
    ) as caught:
        checked_name(name, Subscribe(topic=name, id=4), "topic")
    assert (caught.value.op, caught.value.id) == ("subscribe", 4)


def test_an_id_that_cannot_be_kept_is_refused_and_not_repeated():
    with pytest.raises(ProtocolError, match="id must have at most 1024 characters, not 1025") as caught:
        checked_id(Subscribe(topic="/a", id="x" * 1025))
    assert (caught.value.op, caught.value.id) == ("subscribe", None)
    assert checked_id(Subscribe(topic="/a", id="x" * 1024)) == "x" * 1024


def test_an_error_about_an_operation_without_an_id_has_none():
    assert wrong(Subscribe(topic="/a"), "No.").id is None


@pytest.mark.parametrize("name", ["/stop/", "stop/", "//stop", "/control//acquire", "/"])
def test_a_name_that_only_looks_like_another_is_refused(name):
    """People read `/stop/` as `/stop`, and a robot compares names as they are."""
    with pytest.raises(ProtocolError, match="without empty parts") as caught:
        checked_name(name, Subscribe(topic=name), "topic")
    assert name.strip("/") in str(caught.value)
