"""pilothouse_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, TypeAlias

from msgspec import Meta, field

from bridge.msgs.arrays import Float32Array, Float64Array
from bridge.msgs.base import Msg, int32
from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.pilothouse_msgs.part1 import CommandRequest, CommandResponse
from bridge.msgs.pilothouse_msgs.part2 import Mission, Place, TaskOrder
from bridge.msgs.std_msgs import Header

__all__ = [
    "RecallMissionRequest",
    "RecallMissionResponse",
    "RobotInfo",
    "RudderState",
    "RunTaskFeedback",
    "RunTaskGoal",
    "RunTaskResult",
    "Schedule",
    "ScheduledTask",
    "SetMissionRequest",
    "SetMissionResponse",
    "SetModeRequest",
    "SetModeResponse",
    "SetOptionRequest",
    "SetOptionResponse",
    "SetPlaceRequest",
    "SetPlaceResponse",
    "SetQueueRequest",
    "SetQueueResponse",
    "SetScheduleRequest",
    "SetScheduleResponse",
    "SonarRing",
    "StartTaskRequest",
    "TaskProgress",
]

_Boolx7: TypeAlias = Annotated[list[bool], Meta(min_length=7, max_length=7)]


class RecallMissionRequest(CommandRequest, frozen=True, gc=False):
    """Make a kept mission the stored one."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RecallMissionRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string", "string")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    name: str = ""
    """What it was stored as."""


class RecallMissionResponse(CommandResponse, frozen=True, gc=False):
    """What `RecallMission` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RecallMissionResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")


class RobotInfo(Msg, frozen=True, gc=False):
    """Who this robot is and what it can do; latched on /robot/info."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RobotInfo"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "string",
        "string",
        "string",
        "string",
        "float64",
        "float64",
        "float64",
        "string[]",
        "float64",
        "float64",
        "float64",
        "string[]",
        "string[]",
        "float64",
    )
    UNITS: ClassVar[dict[str, str]] = {
        "max_speed": "m/s",
        "max_yaw_rate": "rad/s",
        "radius": "m",
        "latitude": "deg",
        "longitude": "deg",
        "camera_fov": "rad",
        "laser_x": "m",
    }
    name: str = ""
    """What people call it, as in Patrol-1."""
    kind: str = ""
    """wheels, ackermann, boat, hexapod or quadrotor."""
    model: str = ""
    """What the --robot option calls it, as in patrol."""
    description: str = ""
    """The kind in plain words, as in Differential drive."""
    world: str = ""
    """Name of the place or simulated world."""
    max_speed: float = 0.0
    """Greatest speed, along any direction [m/s]."""
    max_yaw_rate: float = 0.0
    """Greatest turn rate [rad/s], either way."""
    radius: float = 0.0
    """Of the circle that the body fits in [m]."""
    cameras: list[str] = []
    """Names of the camera streams; each is served at ws://HOST:PORT/camera/NAME."""
    latitude: float = math.nan
    """Of the map frame's origin [deg]; NaN when the map has no place on earth."""
    longitude: float = math.nan
    """Of the map frame's origin [deg]."""
    camera_fov: float = math.nan
    """Horizontal field of view of the first camera [rad]."""
    manoeuvres: list[str] = []
    """Which kinds of pilothouse_msgs/Manoeuvre it knows; empty for one that knows twists only."""
    payloads: list[str] = []
    """Names of the payloads that are mounted."""
    laser_x: float = 0.0
    """How far its laser is ahead of base_link [m]."""


class RudderState(Msg, frozen=True, gc=False):
    """The rudder and the propeller of a boat."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RudderState"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "float64", "float64", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"angle": "rad", "wanted": "rad", "thrust": "N"}
    header: Header = Header()
    """Frame base_link."""
    angle: float = 0.0
    """[rad], positive turns the boat to the left."""
    wanted: float = 0.0
    """Where the rudder is told to go [rad]."""
    throttle: float = 0.0
    """Told to the propeller, a share of its full thrust, -1 to 1."""
    thrust: float = 0.0
    """Of the propeller [N], negative astern."""


class TaskProgress(Msg, frozen=True, gc=False):
    """How far the running task is; /task/progress at 2 Hz, only while one runs."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/TaskProgress"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "int32", "float64", "float64", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"distance_to_next": "m", "time_left": "s", "distance_driven": "m"}
    stamp: Time = Time()
    """When it was reckoned."""
    task_id: int32 = 0
    """That of TaskStatus."""
    progress: float = math.nan
    """Of this lap, or of the whole where laps are counted: 0 to 1."""
    distance_to_next: float = math.nan
    """Along the path [m]."""
    time_left: float = math.nan
    """Estimate to the end of this lap, or of the whole where laps are counted [s]."""
    distance_driven: float = 0.0
    """In this run [m]."""


class RunTaskFeedback(TaskProgress, frozen=True, gc=False):
    """How far `RunTask` is."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RunTaskFeedback"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "int32", "float64", "float64", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"distance_to_next": "m", "time_left": "s", "distance_driven": "m"}


class StartTaskRequest(CommandRequest, frozen=True, gc=False):
    """Start a task."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/StartTaskRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "float64",
        "float64",
        "string",
        "string",
        "string",
        "pilothouse_msgs/TaskOrder",
    )
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    task: str = "patrol"
    """patrol or go_home; counts only while the order's own task is empty."""
    order: TaskOrder = field(default_factory=TaskOrder)
    """What to do; with its task empty, the field `task` says it."""


class RunTaskGoal(StartTaskRequest, frozen=True, gc=False):
    """Run a task and be told what became of it. Taking the goal back ends the task."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RunTaskGoal"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "float64",
        "float64",
        "string",
        "string",
        "string",
        "pilothouse_msgs/TaskOrder",
    )
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}


class RunTaskResult(Msg, frozen=True, gc=False):
    """What `RunTask` came to."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RunTaskResult"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int32", "string", "string", "int32")
    task_id: int32 = 0
    """Number of this run, as in TaskStatus."""
    state: str = ""
    """SUCCEEDED; whatever else became of it is told as a failure with its reason."""
    message: str = ""
    """One sentence: what was done."""
    visited: int32 = 0
    """Waypoints reached."""


class ScheduledTask(Msg, frozen=True, gc=False):
    """A task that starts by itself, at a time of day or every so often."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/ScheduledTask"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "int32",
        "bool",
        "pilothouse_msgs/TaskOrder",
        "string",
        "bool[7]",
        "float64",
        "time",
    )
    UNITS: ClassVar[dict[str, str]] = {"every": "s"}
    id: int32 = 0
    """Given by the robot; 0 asks for a new one."""
    enabled: bool = True
    """It starts when its time comes; kept and not started otherwise."""
    order: TaskOrder = field(default_factory=TaskOrder)
    """What to do."""
    at: str = ""
    """Time of day as HH:MM, local time of the robot; empty when `every` says it."""
    days: _Boolx7 = field(default_factory=lambda: [True, True, True, True, True, True, True])
    """Days on which `at` counts, Monday first."""
    every: float = 0.0
    """From one start to the next [s]; 0 when `at` says it."""
    next: Time = Time()
    """When it starts next, operators' clock, told by the robot; 0 for never."""


class Schedule(Msg, frozen=True, gc=False):
    """All that starts by itself; latched on /schedule, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Schedule"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "pilothouse_msgs/ScheduledTask[]")
    stamp: Time = Time()
    """When it changed, operators' clock."""
    tasks: list[ScheduledTask] = []
    """In the order of their ids."""


class SetMissionRequest(CommandRequest, frozen=True, gc=False):
    """Store a mission on the robot."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetMissionRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "float64",
        "float64",
        "string",
        "string",
        "pilothouse_msgs/Mission",
    )
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    mission: Mission = field(default_factory=Mission)
    """Replaces what was stored."""


class SetMissionResponse(CommandResponse, frozen=True, gc=False):
    """What `SetMission` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetMissionResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")


class SetModeRequest(CommandRequest, frozen=True, gc=False):
    """Give the robot to a person or to its task."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetModeRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string", "string")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    mode: str = ""
    """MANUAL pauses the task, AUTO goes on with it."""


class SetModeResponse(CommandResponse, frozen=True, gc=False):
    """What `SetMode` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetModeResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")


class SetOptionRequest(CommandRequest, frozen=True, gc=False):
    """Change one of the robot's settings; it is kept over restarts."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetOptionRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "float64",
        "float64",
        "string",
        "string",
        "string",
        "string",
    )
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    name: str = ""
    """follow_link or lost_link_stops_task."""
    value: str = ""
    """on or off."""


class SetOptionResponse(CommandResponse, frozen=True, gc=False):
    """What `SetOption` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetOptionResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")


class SetPlaceRequest(CommandRequest, frozen=True, gc=False):
    """Store a place, or change the one with its id."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetPlaceRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "float64",
        "float64",
        "string",
        "string",
        "pilothouse_msgs/Place",
    )
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    place: Place = Place()
    """Replaces what was stored under its id; 0 makes a new one."""


class SetPlaceResponse(CommandResponse, frozen=True, gc=False):
    """What `SetPlace` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetPlaceResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "int32")
    id: int32 = 0
    """Of the place; 0 when it was not accepted."""


class SetQueueRequest(CommandRequest, frozen=True, gc=False):
    """Replace what comes after the task that runs."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetQueueRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "float64",
        "float64",
        "string",
        "string",
        "int32",
        "pilothouse_msgs/TaskOrder[]",
    )
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    revision: int32 = 0
    """That of the TaskQueue it was made from; refused when the queue has changed since."""
    orders: list[TaskOrder] = []
    """Waiting, the next one first; those with an id stay what they were."""


class SetQueueResponse(CommandResponse, frozen=True, gc=False):
    """What `SetQueue` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetQueueResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")


class SetScheduleRequest(CommandRequest, frozen=True, gc=False):
    """Store a scheduled task, or change the one with its id."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetScheduleRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "float64",
        "float64",
        "string",
        "string",
        "pilothouse_msgs/ScheduledTask",
    )
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    task: ScheduledTask = field(default_factory=ScheduledTask)
    """Replaces what was stored under its id; 0 makes a new one."""


class SetScheduleResponse(CommandResponse, frozen=True, gc=False):
    """What `SetSchedule` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetScheduleResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "int32")
    id: int32 = 0
    """Of the scheduled task; 0 when it was not accepted."""


class SonarRing(Msg, frozen=True, gc=False):
    """Distances all round by ultrasound, each the nearest thing in a cone."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SonarRing"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "float64[]",
        "float64",
        "float64",
        "float64",
        "float64",
        "float32[]",
    )
    UNITS: ClassVar[dict[str, str]] = {
        "bearings": "rad",
        "field_of_view": "rad",
        "radius": "m",
        "range_min": "m",
        "range_max": "m",
        "ranges": "m",
    }
    header: Header = Header()
    """Frame base_link."""
    bearings: Float64Array = field(default_factory=Float64Array)
    """Of each cone's middle in base_link [rad], 0 ahead, positive to the left."""
    field_of_view: float = 0.0
    """Width of a cone [rad]."""
    radius: float = 0.0
    """From the middle of the robot to each sonar [m]."""
    range_min: float = 0.0
    """Shortest that can be measured [m]."""
    range_max: float = 0.0
    """Longest [m]."""
    ranges: Float32Array = field(default_factory=Float32Array)
    """From each sonar [m]; +inf nothing in range, -inf too close (REP-117)."""
