"""What goes to and fro in each operation, as dataclasses; `fields` says how they are written.

A request's numbers have limits, so that NaN and infinity are none. A number of an answer that is not known is left out.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from robotside.gateways.plain.strict_json import MAX_INPUT
from robotside.gateways.soap.fields import About

__all__ = [
    "MAX_PATIENCE",
    "Answer",
    "CallService",
    "Caller",
    "Deliver",
    "Done",
    "FetchMessages",
    "GetMessage",
    "GoTo",
    "Guide",
    "GuideTo",
    "Info",
    "Message",
    "Messages",
    "MoveArm",
    "Nothing",
    "Notify",
    "Place",
    "Places",
    "Pose",
    "PublishMessage",
    "Refusal",
    "StartTask",
    "Status",
    "Subscribe",
    "Subscription",
    "SubscriptionId",
    "Time",
    "Waypoint",
]

MAX_PATIENCE = 10.0
"""A call waits for a message for no longer [s]."""

_Stamp = Annotated[float | None, About("when it was meant, the robot's time as of GetTime [s]", -1e12, 1e12)]
_PlaceName = Annotated[str, About("name of a place, as of ListPlaces, or home", 1, 64)]
_PlaceNames = Annotated[tuple[str, ...], About("names of places, in this order", 1, 64, count=32)]
_Text = Annotated[str | None, About("for the person who receives it or is guided", 0, 200)]
_Instead = Annotated[bool | None, About("replaces the task under way")]
_Topic = Annotated[str, About("name of a topic, as in /odom", 1, 200)]
_Json = Annotated[str, About("JSON in ROS's names", 0, MAX_INPUT)]
_Patience = Annotated[float | None, About("waits for a message for so long [s]", 0, MAX_PATIENCE)]
_Id = Annotated[str, About("as of Subscribe", 1, 64)]
_Angle = Annotated[float | None, About("[rad], 0 east, anticlockwise", -10, 10)]


@dataclass(frozen=True, slots=True)
class Caller:
    """The header that says who calls; all of it may be left out."""

    client_id: Annotated[
        str | None, About("stays the same; who gives it keeps control between calls", 1, 64)
    ] = None
    client_name: Annotated[str | None, About("for people, as in tablet-B", 1, 40)] = None
    command_id: Annotated[str | None, About("unique per command; a repeated one is done once", 1, 64)] = None
    stamp: _Stamp = None
    valid_for: Annotated[float | None, About("not done when older than this on arrival [s]", 0, 60)] = None


@dataclass(frozen=True, slots=True)
class Refusal:
    """The detail of a fault."""

    code: Annotated[str, About("as in docs/bridge.md; empty where there is none")]
    message: Annotated[str, About("one sentence")]


@dataclass(frozen=True, slots=True)
class Nothing:
    """A request without fields."""


@dataclass(frozen=True, slots=True)
class Done:
    """The answer to a command that was accepted."""

    message: Annotated[str, About("one sentence")]


@dataclass(frozen=True, slots=True)
class Info:
    """Who the robot is."""

    name: str
    kind: Annotated[str, About("wheels, ackermann, boat, hexapod, quadrotor, or another one")]
    model: str
    description: str
    world: str
    max_speed: Annotated[float | None, About("[m/s]")]
    max_yaw_rate: Annotated[float | None, About("[rad/s]")]
    radius: Annotated[float | None, About("[m]")]
    camera: Annotated[tuple[str, ...], About("names of its cameras", count=0)]
    payload: Annotated[tuple[str, ...], About("what it carries", count=0)]
    task: Annotated[tuple[str, ...], About("tasks that it knows", count=0)]
    arm_pose: Annotated[tuple[str, ...], About("poses that its arm knows", count=0)]


@dataclass(frozen=True, slots=True)
class Status:
    """How the robot is."""

    mode: Annotated[str, About("MANUAL, AUTO, PAUSED or STOPPED")]
    driver: Annotated[str, About("who has control; empty when it is free")]
    stopped: Annotated[bool, About("STOP is pressed")]
    stopped_by: str
    at_rest: bool
    task: Annotated[str, About("runs or ran last; empty for none")]
    state: Annotated[
        str, About("of the task: IDLE, RUNNING, PAUSED, SUCCEEDED, CANCELED, FAILED, INTERRUPTED")
    ]
    reason: Annotated[str, About("what it does, and why, in one sentence")]
    place: Annotated[str, About("where it goes or stands; empty for none")]
    asks: Annotated[str, About("a question that Confirm answers; empty for none")]
    battery: Annotated[float | None, About("charge, 0 to 1")]
    position_sure: Annotated[bool, About("it is certain where it is")]


@dataclass(frozen=True, slots=True)
class Pose:
    """Where the robot is on its map."""

    x: Annotated[float | None, About("east of the map's origin [m]")]
    y: Annotated[float | None, About("north of the map's origin [m]")]
    yaw: Annotated[float | None, About("[rad], 0 east, anticlockwise")]
    stamp: Annotated[float, About("when, the robot's time [s]")]
    sure: Annotated[bool, About("it is certain of it")]
    height: Annotated[float | None, About("above the map's origin [m], negative under water")] = None


@dataclass(frozen=True, slots=True)
class Time:
    """The robot's time."""

    stamp: Annotated[float, About("[s]")]


@dataclass(frozen=True, slots=True)
class Place:
    """A place with a name."""

    id: int
    name: str
    kind: Annotated[str, About("place, office, home, dock, reception, lab or hall")]
    floor: str
    x: Annotated[float, About("east of the map's origin [m]")]
    y: Annotated[float, About("north of the map's origin [m]")]
    yaw: Annotated[float | None, About("direction to stand in [rad]; left out where any will do")]
    note: str


@dataclass(frozen=True, slots=True)
class Places:
    """All places."""

    place: Annotated[tuple[Place, ...], About("in the order of their ids", count=0)]


@dataclass(frozen=True, slots=True)
class Deliver:
    """Have something brought."""

    source: _PlaceName
    target: _PlaceName
    item: Annotated[str | None, About("what it is, shown to who receives it", 0, 200)] = None
    next_: Annotated[str | None, About("name of a place to go on to", 1, 64)] = None
    card: Annotated[str | None, About("what the recipient's card reads", 0, 64)] = None
    instead: _Instead = None


@dataclass(frozen=True, slots=True)
class GoTo:
    """Go somewhere."""

    place: _PlaceName
    instead: _Instead = None


@dataclass(frozen=True, slots=True)
class GuideTo:
    """Lead a person along places."""

    place: _PlaceNames
    message: _Text = None
    instead: _Instead = None


@dataclass(frozen=True, slots=True)
class Waypoint:
    """A point of the map."""

    x: Annotated[float, About("east of the map's origin [m]", -1e5, 1e5)]
    y: Annotated[float, About("north of the map's origin [m]", -1e5, 1e5)]
    yaw: _Angle = None
    height: Annotated[float | None, About("to be at there, above the map's origin [m]", -1e4, 1e4)] = None


@dataclass(frozen=True, slots=True)
class StartTask:
    """Start any task."""

    task: Annotated[str, About("as of GetInfo", 1, 40)]
    place: _PlaceNames = ()
    goal: Annotated[tuple[Waypoint, ...], About("points for go_to in place of a place", count=32)] = ()
    message: _Text = None
    heading: _Angle = None
    speed: Annotated[float | None, About("[m/s]", 0, 100)] = None
    height: Annotated[float | None, About("above the map's origin [m]", -1e4, 1e4)] = None
    duration: Annotated[float | None, About("[s]", 0, 86400)] = None
    instead: _Instead = None


@dataclass(frozen=True, slots=True)
class MoveArm:
    """Move the arm: to a pose, to angles or by increments, one of them, and open its gripper."""

    pose: Annotated[str | None, About("name of a pose, as of GetInfo", 1, 40)] = None
    angle: Annotated[tuple[float, ...], About("of each joint, from the foot on [rad]", -10, 10)] = ()
    increment: Annotated[
        tuple[float, ...], About("added to each joint, from the foot on [rad]", -10, 10)
    ] = ()
    gripper: Annotated[float | None, About("opening [m]", 0, 10)] = None


@dataclass(frozen=True, slots=True)
class PublishMessage:
    """Give the robot a message on a topic."""

    topic: _Topic
    message: _Json


@dataclass(frozen=True, slots=True)
class CallService:
    """Call any service of the robot."""

    service: Annotated[str, About("name of a service, as in /lights/set", 1, 200)]
    message: Annotated[str | None, About("JSON in ROS's names", 0, MAX_INPUT)] = None


@dataclass(frozen=True, slots=True)
class Answer:
    """What a service answered."""

    message: Annotated[str, About("JSON in ROS's names")]


@dataclass(frozen=True, slots=True)
class GetMessage:
    """Read a topic once."""

    topic: _Topic
    patience: _Patience = None


@dataclass(frozen=True, slots=True)
class Message:
    """A message of the robot."""

    topic: str
    type: Annotated[str, About("ROS type")]
    message: Annotated[str, About("JSON in ROS's names")]


@dataclass(frozen=True, slots=True)
class Messages:
    """Messages of a subscription."""

    message: Annotated[tuple[Message, ...], About(count=0)]


@dataclass(frozen=True, slots=True)
class Notify:
    """Messages that a subscriber is called back with."""

    subscription: _Id
    message: Annotated[tuple[Message, ...], About(count=0)]


@dataclass(frozen=True, slots=True)
class Subscribe:
    """Subscribe to topics, to fetch their messages or to have them sent."""

    topic: Annotated[tuple[str, ...], About("names of topics, as in /task/status", 1, 200)]
    callback: Annotated[
        str | None, About("URL of the client's own Subscriber service, on its own address", 1, 500)
    ] = None


@dataclass(frozen=True, slots=True)
class Subscription:
    """A subscription."""

    subscription: Annotated[str, About("its id; who knows it may fetch its messages")]
    lifetime: Annotated[float, About("it ends so long after its latest FetchMessages or Renew [s]")]


@dataclass(frozen=True, slots=True)
class SubscriptionId:
    """Which subscription."""

    subscription: _Id


@dataclass(frozen=True, slots=True)
class FetchMessages:
    """Fetch what came since the last fetch: the newest of each topic, and each event."""

    subscription: _Id
    patience: _Patience = None


@dataclass(frozen=True, slots=True)
class Guide:
    """How the robot is used."""

    text: str
