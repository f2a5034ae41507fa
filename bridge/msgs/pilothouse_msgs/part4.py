"""pilothouse_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

from typing import ClassVar

from msgspec import field

from bridge.msgs.arrays import Float32Array, Float64Array
from bridge.msgs.base import Msg, int32
from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.pilothouse_msgs.part1 import CommandRequest, CommandResponse
from bridge.msgs.pilothouse_msgs.part2 import TaskOrder
from bridge.msgs.pilothouse_msgs.part3 import Place, ScheduledTask
from bridge.msgs.std_msgs import Header

__all__ = [
    "SetOptionRequest",
    "SetOptionResponse",
    "SetPlaceRequest",
    "SetPlaceResponse",
    "SetQueueRequest",
    "SetQueueResponse",
    "SetScheduleRequest",
    "SetScheduleResponse",
    "SonarRing",
    "StartTaskResponse",
    "TagRead",
    "TaskQueue",
    "TaskStatus",
]


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
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


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
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "bool",
        "string",
        "string",
        "string",
        "diagnostic_msgs/KeyValue[]",
        "int32",
    )
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
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


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
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "bool",
        "string",
        "string",
        "string",
        "diagnostic_msgs/KeyValue[]",
        "int32",
    )
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


class StartTaskResponse(CommandResponse, frozen=True, gc=False):
    """What `StartTask` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/StartTaskResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


class TagRead(Msg, frozen=True, gc=False):
    """A card at the robot's reader; /tag, once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/TagRead"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "string")
    header: Header = Header()
    """When it was read, robot's clock."""
    tag: str = ""
    """What was read; empty when the card is gone."""


class TaskQueue(Msg, frozen=True, gc=False):
    """What comes after the task that runs; latched on /task/queue, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/TaskQueue"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "int32", "pilothouse_msgs/TaskOrder[]", "string")
    stamp: Time = Time()
    """When it changed, operators' clock."""
    revision: int32 = 0
    """Counts every change; /task/queue/set names the one that it was made from."""
    orders: list[TaskOrder] = []
    """Waiting, the next one first."""
    held: str = ""
    """Why it waits for /task/resume, as the end of a sentence; empty while it goes on by itself."""


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
        "string",
        "string",
        "string",
        "string[]",
        "string",
        "string",
        "diagnostic_msgs/KeyValue[]",
    )
    stamp: Time = Time()
    """When it changed."""
    task_id: int32 = 0
    """Number of this run; 0 before the first."""
    task: str = ""
    """patrol, deliver, guide, go_to, go_home, hold, follow_heading, dock or empty."""
    state: str = "IDLE"
    """IDLE, RUNNING, PAUSED, SUCCEEDED, CANCELED, FAILED or INTERRUPTED (a restart cut it; resume or
    cancel it).
    """
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
    phase: str = ""
    """driving, waiting, dwelling, holding, turning, planning (looks for a way), docking, circling, taking
    off, landing or surfacing; empty when it does none of them.
    """
    asks: str = ""
    """A question that /task/confirm answers, as in: Has it been picked up at Office 12? Empty for none."""
    place: str = ""
    """Name of the place it heads for or stands at; empty for none."""
    places: list[str] = []
    """Names of the places of this task, in their order."""
    code: str = ""
    """What the reason says, in one word of docs/bridge.md; empty where it has none."""
    actor_id: str = ""
    """The client_id of whom the reason is about; empty when nobody, or it is not known."""
    parameters: list[KeyValue] = []
    """What the reason names, by the keys that the code has."""
