"""diagnostic_msgs: the robot's own opinion of its parts."""

from __future__ import annotations

from typing import ClassVar

from bridge.msgs.base import Msg
from bridge.msgs.std_msgs import Header

__all__ = ["DiagnosticArray", "DiagnosticStatus", "KeyValue"]


class KeyValue(Msg, frozen=True, gc=False):
    """One reading by name."""

    MSGTYPE: ClassVar[str] = "diagnostic_msgs/KeyValue"
    key: str = ""
    value: str = ""


class DiagnosticStatus(Msg, frozen=True, gc=False):
    """The state of one part."""

    MSGTYPE: ClassVar[str] = "diagnostic_msgs/DiagnosticStatus"
    level: int = 0
    """0 OK, 1 warning, 2 error, 3 stale."""
    name: str = ""
    message: str = ""
    hardware_id: str = ""
    values: list[KeyValue] = []


class DiagnosticArray(Msg, frozen=True, gc=False):
    """The state of all parts."""

    MSGTYPE: ClassVar[str] = "diagnostic_msgs/DiagnosticArray"
    header: Header = Header()
    status: list[DiagnosticStatus] = []
