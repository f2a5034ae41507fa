"""std_msgs and the two built-in time types."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from bridge.msgs.base import Msg

__all__ = ["Duration", "Empty", "Float64", "Header", "Int32", "String", "Time"]


class Time(Msg, frozen=True, gc=False):
    """An instant of the robot's clock or the operators': docs/bridge.md says which stamp is of which.

    ROS 1 calls the fields `secs` and `nsecs`, ROS 2 `sec` and `nanosec`; both are understood, and the
    ROS 1 names are sent because both servers accept them.
    """

    MSGTYPE: ClassVar[str] = "time"
    secs: int = 0
    """Whole seconds since the clock's epoch [s]."""
    nsecs: int = 0
    """The rest [ns], 0 to 999999999."""
    sec: int | msgspec.UnsetType = msgspec.UNSET
    nanosec: int | msgspec.UnsetType = msgspec.UNSET

    def __post_init__(self) -> None:
        if self.sec is not msgspec.UNSET or self.nanosec is not msgspec.UNSET:
            msgspec.structs.force_setattr(self, "secs", self.sec or 0)
            msgspec.structs.force_setattr(self, "nsecs", self.nanosec or 0)
            msgspec.structs.force_setattr(self, "sec", msgspec.UNSET)
            msgspec.structs.force_setattr(self, "nanosec", msgspec.UNSET)

    @property
    def seconds(self) -> float:
        """The same instant as one number [s]."""
        return self.secs + self.nsecs * 1e-9

    @classmethod
    def at(cls, seconds: float) -> Time:
        """The instant `seconds` [s] after the epoch, to the nanosecond a float can say."""
        whole = int(seconds // 1)
        nanoseconds = round((seconds - whole) * 1e9)
        if nanoseconds == 1_000_000_000:
            whole, nanoseconds = whole + 1, 0
        return cls(whole, nanoseconds)


class Duration(Time, frozen=True, gc=False):
    """A length of time."""

    MSGTYPE: ClassVar[str] = "duration"


class Header(Msg, frozen=True, gc=False):
    """When and in which frame a message was measured."""

    MSGTYPE: ClassVar[str] = "std_msgs/Header"
    stamp: Time = Time()
    frame_id: str = ""
    """Name of the coordinate frame (REP-105): `map`, `odom`, `base_link`, or a sensor's."""


class String(Msg, frozen=True, gc=False):
    """A text."""

    MSGTYPE: ClassVar[str] = "std_msgs/String"
    data: str = ""


class Float64(Msg, frozen=True, gc=False):
    """A number."""

    MSGTYPE: ClassVar[str] = "std_msgs/Float64"
    data: float = 0.0


class Int32(Msg, frozen=True, gc=False):
    """A whole number."""

    MSGTYPE: ClassVar[str] = "std_msgs/Int32"
    data: int = 0


class Empty(Msg, frozen=True, gc=False):
    """Nothing but the fact that it was sent."""

    MSGTYPE: ClassVar[str] = "std_msgs/Empty"
