"""Silence of the sensors that a robot needs to move by itself."""

from __future__ import annotations

import math

from robotside.autonomy.sensor_health import needed

__all__ = ["SensorSilence"]

SILENCE_TIMEOUT = 0.6
"""Odometry or laser silent for this long means that the robot must not drive by itself [s]."""

ODOMETRY_TIMEOUT = 2.0
"""Without odometry for this long it is not known whether the wheels stand still [s]."""


class SensorSilence:
    """Times of the last measurements, by topic; all times are of the robot's clock [s]."""

    def __init__(self, kind: str) -> None:
        """Of a robot of a `kind`, as its information calls it."""
        self._kind = kind
        self._last: dict[str, float] = {}

    def on_measurement(self, topic: str, now: float) -> None:
        """A sound measurement came."""
        self._last[topic] = now

    def skip(self, seconds: float) -> None:
        """The robot's clock jumped by `seconds` [s]."""
        self._last = {topic: heard + seconds for topic, heard in self._last.items()}

    def has(self, topic: str) -> bool:
        """A measurement has ever come on `topic`."""
        return topic in self._last

    def sentence(self, now: float) -> str:
        """The needed sensor that is silent, as in `the laser has been silent for 0.6 s`; empty when none is."""
        for topic, sensor in needed(self._kind, self._last).items():
            last = self._last.get(topic, -math.inf)
            if not now - last <= SILENCE_TIMEOUT:
                since = (
                    f"has been silent for {SILENCE_TIMEOUT} s" if last > -math.inf else "has sent no data yet"
                )
                return f"the {sensor} {since if sensor != 'sonars' else since.replace('has', 'have', 1)}"
        return ""

    def is_measured(self, now: float, since: float = -math.inf) -> bool:
        """The speed is known: odometry came lately, and after `since` [s]."""
        last = self._last.get("/odom", -math.inf)
        return now - last <= ODOMETRY_TIMEOUT and last > since
