"""Signs of life of one link, measured in the network thread and read in any."""

from __future__ import annotations

import math
from collections.abc import Callable

from bridge.client.client import BridgeClient

__all__ = ["LinkHealth"]

SILENCE_LIMIT = 0.7
"""A link on which nothing came for longer carries no drive commands [s]: they would arrive late, if at all."""


class LinkHealth:
    """Round trip, losses, silence, and the robot's clock."""

    def __init__(self, client: BridgeClient, now: Callable[[], float]) -> None:
        """`now` is our clock [s]."""
        self._client, self._now = client, now
        self._heard = -math.inf
        self._offset = math.nan
        self.rtt = math.nan
        """Round trip [s]; NaN while it is not known."""
        self.lost = 0
        """How many of the last 20 pings had no answer."""
        self.traffic = client.traffic
        """What came of each topic."""

    def measure(self) -> None:
        """Copy what the client knows; an answered ping is a sign of life as well."""
        rtt = self._client.rtt
        if rtt != self.rtt:
            self._heard = self._now() if math.isfinite(rtt) else self._heard
        self.rtt, self.lost, self._offset = rtt, self._client.lost, self._client.offset

    def on_sign(self, received: float) -> None:
        """Something came at `received` [s], our clock."""
        self._heard = received

    @property
    def fingerprint(self) -> str:
        """Of the certificate that the robot has shown; empty without TLS or while the link does not stand."""
        return self._client.fingerprint

    def robot_time(self) -> float:
        """The robot's clock [s]; NaN while it is not known."""
        return self._now() + self._offset

    @property
    def silence(self) -> float:
        """Time since anything came [s]; infinite before the first sign."""
        return self._now() - self._heard

    @property
    def silent(self) -> bool:
        """Nothing came for a while, though the connection still stands: whoever drives has to push anew."""
        return self.silence > SILENCE_LIMIT
