"""Identities and roles: who a connection proved to be, and what it may do."""

from __future__ import annotations

import hashlib
import math
from dataclasses import dataclass
from enum import IntEnum

__all__ = ["STRANGER", "Identity", "Role", "public_id"]

_PUBLIC_ID_LENGTH = 32
"""Hex digits of a public id."""


class Role(IntEnum):
    """What somebody may do; each role includes those before it."""

    NONE = 0
    """STOP, and asking to be paired."""
    WATCH = 1
    """Reading topics and records, and watching cameras."""
    DRIVE = 2
    """Control of the robot, its tasks, missions and places."""
    MANAGE = 3
    """Settings that safety depends on, people and their keys, the audit log."""

    @property
    def word(self) -> str:
        """As people write it: `none`, `watch`, `drive` or `manage`."""
        return self.name.lower()

    @classmethod
    def read(cls, text: str) -> Role:
        """The role of that word; ValueError with one sentence for any other."""
        for role in cls:
            if role.word == text:
                return role
        words = ", ".join(role.word for role in cls)
        raise ValueError(f"A role is one of {words}, not {text!r}.")


@dataclass(frozen=True, slots=True)
class Identity:
    """Who is at the other end of a connection."""

    id: str
    """Public id, never a secret; empty for who has none."""
    name: str
    """For people; empty when it is not known."""
    role: Role
    ends: float = math.inf
    """When the role ends [s, operators' clock]."""
    proven: bool = False
    """It proved by a key of the robot that it is who it says."""


STRANGER = Identity("", "", Role.NONE)
"""Somebody who proved nothing."""


def public_id(client_id: str) -> str:
    """The id by which others know a client that calls itself `client_id`; empty for an empty one.

    Whoever repeats a `client_id` counts as the same client, so it is never published: this is a one-way hash of it.
    """
    if not client_id:
        return ""
    return hashlib.sha256(b"pilothouse client " + client_id.encode()).hexdigest()[:_PUBLIC_ID_LENGTH]
