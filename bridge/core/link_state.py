"""How a link is doing, for the operator."""

from __future__ import annotations

import enum
from dataclasses import dataclass

__all__ = ["LinkState", "Phase"]


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
