"""The form of a gateway: one protocol by which clients reach a robot, behind the robot's door."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

__all__ = ["Gateway"]


class Gateway(Protocol):
    """One protocol. It decodes and encodes; what a client may do is decided at the door alone."""

    async def start(self) -> None:
        """Begin to listen. BridgeError with one sentence when that is not possible."""

    async def stop(self) -> None:
        """End all connections and stop listening; nothing is left running. Allowed before `start` too."""

    def endpoints(self) -> Mapping[str, str]:
        """The URLs that clients use, by protocol, as in `{"rosbridge": "ws://192.0.2.7:9090"}`; known once started."""
