"""The classes in bridge/msgs are what their ROS text makes, and the text's fields are those of ROS."""

from __future__ import annotations

import math
import re
from pathlib import Path

from rosbags.interfaces import Nodetype
from rosbags.typesys.stores.ros2_humble import FIELDDEFS

import bridge.msgs
from bridge.generate import library, modules
from bridge.generate.find import definitions
from bridge.msgs import TYPES
from tests.looped import looped

ROOT = Path(__file__).parents[3]
MSGS = ROOT / "bridge" / "msgs"
TEXT = [ROOT / "bridge" / "definitions", ROOT / "pilothouse_msgs"]
BY_HAND = {
    "__init__.py",
    "additions.py",
    "arrays.py",
    "base.py",
    "builtin_interfaces.py",
    "common.py",
    "making.py",
}
LIBRARY = library.Library(definitions(TEXT, None, lambda name: False))
FILES = {
    f"{package}.py": modules.package_module(package, LIBRARY, "bridge.msgs") for package in LIBRARY.packages
}


@looped("path", sorted(FILES))
def test_a_file_is_byte_for_byte_what_its_text_makes(path):
    assert (MSGS / path).read_bytes() == FILES[path].encode()


def test_there_is_no_other_file():
    there = {path.relative_to(MSGS).as_posix() for path in MSGS.rglob("*.py")}
    assert there - BY_HAND == set(FILES)


def test_no_class_is_longer_than_the_house_allows():
    classes = [each for text in FILES.values() for each in text.split("\nclass ")[1:]]
    assert max(each.count("\n") for each in classes) <= 250


def test_the_table_of_types_holds_every_part_of_every_text():
    assert set(TYPES) == {*LIBRARY.parts, "time", "duration"}
    assert all(name == TYPES[name].MSGTYPE for name in TYPES)


@looped("cls", TYPES.values())
def test_every_class_knows_the_exact_type_of_each_field(cls):
    sent = [name for name in cls.__struct_fields__ if name not in ("sec", "nanosec")]
    assert len(cls.ROSTYPES) == len(sent)


def test_what_was_made_is_imported_under_its_package():
    assert bridge.msgs.sensor_msgs.Imu is TYPES["sensor_msgs/Imu"]
    assert bridge.msgs.std_srvs.TriggerResponse is TYPES["std_srvs/TriggerResponse"]
    assert bridge.msgs.tf2_msgs.LookupTransformGoal is TYPES["tf2_msgs/LookupTransformGoal"]


# ROS's own fields


def spelled(desc) -> str:
    kind, value = desc
    if kind is Nodetype.NAME:
        name = value.replace("/msg/", "/")
        return {"builtin_interfaces/Time": "time", "builtin_interfaces/Duration": "duration"}.get(name, name)
    if kind is Nodetype.BASE:
        return value[0] + (f"<={value[1]}" if value[1] else "")
    inner, size = value
    array = f"[{size}]" if kind is Nodetype.ARRAY else f"[<={size}]" if size else "[]"
    return spelled(inner) + array


HUMBLE = {
    name.replace("/msg/", "/"): (
        [(constant, base, value) for constant, base, value in constants],
        [] if name == "std_msgs/msg/Empty" else [(field, spelled(desc)) for field, desc in fields],
    )
    for name, (constants, fields) in FIELDDEFS.items()
}
STANDARD = (
    "std_msgs",
    "geometry_msgs",
    "sensor_msgs",
    "nav_msgs",
    "diagnostic_msgs",
    "tf2_msgs",
    "action_msgs",
    "unique_identifier_msgs",
)
MESSAGES = sorted(name for name in HUMBLE if name.split("/")[0] in STANDARD)


@looped("name", MESSAGES)
def test_a_standard_message_has_the_fields_and_constants_of_ros_2_humble(name):
    part = LIBRARY.parts[name]
    constants, fields = HUMBLE[name]
    assert [(each.name, each.kind.rostype) for each in part.fields] == fields
    assert [(each.name, each.base, each.value) for each in part.constants] == constants


OTHERS = {
    "std_srvs/SetBoolRequest": "bool data",
    "std_srvs/SetBoolResponse": "bool success, string message",
    "std_srvs/TriggerResponse": "bool success, string message",
    "nav_msgs/GetPlanRequest": "geometry_msgs/PoseStamped start, geometry_msgs/PoseStamped goal, float32 tolerance",
    "nav_msgs/LoadMapResponse": "nav_msgs/OccupancyGrid map, uint8 result",
    "nav_msgs/SetMapRequest": "nav_msgs/OccupancyGrid map, geometry_msgs/PoseWithCovarianceStamped initial_pose",
    "diagnostic_msgs/SelfTestResponse": "string id, byte passed, diagnostic_msgs/DiagnosticStatus[] status",
    "diagnostic_msgs/AddDiagnosticsRequest": "string load_namespace",
    "sensor_msgs/SetCameraInfoResponse": "bool success, string status_message",
    "tf2_msgs/LookupTransformGoal": "string target_frame, string source_frame, time source_time, "
    "duration timeout, time target_time, string fixed_frame, bool advanced",
    "tf2_msgs/LookupTransformResult": "geometry_msgs/TransformStamped transform, tf2_msgs/TF2Error error",
    "tf2_msgs/LookupTransformFeedback": "",
    "vision_msgs/BoundingBox2D": "vision_msgs/Pose2D center, float64 size_x, float64 size_y",
    "vision_msgs/BoundingBox3D": "geometry_msgs/Pose center, geometry_msgs/Vector3 size",
    "vision_msgs/Detection2D": "std_msgs/Header header, vision_msgs/ObjectHypothesisWithPose[] results, "
    "vision_msgs/BoundingBox2D bbox, string id",
    "vision_msgs/LabelInfo": "std_msgs/Header header, vision_msgs/VisionClass[] class_map, float32 threshold",
    "vision_msgs/ObjectHypothesis": "string class_id, float64 score",
    "vision_msgs/VisionClass": "uint16 class_id, string class_name",
    "vision_msgs/VisionInfo": "std_msgs/Header header, string method, string database_location, "
    "int32 database_version",
    "rosapi_msgs/TypeDef": "string type, string[] fieldnames, string[] fieldtypes, int32[] fieldarraylen, "
    "string[] examples, string[] constnames, string[] constvalues",
    "rosapi_msgs/GetParamRequest": "string name, string default_value",
    "rosapi_msgs/GetROSVersionResponse": "uint8 version, string distro",
    "rosapi_msgs/NodeDetailsResponse": "string[] subscribing, string[] publishing, string[] services",
    "rosapi_msgs/TopicsAndRawTypesResponse": "string[] topics, string[] types, string[] typedefs_full_text",
}


@looped("name", OTHERS)
def test_what_the_parser_has_no_copy_of_has_the_fields_that_its_package_publishes(name):
    fields = ", ".join(f"{each.kind.rostype} {each.name}" for each in LIBRARY.parts[name].fields)
    assert fields == OTHERS[name]


UNKNOWN = {
    "Place": "yaw",
    "TaskOrder": "heading, speed, duration",
    "Limits": "max_speed, max_yaw_rate, min_depth, max_depth, max_height, max_slope, floor, ceiling, clearance",
    "Following": "distance",
    "SetQueueRequest": "stamp",
}


@looped("name", UNKNOWN)
def test_what_nobody_told_or_measured_is_nan_and_not_zero(name):
    made = TYPES[f"pilothouse_msgs/{name}"]()
    assert all(math.isnan(getattr(made, field)) for field in UNKNOWN[name].split(", "))


def test_every_field_of_our_own_messages_says_what_it_means():
    ours = [part for part in LIBRARY.parts.values() if part.package == "pilothouse_msgs"]
    assert len(ours) > 15
    assert not [f"{part.rosname}.{each.name}" for part in ours for each in part.fields if not each.comment]
    assert all(part.comment for part in LIBRARY.parts.values())


def test_our_own_texts_are_in_columns():
    for path in TEXT[1].glob("*/*.*"):
        for line in path.read_text().splitlines():
            assert re.fullmatch(r"|---|# .+|\S+ \w+( \S+)? +# .+", line), f"{path.name}: {line}"
