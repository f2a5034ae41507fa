"""The publisher of the checklist before the first motion."""

from __future__ import annotations

import math
from collections.abc import Callable

from bridge.msgs.pilothouse_msgs import Check, Checklist
from bridge.msgs.std_msgs import Time
from robotside.autonomy.autonomy import Autonomy
from robotside.autonomy.battery_watch import LOW_CHARGE
from robotside.autonomy.checklist import CheckInputs, checks
from robotside.autonomy.sensor_health import SensorHealth
from robotside.core.bus import Publish

__all__ = ["Readiness"]


class Readiness:
    """Publishes the checklist of one robot; times are of the operators' clock [s] unless stated otherwise."""

    def __init__(self, clock: Callable[[], float], publish: Publish, kind: str = "wheels") -> None:
        """Of a robot of a `kind`, as its information calls it."""
        self._clock, self._publish = clock, publish
        self.sensor_health = SensorHealth(kind)
        """The robot's newest measurements."""
        self.stop_tested = Time()
        """When STOP, pressed since the start, last brought the robot to rest; 0 when never."""
        self._stopping = False
        self._offset = math.nan
        self._checks: list[Check] = []

    def on_operator_time(self, stamp: float) -> None:
        """A message came with the `stamp` of an operator's clock [s]; NaN changes nothing."""
        if math.isfinite(stamp):
            self._offset = stamp - self._clock()

    def stop_pressed(self) -> None:
        """STOP was pressed just now; one that was pressed before the start tests nothing."""
        self._stopping = True

    def rests(self, *, stopped: bool) -> None:
        """The robot stands still; `stopped` while STOP is pressed."""
        if self._stopping and stopped:
            self.stop_tested = Time.at(self._clock())
        self._stopping = False

    def update(self, autonomy: Autonomy, trouble: str, now: float) -> None:
        """Look through everything at `now` [s, robot clock]; `trouble` is why the robot cannot be reached."""
        where = autonomy.pose_estimator
        found = checks(
            CheckInputs(
                battery=autonomy.battery,
                low_below=LOW_CHARGE,
                silent=self.sensor_health.silent(now),
                placed=where.pose is not None,
                sure=where.sure,
                stop_tested=self.stop_tested.seconds > 0,
                offset=self._offset,
                trouble=trouble,
            )
        )
        if found != self._checks:
            self._checks = found
            self._publish("/checklist", Checklist(Time.at(self._clock()), found))
