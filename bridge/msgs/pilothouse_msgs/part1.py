"""pilothouse_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

import math
from typing import ClassVar

from msgspec import field

from bridge.msgs.arrays import Int32Array
from bridge.msgs.base import Msg, int32
from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.std_msgs import Header

__all__ = [
    "AcknowledgeEventsRequest",
    "AcknowledgeEventsResponse",
    "Bumper",
    "Check",
    "Checklist",
    "CommandRequest",
    "CommandResponse",
    "ControlStatus",
    "DeletePlaceRequest",
    "DeletePlaceResponse",
    "DeleteScheduleRequest",
    "DeleteScheduleResponse",
    "Event",
    "Following",
    "GetEventsRequest",
    "GetEventsResponse",
    "GetHistoryRequest",
    "GetHistoryResponse",
    "GetMissionRequest",
    "TaskOrder",
    "TaskRun",
    "Waypoint",
]


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


class AcknowledgeEventsRequest(CommandRequest, frozen=True, gc=False):
    """Say that somebody has seen to events; the first who does so is remembered."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/AcknowledgeEventsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string", "int32[]")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    ids: Int32Array = field(default_factory=Int32Array)
    """Their numbers."""


class CommandResponse(Msg, frozen=True, gc=False):
    """What `Command` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/CommandResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")
    success: bool = False
    """It was accepted."""
    message: str = ""
    """One sentence: what was accepted, or why not and what is allowed."""


class AcknowledgeEventsResponse(CommandResponse, frozen=True, gc=False):
    """What `AcknowledgeEvents` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/AcknowledgeEventsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")


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


class Check(Msg, frozen=True, gc=False):
    """One line of the list that is looked through before the first motion."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Check"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "string", "string")
    name: str = ""
    """battery, sensors, position, stop or clock."""
    state: str = "unknown"
    """ok, bad or unknown."""
    text: str = ""
    """One sentence: what was found, and what to do about it when it is not good."""


class Checklist(Msg, frozen=True, gc=False):
    """What is looked through before the first motion; latched on /checklist, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Checklist"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "pilothouse_msgs/Check[]")
    stamp: Time = Time()
    """When it changed, operators' clock."""
    checks: list[Check] = []
    """Always the same ones in the same order."""


class ControlStatus(Msg, frozen=True, gc=False):
    """Who steers and whether it may move; latched on /control/status, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/ControlStatus"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "time",
        "string",
        "string",
        "string",
        "bool",
        "string",
        "bool",
        "string",
        "string",
        "time",
        "float64",
        "bool",
        "time",
        "bool",
    )
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
    requested_by: str = ""
    """Name of who asks the driver for control; empty when nobody does."""
    requested_by_id: str = ""
    """The client_id of who asks for it."""
    handover: Time = Time()
    """When control goes over unless the driver objects, operators' clock; 0 when nobody asks."""
    speed_cap: float = 1.0
    """Share of the full speed that the driver's link allows, 0 to 1."""
    follows_link: bool = True
    """The speed falls with the driver's link; /settings/set switches it."""
    stop_tested: Time = Time()
    """When STOP was last pressed and brought it to rest, operators' clock; 0 when never since it started."""
    lost_link_stops_task: bool = False
    """A task is paused when the link to the driver is lost; /settings/set switches it."""


class DeletePlaceRequest(CommandRequest, frozen=True, gc=False):
    """Forget a place."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/DeletePlaceRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string", "int32")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    id: int32 = 0
    """Of the place."""


class DeletePlaceResponse(CommandResponse, frozen=True, gc=False):
    """What `DeletePlace` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/DeletePlaceResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")


class DeleteScheduleRequest(CommandRequest, frozen=True, gc=False):
    """Forget a scheduled task."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/DeleteScheduleRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string", "int32")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    id: int32 = 0
    """Of the scheduled task."""


class DeleteScheduleResponse(CommandResponse, frozen=True, gc=False):
    """What `DeleteSchedule` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/DeleteScheduleResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")


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
        "string",
        "time",
    )
    UNITS: ClassVar[dict[str, str]] = {"position": "m"}
    id: int32 = 0
    """Counts from 1, over restarts of the robot side."""
    boot: str = ""
    """Identity of the log; a new one, of a log that was started fresh, starts the numbers anew."""
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
    acknowledged_by: str = ""
    """Who has seen to it; empty while nobody has."""
    acknowledged: Time = Time()
    """When, operators' clock; 0 while nobody has."""


class Following(Msg, frozen=True, gc=False):
    """Whether the person who is led comes along; /following."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Following"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "bool", "float64")
    UNITS: ClassVar[dict[str, str]] = {"distance": "m"}
    header: Header = Header()
    """When it was measured, robot's clock; frame base_link."""
    present: bool = False
    """Somebody follows."""
    distance: float = math.nan
    """To who follows [m]; NaN when it is not known."""


class GetEventsRequest(Msg, frozen=True, gc=False):
    """Ask for the events after since."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetEventsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int32", "string", "int32[]", "int32")
    since: int32 = 0
    """Number of the last event that is known."""
    boot: str = ""
    """The boot that since belongs to; of another one all are given, for an empty one the newest 500."""
    open: Int32Array = field(default_factory=Int32Array)
    """Earlier events that nobody has seen to, as far as is known; those that somebody has are given too."""
    most: int32 = 0
    """At most so many later events in one answer, the first of them; 0 for all, or the newest 500 of
    another boot.
    """


class GetEventsResponse(Msg, frozen=True, gc=False):
    """What `GetEvents` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetEventsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("pilothouse_msgs/Event[]", "bool", "int32")
    events: list[Event] = []
    """Oldest first."""
    more: bool = False
    """There are later ones: ask again, since the last of these."""
    oldest: int32 = 0
    """Number of the oldest event that is kept; 0 when there is none, or it is not known."""


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
    )
    UNITS: ClassVar[dict[str, str]] = {"heading": "rad", "speed": "m/s", "duration": "s"}
    id: int32 = 0
    """Given by the robot; 0 for a new one."""
    task: str = ""
    """patrol, deliver, guide, go_to, go_home, hold, follow_heading or dock."""
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
    """How fast [m/s]; NaN for the robot's cruising speed."""
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


class GetHistoryResponse(CommandResponse, frozen=True, gc=False):
    """What `GetHistory` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetHistoryResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "pilothouse_msgs/TaskRun[]")
    runs: list[TaskRun] = []
    """Newest first."""


class GetMissionRequest(Msg, frozen=True, gc=False):
    """Ask for the stored mission."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetMissionRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()
