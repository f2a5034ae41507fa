"""The layout of messages in bytes, for reading and writing: codes, alignment, and the classes that have one."""

from __future__ import annotations

from bridge.codec.fields import CODES, HEADER, TIMES, Field, ros_fields
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from bridge.msgs.std_msgs import Duration

__all__ = ["CDR_LITTLE_ENDIAN", "fields_with_widths", "lacks_count", "time_codes"]

CDR_LITTLE_ENDIAN = b"\x00\x01\x00\x00"
"""Header of a message in CDR; alignment counts from behind it."""


def fields_with_widths(cls: type[Msg], cdr: bool) -> tuple[Field, ...]:
    """The fields of `cls` in ROS 1, or with `cdr` in ROS 2; ProtocolError when it does not have the widths of its numbers."""
    fields = ros_fields(cls, cdr)
    if not hasattr(cls, "ROSTYPES") and any(field.base in CODES for field in fields):
        raise ProtocolError(f"{cls.MSGTYPE or cls.__name__} does not give the widths of its numbers.")
    return fields


def lacks_count(cls: type[Msg], cdr: bool) -> bool:
    """Whether ROS 1 has the publisher's count of messages before the stamp of `cls`, and the class leaves it out."""
    return cls.MSGTYPE == HEADER and not cdr and all(field.key != "seq" for field in ros_fields(cls, cdr))


def time_codes(cls: type[Msg], cdr: bool) -> str:
    """The codes of a time's two numbers."""
    if cdr:
        return TIMES["builtin_interfaces/Time"]
    return TIMES["duration" if issubclass(cls, Duration) else "time"]
