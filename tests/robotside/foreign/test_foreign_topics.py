"""Which topic of a strange robot is which of ours."""

from __future__ import annotations

from bridge.core.topics import CAMERA
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import LineSensor
from bridge.msgs.sensor_msgs import Range
from robotside.foreign.foreign_topics import CONTROL, match, usual

TURTLEBOT = {
    "/odom": "nav_msgs/Odometry",
    "/scan": "sensor_msgs/LaserScan",
    "/map": "nav_msgs/OccupancyGrid",
    "/battery_state": "sensor_msgs/BatteryState",
    "/camera/rgb/image_raw/compressed": "sensor_msgs/CompressedImage",
    "/cmd_vel": "geometry_msgs/Twist",
}


def test_usual_names_need_no_word() -> None:
    found = match(TURTLEBOT)
    assert found.topics["/odom"] == ("/odom", Odometry)
    assert (found.command, found.stamped) == ("/cmd_vel", False)
    assert found.remarks == (f"/camera/rgb/image_raw/compressed is used as {CAMERA}, by its type.",)


def test_small_sensors_are_passed_on_where_a_robot_has_them() -> None:
    found = match(TURTLEBOT | {"/line_sensor": "pilothouse_msgs/LineSensor", "/sonar": "sensor_msgs/Range"})
    assert found.topics["/line_sensor"] == ("/line_sensor", LineSensor)
    assert found.topics["/range/front"] == ("/sonar", Range)
    assert "/range/left" not in found.topics
    assert "/line_sensor" not in match(TURTLEBOT).topics


def test_a_bare_robot_says_what_it_has_not() -> None:
    found = match({"/odom": "nav_msgs/Odometry", "/cmd_vel": "geometry_msgs/Twist"})
    assert set(found.topics) == {"/odom"}
    assert list(found.remarks) == [
        "There is no laser: driving by hand only.",
        "There is no map: driving by hand only.",
        "There is no camera.",
        "There is no battery report.",
    ]


def test_other_names_are_found_by_type_and_the_least_special_wins() -> None:
    found = match(
        TURTLEBOT
        | {
            "/scan": "sensor_msgs/Imu",
            "/rear/laser": "sensor_msgs/LaserScan",
            "/front": "sensor_msgs/LaserScan",
        }
    )
    assert found.topics["/scan"][0] == "/front"
    assert found.topics["/imu/data"][0] == "/scan"


def test_a_usual_name_with_another_type_is_not_taken() -> None:
    found = match({"/odom": "std_msgs/String"})
    assert "/odom" not in found.topics


def test_ros_2_spells_its_types_otherwise() -> None:
    found = match({"/odom": "nav_msgs/msg/Odometry", "/robot/cmd_vel": "geometry_msgs/msg/TwistStamped"})
    assert "/odom" in found.topics
    assert (found.command, found.stamped) == ("/robot/cmd_vel", True)
    assert "Drive commands go to /robot/cmd_vel." in found.remarks


def test_stamped_and_plain_commands_on_the_usual_name() -> None:
    assert match({"/cmd_vel": "geometry_msgs/TwistStamped"}).stamped
    both = match({"/cmd_vel": "geometry_msgs/TwistStamped", "/a/cmd_vel": "geometry_msgs/Twist"})
    assert (both.command, both.stamped) == ("/cmd_vel", True)


def test_not_every_twist_is_a_command() -> None:
    found = match({"/measured_speed": "geometry_msgs/Twist"})
    assert found.command == "/cmd_vel"
    assert "No topic accepts drive commands" in found.remarks[-1]


def test_a_robot_that_does_not_tell_is_supposed_to_be_usual() -> None:
    found = usual()
    assert found.topics["/scan"][0] == "/scan"
    assert found.remarks == ("It does not list its topics: the usual names are assumed.",)


def test_who_drives_is_asked_only_of_a_robot_side_of_ours_that_tells_its_topics() -> None:
    assert CONTROL in match({CONTROL: "pilothouse_msgs/ControlStatus"}).topics
    assert CONTROL not in match({CONTROL: "std_msgs/String"}).topics
    assert CONTROL not in usual().topics


def test_a_robot_that_does_not_tell_is_not_asked_for_types_that_no_other_has() -> None:
    assert not [kind.MSGTYPE for _, kind in usual().topics.values() if kind.MSGTYPE.startswith("pilothouse")]
