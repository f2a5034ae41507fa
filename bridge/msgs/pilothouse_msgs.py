"""pilothouse_msgs: what ROS has no type for. The same definitions as ROS text are in `pilothouse_msgs/`."""

from __future__ import annotations

import math
from typing import ClassVar

from bridge.msgs.base import Msg
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.std_msgs import Header, Time

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
    "SetMissionRequest",
    "StartTaskRequest",
    "TaskProgress",
    "TaskStatus",
    "Waypoint",
]


MOTIONS = ("loop", "random", "intermittent")
"""In what order and with which pauses a mission's points are visited."""
LONGEST_DWELL = 600.0
"""Longest stay at a point in intermittent motion [s]."""
MOST_LAPS = 999


class RobotInfo(Msg, frozen=True, gc=False):
    """Who this robot is and what it can do; latched on `/robot/info`."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RobotInfo"
    name: str = ""
    """What people call it, as in `Patrol-1`."""
    kind: str = ""
    """`wheels`, `ackermann`, `boat`, `hexapod` or `quadrotor`."""
    model: str = ""
    """What the `--robot` option calls it, as in `patrol`."""
    description: str = ""
    """The kind in plain words, as in `Differential drive`."""
    world: str = ""
    max_speed: float = 0.0
    """[m/s]"""
    max_yaw_rate: float = 0.0
    """[rad/s]"""
    radius: float = 0.0
    """Of the circle that the body fits in [m]."""
    cameras: list[str] = []
    """Names of the camera streams; each is served at `ws://HOST:PORT/camera/NAME`."""
    latitude: float = math.nan
    """Of the map frame's origin [deg]; NaN when the map has no place on earth."""
    longitude: float = math.nan
    """Of the map frame's origin [deg]."""
    camera_fov: float = math.nan
    """Horizontal field of view of the first camera [rad]."""


class Waypoint(Msg, frozen=True, gc=False):
    """A place to pass, in the `map` frame."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Waypoint"
    x: float = 0.0
    """[m]"""
    y: float = 0.0
    """[m]"""
    yaw: float = math.nan
    """Direction to stand in [rad]; NaN when any will do."""
    name: str = ""


class Mission(Msg, frozen=True, gc=False):
    """Where to patrol and how."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Mission"
    stamp: Time = Time()
    """When the robot stored it; 0 when it never was."""
    waypoints: list[Waypoint] = []
    home: list[Waypoint] = []
    """The place to return to: one waypoint, or none when it is not set."""
    motion: str = "loop"
    """`loop`, `random` or `intermittent`."""
    dwell: float = 5.0
    """How long to stand at each point in intermittent motion [s]."""
    laps: int = 0
    """Rounds to make; 0 goes on until stopped."""
    stop_on_intruder: bool = False


class TaskStatus(Msg, frozen=True, gc=False):
    """What the robot is doing for the operator; latched on `/task/status`, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/TaskStatus"
    stamp: Time = Time()
    task_id: int = 0
    """Number of this run; 0 before the first."""
    task: str = ""
    """`patrol`, `go_home` or empty."""
    state: str = "IDLE"
    """`IDLE`, `RUNNING`, `PAUSED`, `SUCCEEDED`, `CANCELED` or `FAILED`."""
    reason: str = ""
    """One sentence for the operator: what it does and why."""
    motion: str = ""
    waypoint: int = 0
    """Number of the waypoint it is heading for, from 1; 0 for none."""
    waypoints: int = 0
    lap: int = 0
    """From 1."""
    laps: int = 0
    """0 until stopped."""
    visited: int = 0
    """Waypoints reached in this run."""


class TaskProgress(Msg, frozen=True, gc=False):
    """How far the running task is; `/task/progress` at 2 Hz, only while one runs."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/TaskProgress"
    stamp: Time = Time()
    task_id: int = 0
    progress: float = math.nan
    """Of this lap, or of the whole where laps are counted: 0 to 1."""
    distance_to_next: float = math.nan
    """Along the path [m]."""
    time_left: float = math.nan
    """Estimate to the end of this lap, or of the whole where laps are counted [s]."""
    distance_driven: float = 0.0
    """In this run [m]."""


class ControlStatus(Msg, frozen=True, gc=False):
    """Who steers and whether it may move; latched on `/control/status`, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/ControlStatus"
    stamp: Time = Time()
    mode: str = "MANUAL"
    """`MANUAL`, `AUTO`, `PAUSED` or `STOPPED`."""
    driver: str = ""
    """Name of who has control; empty when it is free."""
    driver_id: str = ""
    """The `client_id` that acquired it."""
    stopped: bool = False
    """STOP is latched: nothing moves until it is released."""
    stopped_by: str = ""
    """Who pressed STOP."""
    at_rest: bool = True
    """The wheels stand still, as measured."""


class Event(Msg, frozen=True, gc=False):
    """Something that happened; `/events`, each once. `/events/get` tells what was missed."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Event"
    id: int = 0
    """Counts from 1 for each run of the robot side."""
    boot: str = ""
    """Identity of this run of the robot side; a new one starts the numbers anew."""
    stamp: Time = Time()
    level: str = "info"
    """`info`, `ok`, `warn` or `alarm`."""
    kind: str = ""
    """`waypoint`, `intruder`, `task`, `command`, `mission`, `contact`, `battery`, `control`, `stop` or `localisation`."""
    text: str = ""
    """One sentence for the operator."""
    position: Point = Point(math.nan, math.nan, math.nan)
    """Where in `map` [m]; NaN when it has no place."""


class Intruder(Msg, frozen=True, gc=False):
    """A thing that does not belong here."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Intruder"
    id: int = 0
    class_id: str = "cone"
    position: Point = Point()
    """In `map` [m]."""
    first_seen: Time = Time()
    sightings: int = 1


class IntruderArray(Msg, frozen=True, gc=False):
    """All intruders known; latched on `/intruders`, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/IntruderArray"
    header: Header = Header()
    intruders: list[Intruder] = []


class Bumper(Msg, frozen=True, gc=False):
    """The bumper ring."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Bumper"
    header: Header = Header()
    pressed: bool = False
    bearing: float = math.nan
    """Direction of the contact in `base_link` [rad]; NaN when there is none."""


class CommandRequest(Msg, frozen=True, gc=False):
    """A one-shot command. An empty request, as of std_srvs/Trigger, is one without identity or expiry."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/CommandRequest"
    command_id: str = ""
    """Unique per command; the same id sent again gets the first answer and is not executed twice."""
    stamp: float = math.nan
    """When the operator gave it [s], operators' clock; NaN when the sender does not know it."""
    valid_for: float = 5.0
    """Refused when older than this on arrival [s]."""
    client_id: str = ""
    """Who asks; stays the same over reconnects."""
    client_name: str = ""
    """What to call who asks, as in `tablet-B`."""


class CommandResponse(Msg, frozen=True, gc=False):
    """The answer to a command. Its first two fields are those of std_srvs/Trigger."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/CommandResponse"
    success: bool = False
    message: str = ""
    """One sentence: what was accepted, or why not and what is allowed."""


class StartTaskRequest(CommandRequest, frozen=True, gc=False):
    """Start a task on the stored mission."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/StartTaskRequest"
    task: str = "patrol"


class SetMissionRequest(CommandRequest, frozen=True, gc=False):
    """Store a mission on the robot."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetMissionRequest"
    mission: Mission = Mission()


class GetMissionRequest(Msg, frozen=True, gc=False):
    """Ask for the stored mission."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetMissionRequest"


class GetMissionResponse(Msg, frozen=True, gc=False):
    """The stored mission."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetMissionResponse"
    success: bool = False
    message: str = ""
    mission: Mission = Mission()


class GetEventsRequest(Msg, frozen=True, gc=False):
    """Ask for the events after `since`."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetEventsRequest"
    since: int = 0
    boot: str = ""
    """The `boot` that `since` belongs to; another one gives all events of this run."""


class GetEventsResponse(Msg, frozen=True, gc=False):
    """Events, oldest first; the newest 500 are kept."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetEventsResponse"
    events: list[Event] = []
