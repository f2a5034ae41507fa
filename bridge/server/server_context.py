"""The parts of a server that all of its sessions share."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from bridge.core.compat import Compat
from bridge.core.robot_catalogue import Action, Service, Session
from bridge.server.client_services import ClientServices
from bridge.server.flow.message_reducing import MessageReducer
from bridge.server.rosapi.services import RosApi
from bridge.server.switchboard import Switchboard

__all__ = ["ServerContext"]


@dataclass(frozen=True, slots=True)
class ServerContext:
    """The robot's services and actions, and the server's parts that pass messages on."""

    switchboard: Switchboard
    services: Mapping[str, Service]
    """The robot's own, by absolute name."""
    actions: Mapping[str, Action]
    """The robot's own, by absolute name."""
    client_services: ClientServices
    rosapi: RosApi
    reducer: MessageReducer
    compat: Compat
    now: Callable[[], float]
    """The operators' clock [s]."""
    on_message: Callable[[Session, str, Any, float | None], None]
    """Called with each message for the robot: the sender, the topic, the message, its stamp [s] or None."""
