"""pilothouse_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, TypeAlias

from msgspec import Meta, field

from bridge.msgs.arrays import Float64Array
from bridge.msgs.base import Msg, int32
from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.pilothouse_msgs.part1 import ArmOrder, CommandRequest, CommandResponse
from bridge.msgs.pilothouse_msgs.part2 import Mission, TaskOrder
from bridge.msgs.std_msgs import Header

__all__ = [
    "MotorArray",
    "MoveArmRequest",
    "MoveArmResponse",
    "Place",
    "PlaceArray",
    "RecallMissionRequest",
    "RecallMissionResponse",
    "RobotInfo",
    "RudderState",
    "RunTaskFeedback",
    "RunTaskGoal",
    "RunTaskResult",
    "Schedule",
    "ScheduledTask",
    "SetLightsRequest",
    "SetLightsResponse",
    "SetMissionRequest",
    "SetMissionResponse",
    "SetModeRequest",
    "SetModeResponse",
    "StartTaskRequest",
    "TaskProgress",
]

_Boolx7: TypeAlias = Annotated[list[bool], Meta(min_length=7, max_length=7)]


class MotorArray(Msg, frozen=True, gc=False):
    """The motors of a robot: wheels, propeller, legs or rotors."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/MotorArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "string[]",
        "float64[]",
        "float64[]",
        "float64[]",
    )
    UNITS: ClassVar[dict[str, str]] = {"speeds": "rad/s", "torques": "N m", "temperatures": "degC"}
    header: Header = Header()
    """Frame base_link."""
    names: list[str] = []
    """Of each motor."""
    speeds: Float64Array = field(default_factory=Float64Array)
    """Of what the motor turns [rad/s]; of a leg its swing's greatest."""
    torques: Float64Array = field(default_factory=Float64Array)
    """There [N m]."""
    temperatures: Float64Array = field(default_factory=Float64Array)
    """Of the winding [degC]."""


class MoveArmRequest(CommandRequest, frozen=True, gc=False):
    """Where a mounted arm is to go."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/MoveArmRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "float64",
        "float64",
        "string",
        "string",
        "pilothouse_msgs/ArmOrder",
    )
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    order: ArmOrder = field(default_factory=ArmOrder)
    """By a pose's name, a point for the tip, or angles."""


class MoveArmResponse(CommandResponse, frozen=True, gc=False):
    """What `MoveArm` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/MoveArmResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


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
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


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
        "string[]",
        "float64",
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
        "laser_x": "m",
        "max_climb": "m/s",
        "max_tilt": "rad",
        "max_steering": "rad",
        "min_radius": "m",
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
    tasks: list[str] = []
    """Which tasks of pilothouse_msgs/TaskOrder it knows; empty for one that does not say."""
    max_climb: float = 0.0
    """Greatest speed up and down [m/s]; 0 for one that stays on the ground or the water."""
    max_tilt: float = 0.0
    """Greatest roll and pitch that it holds by order [rad]; 0 for one that takes no such order."""
    max_steering: float = 0.0
    """Greatest angle of its front wheels or its rudder [rad]; 0 for one that has none."""
    min_radius: float = 0.0
    """Of the tightest turn that it drives [m]; 0 for one that turns where it stands."""


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
        "bool",
    )
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    task: str = "patrol"
    """patrol or go_home; counts only while the order's own task is empty."""
    order: TaskOrder = field(default_factory=TaskOrder)
    """What to do; with its task empty, the field `task` says it."""
    instead: bool = False
    """Also while a task is under way, which ends only when this one is accepted; the queue waits then."""


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
        "bool",
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


class SetLightsRequest(CommandRequest, frozen=True, gc=False):
    """How bright the robot's lights shall be."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetLightsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string", "float64")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    brightness: float = 0.0
    """0 off to 1 full."""


class SetLightsResponse(CommandResponse, frozen=True, gc=False):
    """What `SetLights` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetLightsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


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
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


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
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")
