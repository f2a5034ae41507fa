"""pilothouse_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

import math
from typing import ClassVar

from msgspec import field

from bridge.msgs.arrays import Float32Array
from bridge.msgs.base import Msg, int32
from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.geometry_msgs import Point, Polygon, Twist
from bridge.msgs.pilothouse_msgs.part1 import CommandRequest, CommandResponse
from bridge.msgs.std_msgs import Header

__all__ = [
    "GetHistoryRequest",
    "GetHistoryResponse",
    "GetMissionRequest",
    "GetMissionResponse",
    "GetMissionsRequest",
    "GetMissionsResponse",
    "Intruder",
    "IntruderArray",
    "KeptMission",
    "LightState",
    "Limits",
    "LineSensor",
    "Manoeuvre",
    "Mission",
    "TaskOrder",
    "TaskRun",
    "Waypoint",
]


class GetHistoryRequest(CommandRequest, frozen=True, gc=False):
    """Ask for the tasks that were done."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetHistoryRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "float64",
        "float64",
        "string",
        "string",
        "int32",
        "int32",
    )
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    before: int32 = 0
    """Only runs with a smaller number; 0 begins with the newest."""
    limit: int32 = 50
    """At most so many."""


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


class TaskOrder(Msg, frozen=True, gc=False):
    """What an operator wants done: a task and all that it needs. Used to start one, to queue it and to
    schedule it.
    """

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/TaskOrder"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "int32",
        "string",
        "string[]",
        "pilothouse_msgs/Waypoint[]",
        "string",
        "string",
        "float64",
        "float64",
        "float64",
        "float64",
        "float64",
    )
    UNITS: ClassVar[dict[str, str]] = {"heading": "rad", "speed": "m/s", "height": "m", "duration": "s"}
    id: int32 = 0
    """Given by the robot; 0 for a new one."""
    task: str = ""
    """patrol, deliver, guide, go_to, go_home, hold, follow_heading, dock, take_off, land or surface; which
    ones a robot knows is in its RobotInfo.
    """
    places: list[str] = []
    """Names. Patrol: none takes the stored mission. Deliver: from, to and, if it shall go on to one then,
    a third. Guide: in this order. Go_to and dock: one.
    """
    goals: list[Waypoint] = []
    """Instead of places, for go_to: points in the map frame."""
    message: str = ""
    """What to tell the person who picks it up or is led; empty when there is nothing to tell."""
    recipient_tag: str = ""
    """What the robot's reader reads of the addressee's card, in place of the place's own; empty for that."""
    heading: float = math.nan
    """Where follow_heading goes [rad], 0 east, anticlockwise; NaN for where it points."""
    speed: float = math.nan
    """How fast [m/s]; NaN for the robot's cruising speed, or what the throttle says."""
    throttle: float = math.nan
    """For follow_heading in place of a speed: share of the full power, -1 to 1; NaN where the speed says
    it.
    """
    height: float = math.nan
    """For take_off, hold and follow_heading: to hold above the map's origin [m], below water negative; NaN
    the usual or the present one.
    """
    duration: float = math.nan
    """How long to hold or to follow the heading [s]; NaN until stopped."""


class TaskRun(Msg, frozen=True, gc=False):
    """A task that was done or is under way, as the robot's history has it."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/TaskRun"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "int32",
        "pilothouse_msgs/TaskOrder",
        "time",
        "time",
        "string",
        "string",
        "float64",
        "int32",
        "string",
        "string",
        "string",
        "diagnostic_msgs/KeyValue[]",
    )
    UNITS: ClassVar[dict[str, str]] = {"distance": "m"}
    id: int32 = 0
    """Number of this run, as in TaskStatus."""
    order: TaskOrder = field(default_factory=TaskOrder)
    """What was asked."""
    started: Time = Time()
    """When it began, operators' clock."""
    ended: Time = Time()
    """When it ended, operators' clock; 0 while it runs."""
    state: str = ""
    """As in TaskStatus: RUNNING, PAUSED, SUCCEEDED, CANCELED, FAILED or INTERRUPTED."""
    reason: str = ""
    """One sentence: what became of it and why."""
    distance: float = 0.0
    """Driven in this run [m]."""
    visited: int32 = 0
    """Waypoints or places reached."""
    by: str = ""
    """Who started it; empty when the schedule or the robot did."""
    code: str = ""
    """What the reason says, in one word of docs/bridge.md; empty where it has none."""
    actor_id: str = ""
    """The client_id of whom the reason is about; empty when nobody, or it is not known."""
    parameters: list[KeyValue] = []
    """What the reason names, by the keys that the code has."""


class GetHistoryResponse(CommandResponse, frozen=True, gc=False):
    """What `GetHistory` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetHistoryResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "bool",
        "string",
        "string",
        "string",
        "diagnostic_msgs/KeyValue[]",
        "pilothouse_msgs/TaskRun[]",
    )
    runs: list[TaskRun] = []
    """Newest first."""


class GetMissionRequest(Msg, frozen=True, gc=False):
    """Ask for the stored mission."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetMissionRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


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
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "bool",
        "string",
        "pilothouse_msgs/Mission",
        "string",
        "string",
        "diagnostic_msgs/KeyValue[]",
    )
    success: bool = False
    """Always true."""
    message: str = ""
    """One sentence when none was stored yet, else empty."""
    mission: Mission = field(default_factory=Mission)
    """The stored mission."""
    code: str = ""
    """Why not, in one word of docs/bridge.md, as in stop_is_pressed; empty where it was accepted."""
    actor_id: str = ""
    """The client_id of whom the reason is about, as of who has control; empty when nobody, or it is not
    known.
    """
    parameters: list[KeyValue] = []
    """What the reason names, by the keys that the code has."""


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
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "bool",
        "string",
        "string",
        "string",
        "diagnostic_msgs/KeyValue[]",
        "string[]",
        "pilothouse_msgs/KeptMission[]",
    )
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


class LightState(Msg, frozen=True, gc=False):
    """The lights of a robot; to the robot, how they shall be."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/LightState"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "float64")
    header: Header = Header()
    """Frame base_link."""
    brightness: float = 0.0
    """0 off to 1 full."""


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


class Manoeuvre(Msg, frozen=True, gc=False):
    """How a robot moves until it is told otherwise, for what a twist alone does not say. To the robot an
    order; on /manoeuvre what it follows now.
    Which kinds a robot knows is in its RobotInfo. What a kind does not name below is not looked at.
    """

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Manoeuvre"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "string",
        "geometry_msgs/Twist",
        "float64",
        "float64",
        "float64",
        "float64",
        "float64",
        "float64",
        "float64",
    )
    UNITS: ClassVar[dict[str, str]] = {
        "speed": "m/s",
        "steering": "rad",
        "roll": "rad",
        "pitch": "rad",
        "yaw": "rad",
        "height": "m",
    }
    header: Header = Header()
    """Frame map."""
    kind: str = ""
    """twist, steer, course, tilt, hover, take_off, land, surface or rest."""
    twist: Twist = Twist()
    """twist: all of it. tilt: climb in linear.z, turn in angular.z."""
    speed: float = math.nan
    """steer, course: ahead [m/s]; NaN where the throttle says it."""
    throttle: float = math.nan
    """steer, course: share of the full power, -1 to 1; NaN where the speed says it."""
    steering: float = 0.0
    """steer: angle of the front wheels [rad], of the rudder [rad]; positive to the left."""
    roll: float = 0.0
    """tilt: to hold [rad]."""
    pitch: float = 0.0
    """tilt: to hold [rad], positive nose down."""
    yaw: float = math.nan
    """course, hover: to hold in map [rad]; NaN the present one."""
    height: float = math.nan
    """course, hover, take_off: to hold above the map's origin [m], below water negative; NaN the present
    or the usual one.
    """
