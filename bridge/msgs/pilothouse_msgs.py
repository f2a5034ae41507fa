"""pilothouse_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

import math
from typing import ClassVar

from msgspec import field

from bridge.msgs.additions import LONGEST_DWELL, MOST_LAPS, MOTIONS
from bridge.msgs.base import Msg, int32
from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.std_msgs import Header

__all__ = [
    "Bumper",
    "CommandRequest",
    "CommandResponse",
    "ControlStatus",
    "Event",
    "GetEventsRequest",
    "GetEventsResponse",
    "GetMissionRequest",
    "GetMissionResponse",
    "Intruder",
    "IntruderArray",
    "LONGEST_DWELL",
    "MOST_LAPS",
    "MOTIONS",
    "Mission",
    "RobotInfo",
    "RunTaskFeedback",
    "RunTaskGoal",
    "RunTaskResult",
    "SetMissionRequest",
    "SetMissionResponse",
    "StartTaskRequest",
    "StartTaskResponse",
    "TaskProgress",
    "TaskStatus",
    "Waypoint",
]


class Bumper(Msg, frozen=True, gc=False):
    """The bumper ring."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Bumper"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "bool", "float64")
    UNITS: ClassVar[dict[str, str]] = {"bearing": "rad"}
    header: Header = Header()
    """Frame base_link."""
    pressed: bool = False
    """Something touches it."""
    bearing: float = math.nan
    """Direction of the contact in base_link [rad], 0 ahead, positive to the left; NaN when there is none."""


class CommandRequest(Msg, frozen=True, gc=False):
    """A one-shot command. An empty request, as of std_srvs/Trigger, is one without identity or expiry."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/CommandRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    command_id: str = ""
    """Unique per command; the same id sent again gets the first answer and is not executed twice."""
    stamp: float = math.nan
    """When the operator gave it [s], operators' clock; NaN when the sender does not know it."""
    valid_for: float = 5.0
    """Refused when older than this on arrival [s]."""
    client_id: str = ""
    """Who asks; stays the same over reconnects."""
    client_name: str = ""
    """What to call who asks, as in tablet-B."""


class CommandResponse(Msg, frozen=True, gc=False):
    """What `Command` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/CommandResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")
    success: bool = False
    """It was accepted."""
    message: str = ""
    """One sentence: what was accepted, or why not and what is allowed."""


class ControlStatus(Msg, frozen=True, gc=False):
    """Who steers and whether it may move; latched on /control/status, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/ControlStatus"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "string", "string", "string", "bool", "string", "bool")
    stamp: Time = Time()
    """When it changed."""
    mode: str = "MANUAL"
    """MANUAL, AUTO, PAUSED or STOPPED."""
    driver: str = ""
    """Name of who has control; empty when it is free."""
    driver_id: str = ""
    """The client_id that acquired it."""
    stopped: bool = False
    """STOP is latched: nothing moves until it is released."""
    stopped_by: str = ""
    """Who pressed STOP."""
    at_rest: bool = True
    """The wheels stand still, as measured."""


class Event(Msg, frozen=True, gc=False):
    """Something that happened; /events, each once. /events/get tells what was missed."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Event"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "int32",
        "string",
        "time",
        "string",
        "string",
        "string",
        "geometry_msgs/Point",
    )
    UNITS: ClassVar[dict[str, str]] = {"position": "m"}
    id: int32 = 0
    """Counts from 1 for each run of the robot side."""
    boot: str = ""
    """Identity of this run of the robot side; a new one starts the numbers anew."""
    stamp: Time = Time()
    """When it happened."""
    level: str = "info"
    """info, ok, warn or alarm."""
    kind: str = ""
    """waypoint, intruder, task, command, mission, contact, battery, control, stop or localisation."""
    text: str = ""
    """One sentence for the operator."""
    position: Point = Point(math.nan, math.nan, math.nan)
    """Where in map [m]; NaN when it has no place."""


class GetEventsRequest(Msg, frozen=True, gc=False):
    """Ask for the events after since."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetEventsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int32", "string")
    since: int32 = 0
    """Number of the last event that is known."""
    boot: str = ""
    """The boot that since belongs to; another one gives all events of this run."""


class GetEventsResponse(Msg, frozen=True, gc=False):
    """What `GetEvents` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetEventsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("pilothouse_msgs/Event[]",)
    events: list[Event] = []
    """Oldest first."""


class GetMissionRequest(Msg, frozen=True, gc=False):
    """Ask for the stored mission."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetMissionRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class Waypoint(Msg, frozen=True, gc=False):
    """A place to pass, in the map frame."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Waypoint"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("float64", "float64", "float64", "string")
    UNITS: ClassVar[dict[str, str]] = {"x": "m", "y": "m", "yaw": "rad"}
    x: float = 0.0
    """East of the map's origin [m]."""
    y: float = 0.0
    """North of the map's origin [m]."""
    yaw: float = math.nan
    """Direction to stand in [rad], 0 east, anticlockwise; NaN when any will do."""
    name: str = ""
    """What people call it; empty when it has no name."""


class Mission(Msg, frozen=True, gc=False):
    """Where to patrol and how."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Mission"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "time",
        "pilothouse_msgs/Waypoint[]",
        "pilothouse_msgs/Waypoint[]",
        "string",
        "float64",
        "int32",
        "bool",
    )
    UNITS: ClassVar[dict[str, str]] = {"dwell": "s"}
    stamp: Time = Time()
    """When the robot stored it; 0 when it never was."""
    waypoints: list[Waypoint] = []
    """Where to go, in the map frame."""
    home: list[Waypoint] = []
    """The place to return to: one waypoint, or none when it is not set."""
    motion: str = "loop"
    """loop, random or intermittent."""
    dwell: float = 5.0
    """How long to stand at each point in intermittent motion [s]."""
    laps: int32 = 0
    """Rounds to make; 0 goes on until stopped."""
    stop_on_intruder: bool = False
    """Pause when an intruder is found."""


class GetMissionResponse(Msg, frozen=True, gc=False):
    """What `GetMission` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetMissionResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "pilothouse_msgs/Mission")
    success: bool = False
    """Always true."""
    message: str = ""
    """One sentence when none was stored yet, else empty."""
    mission: Mission = field(default_factory=Mission)
    """The stored mission."""


class Intruder(Msg, frozen=True, gc=False):
    """A thing that does not belong here."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Intruder"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int32", "string", "geometry_msgs/Point", "time", "int32")
    UNITS: ClassVar[dict[str, str]] = {"position": "m"}
    id: int32 = 0
    """Counts from 1 for each run of the robot side."""
    class_id: str = "cone"
    """What it is."""
    position: Point = Point()
    """In map [m]."""
    first_seen: Time = Time()
    """When it was seen first."""
    sightings: int32 = 1
    """How often it was seen."""


class IntruderArray(Msg, frozen=True, gc=False):
    """All intruders known; latched on /intruders, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/IntruderArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "pilothouse_msgs/Intruder[]")
    header: Header = Header()
    """Frame map."""
    intruders: list[Intruder] = []
    """In the order of their ids."""


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
    )
    UNITS: ClassVar[dict[str, str]] = {
        "max_speed": "m/s",
        "max_yaw_rate": "rad/s",
        "radius": "m",
        "latitude": "deg",
        "longitude": "deg",
        "camera_fov": "rad",
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
    """Start a task on the stored mission."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/StartTaskRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string", "string")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    task: str = "patrol"
    """patrol or go_home."""


class RunTaskGoal(StartTaskRequest, frozen=True, gc=False):
    """Run a task on the stored mission and be told what became of it. Taking the goal back ends the task."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RunTaskGoal"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string", "string")
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


class StartTaskResponse(CommandResponse, frozen=True, gc=False):
    """What `StartTask` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/StartTaskResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")


class TaskStatus(Msg, frozen=True, gc=False):
    """What the robot is doing for the operator; latched on /task/status, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/TaskStatus"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "time",
        "int32",
        "string",
        "string",
        "string",
        "string",
        "int32",
        "int32",
        "int32",
        "int32",
        "int32",
    )
    stamp: Time = Time()
    """When it changed."""
    task_id: int32 = 0
    """Number of this run; 0 before the first."""
    task: str = ""
    """patrol, go_home, go_to (a single goal) or empty."""
    state: str = "IDLE"
    """IDLE, RUNNING, PAUSED, SUCCEEDED, CANCELED or FAILED."""
    reason: str = ""
    """One sentence for the operator: what it does and why."""
    motion: str = ""
    """loop, random or intermittent; empty without a patrol."""
    waypoint: int32 = 0
    """Number of the waypoint it is heading for, from 1; 0 for none."""
    waypoints: int32 = 0
    """How many waypoints there are."""
    lap: int32 = 0
    """From 1."""
    laps: int32 = 0
    """0 until stopped."""
    visited: int32 = 0
    """Waypoints reached in this run."""
