"""Only the fields that were asked for travel."""

from __future__ import annotations

import msgspec
import pytest

from bridge.codec import from_builtins, from_cbor, from_json, select, to_cbor, to_json
from bridge.core.errors import ProtocolError
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Mission, Waypoint
from bridge.msgs.sensor_msgs import LaserScan
from bridge.msgs.std_msgs import Header, Time

ODOM = Odometry(
    header=Header(Time(5, 7), "odom"), pose=PoseWithCovariance(Pose(Point(1.0, 2.0, 3.0))), child_frame_id="b"
)


def test_one_field_deep_within_travels_alone():
    assert to_json(select(ODOM, ["pose.pose.position.x"])) == b'{"pose":{"pose":{"position":{"x":1.0}}}}'


def test_several_fields_travel_in_the_order_of_the_message():
    chosen = select(ODOM, ("pose.pose.position", "child_frame_id"))
    assert to_json(chosen) == (
        b'{"child_frame_id":"b","pose":{"pose":{"position":{"x":1.0,"y":2.0,"z":3.0}}}}'
    )


def test_what_was_left_out_has_its_default_at_the_other_end():
    back = from_json(to_json(select(ODOM, ["pose.pose.position"])), Odometry)
    assert back == Odometry(pose=PoseWithCovariance(Pose(Point(1.0, 2.0, 3.0))))


@pytest.mark.parametrize(
    "paths", [("pose.pose", "pose.pose.position.x"), ("pose.pose.position.x", "pose.pose")]
)
def test_the_shorter_of_two_paths_counts(paths):
    assert to_json(select(ODOM, paths)) == to_json(select(ODOM, ["pose.pose"]))


def test_a_path_into_a_time_gives_the_whole_time_in_the_names_of_either_ros():
    chosen = select(ODOM, ["header.stamp.nanosec"])
    assert to_json(chosen) == b'{"header":{"stamp":{"secs":5,"nsecs":7}}}'
    assert to_json(chosen, ros2=True) == b'{"header":{"stamp":{"sec":5,"nanosec":7}}}'


def test_a_path_through_an_array_is_about_each_of_its_elements():
    mission = Mission(waypoints=[Waypoint(x=1.0, y=2.0), Waypoint(x=3.0)])
    assert to_json(select(mission, ["waypoints.x"])) == b'{"waypoints":[{"x":1.0},{"x":3.0}]}'


def test_the_message_itself_is_not_changed_and_what_is_chosen_travels_as_cbor_too():
    chosen = select(ODOM, ["pose.covariance", "header.stamp"])
    assert from_builtins(from_cbor(to_cbor(chosen, ros2=True)), Odometry) == Odometry(
        header=Header(Time(5, 7))
    )
    assert ODOM.pose.pose.position.x == 1.0


@pytest.mark.parametrize(
    ("paths", "sentence"),
    [
        (["speed"], "nav_msgs/Odometry has no field 'speed', only header, child_frame_id, pose, twist."),
        (
            ["pose.x"],
            "pose is a geometry_msgs/PoseWithCovariance and has no field 'x', only pose, covariance.",
        ),
        (["child_frame_id.x.y"], "child_frame_id is a string and has no field 'x.y'."),
        ([""], "nav_msgs/Odometry has no field '', only header, child_frame_id, pose, twist."),
        ([], "fields must name one field at least."),
        (
            ["x" * 1000],
            f"nav_msgs/Odometry has no field {'x' * 60!r}, only header, child_frame_id, pose, twist.",
        ),
    ],
)
def test_a_path_that_leads_nowhere_is_named_with_what_there_is(paths, sentence):
    with pytest.raises(ProtocolError) as caught:
        select(ODOM, paths)
    assert str(caught.value) == sentence


def test_numbers_of_a_scan_stay_what_they_are():
    scan = LaserScan(range_max=2.0)
    assert msgspec.json.decode(to_json(select(scan, ["ranges", "range_max"]))) == {
        "range_max": 2.0,
        "ranges": [],
    }
