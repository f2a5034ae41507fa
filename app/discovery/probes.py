"""The schedule of round trips that are measured: few at once, and one to an address in a second.

A HELLO decides where they go, and anybody can send one: see `Entry.probe`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from app.discovery.known_robots import Entry

__all__ = ["ADDRESS_PERIOD", "MAX_AT_ONCE", "MEASURE_PERIOD", "ProbeSchedule"]

MEASURE_PERIOD = 3.0
"""Between two measurements of one robot [s]."""
ADDRESS_PERIOD = 1.0
"""Between two connections to one address [s]."""
MAX_AT_ONCE = 8
"""So many robots are measured at the same time, and in one second."""


class ProbeSchedule:
    """Who is measured next: whose turn was longest ago."""

    def __init__(self) -> None:
        self._targets: dict[str, tuple[str, int]] = {}
        self._robots: dict[str, float] = {}
        """When each robot was measured last [s]."""
        self._addresses: dict[str, float] = {}
        """When something was sent to each address last [s]."""

    def wants(self, entries: Iterable[Entry]) -> None:
        """Measure those of `entries` that are there, and no others. Any thread may call it."""
        self._targets = {
            one.url: one.probe for one in entries if one.probe is not None and one.state == "live"
        }

    def due(self, now: float) -> list[tuple[str, str, int]]:
        """Url, address and port of those to be measured at `now` [s]; they count as measured from then on."""
        targets = self._targets  # once: another thread replaces it
        self._robots = {url: at for url, at in self._robots.items() if url in targets}
        self._addresses = {host: at for host, at in self._addresses.items() if now - at < ADDRESS_PERIOD}
        chosen: list[tuple[str, str, int]] = []
        for url in sorted(targets, key=lambda url: self._robots.get(url, -math.inf)):
            host, port = targets[url]
            rested = now - self._robots.get(url, -math.inf) >= MEASURE_PERIOD
            if rested and host not in self._addresses and len(chosen) < MAX_AT_ONCE:
                self._robots[url] = self._addresses[host] = now
                chosen.append((url, host, port))
        return chosen
