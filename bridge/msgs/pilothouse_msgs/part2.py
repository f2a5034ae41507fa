"""pilothouse_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, TypeAlias

from msgspec import Meta, field

from bridge.msgs.arrays import Float32Array
from bridge.msgs.base import Msg, int32
from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.geometry_msgs import Point, Polygon
from bridge.msgs.pilothouse_msgs.part1 import CommandRequest, CommandResponse, TaskOrder, Waypoint
from bridge.msgs.std_msgs import Header

__all__ = [
    "GetMissionResponse",
    "GetMissionsRequest",
    "GetMissionsResponse",
    "Intruder",
    "IntruderArray",
    "KeptMission",
    "Limits",
    "LineSensor",
    "Mission",
    "Place",
    "PlaceArray",
    "RecallMissionRequest",
    "RecallMissionResponse",
    "RobotInfo",
    "RunTaskFeedback",
    "RunTaskGoal",
    "RunTaskResult",
    "Schedule",
    "ScheduledTask",
    "StartTaskRequest",
    "TaskProgress",
]

_Boolx7: TypeAlias = Annotated[list[bool], Meta(min_length=7, max_length=7)]


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
        "string",
        "string",
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
    """Pause when an intruder is found, whatever `on_intruder` says."""
    name: str = ""
    """What it is kept as; empty for a mission without a name."""
    on_intruder: str = ""
    """stop, report or circle when an intruder is found; empty reports it."""


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


class GetMissionsRequest(CommandRequest, frozen=True, gc=False):
    """Ask for the missions that are kept."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetMissionsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}


class KeptMission(Msg, frozen=True, gc=False):
    """A mission that is kept under a name."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/KeptMission"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "time", "int32", "string", "int32")
    name: str = ""
    """What it is kept as."""
    stamp: Time = Time()
    """When its newest revision was stored, operators' clock."""
    points: int32 = 0
    """Waypoints of it."""
    motion: str = ""
    """loop, random or intermittent."""
    revisions: int32 = 0
    """How many of its revisions are kept, 20 at most."""


class GetMissionsResponse(CommandResponse, frozen=True, gc=False):
    """What `GetMissions` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetMissionsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string[]", "pilothouse_msgs/KeptMission[]")
    names: list[str] = []
    """In the order of the alphabet."""
    missions: list[KeptMission] = []
    """The same with what is known of each."""


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


class Limits(Msg, frozen=True, gc=False):
    """What the robot's own configuration allows; latched on /limits, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Limits"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "float64",
        "float64",
        "float64",
        "float64",
        "float64",
        "float64",
        "geometry_msgs/Polygon[]",
        "geometry_msgs/Polygon[]",
    )
    UNITS: ClassVar[dict[str, str]] = {
        "max_speed": "m/s",
        "max_yaw_rate": "rad/s",
        "min_depth": "m",
        "max_depth": "m",
        "max_height": "m",
        "max_slope": "rad",
        "keep_in": "m",
        "keep_out": "m",
    }
    max_speed: float = math.nan
    """Greatest speed, along any direction [m/s]; NaN for none beside RobotInfo's."""
    max_yaw_rate: float = math.nan
    """Greatest turn rate [rad/s], either way; NaN for none beside RobotInfo's."""
    min_depth: float = math.nan
    """Least depth, positive down from the surface [m]; NaN for none."""
    max_depth: float = math.nan
    """Greatest depth, positive down from the surface [m]; NaN for none."""
    max_height: float = math.nan
    """Greatest height above the map's origin [m]; NaN for none."""
    max_slope: float = math.nan
    """Steepest ground or greatest tilt [rad]; NaN for none."""
    keep_in: list[Polygon] = []
    """Areas in map [m], of which it stays in at least one; none for everywhere."""
    keep_out: list[Polygon] = []
    """Areas in map [m] that it never enters, holes of the others included."""


class LineSensor(Msg, frozen=True, gc=False):
    """A row of cells that look down at the ground and measure how bright it is."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/LineSensor"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "float32[]", "float64")
    UNITS: ClassVar[dict[str, str]] = {"spacing": "m"}
    header: Header = Header()
    """Its frame; the cells lie along the frame's y axis."""
    values: Float32Array = field(default_factory=Float32Array)
    """From the leftmost cell to the rightmost one, 0 dark to 1 bright; NaN for a cell that tells nothing."""
    spacing: float = math.nan
    """Between the middles of two neighbouring cells [m]; NaN when not known."""


class Place(Msg, frozen=True, gc=False):
    """A named pose, so that people say Office 12 and never coordinates."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Place"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "int32",
        "string",
        "string",
        "string",
        "float64",
        "float64",
        "float64",
        "string",
        "string",
    )
    UNITS: ClassVar[dict[str, str]] = {"x": "m", "y": "m", "yaw": "rad"}
    id: int32 = 0
    """Given by the robot and never used again; 0 asks for a new place."""
    name: str = ""
    """What people call it; two places never have the same."""
    kind: str = "place"
    """place, office, home, dock, reception, lab or hall."""
    floor: str = "0"
    """The floor that it is on, as people call it."""
    x: float = 0.0
    """East of the map's origin [m]."""
    y: float = 0.0
    """North of the map's origin [m]."""
    yaw: float = math.nan
    """Direction to stand in [rad], 0 east, anticlockwise; NaN when any will do."""
    tag: str = ""
    """What the robot's reader reads of the card of who belongs here; empty when nobody has one."""
    note: str = ""
    """What to tell people who are led here; empty when there is nothing to tell."""


class PlaceArray(Msg, frozen=True, gc=False):
    """All places known; latched on /places, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/PlaceArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "pilothouse_msgs/Place[]")
    stamp: Time = Time()
    """When it changed, operators' clock."""
    places: list[Place] = []
    """In the order of their ids."""


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
