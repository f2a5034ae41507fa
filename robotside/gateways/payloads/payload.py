"""The form of the table of payloads."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Exchange", "Payload"]


@dataclass(frozen=True, slots=True)
class Exchange:
    """One topic, service or action of a payload."""

    name: str
    """Absolute name. Type, direction and rate are those of the robot's own tables."""
    units: str = ""
    """Fields with their units, as in `linear.x [m/s], angular.z [rad/s]`; empty where no field has one."""
    example: str = ""
    """JSON that a client can send as it stands; empty for what the robot sends."""
    doc: str = ""
    """What a service or an action does; empty for a topic, whose table has it."""


@dataclass(frozen=True, slots=True)
class Payload:
    """One line of the table."""

    key: str
    """As a user writes it, such as `arm`."""
    doc: str
    """What it is, in a few words."""
    exchanges: tuple[Exchange, ...]
    sign: str = ""
    """The topic that only a robot with this payload has; empty for what every robot has."""
