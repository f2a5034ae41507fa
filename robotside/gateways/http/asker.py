"""Who asks for a page, as the doorkeeper found out."""

from __future__ import annotations

from starlette.requests import Request

from bridge.core.identity import Role
from bridge.core.robot_catalogue import Operator
from robotside.door.station_door import StationDoor
from robotside.gateways.http.mounts import OPERATOR

__all__ = ["is_known", "operator_of"]


def operator_of(request: Request) -> Operator:
    """Who asks."""
    operator = getattr(request.state, OPERATOR)
    if not isinstance(operator, Operator):
        raise TypeError(f"The doorkeeper let {operator!r} in.")
    return operator


def is_known(door: StationDoor, request: Request) -> bool:
    """Whether who asks may do anything here at all."""
    return operator_of(request).role(door.now()) > Role.NONE
