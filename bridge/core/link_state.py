"""The state of a link, as the operator sees it."""

from __future__ import annotations

import enum
from dataclasses import dataclass

__all__ = ["CONTROL_TIMEOUT", "LinkFault", "LinkState", "Phase"]

CONTROL_TIMEOUT = 2.0
"""A client that has control and that the robot has not heard for this long loses it [s]."""


class Phase(enum.Enum):
    """The phases of a link."""

    CONNECTING = "connecting"
    CONNECTED = "connected"
    WAITING = "waiting"
    """Between two attempts."""
    CLOSED = "closed"
    """By `close()`, or because the address can never work."""


class LinkFault(enum.Enum):
    """Faults of a link that only a person can mend."""

    NONE = "none"
    """None of these."""
    WRONG_KEY = "wrong_key"
    """The machine at the address does not have the robot's key."""
    NOT_ACCEPTED = "not_accepted"
    """The robot does not know this client's token any more."""
    NOT_PROTECTED = "not_protected"
    """The robot is reached by TLS only, and this link has none."""


@dataclass(frozen=True)
class LinkState:
    """The state of a link, for the operator."""

    phase: Phase
    sentence: str
    """The state in plain words."""
    attempt: int
    """Attempts since the last connection, including this one; 0 when connected."""
    retry_in: float
    """Time from the beginning of this state to the next attempt [s]; 0 except in WAITING. A changed network makes it
    sooner."""
    fault: LinkFault = LinkFault.NONE
    """Of the last attempt."""
