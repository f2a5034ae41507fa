"""Changes of the route from this machine to another one, and sleep of this machine."""

from __future__ import annotations

import socket
import time
from typing import Protocol

__all__ = ["NetworkChanges", "Network", "SystemNetwork"]

ANYWHERE = ("192.0.2.1", 9)
"""An address for documentation (RFC 5737) that stands for the rest of the world. Nothing is sent to it."""
_MIN_SLEEP = 2.0
"""Smallest jump of the clock that counts as sleep [s]."""


class Network(Protocol):
    """The network of a machine, as far as a link needs to know it."""

    def source(self, address: tuple[str, int]) -> str | None:
        """The address of this machine from which packets to `address` would leave now; None without a route."""

    def has(self, local: str) -> bool:
        """Whether `local` is an address of this machine."""

    def slept(self) -> float:
        """Total time that this machine has slept [s], from any beginning; it grows by sleep only."""


class SystemNetwork:
    """The network of the machine that runs this program."""

    def source(self, address: tuple[str, int]) -> str | None:
        """As in `Network`; asks the system's routes and sends nothing."""
        family = socket.AF_INET6 if ":" in address[0] else socket.AF_INET
        try:
            with socket.socket(family, socket.SOCK_DGRAM) as sock:
                sock.connect(address)
                return str(sock.getsockname()[0])
        except OSError:
            return None

    def has(self, local: str) -> bool:
        """As in `Network`; True too where that cannot be found out."""
        family = socket.AF_INET6 if ":" in local else socket.AF_INET
        if local.startswith("fe80:"):  # belongs to an interface, which an address alone does not tell
            return True
        try:
            with socket.socket(family, socket.SOCK_DGRAM) as sock:
                sock.bind((local, 0))
        except OSError:
            return False
        return True

    def slept(self) -> float:
        """As in `Network`; where the system does not count sleep, its calendar minus a clock that stops in sleep."""
        if hasattr(time, "CLOCK_BOOTTIME"):
            return time.clock_gettime(time.CLOCK_BOOTTIME) - time.clock_gettime(time.CLOCK_MONOTONIC)
        return time.time() - time.monotonic()


class NetworkChanges:
    """Detects a new route to an address, or sleep of the machine, since the last check."""

    def __init__(self, network: Network, address: tuple[str, int] | None) -> None:
        """`address` is the numeric destination; None where it is not known."""
        self._network = network
        self._address = ANYWHERE if address is None else address
        self._source = network.source(self._address)
        self._slept = network.slept()

    def has_changed(self) -> bool:
        """Whether there is a route that was not there at the last check, or the machine slept since."""
        source, slept = self._network.source(self._address), self._network.slept()
        moved = source != self._source and source is not None
        woke = slept - self._slept > _MIN_SLEEP
        self._source, self._slept = source, slept
        return moved or woke
