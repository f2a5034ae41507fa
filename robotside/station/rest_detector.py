"""Standstill of the robot, as its odometry tells it."""

from __future__ import annotations

from collections.abc import Callable

from robotside.autonomy.autonomy import Autonomy
from robotside.kinds.registry import kind_of
from robotside.station.port_watch import PortWatch

__all__ = ["RestDetector"]

HYSTERESIS = 3.0
"""A robot at rest is moving again from this many times the speeds of rest on."""


class RestDetector:
    """Detects whether the wheels stand still; False while that is not known."""

    def __init__(self, kind: str, autonomy: Autonomy, port: PortWatch, now: Callable[[], float]) -> None:
        """Of a robot of a `kind`; `now` is the robot's clock [s]."""
        self._speeds = kind_of(kind).at_rest
        self._autonomy, self._port, self._now = autonomy, port, now
        self._was = False

    def update(self) -> bool:
        """`is_at_rest`, from which on the hysteresis counts."""
        self._was = self.is_at_rest
        return self._was

    @property
    def is_at_rest(self) -> bool:
        """The robot stands still, as measured lately."""
        if not self._autonomy.is_measured(self._now(), since=self._port.changed_at) or self._port.is_news:
            return False
        factor = HYSTERESIS if self._was else 1.0
        where, (speed, turn) = self._autonomy.pose_estimator, self._speeds
        return abs(where.speed) < speed * factor and abs(where.turn) < turn * factor
