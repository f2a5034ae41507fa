"""The layout of messages in bytes, for reading and writing: codes, alignment, and the classes that have one."""

from __future__ import annotations

from bridge.codec.fields import CODES, TIMES, Field, fields_of
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from bridge.msgs.std_msgs import Duration

__all__ = ["CDR_LITTLE_ENDIAN", "counted", "fields_with_widths", "time_codes"]

CDR_LITTLE_ENDIAN = b"\x00\x01\x00\x00"
"""Header of a message in CDR; alignment counts from behind it."""


def fields_with_widths(cls: type[Msg]) -> tuple[Field, ...]:
    """The fields of `cls`; ProtocolError when it does not have the widths of its numbers."""
    fields = fields_of(cls)
    if not hasattr(cls, "ROSTYPES") and any(field.base in CODES for field in fields):
        raise ProtocolError(f"{cls.MSGTYPE or cls.__name__} does not give the widths of its numbers.")
    return fields


def counted(cls: type[Msg], cdr: bool) -> bool:
    """Whether ROS 1 has the publisher's count of messages before the stamp of `cls`, which the class leaves out."""
    return cls.MSGTYPE == "std_msgs/Header" and not cdr and fields_of(cls)[0].name != "seq"


def time_codes(cls: type[Msg], cdr: bool) -> str:
    """The codes of a time's two numbers."""
    if cdr:
        return TIMES["builtin_interfaces/Time"]
    return TIMES["duration" if issubclass(cls, Duration) else "time"]
