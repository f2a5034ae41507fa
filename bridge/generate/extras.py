"""Extras of our own classes that ROS text cannot express: methods, names that are no ROS constants, defaults,
ancestry.

None of it changes the messages on the wire. Types that are not named here are made by their text alone.
"""

from __future__ import annotations

from bridge.generate.model import Field, Kind

__all__ = ["ALSO", "BASES", "DEFAULTS", "EXTENDS", "ROS1_FIELDS"]

BASES = {
    "geometry_msgs/Quaternion": "Quaternion",
    "geometry_msgs/Twist": "Twist",
}
"""Classes with methods, by the name of their base class in `bridge.msgs.additions`."""

EXTENDS = {
    "pilothouse_msgs/StartTaskRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/StartTaskResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/RunTaskGoal": "pilothouse_msgs/StartTaskRequest",
    "pilothouse_msgs/RunTaskFeedback": "pilothouse_msgs/TaskProgress",
    "pilothouse_msgs/SetMissionRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/SetMissionResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/SetPlaceRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/SetPlaceResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/DeletePlaceRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/DeletePlaceResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/SetQueueRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/SetQueueResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/SetScheduleRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/SetScheduleResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/DeleteScheduleRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/DeleteScheduleResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/GetHistoryRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/GetHistoryResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/GetIntruderPictureRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/GetIntruderPictureResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/AcknowledgeEventsRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/AcknowledgeEventsResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/SetModeRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/SetModeResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/ChoosePlaceRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/ChoosePlaceResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/SetOptionRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/SetOptionResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/SetLightsRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/SetLightsResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/MoveArmRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/MoveArmResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/GetMissionsRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/GetMissionsResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/RecallMissionRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/RecallMissionResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/BringUpGatewayRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/BringUpGatewayResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/BringDownGatewayRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/BringDownGatewayResponse": "pilothouse_msgs/CommandResponse",
    "pilothouse_msgs/SetPayloadRequest": "pilothouse_msgs/CommandRequest",
    "pilothouse_msgs/SetPayloadResponse": "pilothouse_msgs/CommandResponse",
}
"""Classes that begin with all fields of another one, whose subclass they are."""

ROS1_FIELDS = {
    "std_msgs/Header": (
        Field(
            "seq",
            Kind("uint32"),
            comment="Number of the message as its publisher counts. ROS 1 alone has it, as the first field; 0 where nobody counts.",
        ),
    )
}
"""Fields that the text of ROS 2 lacks and ROS 1 has; they stand behind the others in the class."""

ALSO: dict[str, dict[str, tuple[str, ...]]] = {
    "std_msgs": {"bridge.msgs.builtin_interfaces": ("Duration", "Time")},
    "geometry_msgs": {"bridge.msgs.additions": ("zeros36",)},
    "pilothouse_msgs": {
        "bridge.msgs.additions": (
            "MAX_DWELL",
            "MANOEUVRES",
            "MAX_LAPS",
            "MOTIONS",
            "PLACE_KINDS",
            "REACTIONS",
            "TASKS",
        )
    },
}
"""Names that a package has from elsewhere."""

DEFAULTS = {
    "pilothouse_msgs/RobotInfo": dict.fromkeys(("latitude", "longitude", "camera_fov"), "math.nan"),
    "pilothouse_msgs/Waypoint": dict.fromkeys(("yaw", "height"), "math.nan"),
    "pilothouse_msgs/TaskProgress": dict.fromkeys(("progress", "distance_to_next", "time_left"), "math.nan"),
    "pilothouse_msgs/Event": {"position": "Point(math.nan, math.nan, math.nan)"},
    "pilothouse_msgs/Bumper": {"bearing": "math.nan"},
    "pilothouse_msgs/CommandRequest": {"stamp": "math.nan"},
    "pilothouse_msgs/StartTaskRequest": {"stamp": "math.nan"},
    "pilothouse_msgs/SetMissionRequest": {"stamp": "math.nan"},
    "pilothouse_msgs/Place": {"yaw": "math.nan"},
    "pilothouse_msgs/TaskOrder": dict.fromkeys(
        ("heading", "speed", "throttle", "height", "duration", "charge_to"), "math.nan"
    ),
    "pilothouse_msgs/Limits": dict.fromkeys(
        (
            "max_speed",
            "max_yaw_rate",
            "min_depth",
            "max_depth",
            "max_height",
            "max_slope",
            "floor",
            "ceiling",
            "clearance",
        ),
        "math.nan",
    ),
    "pilothouse_msgs/Manoeuvre": dict.fromkeys(("speed", "throttle", "yaw", "height"), "math.nan"),
    "pilothouse_msgs/ArmOrder": {
        "point": "Point(math.nan, math.nan, math.nan)",
        "pitch": "math.nan",
        "gripper": "math.nan",
    },
    "pilothouse_msgs/ArmState": {"gripper_wanted": "math.nan"},
    "pilothouse_msgs/Compass": {"heading": "math.nan"},
    "pilothouse_msgs/FlightState": {"height": "math.nan"},
    "pilothouse_msgs/AckermannState": {"turning_radius": "math.inf"},
    "pilothouse_msgs/Following": {"distance": "math.nan"},
    "pilothouse_msgs/LineSensor": {"spacing": "math.nan"},
    "pilothouse_msgs/Person": dict.fromkeys(("ends", "last_seen"), "math.nan"),
    "pilothouse_msgs/PairScanResponse": {"ends": "math.nan"},
    "pilothouse_msgs/PairFinishResponse": {"ends": "math.nan"},
    "pilothouse_msgs/GetMeResponse": {"ends": "math.nan"},
    "pilothouse_msgs/RunTaskGoal": {"stamp": "math.nan"},
    "pilothouse_msgs/RunTaskFeedback": dict.fromkeys(
        ("progress", "distance_to_next", "time_left"), "math.nan"
    ),
    "sensor_msgs/BatteryState": {
        **dict.fromkeys(
            ("voltage", "temperature", "current", "charge", "capacity", "design_capacity", "percentage"),
            "math.nan",
        ),
        "present": "True",
    },
    "sensor_msgs/CompressedImage": {"format": '"jpeg"'},
    "sensor_msgs/NavSatFix": dict.fromkeys(("latitude", "longitude", "altitude"), "math.nan"),
    "sensor_msgs/NavSatStatus": {"service": "1"},
    "sensor_msgs/Range": {"range": "math.nan"},
}
"""Default values as Python, for fields where ROS's zero would be taken for a measurement."""
