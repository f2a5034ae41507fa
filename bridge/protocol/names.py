"""Names on the wire: topics, services, types, and the ids of interactions."""

from __future__ import annotations

import re

from msgspec import UNSET

from bridge.codec import shown
from bridge.core.errors import ProtocolError
from bridge.protocol.ops import CallService, Id, Op

__all__ = [
    "MAX_ID_LENGTH",
    "MAX_NAME_LENGTH",
    "absolute",
    "checked_id",
    "checked_name",
    "plain_id",
    "ros2_name",
    "service_and_id",
    "spells_ros2",
    "wrong",
]

MAX_NAME_LENGTH = 256
"""Longest name that is kept [characters]."""
MAX_ID_LENGTH = 1024
"""Longest id that is kept [characters]."""
_ROS2 = re.compile(r"^[^/]+/(?:msg|srv|action)/[^/]+$")


def absolute(name: str) -> str:
    """The absolute name of a topic, service or action, as ROS resolves a relative one."""
    return name if name.startswith("/") else f"/{name}"


def checked_name(name: str, op: Op, field: str) -> str:
    """`name` made absolute; ProtocolError when it is empty, too long to be kept, or has an empty part.

    ROS names have no empty part: `/stop/` and `//stop` would look like `/stop` to people and differ from it for programs.
    """
    if not 0 < len(name) <= MAX_NAME_LENGTH:
        raise wrong(op, f"{field} must have 1 to {MAX_NAME_LENGTH} characters, not {len(name)}.")
    full = absolute(name)
    if "//" in full or full.endswith("/"):
        raise wrong(op, f"{field} must be a name without empty parts, as /stop, not {shown(name)}.")
    return full


def checked_id(op: Op) -> Id:
    """The operation's id; ProtocolError when it is too long to be kept."""
    if not isinstance(op.id, str) or len(op.id) <= MAX_ID_LENGTH:
        return op.id
    raise wrong(op, f"id must have at most {MAX_ID_LENGTH} characters, not {len(op.id)}.")


def plain_id(id: Id) -> str | float | None:
    """The id for an error: None where there is none, or one too long to repeat."""
    if id is UNSET or (isinstance(id, str) and len(id) > MAX_ID_LENGTH):
        return None
    return id


def service_and_id(op: CallService) -> tuple[str, Id]:
    """The absolute name of the called service and the id to answer with.

    Old clients write the id behind the name, as in `/rosapi/topics#33`; it counts where there is no other.
    """
    name, mark, old_id = op.service.partition("#")
    if mark and op.id in (None, UNSET):
        return absolute(name), old_id
    return absolute(name), op.id


def spells_ros2(type: str | None) -> bool:
    """Whether a type is named as in ROS 2: `sensor_msgs/msg/Imu`, not `sensor_msgs/Imu`."""
    return type is not None and _ROS2.match(type) is not None


def ros2_name(type: str, kind: str = "msg") -> str:
    """The ROS 2 form of a type's name; `kind` is `msg`, `srv` or `action`. Anything but `pkg/Type` stays as it is."""
    package, _, name = type.partition("/")
    return f"{package}/{kind}/{name}" if package and name and "/" not in name else type


def wrong(op: Op, sentence: str) -> ProtocolError:
    """A ProtocolError with `sentence`, and the name and id of `op`."""
    return ProtocolError(sentence, op=str(op.__struct_config__.tag), id=plain_id(op.id))
