"""Every topic of a Pilothouse robot: its name, type, expected rate and direction, in one table.

Liveness, throttling, recording and the documentation are derived from it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace

from bridge.msgs import (
    Msg,
    diagnostic_msgs,
    geometry_msgs,
    nav_msgs,
    pilothouse_msgs,
    rosbridge_msgs,
    rosgraph_msgs,
    sensor_msgs,
    std_msgs,
    tf2_msgs,
    vision_msgs,
)

__all__ = [
    "CAMERA",
    "NAMED",
    "SERVER_TOPICS",
    "SONARS",
    "TEMPERATURE",
    "TOPICS",
    "Topic",
    "camera_topics",
    "named",
    "topic",
]


@dataclass(frozen=True, slots=True)
class Topic:
    """One line of the table."""

    name: str
    type: type[Msg]
    rate: float
    """Messages per second while it flows [Hz]; 0 when it is sent once per change and latched."""
    to: str
    """`handheld` or `robot`."""
    doc: str
    on_demand: bool = False
    """Whether it is made only while a client subscribes to it."""
    once: bool = False
    """Whether it is sent when something happens and not latched: a subscriber gets only later messages."""

    @property
    def latched(self) -> bool:
        """Whether a new subscriber gets the last message at once."""
        return self.rate == 0 and not self.once


SONARS = 16
"""Sonars of a ring that have a topic of their own."""

TOPICS: tuple[Topic, ...] = (
    Topic("/robot/info", pilothouse_msgs.RobotInfo, 0, "handheld", "identity and capabilities of the robot"),
    Topic("/pose", geometry_msgs.PoseWithCovarianceStamped, 20, "handheld", "estimated pose in `map`"),
    Topic("/odom", nav_msgs.Odometry, 20, "handheld", "pose and speed by the wheels alone, in `odom`"),
    Topic("/imu/data", sensor_msgs.Imu, 50, "handheld", "attitude, turn rate, acceleration"),
    Topic("/fix", sensor_msgs.NavSatFix, 5, "handheld", "position by satellite"),
    Topic("/scan", sensor_msgs.LaserScan, 10, "handheld", "the newest sweep of the laser"),
    Topic("/bumper", pilothouse_msgs.Bumper, 10, "handheld", "contact of the bumper ring"),
    Topic(
        "/line_sensor",
        pilothouse_msgs.LineSensor,
        20,
        "handheld",
        "brightness of the ground under the robot, cell by cell",
    ),
    Topic(
        "/range/front",
        sensor_msgs.Range,
        10,
        "handheld",
        "distance to the nearest thing ahead, by its echo",
    ),
    Topic("/range/left", sensor_msgs.Range, 10, "handheld", "distance to the nearest thing on the left"),
    Topic("/range/right", sensor_msgs.Range, 10, "handheld", "distance to the nearest thing on the right"),
    Topic("/range/rear", sensor_msgs.Range, 10, "handheld", "distance to the nearest thing behind"),
    Topic(
        "/battery_state",
        sensor_msgs.BatteryState,
        1,
        "handheld",
        "state of the battery",
    ),
    Topic(
        "/joint_states", sensor_msgs.JointState, 20, "handheld", "angles and speeds of wheels, legs or rotors"
    ),
    Topic(
        "/motors", pilothouse_msgs.MotorArray, 5, "handheld", "speeds, torques, temperatures of the motors"
    ),
    Topic(
        "/manoeuvre", pilothouse_msgs.Manoeuvre, 10, "handheld", "the manoeuvre that the robot carries out"
    ),
    Topic("/sonar", pilothouse_msgs.SonarRing, 10, "handheld", "distances all round by ultrasound"),
    *(
        Topic(
            f"/sonar/{number}",
            sensor_msgs.Range,
            10,
            "handheld",
            f"sonar {number} of the ring",
            on_demand=True,
        )
        for number in range(SONARS)
    ),
    Topic("/ackermann", pilothouse_msgs.AckermannState, 20, "handheld", "steering, wheels, turning radius"),
    Topic("/rudder", pilothouse_msgs.RudderState, 10, "handheld", "rudder and propeller"),
    Topic("/compass", pilothouse_msgs.Compass, 10, "handheld", "heading, roll and pitch by compass"),
    Topic("/depth", sensor_msgs.FluidPressure, 10, "handheld", "pressure of water and air at the robot"),
    Topic("/range/down", sensor_msgs.Range, 20, "handheld", "height above the ground, by ultrasound"),
    Topic("/flight", pilothouse_msgs.FlightState, 10, "handheld", "state of flight"),
    Topic(
        "/camera/image/compressed",
        sensor_msgs.CompressedImage,
        15,
        "handheld",
        "the camera for clients without a binary socket",
        on_demand=True,
    ),
    Topic("/arm", pilothouse_msgs.ArmState, 20, "handheld", "joints, tip and gripper of a mounted arm"),
    Topic("/lights", pilothouse_msgs.LightState, 1, "handheld", "brightness of the lights"),
    *(
        Topic(
            f"/camera/{name}/image/compressed",
            sensor_msgs.CompressedImage,
            15,
            "handheld",
            f"the camera that looks {where}",
            on_demand=True,
        )
        for name, where in (("rear", "back"), ("down", "down"))
    ),
    Topic(
        "/detections",
        vision_msgs.Detection2DArray,
        5,
        "handheld",
        "objects in the camera picture, while a task or a client watches",
    ),
    Topic(
        "/intruders",
        pilothouse_msgs.IntruderArray,
        0,
        "handheld",
        "all intruders found, each once",
    ),
    Topic(
        "/localisation/candidates",
        pilothouse_msgs.PlaceCandidates,
        0,
        "handheld",
        "where the robot may be; two or more while it asks which of them it is",
    ),
    Topic("/map", nav_msgs.OccupancyGrid, 0, "handheld", "the robot's own map"),
    Topic("/plan", nav_msgs.Path, 0, "handheld", "the planned path; empty when there is none"),
    Topic("/mission", pilothouse_msgs.Mission, 0, "handheld", "the mission stored on the robot"),
    Topic(
        "/task/status",
        pilothouse_msgs.TaskStatus,
        0,
        "handheld",
        "the running task, its state and the reason",
    ),
    Topic("/task/progress", pilothouse_msgs.TaskProgress, 2, "handheld", "progress of the running task"),
    Topic("/control/status", pilothouse_msgs.ControlStatus, 0, "handheld", "the driver, the mode, and STOP"),
    Topic("/task/queue", pilothouse_msgs.TaskQueue, 0, "handheld", "the tasks that wait"),
    Topic("/schedule", pilothouse_msgs.Schedule, 0, "handheld", "scheduled tasks"),
    Topic("/places", pilothouse_msgs.PlaceArray, 0, "handheld", "named places"),
    Topic("/limits", pilothouse_msgs.Limits, 0, "handheld", "limits of speed and area"),
    Topic(
        "/gateways",
        pilothouse_msgs.GatewayArray,
        0,
        "handheld",
        "the protocols that the robot knows: which are up, and how they are used",
        on_demand=True,
    ),
    Topic(
        "/payloads",
        pilothouse_msgs.PayloadArray,
        0,
        "handheld",
        "the robot's payloads: which are on",
        on_demand=True,
    ),
    Topic("/checklist", pilothouse_msgs.Checklist, 0, "handheld", "checks before the first move"),
    Topic("/tag", pilothouse_msgs.TagRead, 0, "handheld", "the card at the reader"),
    Topic(
        "/following",
        pilothouse_msgs.Following,
        5,
        "handheld",
        "the guided person: following or not, and the distance",
    ),
    Topic("/events", pilothouse_msgs.Event, 0, "handheld", "events, each once", once=True),
    Topic(
        "/rosout",
        rosgraph_msgs.Log,
        0,
        "handheld",
        "the same events as ROS's own log",
        on_demand=True,
        once=True,
    ),
    Topic("/diagnostics", diagnostic_msgs.DiagnosticArray, 1, "handheld", "health of the robot's parts"),
    Topic("/tf", tf2_msgs.TFMessage, 20, "handheld", "transforms of map, odom and base_link"),
    Topic(
        "/sim/ground_truth",
        nav_msgs.Odometry,
        20,
        "handheld",
        "the true pose of the simulated robot, in `map`",
        on_demand=True,
    ),
    Topic("/cmd_vel", geometry_msgs.Twist, 20, "robot", "the operator's drive command; counts for 0.25 s"),
    Topic(
        "/cmd_manoeuvre",
        pilothouse_msgs.Manoeuvre,
        20,
        "robot",
        "a drive command that a twist cannot express, such as steer or tilt; counts for 0.25 s",
    ),
    Topic("/goal_pose", geometry_msgs.PoseStamped, 0, "robot", "a goal for the robot, once"),
    Topic(
        "/initialpose",
        geometry_msgs.PoseWithCovarianceStamped,
        0,
        "robot",
        "the robot's true pose in `map`, from the operator",
    ),
)

NAME = "NAME"
"""What stands in the table for the name of a part, where a robot has a topic for each of several."""

TEMPERATURE = Topic(
    f"/temperature/{NAME}",
    sensor_msgs.Temperature,
    2,
    "handheld",
    "how warm a motor is, by its name in `/motors`",
    on_demand=True,
)

_PICTURES = Topic(
    f"/camera/{NAME}/image/compressed",
    sensor_msgs.CompressedImage,
    15,
    "handheld",
    "any further camera, by its name in `cameras` of `/robot/info`",
    on_demand=True,
)

NAMED: tuple[Topic, ...] = (TEMPERATURE, _PICTURES)
"""Topics of which a robot has one for each of its parts, each called by the part's name in place of `NAME`."""

SERVER_TOPICS: tuple[Topic, ...] = (
    Topic("/client_count", std_msgs.Int32, 0, "handheld", "number of clients of the rosbridge server"),
    Topic(
        "/connected_clients",
        rosbridge_msgs.ConnectedClients,
        0,
        "handheld",
        "clients of the rosbridge server",
    ),
)
"""What the server of the rosbridge protocol adds to the robot's own."""

_BY_NAME = {entry.name: entry for entry in (*TOPICS, *SERVER_TOPICS)}

_NAMED = tuple(
    (re.compile(re.escape(entry.name).replace(NAME, r"[A-Za-z]\w*"), re.ASCII), entry) for entry in NAMED
)

CAMERA = "/camera/image/compressed"
"""Pictures of a robot's first camera."""


def camera_topics(cameras: Iterable[str]) -> dict[str, str]:
    """The topic of each camera's pictures by the camera's name, in the robot's order."""
    named = {name: f"/camera/{name}/image/compressed" for name in cameras}
    return {name: one if number else CAMERA for number, (name, one) in enumerate(named.items())}


def named(family: Topic, part: str) -> Topic:
    """The line of `family`, one of `NAMED`, for the part of that name."""
    return replace(family, name=family.name.replace(NAME, part))


def topic(name: str) -> Topic:
    """The table's line for `name`; KeyError when no robot has such a topic."""
    if name in _BY_NAME:
        return _BY_NAME[name]
    for pattern, family in _NAMED:
        if pattern.fullmatch(name):
            return replace(family, name=name)
    raise KeyError(name)
