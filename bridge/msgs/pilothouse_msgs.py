"""pilothouse_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, TypeAlias

from msgspec import Meta, field

from bridge.msgs.additions import MANOEUVRES, MAX_DWELL, MAX_LAPS, MOTIONS, PLACE_KINDS, REACTIONS, TASKS
from bridge.msgs.arrays import Float32Array, Float64Array, Int32Array
from bridge.msgs.base import Msg, int32, uint32
from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.geometry_msgs import Point, Point32, Polygon, Twist
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Header

__all__ = [
    "AckermannState",
    "AcknowledgeEventsRequest",
    "AcknowledgeEventsResponse",
    "ArmOrder",
    "ArmState",
    "BringDownGatewayRequest",
    "BringDownGatewayResponse",
    "BringUpGatewayRequest",
    "BringUpGatewayResponse",
    "Bumper",
    "Check",
    "Checklist",
    "ChoosePlaceRequest",
    "ChoosePlaceResponse",
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
    "Gateway",
    "GatewayArray",
    "GetEventsRequest",
    "GetEventsResponse",
    "GetHistoryRequest",
    "GetHistoryResponse",
    "GetIntruderPictureRequest",
    "GetIntruderPictureResponse",
    "GetMeRequest",
    "GetMeResponse",
    "GetMissionRequest",
    "GetMissionResponse",
    "GetMissionsRequest",
    "GetMissionsResponse",
    "GetPeopleRequest",
    "GetPeopleResponse",
    "Intruder",
    "IntruderArray",
    "InviteGuestRequest",
    "InviteGuestResponse",
    "InvitePersonRequest",
    "InvitePersonResponse",
    "KeptMission",
    "LightState",
    "Limits",
    "LineSensor",
    "MANOEUVRES",
    "MAX_DWELL",
    "MAX_LAPS",
    "MOTIONS",
    "Manoeuvre",
    "Mission",
    "MotorArray",
    "MoveArmRequest",
    "MoveArmResponse",
    "PLACE_KINDS",
    "PairBeginRequest",
    "PairBeginResponse",
    "PairFinishRequest",
    "PairFinishResponse",
    "PairScanRequest",
    "PairScanResponse",
    "Payload",
    "PayloadArray",
    "Person",
    "Place",
    "PlaceArray",
    "PlaceCandidate",
    "PlaceCandidates",
    "REACTIONS",
    "RecallMissionRequest",
    "RecallMissionResponse",
    "RemovePersonRequest",
    "RemovePersonResponse",
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
    "SetOptionRequest",
    "SetOptionResponse",
    "SetPayloadRequest",
    "SetPayloadResponse",
    "SetPlaceRequest",
    "SetPlaceResponse",
    "SetQueueRequest",
    "SetQueueResponse",
    "SetScheduleRequest",
    "SetScheduleResponse",
    "SonarRing",
    "StartTaskRequest",
    "StartTaskResponse",
    "TASKS",
    "TagRead",
    "TaskOrder",
    "TaskProgress",
    "TaskQueue",
    "TaskRun",
    "TaskStatus",
    "Waypoint",
]

_Boolx7: TypeAlias = Annotated[list[bool], Meta(min_length=7, max_length=7)]


class AckermannState(Msg, frozen=True, gc=False):
    """Motion of a vehicle with steered front wheels, by its encoders."""

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
    """Speed of the middle of the rear axle, ahead [m/s]."""
    steering: float = 0.0
    """Steering angle of a virtual wheel in the middle of the front axle [rad], positive to the left."""
    turning_radius: float = math.inf
    """Turning radius of the middle of the rear axle [m], positive to the left; +inf straight ahead."""
    wheels: list[str] = []
    """Names of the wheels."""
    wheel_angles: Float64Array = field(default_factory=Float64Array)
    """Steering angle of each wheel [rad], positive to the left."""
    wheel_speeds: Float64Array = field(default_factory=Float64Array)
    """Speed at the rim of each wheel [m/s]."""


class CommandRequest(Msg, frozen=True, gc=False):
    """A single command. An empty request, as of std_srvs/Trigger, has no identity and no expiry."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/CommandRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    command_id: str = ""
    """Unique per command; the robot answers a repeated id with the first answer and executes it once."""
    stamp: float = math.nan
    """When the operator gave it [s], operators' clock; NaN when not known."""
    valid_for: float = 5.0
    """Refused when older than this on arrival [s]."""
    client_id: str = ""
    """Identity of the client; stays the same over reconnects."""
    client_name: str = ""
    """Name of the client for people, as in tablet-B."""


class AcknowledgeEventsRequest(CommandRequest, frozen=True, gc=False):
    """Acknowledges events; the robot stores the first client that does."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/AcknowledgeEventsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string", "int32[]")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    ids: Int32Array = field(default_factory=Int32Array)
    """Numbers of the events."""


class CommandResponse(Msg, frozen=True, gc=False):
    """What `Command` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/CommandResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")
    success: bool = False
    """The robot accepted it."""
    message: str = ""
    """One sentence: the accepted command, or the reason of the refusal and the allowed values."""
    code: str = ""
    """Code of the reason, as in docs/bridge.md, such as stop_is_pressed; empty where it was accepted."""
    actor_id: str = ""
    """The public id of the client that the reason is about, such as the one with control; empty without
    one, or when it is not known.
    """
    parameters: list[KeyValue] = []
    """Values in the reason, by the keys of the code."""


class AcknowledgeEventsResponse(CommandResponse, frozen=True, gc=False):
    """What `AcknowledgeEvents` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/AcknowledgeEventsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


class ArmOrder(Msg, frozen=True, gc=False):
    """Goal of an arm: a pose, a point, angles or increments, one of them, and the gripper's opening."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/ArmOrder"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "geometry_msgs/Point",
        "float64",
        "float64[]",
        "float64[]",
        "float64",
    )
    UNITS: ClassVar[dict[str, str]] = {
        "point": "m",
        "pitch": "rad",
        "angles": "rad",
        "increments": "rad",
        "gripper": "m",
    }
    pose: str = ""
    """Name of a pose; empty for none."""
    point: Point = Point(math.nan, math.nan, math.nan)
    """For the tip, in base_link [m]; x is NaN for none."""
    pitch: float = math.nan
    """Pitch of the hand at that point [rad], positive pointing down; NaN for any."""
    angles: Float64Array = field(default_factory=Float64Array)
    """Angles of the joints, from the foot on [rad]; empty for none."""
    increments: Float64Array = field(default_factory=Float64Array)
    """Added to where each joint is going, from the foot on [rad]; empty for none."""
    gripper: float = math.nan
    """Opening between the fingers [m]; NaN leaves it unchanged."""


class ArmState(Msg, frozen=True, gc=False):
    """An arm and its gripper."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/ArmState"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "string[]",
        "float64[]",
        "float64[]",
        "float64",
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
        "gripper_wanted": "m",
        "tip": "m",
        "pitch": "rad",
    }
    header: Header = Header()
    """Frame base_link."""
    joints: list[str] = []
    """Names of the joints, from the foot on."""
    angles: Float64Array = field(default_factory=Float64Array)
    """Angle of each [rad]."""
    wanted: Float64Array = field(default_factory=Float64Array)
    """Commanded angle of each [rad]."""
    gripper: float = 0.0
    """Opening between the fingers [m]."""
    gripper_wanted: float = math.nan
    """Commanded opening [m]; NaN when it is not known."""
    pose: str = ""
    """Name of the present pose; empty for any other."""
    poses: list[str] = []
    """Names of all poses."""
    tip: Point = Point()
    """Position between the fingertips, in base_link [m]."""
    pitch: float = 0.0
    """Pitch of the hand [rad], positive pointing down."""
    touching: bool = False
    """The hand touches something."""


class BringDownGatewayRequest(CommandRequest, frozen=True, gc=False):
    """Brings a protocol down; answered when nothing of it is left."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/BringDownGatewayRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "float64",
        "float64",
        "string",
        "string",
        "string",
        "bool",
    )
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    name: str = ""
    """Of the protocol, as /gateways names it."""
    own: bool = False
    """Also when the caller came by it and loses its connection."""


class BringDownGatewayResponse(CommandResponse, frozen=True, gc=False):
    """What `BringDownGateway` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/BringDownGatewayResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


class BringUpGatewayRequest(CommandRequest, frozen=True, gc=False):
    """Brings a protocol up while the robot runs; answered when it is up, or why it is not."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/BringUpGatewayRequest"
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
    """Of the protocol, as /gateways names it."""
    url: str = ""
    """Where, with its options; empty for the usual one."""


class BringUpGatewayResponse(CommandResponse, frozen=True, gc=False):
    """What `BringUpGateway` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/BringUpGatewayResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


class Bumper(Msg, frozen=True, gc=False):
    """State of the bumper ring."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Bumper"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "bool", "float64")
    UNITS: ClassVar[dict[str, str]] = {"bearing": "rad"}
    header: Header = Header()
    """Frame base_link."""
    pressed: bool = False
    """An object touches it."""
    bearing: float = math.nan
    """Direction of the contact in base_link [rad], 0 ahead, positive to the left; NaN without contact."""


class Check(Msg, frozen=True, gc=False):
    """One line of the checklist before the first motion."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Check"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "string",
        "string",
        "string",
        "diagnostic_msgs/KeyValue[]",
    )
    name: str = ""
    """battery, sensors, position, stop or clock."""
    state: str = "unknown"
    """ok, bad or unknown."""
    text: str = ""
    """One sentence: the finding, and the remedy when it is not good."""
    code: str = ""
    """The kind of finding, a code of docs/bridge.md, as in check_stop_untested; empty without one."""
    parameters: list[KeyValue] = []
    """Values in the sentence, by the keys of the code."""


class Checklist(Msg, frozen=True, gc=False):
    """Checks before the first motion; latched on /checklist, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Checklist"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "pilothouse_msgs/Check[]")
    stamp: Time = Time()
    """When it changed, operators' clock."""
    checks: list[Check] = []
    """Always the same checks in the same order."""


class ChoosePlaceRequest(CommandRequest, frozen=True, gc=False):
    """Tells the robot at which of its candidates it is."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/ChoosePlaceRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string", "uint32")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    id: uint32 = 0
    """Of the candidate, as in /localisation/candidates."""


class ChoosePlaceResponse(CommandResponse, frozen=True, gc=False):
    """What `ChoosePlace` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/ChoosePlaceResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


class Compass(Msg, frozen=True, gc=False):
    """A compass that knows its level: heading, roll and pitch, by the magnetic field and weight, and by a
    gyro where it has one.
    """

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Compass"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "float64", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"heading": "deg", "roll": "rad", "pitch": "rad"}
    header: Header = Header()
    """Frame base_link."""
    heading: float = math.nan
    """Heading of the bow [deg], 0 north, clockwise, 0 to 360; NaN while it knows none."""
    roll: float = 0.0
    """Roll, as it finds its level [rad]."""
    pitch: float = 0.0
    """Pitch likewise [rad], positive nose down."""


class ControlStatus(Msg, frozen=True, gc=False):
    """The driver, the mode, and STOP; latched on /control/status, sent once per change."""

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
        "float64",
        "float64",
        "float64",
    )
    UNITS: ClassVar[dict[str, str]] = {"loop_lag": "s"}
    stamp: Time = Time()
    """When it changed."""
    mode: str = "MANUAL"
    """MANUAL, AUTO, PAUSED or STOPPED."""
    driver: str = ""
    """Name of the client that has control; empty when it is free."""
    driver_id: str = ""
    """The public id of the client that acquired it."""
    stopped: bool = False
    """STOP is latched: nothing moves until it is released."""
    stopped_by: str = ""
    """Name of the client that pressed STOP."""
    stopped_by_id: str = ""
    """The public id of the client that pressed it; empty when it gave none, or before the robot's last
    start.
    """
    at_rest: bool = True
    """The wheels stand still, as measured."""
    requested_by: str = ""
    """Name of the client that asks the driver for control; empty without one."""
    requested_by_id: str = ""
    """The public id of the client that asks for it."""
    handover: Time = Time()
    """When control changes hands unless the driver objects, operators' clock; 0 without a request."""
    speed_cap: float = 1.0
    """Share of the full speed that the driver's link allows, 0 to 1."""
    follows_link: bool = True
    """The speed falls with the driver's link; /settings/set switches it."""
    stop_tested: Time = Time()
    """When STOP last brought the robot to rest, operators' clock; 0 when never since its start."""
    lost_link_stops_task: bool = False
    """A task is paused when the link to the driver is lost; /settings/set switches it."""
    loop_cap: float = 1.0
    """Share of the full speed that the robot's own loop allows: less while its control or its simulation
    lags, 0 while it rests for that.
    """
    real_time_factor: float = 1.0
    """Seconds of a lagging simulation that pass in a second; 1 while it keeps up, and of real robots."""
    loop_lag: float = 0.0
    """Age of the newest data while the loop lags [s]; 0 while it is on time."""


class DeletePlaceRequest(CommandRequest, frozen=True, gc=False):
    """Deletes a place."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/DeletePlaceRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string", "int32")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    id: int32 = 0
    """Number of the place."""


class DeletePlaceResponse(CommandResponse, frozen=True, gc=False):
    """What `DeletePlace` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/DeletePlaceResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


class DeleteScheduleRequest(CommandRequest, frozen=True, gc=False):
    """Deletes a scheduled task."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/DeleteScheduleRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string", "int32")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    id: int32 = 0
    """Number of the scheduled task."""


class DeleteScheduleResponse(CommandResponse, frozen=True, gc=False):
    """What `DeleteSchedule` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/DeleteScheduleResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


class Event(Msg, frozen=True, gc=False):
    """An event; on /events, each once. /events/get returns those that were missed."""

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
    """Identity of the log; the ids of a new log start again from 1."""
    stamp: Time = Time()
    """When it happened."""
    level: str = "info"
    """info, ok, warn or alarm."""
    kind: str = ""
    """waypoint, intruder, task, command, mission, contact, battery, control, stop or localisation."""
    text: str = ""
    """One sentence for the operator."""
    position: Point = Point(math.nan, math.nan, math.nan)
    """Position in map [m]; NaN without one."""
    acknowledged_by: str = ""
    """Name of the operator that acknowledged it; empty until then."""
    acknowledged: Time = Time()
    """When it was acknowledged, operators' clock; 0 until then."""
    code: str = ""
    """The kind of event, a code of docs/bridge.md, as in stop_pressed; empty without one."""
    actor_id: str = ""
    """The public id of the client that caused it; empty without one, or when it is not known."""
    parameters: list[KeyValue] = []
    """Values in the sentence, by the keys of the code."""


class FlightState(Msg, frozen=True, gc=False):
    """State of flight."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/FlightState"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "string", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"height": "m", "climb": "m/s"}
    header: Header = Header()
    """Frame map."""
    phase: str = ""
    """landed, taking_off, flying, landing; turned_over: it lies on its back, rotors off."""
    height: float = math.nan
    """Height above the ground below, by ultrasound [m]; NaN when out of range."""
    climb: float = 0.0
    """Upward speed [m/s]."""


class Following(Msg, frozen=True, gc=False):
    """The person that the robot guides; /following."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Following"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "bool", "float64")
    UNITS: ClassVar[dict[str, str]] = {"distance": "m"}
    header: Header = Header()
    """When it was measured, robot's clock; frame base_link."""
    present: bool = False
    """A person follows."""
    distance: float = math.nan
    """Distance to that person [m]; NaN when not known."""


class Gateway(Msg, frozen=True, gc=False):
    """A protocol by which programs reach the robot."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Gateway"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "string",
        "string",
        "bool",
        "string",
        "string",
        "string[]",
        "string",
        "string[]",
        "string",
        "string",
        "string[]",
        "string[]",
    )
    name: str = ""
    """As it is asked for, such as mqtt."""
    doc: str = ""
    """What it is, in a few words."""
    package: str = ""
    """The library that it needs and this robot lacks; empty when it is there."""
    fixed: bool = False
    """Always up, such as rosbridge: it is neither brought up nor down."""
    state: str = ""
    """down, coming_up, up, lost or going_down; lost is up without reaching its broker."""
    endpoint: str = ""
    """The URL by which clients reach it; empty while it is down."""
    options: list[str] = []
    """Options of its URL as name=value, without user, password and token; empty while it is down."""
    fault: str = ""
    """Why it is lost, or did not come up the last time; empty for none."""
    qr_rows: list[str] = []
    """Rows of the QR code of the endpoint from the top, each of 0 (light) and 1 (dark), without the quiet
    zone.
    """
    guide: str = ""
    """How it is used, with lines that can be pasted; empty while it is down."""
    usual: str = ""
    """The URL that counts where none is given; empty for one that is fixed."""
    schemes: list[str] = []
    """Schemes of its URLs with their usual ports, as mqtt:1883."""
    listens: list[str] = []
    """The schemes by which it listens at its URL; by the others it goes there, to a broker."""


class GatewayArray(Msg, frozen=True, gc=False):
    """All protocols that a robot knows; latched on /gateways, sent once per change while somebody listens."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GatewayArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "pilothouse_msgs/Gateway[]")
    stamp: Time = Time()
    """When it was so, operators' clock."""
    gateways: list[Gateway] = []
    """Those that always run first, the others by name."""


class GetEventsRequest(Msg, frozen=True, gc=False):
    """Returns the events after `since`."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetEventsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int32", "string", "int32[]", "int32")
    since: int32 = 0
    """Number of the last event that the client knows."""
    boot: str = ""
    """The boot that `since` belongs to; for another boot all events are returned, for an empty one the
    newest 500.
    """
    open: Int32Array = field(default_factory=Int32Array)
    """Earlier events that the client knows as unacknowledged; those acknowledged since are returned too."""
    most: int32 = 0
    """Maximum number of later events in one answer, the first of them; 0 for all, or the newest 500 of
    another boot.
    """


class GetEventsResponse(Msg, frozen=True, gc=False):
    """What `GetEvents` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetEventsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("pilothouse_msgs/Event[]", "bool", "int32")
    events: list[Event] = []
    """Oldest first."""
    more: bool = False
    """There are later events: call again with `since` the last of these."""
    oldest: int32 = 0
    """Number of the oldest stored event; 0 when there is none, or it is not known."""


class GetHistoryRequest(CommandRequest, frozen=True, gc=False):
    """Returns past tasks."""

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
    """Maximum number of runs."""


class Waypoint(Msg, frozen=True, gc=False):
    """A point to pass, in the map frame."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Waypoint"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("float64", "float64", "float64", "string", "float64")
    UNITS: ClassVar[dict[str, str]] = {"x": "m", "y": "m", "yaw": "rad", "height": "m"}
    x: float = 0.0
    """East of the map's origin [m]."""
    y: float = 0.0
    """North of the map's origin [m]."""
    yaw: float = math.nan
    """Direction to stand in [rad], 0 east, anticlockwise; NaN when any will do."""
    name: str = ""
    """Name; empty without one."""
    height: float = math.nan
    """To be at there, above the map's origin [m], negative below water, of robots that swim or fly; NaN or
    0 for the one that it has.
    """


class TaskOrder(Msg, frozen=True, gc=False):
    """An order: a task with its parameters. Used to start one, to queue it and to schedule it."""

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
        "float64",
    )
    UNITS: ClassVar[dict[str, str]] = {"heading": "rad", "speed": "m/s", "height": "m", "duration": "s"}
    id: int32 = 0
    """Given by the robot; 0 for a new one."""
    task: str = ""
    """patrol, deliver, guide, go_to, go_home, hold, follow_heading, dock, undock, take_off, land or
    surface; RobotInfo lists those that a robot knows.
    """
    places: list[str] = []
    """Names of places. patrol: none for the stored mission; deliver: from, to and optionally a third to go
    on to; guide: in this order; go_to and dock: one.
    """
    goals: list[Waypoint] = []
    """For go_to in place of places: points in the map frame."""
    message: str = ""
    """Message for the person who receives it or is guided; empty for none."""
    recipient_tag: str = ""
    """Content of the recipient's card, in place of the place's own; empty for the place's own."""
    heading: float = math.nan
    """Direction for follow_heading [rad], 0 east, anticlockwise; NaN for the present one."""
    speed: float = math.nan
    """Speed [m/s]; NaN for the robot's cruising speed, or the throttle's."""
    throttle: float = math.nan
    """For follow_heading in place of a speed: share of the full power, -1 to 1; NaN where the speed is
    given.
    """
    height: float = math.nan
    """Of robots that swim or fly: height to go at or to hold, above the map's origin [m], negative below
    water; NaN for the default or the present one.
    """
    duration: float = math.nan
    """Time to hold or to follow the heading [s]; NaN for until stopped."""
    charge_to: float = math.nan
    """For dock: it stays until the battery has this share, 0 to 1; NaN to be done as soon as it takes
    charge.
    """


class TaskRun(Msg, frozen=True, gc=False):
    """A past or present run of a task in the robot's history."""

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
    """The order."""
    started: Time = Time()
    """When it began, operators' clock."""
    ended: Time = Time()
    """When it ended, operators' clock; 0 while it runs."""
    state: str = ""
    """As in TaskStatus: RUNNING, PAUSED, SUCCEEDED, CANCELED, FAILED or INTERRUPTED."""
    reason: str = ""
    """One sentence: the outcome and its cause."""
    distance: float = 0.0
    """Distance driven in this run [m]."""
    visited: int32 = 0
    """Waypoints or places reached."""
    by: str = ""
    """Name of the client that started it; empty when the schedule or the robot did."""
    code: str = ""
    """Code of the reason, as in docs/bridge.md; empty without one."""
    actor_id: str = ""
    """The public id of the client that the reason is about; empty without one, or when it is not known."""
    parameters: list[KeyValue] = []
    """Values in the reason, by the keys of the code."""


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


class GetIntruderPictureRequest(CommandRequest, frozen=True, gc=False):
    """Returns the picture of an intruder, as the robot kept it with the event that reported it."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetIntruderPictureRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "float64",
        "float64",
        "string",
        "string",
        "int32",
        "string",
    )
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    event: int32 = 0
    """Number of the event."""
    boot: str = ""
    """The log that the event belongs to; empty for the robot's present one."""


class GetIntruderPictureResponse(CommandResponse, frozen=True, gc=False):
    """What `GetIntruderPicture` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetIntruderPictureResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "bool",
        "string",
        "string",
        "string",
        "diagnostic_msgs/KeyValue[]",
        "sensor_msgs/CompressedImage",
    )
    picture: CompressedImage = CompressedImage()
    """JPEG, at most 192 pixels long and 24 kB."""


class GetMeRequest(Msg, frozen=True, gc=False):
    """Returns who the robot takes the caller for."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetMeRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class GetMeResponse(Msg, frozen=True, gc=False):
    """What `GetMe` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetMeResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "string", "string", "float64", "bool", "bool")
    UNITS: ClassVar[dict[str, str]] = {"ends": "s"}
    id: str = ""
    """Public id; empty for who proved nothing."""
    name: str = ""
    """Name for people; empty when it is not known."""
    role: str = ""
    """none, watch, drive or manage."""
    ends: float = math.nan
    """When the role ends [s], operators' clock; NaN when it does not."""
    proven: bool = False
    """It proved by a key who it is."""
    secure: bool = False
    """It came by TLS."""


class GetMissionRequest(Msg, frozen=True, gc=False):
    """Returns the stored mission."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetMissionRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class Mission(Msg, frozen=True, gc=False):
    """The points of a patrol and the way to visit them."""

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
        "string[]",
    )
    UNITS: ClassVar[dict[str, str]] = {"dwell": "s"}
    stamp: Time = Time()
    """When the robot stored it; 0 when never stored."""
    waypoints: list[Waypoint] = []
    """Points to visit, in the map frame."""
    home: list[Waypoint] = []
    """Home, the place to return to: one waypoint, or none when not set."""
    motion: str = "loop"
    """loop, random or intermittent."""
    dwell: float = 5.0
    """Time to stay at each point in intermittent motion [s]."""
    laps: int32 = 0
    """Number of laps; 0 for until stopped."""
    stop_on_intruder: bool = False
    """Pause when an intruder is found, for any `on_intruder`."""
    name: str = ""
    """Name under which it is stored; empty for a mission without one."""
    on_intruder: str = ""
    """stop, report or circle when an intruder is found; empty reports it."""
    intruder_classes: list[str] = []
    """Classes that count as intruders: cone, person, car or box; none means person and cone."""


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
    """One sentence when none is stored yet, else empty."""
    mission: Mission = field(default_factory=Mission)
    """The stored mission."""
    code: str = ""
    """Code of the reason, as in docs/bridge.md, such as stop_is_pressed; empty where it was accepted."""
    actor_id: str = ""
    """The public id of the client that the reason is about, such as the one with control; empty without
    one, or when it is not known.
    """
    parameters: list[KeyValue] = []
    """Values in the reason, by the keys of the code."""


class GetMissionsRequest(CommandRequest, frozen=True, gc=False):
    """Returns the missions stored under names."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetMissionsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}


class KeptMission(Msg, frozen=True, gc=False):
    """A mission stored under a name."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/KeptMission"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "time", "int32", "string", "int32")
    name: str = ""
    """Name under which it is stored."""
    stamp: Time = Time()
    """When its newest revision was stored, operators' clock."""
    points: int32 = 0
    """Number of waypoints."""
    motion: str = ""
    """loop, random or intermittent."""
    revisions: int32 = 0
    """Number of stored revisions, 20 at most."""


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
    """Names in alphabetical order."""
    missions: list[KeptMission] = []
    """The same missions in detail."""


class GetPeopleRequest(Msg, frozen=True, gc=False):
    """Returns everybody whom the robot knows."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetPeopleRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class Person(Msg, frozen=True, gc=False):
    """A person that the robot knows: a paired handheld, a program with a token, or a guest."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Person"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "string",
        "string",
        "string",
        "float64",
        "float64",
        "float64",
        "bool",
    )
    UNITS: ClassVar[dict[str, str]] = {"created": "s", "ends": "s", "last_seen": "s"}
    id: str = ""
    """Public id, never a secret."""
    name: str = ""
    """Name for people; several may have the same one."""
    role: str = ""
    """watch, drive or manage."""
    kind: str = ""
    """handheld, token or guest."""
    created: float = 0.0
    """When it became known [s], operators' clock."""
    ends: float = math.nan
    """When its role ends [s], operators' clock; NaN when it does not."""
    last_seen: float = math.nan
    """When it last proved who it is [s], operators' clock; NaN for never."""
    connected: bool = False
    """It is connected now."""


class GetPeopleResponse(Msg, frozen=True, gc=False):
    """What `GetPeople` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/GetPeopleResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("pilothouse_msgs/Person[]",)
    people: list[Person] = []
    """Oldest first."""


class Intruder(Msg, frozen=True, gc=False):
    """An object that does not belong there."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Intruder"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int32", "string", "geometry_msgs/Point", "time", "int32")
    UNITS: ClassVar[dict[str, str]] = {"position": "m"}
    id: int32 = 0
    """Counts from 1 for each run of the robot side."""
    class_id: str = "cone"
    """Its class: cone, person, car, box, or unknown where the camera is not sure."""
    position: Point = Point()
    """Position in map [m]."""
    first_seen: Time = Time()
    """When it was first seen."""
    sightings: int32 = 1
    """Number of sightings."""


class IntruderArray(Msg, frozen=True, gc=False):
    """All known intruders; latched on /intruders, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/IntruderArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "pilothouse_msgs/Intruder[]")
    header: Header = Header()
    """Frame map."""
    intruders: list[Intruder] = []
    """In the order of their ids."""


class InviteGuestRequest(Msg, frozen=True, gc=False):
    """Opens pairing for one guest, whose role ends by itself."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/InviteGuestRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64")
    UNITS: ClassVar[dict[str, str]] = {"duration": "s"}
    role: str = ""
    """watch or drive; empty for watch."""
    duration: float = 3600.0
    """How long the role lasts from now on [s], 60 to 86400."""


class InviteGuestResponse(Msg, frozen=True, gc=False):
    """What `InviteGuest` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/InviteGuestResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "string", "float64", "string[]")
    UNITS: ClassVar[dict[str, str]] = {"ends": "s"}
    link: str = ""
    """Link for the QR code."""
    code: str = ""
    """Eight digits for people."""
    ends: float = 0.0
    """When the role ends [s], operators' clock."""
    qr_rows: list[str] = []
    """Rows of the QR code of the link from the top, each of 0 (light) and 1 (dark), without the quiet
    zone.
    """


class InvitePersonRequest(Msg, frozen=True, gc=False):
    """Opens pairing for ten minutes and one handheld."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/InvitePersonRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    role: str = ""
    """Role of who pairs: watch, drive or manage; empty for drive."""


class InvitePersonResponse(Msg, frozen=True, gc=False):
    """What `InvitePerson` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/InvitePersonResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "string", "float64", "string[]")
    UNITS: ClassVar[dict[str, str]] = {"open_until": "s"}
    link: str = ""
    """Link for the QR code."""
    code: str = ""
    """Six digits for people."""
    open_until: float = 0.0
    """When it ends [s], operators' clock."""
    qr_rows: list[str] = []
    """Rows of the QR code of the link from the top, each of 0 (light) and 1 (dark), without the quiet
    zone.
    """


class LightState(Msg, frozen=True, gc=False):
    """The lights of a robot: their state, or as a command the state to set."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/LightState"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "float64")
    header: Header = Header()
    """Frame base_link."""
    brightness: float = 0.0
    """0 off to 1 full."""


class Limits(Msg, frozen=True, gc=False):
    """Limits of the robot's own configuration; latched on /limits, sent once per change."""

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
        "float64",
        "float64",
        "float64",
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
        "floor": "m",
        "ceiling": "m",
        "clearance": "m",
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
    floor: float = math.nan
    """Of the fence: lowest height above the map's origin [m], negative under water; taking off and landing
    pass it. NaN for none.
    """
    ceiling: float = math.nan
    """Of the fence: greatest height above the map's origin [m], negative under water; NaN for none."""
    clearance: float = math.nan
    """Kept at least between the body and anything on ways of its own [m]; NaN for what its kind keeps."""


class LineSensor(Msg, frozen=True, gc=False):
    """A row of cells that measure the brightness of the ground under them."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/LineSensor"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "float32[]", "float64")
    UNITS: ClassVar[dict[str, str]] = {"spacing": "m"}
    header: Header = Header()
    """Frame of the sensor; the cells lie along its y axis."""
    values: Float32Array = field(default_factory=Float32Array)
    """From the leftmost cell to the rightmost one, 0 dark to 1 bright; NaN for a cell without a value."""
    spacing: float = math.nan
    """Between the middles of two neighbouring cells [m]; NaN when not known."""


class Manoeuvre(Msg, frozen=True, gc=False):
    """Motion that a twist alone cannot express, until the next order: a command to the robot; on
    /manoeuvre the one that it carries out.
    RobotInfo lists the kinds that a robot knows. A kind uses the fields that name it below and ignores
    the others.
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
    """twist: all of it; tilt: climb in linear.z, turn in angular.z."""
    speed: float = math.nan
    """steer, course: speed ahead [m/s]; NaN where the throttle is given."""
    throttle: float = math.nan
    """steer, course: share of the full power, -1 to 1; NaN where the speed is given."""
    steering: float = 0.0
    """steer: angle of the front wheels [rad], of the rudder [rad]; positive to the left."""
    roll: float = 0.0
    """tilt: roll to hold [rad]."""
    pitch: float = 0.0
    """tilt: pitch to hold [rad], positive nose down."""
    yaw: float = math.nan
    """course, hover: direction to hold in map [rad]; NaN for the present one."""
    height: float = math.nan
    """course, hover, take_off: height to hold above the map's origin [m], negative below water; NaN for
    the present or the default one.
    """


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
    """Names of the motors."""
    speeds: Float64Array = field(default_factory=Float64Array)
    """Speed of the part that each motor turns [rad/s]; of a leg the maximum of its swing."""
    torques: Float64Array = field(default_factory=Float64Array)
    """Torque on that part [N m]."""
    temperatures: Float64Array = field(default_factory=Float64Array)
    """Temperature of each winding [degC]."""


class MoveArmRequest(CommandRequest, frozen=True, gc=False):
    """Moves a mounted arm."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/MoveArmRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "float64",
        "float64",
        "string",
        "string",
        "pilothouse_msgs/ArmOrder",
        "bool",
    )
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    order: ArmOrder = field(default_factory=ArmOrder)
    """Goal as a pose's name, a point for the tip, angles, or increments."""
    wait: bool = False
    """Answer when the arm is there, or when it will not come there; else at once."""


class MoveArmResponse(CommandResponse, frozen=True, gc=False):
    """What `MoveArm` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/MoveArmResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


class PairBeginRequest(Msg, frozen=True, gc=False):
    """Begins to pair with a code: the two messages of SPAKE2, the handheld is its side A. Only over TLS."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/PairBeginRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "string")
    tag: str = ""
    """First two digits of a guest's code of eight; empty for the code of six."""
    message: str = ""
    """The handheld's message, in hex."""


class PairBeginResponse(Msg, frozen=True, gc=False):
    """What `PairBegin` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/PairBeginResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    message: str = ""
    """The robot's message, in hex."""


class PairFinishRequest(Msg, frozen=True, gc=False):
    """Ends what PairBegin began on the same connection. The handheld proves first that it has the code."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/PairFinishRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "string")
    confirmation: str = ""
    """HMAC of the handheld, in hex."""
    name: str = ""
    """Name of the handheld for people, as in tablet-B."""


class PairFinishResponse(Msg, frozen=True, gc=False):
    """What `PairFinish` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/PairFinishResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "string", "string", "string", "float64", "string")
    UNITS: ClassVar[dict[str, str]] = {"ends": "s"}
    confirmation: str = ""
    """HMAC of the robot, in hex; a wrong one means that another has answered."""
    id: str = ""
    """Public id of the handheld from now on."""
    token: str = ""
    """Its key: shown to the robot at each connection, never to anybody else."""
    role: str = ""
    """watch, drive or manage."""
    ends: float = math.nan
    """When the role ends [s], operators' clock; NaN when it does not."""
    robot: str = ""
    """Name of the robot."""


class PairScanRequest(Msg, frozen=True, gc=False):
    """Pairs with the secret of a QR code. Only over TLS, with the certificate that the code names."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/PairScanRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "string")
    secret: str = ""
    """Of the link."""
    name: str = ""
    """Name of the handheld for people, as in tablet-B."""


class PairScanResponse(Msg, frozen=True, gc=False):
    """What `PairScan` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/PairScanResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "string", "string", "float64", "string")
    UNITS: ClassVar[dict[str, str]] = {"ends": "s"}
    id: str = ""
    """Public id of the handheld from now on."""
    token: str = ""
    """Its key: shown to the robot at each connection, never to anybody else."""
    role: str = ""
    """watch, drive or manage."""
    ends: float = math.nan
    """When the role ends [s], operators' clock; NaN when it does not."""
    robot: str = ""
    """Name of the robot."""


class Payload(Msg, frozen=True, gc=False):
    """Something that a robot carries or does, and that is offered to clients or not."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Payload"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "string",
        "bool",
        "bool",
        "string",
        "string[]",
        "string[]",
    )
    key: str = ""
    """As it is asked for, such as camera."""
    doc: str = ""
    """What it is, in a few words."""
    on: bool = False
    """It is offered; one that is off is not sent, takes no commands and does not run."""
    fixed: bool = False
    """It cannot be switched off, for the reason in why."""
    why: str = ""
    """One sentence: why it is fixed, or who switched it off; empty for none."""
    topics: list[str] = []
    """Topics that it publishes or listens to."""
    services: list[str] = []
    """Its services and actions."""


class PayloadArray(Msg, frozen=True, gc=False):
    """All payloads of a robot; latched on /payloads, sent once per change while somebody listens."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/PayloadArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "pilothouse_msgs/Payload[]")
    stamp: Time = Time()
    """When it was so, operators' clock."""
    payloads: list[Payload] = []
    """In the order of the table of payloads."""


class Place(Msg, frozen=True, gc=False):
    """A named pose, so that people can say Office 12 in place of coordinates."""

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
        "float64",
    )
    UNITS: ClassVar[dict[str, str]] = {"x": "m", "y": "m", "yaw": "rad", "height": "m"}
    id: int32 = 0
    """Given by the robot and never used again; 0 asks for a new place."""
    name: str = ""
    """Name of the place, unique."""
    kind: str = "place"
    """place, office, home, dock, reception, lab or hall."""
    floor: str = "0"
    """Name of its floor."""
    x: float = 0.0
    """East of the map's origin [m]."""
    y: float = 0.0
    """North of the map's origin [m]."""
    yaw: float = math.nan
    """Direction to stand in [rad], 0 east, anticlockwise; NaN when any will do."""
    tag: str = ""
    """Content of the card of the person who belongs here; empty without one."""
    note: str = ""
    """Message for people who are guided here; empty for none."""
    height: float = 0.0
    """To be at there, above the map's origin [m], negative below water, of robots that swim or fly; 0 for
    the one that it has.
    """


class PlaceArray(Msg, frozen=True, gc=False):
    """All known places; latched on /places, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/PlaceArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "pilothouse_msgs/Place[]")
    stamp: Time = Time()
    """When it changed, operators' clock."""
    places: list[Place] = []
    """In the order of their ids."""


class PlaceCandidate(Msg, frozen=True, gc=False):
    """A place where the robot may be: as far as it can tell, it fits what the robot measures."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/PlaceCandidate"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint32", "float64", "float64", "float64", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"x": "m", "y": "m", "yaw": "rad", "spread": "m"}
    id: uint32 = 0
    """Kept while the question is open, and never given again in a run of the robot side; the first
    candidate of each question has 1, 27, 53, ..., so that screens can call it A.
    """
    x: float = 0.0
    """In map [m]."""
    y: float = 0.0
    """In map [m]."""
    yaw: float = 0.0
    """In map [rad], 0 east, anticlockwise."""
    share: float = 0.0
    """How likely it is beside all others, 0 to 1."""
    spread: float = 0.0
    """Uncertainty of the place in the worst direction, one standard deviation [m]."""


class PlaceCandidates(Msg, frozen=True, gc=False):
    """Where the robot may be, while it cannot tell by itself; latched on /localisation/candidates, sent on
    change.
    """

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/PlaceCandidates"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "pilothouse_msgs/PlaceCandidate[]", "string")
    header: Header = Header()
    """Frame map."""
    candidates: list[PlaceCandidate] = []
    """The likeliest first; two or more are a question to the operator, none is no question."""
    reason: str = ""
    """One sentence: why it asks; empty for none."""


class RecallMissionRequest(CommandRequest, frozen=True, gc=False):
    """Makes a named mission the robot's stored mission."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RecallMissionRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string", "string")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    name: str = ""
    """Name under which it is stored."""


class RecallMissionResponse(CommandResponse, frozen=True, gc=False):
    """What `RecallMission` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RecallMissionResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


class RemovePersonRequest(Msg, frozen=True, gc=False):
    """Forgets a person: its key opens nothing any more, its connections end, and what it drives stops."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RemovePersonRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    id: str = ""
    """Its public id."""


class RemovePersonResponse(Msg, frozen=True, gc=False):
    """What `RemovePerson` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RemovePersonResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    name: str = ""
    """Name of who was removed."""


class RobotInfo(Msg, frozen=True, gc=False):
    """Identity and capabilities of the robot; latched on /robot/info."""

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
        "string",
        "string",
        "string",
        "string[]",
        "bool",
        "bool",
        "geometry_msgs/Point32[]",
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
        "footprint": "m",
    }
    name: str = ""
    """Name for people, as in Patrol-1."""
    kind: str = ""
    """wheels, ackermann, boat, hexapod, quadrotor, or another one."""
    model: str = ""
    """Name in the --robot option, as in patrol."""
    description: str = ""
    """The kind in plain words, as in Differential drive."""
    world: str = ""
    """Name of the place or simulated world."""
    max_speed: float = 0.0
    """Greatest speed, along any direction [m/s]."""
    max_yaw_rate: float = 0.0
    """Greatest turn rate [rad/s], either way."""
    radius: float = 0.0
    """Radius of the circle around the body [m]."""
    cameras: list[str] = []
    """Names of the camera streams; each is served at ws://HOST:PORT/camera/NAME."""
    latitude: float = math.nan
    """Of the map frame's origin [deg]; NaN when the map has no geographic position."""
    longitude: float = math.nan
    """Of the map frame's origin [deg]."""
    camera_fov: float = math.nan
    """Horizontal field of view of the first camera [rad]."""
    manoeuvres: list[str] = []
    """Kinds of pilothouse_msgs/Manoeuvre that it knows; empty for a robot that knows twists only."""
    payloads: list[str] = []
    """Names of the mounted payloads."""
    laser_x: float = 0.0
    """Distance of the laser ahead of base_link [m]."""
    tasks: list[str] = []
    """Tasks of pilothouse_msgs/TaskOrder that it knows; empty when not known."""
    max_climb: float = 0.0
    """Greatest speed up and down [m/s]; 0 for a robot that stays on the ground or the water."""
    max_tilt: float = 0.0
    """Greatest roll and pitch that it holds on command [rad]; 0 for a robot without that command."""
    max_steering: float = 0.0
    """Greatest angle of its front wheels or its rudder [rad]; 0 for a robot without them."""
    min_radius: float = 0.0
    """Radius of its tightest turn [m]; 0 for a robot that turns on the spot."""
    icon: str = ""
    """Icon of its kind, a name of Material Symbols, as in sailing; empty for a generic one."""
    moves: str = ""
    """Verb for its motion, as a sentence begins: Sails; empty for Drives."""
    holds: str = ""
    """Words for keeping its place, likewise: Hovers where it is; empty for Stands still where it is."""
    order_fields: list[str] = []
    """Which of speed, throttle and height an order may give, height only with a max_climb; empty for speed
    and height.
    """
    dives: bool = False
    """It keeps a depth, which orders give in place of a height, and may lie any way up."""
    flies: bool = False
    """It takes off and lands."""
    footprint: list[Point32] = []
    """Corners of its outline in base_link, in order [m]; empty for a round one, of which radius tells all."""


class RudderState(Msg, frozen=True, gc=False):
    """The rudder and the propeller of a boat."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RudderState"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "float64", "float64", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"angle": "rad", "wanted": "rad", "thrust": "N"}
    header: Header = Header()
    """Frame base_link."""
    angle: float = 0.0
    """Angle of the rudder [rad], positive turns the boat to the left."""
    wanted: float = 0.0
    """Commanded rudder angle [rad]."""
    throttle: float = 0.0
    """Commanded thrust of the propeller, a fraction of its full thrust, -1 to 1."""
    thrust: float = 0.0
    """Thrust of the propeller [N], negative astern."""


class TaskProgress(Msg, frozen=True, gc=False):
    """Progress of the running task; /task/progress at 2 Hz, only while one runs."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/TaskProgress"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "int32", "float64", "float64", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"distance_to_next": "m", "time_left": "s", "distance_driven": "m"}
    stamp: Time = Time()
    """When it was computed."""
    task_id: int32 = 0
    """The task_id of TaskStatus."""
    progress: float = math.nan
    """Progress of this lap, or of the whole where laps are counted: 0 to 1."""
    distance_to_next: float = math.nan
    """Distance to the next point, along the path [m]."""
    time_left: float = math.nan
    """Estimated time to the end of this lap, or of the whole where laps are counted [s]."""
    distance_driven: float = 0.0
    """Distance driven in this run [m]."""


class RunTaskFeedback(TaskProgress, frozen=True, gc=False):
    """How far `RunTask` is."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/RunTaskFeedback"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "int32", "float64", "float64", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"distance_to_next": "m", "time_left": "s", "distance_driven": "m"}


class StartTaskRequest(CommandRequest, frozen=True, gc=False):
    """Starts a task."""

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
    """The order; with its task empty, the field `task` counts."""
    instead: bool = False
    """Replaces a task under way, which ends only when this one is accepted; the queue waits then."""


class RunTaskGoal(StartTaskRequest, frozen=True, gc=False):
    """Runs a task until its result; cancelling the goal ends the task."""

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
    """SUCCEEDED; any other outcome is a failure with its reason."""
    message: str = ""
    """One sentence: the result."""
    visited: int32 = 0
    """Waypoints reached."""


class ScheduledTask(Msg, frozen=True, gc=False):
    """A task that starts by itself, at a time of day or at intervals."""

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
    """It starts at its time; a disabled one is kept and does not start."""
    order: TaskOrder = field(default_factory=TaskOrder)
    """The order."""
    at: str = ""
    """Time of day as HH:MM, local time of the robot; empty when `every` is given."""
    days: _Boolx7 = field(default_factory=lambda: [True, True, True, True, True, True, True])
    """Days on which `at` counts, Monday first."""
    every: float = 0.0
    """Time from one start to the next [s]; 0 when `at` is given."""
    next: Time = Time()
    """Its next start, operators' clock, set by the robot; 0 for never."""


class Schedule(Msg, frozen=True, gc=False):
    """Scheduled tasks; latched on /schedule, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/Schedule"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "pilothouse_msgs/ScheduledTask[]")
    stamp: Time = Time()
    """When it changed, operators' clock."""
    tasks: list[ScheduledTask] = []
    """In the order of their ids."""


class SetLightsRequest(CommandRequest, frozen=True, gc=False):
    """Sets the brightness of the robot's lights."""

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
    """Stores a mission on the robot."""

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
    """Replaces the stored mission."""


class SetMissionResponse(CommandResponse, frozen=True, gc=False):
    """What `SetMission` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetMissionResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


class SetModeRequest(CommandRequest, frozen=True, gc=False):
    """Gives the robot to an operator or to its task."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetModeRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float64", "float64", "string", "string", "string")
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    mode: str = ""
    """MANUAL pauses the task, AUTO resumes it."""


class SetModeResponse(CommandResponse, frozen=True, gc=False):
    """What `SetMode` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetModeResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


class SetOptionRequest(CommandRequest, frozen=True, gc=False):
    """Changes one of the robot's settings; the value persists over restarts."""

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


class SetPayloadRequest(CommandRequest, frozen=True, gc=False):
    """Switches a payload on or off for all clients."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetPayloadRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "float64",
        "float64",
        "string",
        "string",
        "string",
        "bool",
    )
    UNITS: ClassVar[dict[str, str]] = {"stamp": "s", "valid_for": "s"}
    key: str = ""
    """Of the payload, as /payloads names it."""
    on: bool = False
    """It shall be offered."""


class SetPayloadResponse(CommandResponse, frozen=True, gc=False):
    """What `SetPayload` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetPayloadResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


class SetPlaceRequest(CommandRequest, frozen=True, gc=False):
    """Stores a place, or changes the one with its id."""

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
    """Replaces the place with its id; 0 makes a new one."""


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
    """Number of the place; 0 when not accepted."""


class SetQueueRequest(CommandRequest, frozen=True, gc=False):
    """Replaces the tasks after the running one."""

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
    """Revision of the TaskQueue that it edits; refused when the queue has changed since."""
    orders: list[TaskOrder] = []
    """Waiting orders, the next one first; those with an id stay unchanged."""


class SetQueueResponse(CommandResponse, frozen=True, gc=False):
    """What `SetQueue` answers."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/SetQueueResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string", "string", "string", "diagnostic_msgs/KeyValue[]")


class SetScheduleRequest(CommandRequest, frozen=True, gc=False):
    """Stores a scheduled task, or changes the one with its id."""

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
    """Replaces the task with its id; 0 makes a new one."""


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
    """Number of the scheduled task; 0 when not accepted."""


class SonarRing(Msg, frozen=True, gc=False):
    """Distances all round by ultrasound, each to the nearest object in a cone."""

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
    """Direction of each cone's middle in base_link [rad], 0 ahead, positive to the left."""
    field_of_view: float = 0.0
    """Width of a cone [rad]."""
    radius: float = 0.0
    """Distance of each sonar from the middle of the robot [m]."""
    range_min: float = 0.0
    """Shortest measurable distance [m]."""
    range_max: float = 0.0
    """Longest measurable distance [m]."""
    ranges: Float32Array = field(default_factory=Float32Array)
    """Distance from each sonar [m]; +inf for nothing in range, -inf for too close (REP-117)."""


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
    """Content of the card; empty when the card is gone."""


class TaskQueue(Msg, frozen=True, gc=False):
    """Waiting orders; latched on /task/queue, sent once per change."""

    MSGTYPE: ClassVar[str] = "pilothouse_msgs/TaskQueue"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time", "int32", "pilothouse_msgs/TaskOrder[]", "string")
    stamp: Time = Time()
    """When it changed, operators' clock."""
    revision: int32 = 0
    """Counts every change; /task/queue/set names the revision that it edits."""
    orders: list[TaskOrder] = []
    """Waiting orders, the next one first."""
    held: str = ""
    """Reason why it waits for /task/resume, as the end of a sentence; empty while it goes on by itself."""


class TaskStatus(Msg, frozen=True, gc=False):
    """The running task; latched on /task/status, sent once per change."""

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
    """IDLE, RUNNING, PAUSED, SUCCEEDED, CANCELED, FAILED or INTERRUPTED (by a restart; resume or cancel
    it).
    """
    reason: str = ""
    """One sentence for the operator: its activity and the cause."""
    motion: str = ""
    """loop, random or intermittent; empty without a patrol."""
    waypoint: int32 = 0
    """Number of the waypoint it is heading for, from 1; 0 for none."""
    waypoints: int32 = 0
    """Number of waypoints."""
    lap: int32 = 0
    """Number of the lap, from 1."""
    laps: int32 = 0
    """Number of laps; 0 for until stopped."""
    visited: int32 = 0
    """Waypoints reached in this run."""
    phase: str = ""
    """driving, waiting, dwelling, holding, turning, planning (searches a path), docking, undocking,
    charging, circling, taking off, landing, surfacing or unsure (of its place); empty for none of them.
    """
    asks: str = ""
    """A question that /task/confirm answers, as in: Has it been picked up at Office 12? Empty for none."""
    place: str = ""
    """Name of the place it heads for or stands at; empty for none."""
    places: list[str] = []
    """Names of the places of this task, in their order."""
    code: str = ""
    """Code of the reason, as in docs/bridge.md; empty without one."""
    actor_id: str = ""
    """The public id of the client that the reason is about; empty without one, or when it is not known."""
    parameters: list[KeyValue] = []
    """Values in the reason, by the keys of the code."""
