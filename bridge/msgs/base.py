"""The base of every message class, an immutable record with its ROS type names, and ROS's whole numbers."""

from __future__ import annotations

from typing import Annotated, ClassVar, TypeAlias

import msgspec
from msgspec import Meta

__all__ = [
    "Msg",
    "byte",
    "char",
    "int8",
    "int16",
    "int32",
    "int64",
    "uint8",
    "uint16",
    "uint32",
    "uint64",
]

int8: TypeAlias = Annotated[int, Meta(ge=-(2**7), le=2**7 - 1)]
int16: TypeAlias = Annotated[int, Meta(ge=-(2**15), le=2**15 - 1)]
int32: TypeAlias = Annotated[int, Meta(ge=-(2**31), le=2**31 - 1)]
int64: TypeAlias = Annotated[int, Meta(ge=-(2**63), le=2**63 - 1)]
uint8: TypeAlias = Annotated[int, Meta(ge=0, le=2**8 - 1)]
uint16: TypeAlias = Annotated[int, Meta(ge=0, le=2**16 - 1)]
uint32: TypeAlias = Annotated[int, Meta(ge=0, le=2**32 - 1)]
uint64: TypeAlias = Annotated[int, Meta(ge=0, le=2**63 - 1)]
"""0 to 2**64 - 1. msgspec compares in 64 bits with sign; what is above is left to the codec's own reader."""
char: TypeAlias = uint8
byte: TypeAlias = Annotated[int, Meta(ge=-(2**7), le=2**8 - 1)]
"""Eight bits: with a sign in ROS 1, without one in ROS 2; both are understood."""


class Msg(msgspec.Struct, frozen=True, gc=False):
    """A ROS message, or one part of a ROS service or action.

    Field names are ROS's own. Units follow REP-103 (metre, second, radian) unless a field says otherwise.
    A float that is not known is NaN; it travels as `null` in JSON.
    """

    MSGTYPE: ClassVar[str] = ""
    """Full ROS 1 name of the type, as in `sensor_msgs/Imu`; a service's halves end in `Request` and `Response`,
    an action's parts in `Goal`, `Result` and `Feedback`."""

    ROSTYPES: ClassVar[tuple[str, ...]]
    """The exact ROS type of each field in its order, as in `float64[36]`, `geometry_msgs/Pose`, `string<=20`, `time`.

    Only these know a number's width. Every generated or learned class has them.
    """

    CONSTTYPES: ClassVar[tuple[str, ...]] = ()
    """The exact ROS type of each constant of the class in their order; empty where nobody gave them."""
