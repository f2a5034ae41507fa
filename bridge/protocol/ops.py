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
"""Identifies an interaction; returned unchanged. UNSET where the sender gave none."""

LEVELS = ("info", "warning", "error", "none")
"""Levels of remarks that a client may ask for, from everything to nothing."""

COMPRESSIONS = ("none", "png", "cbor", "cbor-raw")
"""Compressions of messages; of several that one client asks for, the later in this row wins."""

Number = int | float | None
"""Clients send whole numbers as floats, and null where they mean nothing."""
MISSING = Raw(b"{}")
"""Stands for a missing message, arguments or values: this very object, which reads as an empty one."""


class Op(msgspec.Struct, frozen=True, tag_field="op", omit_defaults=True, kw_only=True):
    """One operation."""

    id: Id = UNSET
    fragment_size: Number | UnsetType = UNSET
    """Longest text frame [characters] that the sender wants from now on, longer ones come as `Fragment`s; null for no
    limit."""


class Advertise(Op, frozen=True, tag="advertise"):
    """The sender is going to publish on `topic`."""

    topic: str
    type: str | None = None
    latch: bool | None = False
    """Whether later subscribers get the last message at once."""
    queue_size: Number = 100


class Unadvertise(Op, frozen=True, tag="unadvertise"):
    """Ends an `Advertise`; without `id` all of them for `topic`."""

    topic: str


class Publish(Op, frozen=True, tag="publish"):
    """A message."""

    topic: str
    msg: Raw = MISSING
    """The message as JSON text; fields that are missing take their defaults."""
    latch: bool | None = False
    queue_size: Number = 100
    stamp: float | None = None
    """The operators' clock [s] at the operator's input; None when the sender does not say."""


class Reduction(msgspec.Struct, frozen=True, omit_defaults=True):
    """The part of each message that a subscriber wants; None where it wants all. Hashable: a key of encoded forms."""

    fields: tuple[str, ...] | None = None
    """Paths of the only fields to send, as in `pose.pose.position`."""
    beams: int | None = None
    """Most ranges of a LaserScan; of those that are merged the nearest is kept."""
    width: int | None = None
    """Most columns of a picture [px]; its shape is kept."""
    quality: int | None = None
    """JPEG quality of a picture, 1 to 95."""
    resolution: float | None = None
    """Least edge of a map's cell [m]; of cells that are merged the most occupied is kept."""


class Subscribe(Op, frozen=True, tag="subscribe"):
    """The sender wants the messages on `topic`."""

    topic: str
    type: str | None = None
    throttle_rate: Number = 0
    """Shortest time between two messages [ms]."""
    queue_length: Number = 0
    """Most messages that may wait; 0 for the server's choice."""
    compression: str | None = "none"
    """One of `COMPRESSIONS`; anything else counts as `none`."""
    reduce: Reduction | None = None


class Unsubscribe(Op, frozen=True, tag="unsubscribe"):
    """Ends a `Subscribe`; without `id` all of them for `topic`."""

    topic: str


class CallService(Op, frozen=True, tag="call_service"):
    """A request to a service, answered once."""

    service: str
    args: Raw = MISSING
    """An object, or a list of the fields in their order, as JSON text."""
    compression: str | None = "none"
    timeout: Number = None
    """Longest time for the answer [s]; None for no limit."""


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
    """Ends an `AdvertiseService`."""

    service: str


class AdvertiseAction(Op, frozen=True, tag="advertise_action"):
    """The sender carries goals of `action` out from now on."""

    action: str
    type: str = ""


class UnadvertiseAction(Op, frozen=True, tag="unadvertise_action"):
    """Ends an `AdvertiseAction`."""

    action: str


class SendActionGoal(Op, frozen=True, tag="send_action_goal"):
    """A goal of an action; its `id` identifies the goal."""

    action: str
    action_type: str = ""
    args: Raw = MISSING
    """The goal as JSON text: an object, or a list of the fields in their order."""
    feedback: bool | None = False
    """Whether the sender wants feedback."""
    compression: str | None = "none"


class CancelActionGoal(Op, frozen=True, tag="cancel_action_goal"):
    """Cancels the goal `id`."""

    action: str


class ActionFeedback(Op, frozen=True, tag="action_feedback", omit_defaults=False):
    """Feedback of the goal `id`."""

    action: str
    values: Raw = MISSING


class ActionResult(Op, frozen=True, tag="action_result", omit_defaults=False):
    """The result of the goal `id`."""

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
    """Index of the slice, from 0."""
    total: int | float
    """Number of slices. The ROS 1 server sends 3.7 where it means 3; the whole part counts."""


class Png(Op, frozen=True, tag="png", omit_defaults=False):
    """Another operation's JSON text in the pixels of a picture."""

    data: str
    """Base64 of a PNG file."""
    num: int | float | None = None
    total: int | float | None = None


class Status(Op, frozen=True, tag="status", omit_defaults=False):
    """A remark of the server, sent to clients that asked for it by `SetLevel`."""

    level: str = "error"
    msg: str = ""


class SetLevel(Op, frozen=True, tag="set_level"):
    """The least level of remarks that the sender wants: one of `LEVELS`."""

    level: str = "error"


class Auth(Op, frozen=True, tag="auth"):
    """Credentials. A robot of ours takes a `token`; what ROS 1 servers ask for instead is accepted and ignored."""

    token: str = ""


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
"""All operations."""
