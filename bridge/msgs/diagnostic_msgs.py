"""diagnostic_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

from typing import ClassVar

from bridge.msgs.base import Msg, byte
from bridge.msgs.std_msgs import Header

__all__ = [
    "AddDiagnosticsRequest",
    "AddDiagnosticsResponse",
    "DiagnosticArray",
    "DiagnosticStatus",
    "KeyValue",
    "SelfTestRequest",
    "SelfTestResponse",
]


class AddDiagnosticsRequest(Msg, frozen=True, gc=False):
    """Have more parts watched."""

    MSGTYPE: ClassVar[str] = "diagnostic_msgs/AddDiagnosticsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    load_namespace: str = ""
    """Absolute name under which the parameters of what is to be watched lie."""


class AddDiagnosticsResponse(Msg, frozen=True, gc=False):
    """What `AddDiagnostics` answers."""

    MSGTYPE: ClassVar[str] = "diagnostic_msgs/AddDiagnosticsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")
    success: bool = False
    message: str = ""


class KeyValue(Msg, frozen=True, gc=False):
    """One reading by name."""

    MSGTYPE: ClassVar[str] = "diagnostic_msgs/KeyValue"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "string")
    key: str = ""
    value: str = ""


class DiagnosticStatus(Msg, frozen=True, gc=False):
    """The state of one part."""

    MSGTYPE: ClassVar[str] = "diagnostic_msgs/DiagnosticStatus"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("byte", "string", "string", "string", "diagnostic_msgs/KeyValue[]")
    CONSTTYPES: ClassVar[tuple[str, ...]] = ("byte",) * 4

    OK: ClassVar[int] = 0
    WARN: ClassVar[int] = 1
    ERROR: ClassVar[int] = 2
    STALE: ClassVar[int] = 3

    level: byte = 0
    """0 OK, 1 warning, 2 error, 3 stale."""
    name: str = ""
    """Of the part."""
    message: str = ""
    """One sentence."""
    hardware_id: str = ""
    """Which piece of hardware it is about."""
    values: list[KeyValue] = []
    """Readings."""


class DiagnosticArray(Msg, frozen=True, gc=False):
    """The state of all parts."""

    MSGTYPE: ClassVar[str] = "diagnostic_msgs/DiagnosticArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "diagnostic_msgs/DiagnosticStatus[]")
    header: Header = Header()
    status: list[DiagnosticStatus] = []


class SelfTestRequest(Msg, frozen=True, gc=False):
    """Have a device test itself."""

    MSGTYPE: ClassVar[str] = "diagnostic_msgs/SelfTestRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class SelfTestResponse(Msg, frozen=True, gc=False):
    """What `SelfTest` answers."""

    MSGTYPE: ClassVar[str] = "diagnostic_msgs/SelfTestResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "byte", "diagnostic_msgs/DiagnosticStatus[]")
    id: str = ""
    """Of the device."""
    passed: byte = 0
    """0 failed, 1 passed."""
    status: list[DiagnosticStatus] = []
    """The single tests."""
