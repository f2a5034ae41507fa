"""unique_identifier_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

from typing import Annotated, ClassVar, TypeAlias

from msgspec import Meta

from bridge.msgs.base import Msg

__all__ = ["UUID"]

_Bytesx16: TypeAlias = Annotated[bytes, Meta(min_length=16, max_length=16)]


class UUID(Msg, frozen=True, gc=False):
    """A universally unique identifier (RFC 4122)."""

    MSGTYPE: ClassVar[str] = "unique_identifier_msgs/UUID"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint8[16]",)
    uuid: _Bytesx16 = bytes(16)
