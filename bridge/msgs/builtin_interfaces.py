"""ROS's two built-in types, time and duration, which ROS 1 and ROS 2 spell differently."""

from __future__ import annotations

from typing import Annotated, ClassVar, TypeAlias

import msgspec
from msgspec import Meta

from bridge.msgs.base import Msg

__all__ = ["Duration", "Time"]

_Count: TypeAlias = Annotated[int, Meta(ge=-(2**31), le=2**32 - 1)]
"""32 bits: with a sign in some of ROS 1 and 2, without one in others."""


class Time(Msg, frozen=True, gc=False):
    """An instant of the robot's clock or of the operators' clock; docs/bridge.md lists the stamps of each.

    ROS 1 calls the fields `secs` and `nsecs`, ROS 2 `sec` and `nanosec`; both are understood, and the ROS 1 names are
    sent because both servers accept them.
    """

    MSGTYPE: ClassVar[str] = "time"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint32", "uint32")
    secs: _Count = 0
    """Whole seconds since the clock's epoch [s]."""
    nsecs: _Count = 0
    """The fraction [ns], 0 to 999999999."""
    sec: _Count | msgspec.UnsetType = msgspec.UNSET
    nanosec: _Count | msgspec.UnsetType = msgspec.UNSET

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
        """The instant `seconds` [s] after the epoch, as precise as a float."""
        whole = int(seconds // 1)
        nanoseconds = round((seconds - whole) * 1e9)
        if nanoseconds == 1_000_000_000:
            whole, nanoseconds = whole + 1, 0
        return cls(whole, nanoseconds)


class Duration(Time, frozen=True, gc=False):
    """A length of time."""

    MSGTYPE: ClassVar[str] = "duration"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int32", "int32")
