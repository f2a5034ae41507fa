"""What message types are made of."""

from __future__ import annotations

from typing import ClassVar

from bridge.msgs import TYPES
from bridge.msgs.base import Msg
from bridge.msgs.sensor_msgs import Imu, NavSatStatus
from bridge.server.rosapi.type_descriptions import constant_types, constants, typedefs
from tests.looped import looped


def kinds(name: str) -> dict[str, tuple[str, int]]:
    first = typedefs(name)[0]
    columns = (first["fieldnames"], first["fieldtypes"], first["fieldarraylen"])
    return {field: (kind, length) for field, kind, length in zip(*columns, strict=True)}


def test_a_type_comes_first_and_then_what_it_is_made_of():
    found = typedefs("geometry_msgs/Twist")
    assert [each["type"] for each in found] == ["geometry_msgs/Twist", "geometry_msgs/Vector3"]
    assert found[0]["fieldnames"] == ["linear", "angular"]
    assert found[1]["fieldtypes"] == ["float64", "float64", "float64"]


def test_a_class_will_do_as_well_as_a_name():
    assert typedefs(Imu) == typedefs("sensor_msgs/Imu")


def test_a_number_has_its_true_width():
    assert kinds("sensor_msgs/LaserScan")["angle_min"] == ("float32", -1)
    assert kinds("sensor_msgs/NavSatStatus") == {"status": ("int8", -1), "service": ("uint16", -1)}


def test_lists_and_arrays_have_any_length():
    assert kinds("sensor_msgs/LaserScan")["ranges"] == ("float32", 0)
    assert kinds("sensor_msgs/CompressedImage")["data"] == ("uint8", 0)
    assert kinds("nav_msgs/Path")["poses"] == ("geometry_msgs/PoseStamped", 0)


def test_a_fixed_array_tells_its_length():
    assert kinds("geometry_msgs/PoseWithCovariance")["covariance"] == ("float64", 36)
    assert kinds("unique_identifier_msgs/UUID")["uuid"] == ("uint8", 16)


class Bounded(Msg, frozen=True, gc=False):
    MSGTYPE: ClassVar[str] = "test_msgs/Bounded"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string<=20", "float32[<=8]")
    name: str = ""
    values: list[float] = []


def test_a_bound_cannot_be_told_and_is_any_length():
    (found,) = typedefs(Bounded)
    assert (found["fieldtypes"], found["fieldarraylen"]) == (["string", "float32"], [-1, 0])


def test_constants_are_told_with_their_values():
    found = typedefs("sensor_msgs/NavSatStatus")[0]
    told = dict(zip(found["constnames"], found["constvalues"], strict=True))
    assert told["STATUS_NO_FIX"] == "-1"
    assert constants(NavSatStatus)["SERVICE_GALILEO"] == 8
    assert "MSGTYPE" not in told
    assert constant_types(NavSatStatus)["SERVICE_GALILEO"] == "uint16"


def test_examples_are_the_defaults():
    found = typedefs("sensor_msgs/CompressedImage")[0]
    assert found["examples"] == ["{}", "jpeg", "[]"]
    assert typedefs("geometry_msgs/Quaternion")[0]["examples"] == ["0.0", "0.0", "0.0", "1.0"]


def test_a_time_is_built_in_and_needs_no_definition():
    (header,) = typedefs("std_msgs/Header")
    assert header["fieldtypes"] == ["uint32", "time", "string"]
    assert header["examples"] == ["0", "{}", ""]


def test_ros_2_has_headers_without_a_count_and_times_as_messages():
    header, time = typedefs("std_msgs/Header", ros2=True)
    assert (header["fieldnames"], header["fieldtypes"]) == (
        ["stamp", "frame_id"],
        ["builtin_interfaces/Time", "string"],
    )
    assert (time["type"], time["fieldnames"]) == ("builtin_interfaces/Time", ["sec", "nanosec"])
    assert len(typedefs("std_msgs/String", ros2=True)) == 1


def test_what_is_told_can_be_changed_without_harm():
    typedefs("std_msgs/Header")[0]["type"] = "changed"
    assert typedefs("std_msgs/Header")[0]["type"] == "std_msgs/Header"


@looped("name", sorted(set(TYPES) - {"time", "duration"}))
def test_every_type_can_be_told_with_columns_of_one_length(name):
    found = typedefs(name)
    assert found[0]["type"] == name
    for each in found:
        columns = [each[key] for key in ("fieldnames", "fieldtypes", "fieldarraylen", "examples")]
        assert len({len(column) for column in columns}) == 1
        assert len(each["constnames"]) == len(each["constvalues"])


def test_an_unknown_type_has_no_definition():
    assert typedefs("nobody_msgs/Nothing") == []


@looped("name", sorted(set(TYPES) - {"time", "duration"}))
def test_every_constant_has_its_type(name):
    assert list(constant_types(TYPES[name])) == list(constants(TYPES[name]))
