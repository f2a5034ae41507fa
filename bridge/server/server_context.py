"""The parts of a server that all of its sessions share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from bridge.core.compat import Compat
from bridge.core.robot_door import RobotDoor
from bridge.server.client_services import ClientServices
from bridge.server.flow.message_reducing import MessageReducer
from bridge.server.rosapi.services import RosApi
from bridge.server.switchboard import Switchboard

__all__ = ["ServerContext"]


@dataclass(frozen=True, slots=True)
class ServerContext:
    """The door to the robot, and the server's parts that pass messages on."""

    switchboard: Switchboard
    door: RobotDoor
    client_services: ClientServices
    rosapi: RosApi
    reducer: MessageReducer
    compat: Compat
    now: Callable[[], float]
    """The operators' clock [s]."""
