"""The common packages of ROS: known by name, and made when one is first asked for."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

from bridge.codec import from_cbor, from_json, to_cbor, to_json
from bridge.msgs import TYPES
from bridge.msgs.common import HOME, CommonTypes
from bridge.msgs.geometry_msgs import Pose
from bridge.msgs.std_msgs import Duration, Time
from bridge.rosbytes import deserialize, serialize
from tests.looped import looped

NAMES = CommonTypes(TYPES.get).names()
ASKED_FOR = (
    "actionlib_msgs/GoalID",
    "rosgraph_msgs/Log",
    "rcl_interfaces/Log",
    "visualization_msgs/MarkerArray",
    "trajectory_msgs/JointTrajectory",
    "move_base_msgs/MoveBaseActionGoal",
    "nav2_msgs/NavigateToPoseGoal",
    "shape_msgs/SolidPrimitive",
    "stereo_msgs/DisparityImage",
    "map_msgs/OccupancyGridUpdate",
    "geographic_msgs/GeoPointStamped",
    "control_msgs/FollowJointTrajectoryAction",
    "example_interfaces/AddTwoIntsRequest",
    "tf/tfMessage",
    "std_msgs/Time",
    "std_msgs/Duration",
)

LOADED = """
import sys
opened = []
sys.addaudithook(lambda event, args: opened.append(str(args[0])) if event == "open" else None)
import bridge.server.server, bridge.client.remote_robot, bridge.core.topics, bridge.msgs
assert bridge.msgs.TYPES.get("sensor_msgs/Imu")
print("bridge.msgs.common" in sys.modules, any("common" in name and name.endswith(".txt") for name in opened))
assert bridge.msgs.TYPES["actionlib_msgs/GoalID"]
print([name.rpartition("/")[2] for name in opened if name.endswith(".txt")])
"""


def test_nothing_of_them_is_loaded_before_one_is_asked_for_and_then_its_package_alone():
    told = subprocess.run(
        [sys.executable, "-c", LOADED], capture_output=True, text=True, check=True, cwd=HOME.parents[2]
    )
    assert told.stdout.splitlines() == ["False False", "['actionlib_msgs.txt']"]


def test_they_are_not_listed_among_those_made_beforehand():
    assert TYPES["visualization_msgs/Marker"]
    assert "visualization_msgs/Marker" not in list(TYPES)


@looped("name", ASKED_FOR)
def test_what_programs_use_is_there(name):
    assert name == TYPES[name].MSGTYPE


@looped("name", NAMES)
def test_every_one_goes_through_text_and_bytes(name):
    msg = TYPES[name]()
    if not any("wstring" in rostype for rostype in type(msg).ROSTYPES):
        for cdr in (False, True):
            assert deserialize(serialize(msg, cdr), type(msg), cdr) == msg
    assert from_json(to_json(msg), type(msg)) == msg
    assert from_cbor(to_cbor(msg)).keys() == json.loads(to_json(msg)).keys()


def test_its_parts_are_the_classes_of_the_robot():
    marker = TYPES["visualization_msgs/Marker"]
    assert type(marker().pose) is Pose
    assert type(marker().lifetime) is Duration
    assert (marker.CUBE, marker.DELETEALL) == (1, 3)
    assert type(TYPES["std_msgs/Time"]().data) is Time


def test_an_action_has_the_messages_that_its_topics_carry_in_ros_1():
    goal = TYPES["move_base_msgs/MoveBaseActionGoal"]()
    assert list(goal.__struct_fields__) == ["header", "goal_id", "goal"]
    assert goal.goal.target_pose.header.frame_id == ""
    assert TYPES["tf2_msgs/LookupTransformActionResult"]().result == TYPES["tf2_msgs/LookupTransformResult"]()


@pytest.mark.parametrize(
    "name",
    [
        "",
        "x",
        "visualization_msgs",
        "visualization_msgs/",
        "visualization_msgs/Nothing",
        "../common/tf/tfMessage",
        "/etc/x",
    ],
)
def test_what_is_not_there_is_not_known(name):
    assert TYPES.get(name) is None
    assert name not in TYPES
    with pytest.raises(KeyError):
        TYPES[name]


def test_each_file_names_its_source_and_licence():
    for path in HOME.glob("*.txt"):
        first = path.read_text("utf-8").partition("\n")[0]
        assert first.startswith(f"# {path.stem}: ")
        assert first.endswith(("BSD-3-Clause", "Apache-2.0")), first
