"""The operations of rosbridge v2 as records; the field names are those on the wire.

Two extensions, which foreign servers ignore: `publish` may carry `stamp`, and `subscribe` may carry `reduce`. What came as
CBOR instead of text is a `BinaryPublish`.
"""

from __future__ import annotations

from dataclasses import dataclass

import msgspec
from msgspec import UNSET, Raw, UnsetType

__all__ = [
    "ActionFeedback",
    "ActionResult",
    "Advertise",
    "AdvertiseAction",
    "AdvertiseService",
    "Auth",
    "BinaryPublish",
    "COMPRESSIONS",
    "CallService",
    "CancelActionGoal",
    "Fragment",
    "Id",
    "LEVELS",
    "MISSING",
    "OPS",
    "Op",
    "Png",
    "Publish",
    "Reduction",
    "SendActionGoal",
    "ServiceResponse",
    "SetLevel",
    "Status",
    "Subscribe",
    "Unadvertise",
    "UnadvertiseAction",
    "UnadvertiseService",
    "Unsubscribe",
]

Id = str | int | float | UnsetType | None
"""Names an interaction; given back as it came. UNSET where the sender gave none."""

LEVELS = ("info", "warning", "error", "none")
"""What a client may ask to be told, from everything to nothing."""

COMPRESSIONS = ("none", "png", "cbor", "cbor-raw")
"""How a message may travel; when several subscriptions of a client differ, the later in this row wins."""

Number = int | float | None
"""Clients send whole numbers as floats, and null where they mean nothing."""
MISSING = Raw(b"{}")
"""Stands where a message, arguments or values were left out: that very object, and an empty one to whoever reads it."""


class Op(msgspec.Struct, frozen=True, tag_field="op", omit_defaults=True, kw_only=True):
    """One operation."""

    id: Id = UNSET
    fragment_size: Number | UnsetType = UNSET
    """Longest text frame [characters] that the sender wants from now on, longer ones come as `Fragment`s; null for no end."""


class Advertise(Op, frozen=True, tag="advertise"):
    """The sender is going to publish on `topic`."""

    topic: str
    type: str | None = None
    latch: bool | None = False
    """Whoever subscribes later gets the last message at once."""
    queue_size: Number = 100


class Unadvertise(Op, frozen=True, tag="unadvertise"):
    """Takes an `Advertise` back; without `id` all of them for `topic`."""

    topic: str


class Publish(Op, frozen=True, tag="publish"):
    """A message."""

    topic: str
    msg: Raw = MISSING
    """The message as JSON text; fields that are missing take their defaults."""
    latch: bool | None = False
    queue_size: Number = 100
    stamp: float | None = None
    """When the sender meant it [s], operators' clock; None when it does not say."""


class Reduction(msgspec.Struct, frozen=True, omit_defaults=True):
    """How much of each message a subscriber wants; None where it wants all. Hashable: a key of what is encoded once."""

    fields: tuple[str, ...] | None = None
    """Paths of the only fields that are to travel, as in `pose.pose.position`."""
    beams: int | None = None
    """At most so many ranges of a LaserScan; of those that fall together the nearest is kept."""
    width: int | None = None
    """At most so many columns of a picture [px]; its shape is kept."""
    quality: int | None = None
    """JPEG quality of a picture, 1 to 95."""
    resolution: float | None = None
    """Least edge of a map's cell [m]; of cells that fall together the most occupied is kept."""


class Subscribe(Op, frozen=True, tag="subscribe"):
    """The sender wants what is published on `topic`."""

    topic: str
    type: str | None = None
    throttle_rate: Number = 0
    """Shortest time between two messages [ms]."""
    queue_length: Number = 0
    """How many messages may wait; 0 as many as the server sees fit."""
    compression: str | None = "none"
    """One of `COMPRESSIONS`; anything else counts as `none`."""
    reduce: Reduction | None = None


class Unsubscribe(Op, frozen=True, tag="unsubscribe"):
    """Takes a `Subscribe` back; without `id` all of them for `topic`."""

    topic: str


class CallService(Op, frozen=True, tag="call_service"):
    """Asks for something to be done once and answered."""

    service: str
    args: Raw = MISSING
    """An object, or a list of the fields in their order, as JSON text."""
    compression: str | None = "none"
    timeout: Number = None
    """How long the answer may take [s]; None as long as it wants."""


class ServiceResponse(Op, frozen=True, tag="service_response", omit_defaults=False):
    """The answer to a `CallService` with the same `id`."""

    service: str = ""
    values: Raw = MISSING
    """The response; the reason as a text when `result` is false."""
    result: bool = True


class AdvertiseService(Op, frozen=True, tag="advertise_service"):
    """The sender answers calls of `service` from now on."""

    service: str
    type: str = ""


class UnadvertiseService(Op, frozen=True, tag="unadvertise_service"):
    """Takes an `AdvertiseService` back."""

    service: str


class AdvertiseAction(Op, frozen=True, tag="advertise_action"):
    """The sender carries goals of `action` out from now on."""

    action: str
    type: str = ""


class UnadvertiseAction(Op, frozen=True, tag="unadvertise_action"):
    """Takes an `AdvertiseAction` back."""

    action: str


class SendActionGoal(Op, frozen=True, tag="send_action_goal"):
    """Asks for something that takes a while; its `id` names the goal."""

    action: str
    action_type: str = ""
    args: Raw = MISSING
    """The goal as JSON text: an object, or a list of the fields in their order."""
    feedback: bool | None = False
    """The sender wants to hear how it goes."""
    compression: str | None = "none"


class CancelActionGoal(Op, frozen=True, tag="cancel_action_goal"):
    """Takes the goal called `id` back."""

    action: str


class ActionFeedback(Op, frozen=True, tag="action_feedback", omit_defaults=False):
    """How far the goal called `id` is."""

    action: str
    values: Raw = MISSING


class ActionResult(Op, frozen=True, tag="action_result", omit_defaults=False):
    """What became of the goal called `id`."""

    action: str
    values: Raw = MISSING
    """The result; the reason as a text when `result` is false."""
    status: int = 0
    """As in action_msgs/GoalStatus: 0 unknown, 1 accepted, 2 executing, 3 canceling, 4 succeeded, 5 canceled, 6 aborted."""
    result: bool = True


class Fragment(Op, frozen=True, tag="fragment", omit_defaults=False):
    """A slice of another operation's JSON text."""

    data: str
    num: int | float
    """Its place among the slices, from 0."""
    total: int | float
    """How many slices there are. The ROS 1 server sends 3.7 where it means 3; the whole part counts."""


class Png(Op, frozen=True, tag="png", omit_defaults=False):
    """Another operation's JSON text in the pixels of a picture."""

    data: str
    """Base64 of a PNG file."""
    num: int | float | None = None
    total: int | float | None = None


class Status(Op, frozen=True, tag="status", omit_defaults=False):
    """A remark of the server; sent only to those who asked by `SetLevel`."""

    level: str = "error"
    msg: str = ""


class SetLevel(Op, frozen=True, tag="set_level"):
    """Which remarks the sender wants: one of `LEVELS`."""

    level: str = "error"


class Auth(Op, frozen=True, tag="auth"):
    """Credentials for a ROS 1 server that asks for them; taken and not looked at."""


@dataclass(frozen=True, slots=True)
class BinaryPublish:
    """A `Publish` that came as CBOR."""

    topic: str
    msg: object
    """The message as decoded, for `codec.from_builtins`."""


OPS: tuple[type[Op], ...] = (
    Advertise,
    Unadvertise,
    Publish,
    Subscribe,
    Unsubscribe,
    CallService,
    ServiceResponse,
    AdvertiseService,
    UnadvertiseService,
    AdvertiseAction,
    UnadvertiseAction,
    SendActionGoal,
    CancelActionGoal,
    ActionFeedback,
    ActionResult,
    Fragment,
    Png,
    Status,
    SetLevel,
    Auth,
)
"""All of them."""
