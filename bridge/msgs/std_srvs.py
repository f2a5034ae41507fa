"""std_srvs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

from typing import ClassVar

from bridge.msgs.base import Msg

__all__ = [
    "EmptyRequest",
    "EmptyResponse",
    "SetBoolRequest",
    "SetBoolResponse",
    "TriggerRequest",
    "TriggerResponse",
]


class EmptyRequest(Msg, frozen=True, gc=False):
    """A service without request and response fields."""

    MSGTYPE: ClassVar[str] = "std_srvs/EmptyRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class EmptyResponse(Msg, frozen=True, gc=False):
    """What `Empty` answers."""

    MSGTYPE: ClassVar[str] = "std_srvs/EmptyResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class SetBoolRequest(Msg, frozen=True, gc=False):
    """Switch something on or off."""

    MSGTYPE: ClassVar[str] = "std_srvs/SetBoolRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool",)
    data: bool = False


class SetBoolResponse(Msg, frozen=True, gc=False):
    """What `SetBool` answers."""

    MSGTYPE: ClassVar[str] = "std_srvs/SetBoolResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")
    success: bool = False
    """It was done."""
    message: str = ""
    """One sentence."""


class TriggerRequest(Msg, frozen=True, gc=False):
    """Something to be done, once."""

    MSGTYPE: ClassVar[str] = "std_srvs/TriggerRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class TriggerResponse(Msg, frozen=True, gc=False):
    """What `Trigger` answers."""

    MSGTYPE: ClassVar[str] = "std_srvs/TriggerResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")
    success: bool = False
    """It was done."""
    message: str = ""
    """One sentence."""
