"""pilothouse_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

import math
from typing import ClassVar

from msgspec import field

from bridge.msgs.arrays import Float64Array, Int32Array
from bridge.msgs.base import Msg, int32
from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.std_msgs import Header

__all__ = [
    "AckermannState",
    "AcknowledgeEventsRequest",
    "AcknowledgeEventsResponse",
    "ArmOrder",
    "ArmState",
    "Bumper",
    "Check",
    "Checklist",
    "CommandRequest",
    "CommandResponse",
    "Compass",
    "ControlStatus",
    "DeletePlaceRequest",
    "DeletePlaceResponse",
    "DeleteScheduleRequest",
    "DeleteScheduleResponse",
    "Event",
    "FlightState",
    "Following",
    "GetEventsRequest",
    "GetEventsResponse",
]


class AckermannState(Msg, frozen=True, gc=False):
    """How a vehicle with steered front wheels drives, as its encoders tell."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/AckermannState"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "float64",
        "float64",
        "float64",
        "string[]",
        "float64[]",
        "float64[]",
    )
    UNITS: ClassVar[dict[str, str]] = {
        "speed": "m/s",
        "steering": "rad",
        "turning_radius": "m",
        "wheel_angles": "rad",
        "wheel_speeds": "m/s",
    }
    header: Header = Header()
    """Frame base_link, the middle of the rear axle."""
    speed: float = 0.0
    """Of the middle of the rear axle, ahead [m/s]."""
    steering: float = 0.0
    """Of a wheel in the middle of the front axle [rad], positive to the left."""
    turning_radius: float = math.inf
    """Of the middle of the rear axle [m], positive to the left; +inf straight ahead."""
    wheels: list[str] = []
    """Names of the wheels."""
    wheel_angles: Float64Array = field(default_factory=Float64Array)
    """How far each is steered [rad], positive to the left."""
    wheel_speeds: Float64Array = field(default_factory=Float64Array)
    """At the rim of each [m/s]."""


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
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")
    success: bool = False
    """It was accepted."""
    message: str = ""
    """One sentence: what was accepted, or why not and what is allowed."""
    code: str = ""
    """Why not, in one word of docs/bridge.md, as in stop_is_pressed; empty where it was accepted."""
    actor_id: str = ""
    """The client_id of whom the reason is about, as of who has control; empty when nobody, or it is not
    known.
    """
    parameters: list[KeyValue] = []
    """What the reason names, by the keys that the code has."""


class AcknowledgeEventsResponse(CommandResponse, frozen=True, gc=False):
    """What `AcknowledgeEvents` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/AcknowledgeEventsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


class ArmOrder(Msg, frozen=True, gc=False):
    """Where an arm is to go; the first of these that says something counts."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/ArmOrder"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "geometry_msgs/Point", "float64", "float64[]", "float64")
    UNITS: ClassVar[dict[str, str]] = {"point": "m", "pitch": "rad", "angles": "rad", "gripper": "m"}
    pose: str = ""
    """Name of a pose; empty for none."""
    point: Point = Point(math.nan, math.nan, math.nan)
    """For the tip, in base_link [m]; x is NaN for none."""
    pitch: float = math.nan
    """Of the hand at that point [rad], positive pointing down; NaN any."""
    angles: Float64Array = field(default_factory=Float64Array)
    """Of the joints from the foot on [rad]; empty for none."""
    gripper: float = math.nan
    """Opening between the fingers [m]; NaN leaves it as it is."""


class ArmState(Msg, frozen=True, gc=False):
    """An arm with four joints and a gripper."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/ArmState"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "string[]",
        "float64[]",
        "float64[]",
        "float64",
        "string",
        "string[]",
        "geometry_msgs/Point",
        "float64",
        "bool",
    )
    UNITS: ClassVar[dict[str, str]] = {
        "angles": "rad",
        "wanted": "rad",
        "gripper": "m",
        "tip": "m",
        "pitch": "rad",
    }
    header: Header = Header()
    """Frame base_link."""
    joints: list[str] = []
    """Names of the joints, from the foot on."""
    angles: Float64Array = field(default_factory=Float64Array)
    """Of each [rad]."""
    wanted: Float64Array = field(default_factory=Float64Array)
    """Where each is going [rad]."""
    gripper: float = 0.0
    """Opening between the fingers [m]."""
    pose: str = ""
    """The named pose that it is in; empty for any other."""
    poses: list[str] = []
    """The poses that have names."""
    tip: Point = Point()
    """Between the fingertips, in base_link [m]."""
    pitch: float = 0.0
    """Of the hand [rad], positive pointing down."""
    touching: bool = False
    """The hand touches something."""


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


class Compass(Msg, frozen=True, gc=False):
    """A compass that a tilt does not disturb: the magnetic field turned level by the accelerometer."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Compass"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "float64", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"heading": "deg", "roll": "rad", "pitch": "rad"}
    header: Header = Header()
    """Frame base_link."""
    heading: float = math.nan
    """Of the bow [deg], 0 north, clockwise, 0 to 360; NaN while the unit falls freely."""
    roll: float = 0.0
    """As the accelerometer has it [rad]."""
    pitch: float = 0.0
    """[rad], positive nose down."""


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
    stopped_by_id: str = ""
    """The client_id of who pressed it; empty when it gave none, or before the robot's last start."""
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
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


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
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


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
        "string",
        "string",
        "diagnostic_msgs/KeyValue[]",
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
    code: str = ""
    """What happened, in one word of docs/bridge.md, as in stop_pressed; empty where it has none."""
    actor_id: str = ""
    """The client_id of who caused it; empty when nobody did, or it is not known."""
    parameters: list[KeyValue] = []
    """What the sentence names, by the keys that the code has."""


class FlightState(Msg, frozen=True, gc=False):
    """Whether something that flies is in the air."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/FlightState"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "string", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"height": "m", "climb": "m/s"}
    header: Header = Header()
    """Frame map."""
    phase: str = ""
    """landed, taking_off, flying, landing; turned_over: it lies on its back, rotors off."""
    height: float = math.nan
    """Above the ground right under it, as its ultrasound has it [m]; NaN when that is out of reach."""
    climb: float = 0.0
    """Upward speed [m/s]."""


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
