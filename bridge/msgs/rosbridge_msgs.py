"""rosbridge_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

from typing import ClassVar

from bridge.msgs.base import Msg
from bridge.msgs.builtin_interfaces import Time

__all__ = ["ConnectedClient", "ConnectedClients"]


class ConnectedClient(Msg, frozen=True, gc=False):
    """A client of a rosbridge server."""

    MSGTYPE: ClassVar[str] = "rosbridge_msgs/ConnectedClient"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "time")
    ip_address: str = ""
    """Where it comes from."""
    connection_time: Time = Time()
    """Since when."""


class ConnectedClients(Msg, frozen=True, gc=False):
    """All clients of a rosbridge server."""

    MSGTYPE: ClassVar[str] = "rosbridge_msgs/ConnectedClients"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("rosbridge_msgs/ConnectedClient[]",)
    clients: list[ConnectedClient] = []
