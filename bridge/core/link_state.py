"""How a link is doing, for the operator."""

from __future__ import annotations

import enum
from dataclasses import dataclass

__all__ = ["CONTROL_TIMEOUT", "LinkState", "Phase"]

CONTROL_TIMEOUT = 2.0
"""A client that has control and that the robot has not heard for this long loses it [s]."""


class Phase(enum.Enum):
    """Where a link is in its life."""

    CONNECTING = "connecting"
    CONNECTED = "connected"
    WAITING = "waiting"
    """Between two attempts."""
    CLOSED = "closed"
    """By `close()`, or because the address can never work."""


@dataclass(frozen=True)
class LinkState:
    """The state of a link, for the operator."""

    phase: Phase
    sentence: str
    """What is the case, in plain words."""
    attempt: int
    """Attempts since the last connection, this one included; 0 when connected."""
    retry_in: float
    """Seconds from this state's beginning to the next attempt; 0 except in WAITING. A changed network makes it sooner."""
