"""tf2_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

from typing import ClassVar

from bridge.msgs.base import Msg, uint8
from bridge.msgs.builtin_interfaces import Duration, Time
from bridge.msgs.geometry_msgs import TransformStamped

__all__ = [
    "FrameGraphRequest",
    "FrameGraphResponse",
    "LookupTransformFeedback",
    "LookupTransformGoal",
    "LookupTransformResult",
    "TF2Error",
    "TFMessage",
]


class FrameGraphRequest(Msg, frozen=True, gc=False):
    """Ask for the frame tree."""

    MSGTYPE: ClassVar[str] = "tf2_msgs/FrameGraphRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class FrameGraphResponse(Msg, frozen=True, gc=False):
    """What `FrameGraph` answers."""

    MSGTYPE: ClassVar[str] = "tf2_msgs/FrameGraphResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    frame_yaml: str = ""
    """The frames as YAML."""


class LookupTransformFeedback(Msg, frozen=True, gc=False):
    """How far `LookupTransform` is."""

    MSGTYPE: ClassVar[str] = "tf2_msgs/LookupTransformFeedback"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class LookupTransformGoal(Msg, frozen=True, gc=False):
    """Wait for a transform between two frames."""

    MSGTYPE: ClassVar[str] = "tf2_msgs/LookupTransformGoal"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "string", "time", "duration", "time", "string", "bool")
    target_frame: str = ""
    source_frame: str = ""
    source_time: Time = Time()
    """0 for the newest."""
    timeout: Duration = Duration()
    """Time to wait for it [s]."""
    target_time: Time = Time()
    """Looked at only where advanced is true."""
    fixed_frame: str = ""
    """Does not move between the two times; looked at only where advanced is true."""
    advanced: bool = False
    """Between two times, over the fixed frame."""


class TF2Error(Msg, frozen=True, gc=False):
    """Reason why a transform is not known."""

    MSGTYPE: ClassVar[str] = "tf2_msgs/TF2Error"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint8", "string")
    CONSTTYPES: ClassVar[tuple[str, ...]] = ("uint8",) * 7

    NO_ERROR: ClassVar[int] = 0
    LOOKUP_ERROR: ClassVar[int] = 1
    """A frame is not known."""
    CONNECTIVITY_ERROR: ClassVar[int] = 2
    """Nothing joins the two frames."""
    EXTRAPOLATION_ERROR: ClassVar[int] = 3
    """The time lies outside of what is known."""
    INVALID_ARGUMENT_ERROR: ClassVar[int] = 4
    TIMEOUT_ERROR: ClassVar[int] = 5
    TRANSFORM_ERROR: ClassVar[int] = 6

    error: uint8 = 0
    """One of …_ERROR."""
    error_string: str = ""
    """One sentence."""


class LookupTransformResult(Msg, frozen=True, gc=False):
    """What `LookupTransform` came to."""

    MSGTYPE: ClassVar[str] = "tf2_msgs/LookupTransformResult"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("geometry_msgs/TransformStamped", "tf2_msgs/TF2Error")
    transform: TransformStamped = TransformStamped()
    error: TF2Error = TF2Error()


class TFMessage(Msg, frozen=True, gc=False):
    """Some edges of the frame tree (REP-105)."""

    MSGTYPE: ClassVar[str] = "tf2_msgs/TFMessage"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("geometry_msgs/TransformStamped[]",)
    transforms: list[TransformStamped] = []
