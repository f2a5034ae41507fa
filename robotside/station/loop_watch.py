"""The watch over the robot's loop: a robot whose simulation or whose control lags says so, goes slower and rests at last."""

from __future__ import annotations

import math

from bridge.core.codes import Code
from bridge.msgs.diagnostic_msgs import DiagnosticStatus, KeyValue
from robotside.autonomy.autonomy import Autonomy
from robotside.autonomy.sensor_health import SensorHealth
from robotside.control.guarded_robot import GuardedRobot
from robotside.control.latency_speed_cap import LatencySpeedCap
from robotside.control.loop_speed_cap import share_by_factor, share_by_lag
from robotside.core.notice import Notice
from robotside.records.events import Say
from robotside.station.limit_guard import LimitGuard

__all__ = ["LATE_TIME", "ON_TIME_TIME", "LoopWatch"]

LATE_TIME, ON_TIME_TIME = 2.0, 5.0
"""So long it must lag, or no longer lag, before an event says so [s]."""

FIGURES_PERIOD = 1.0
"""Between two changes of the figures that operators read [s]."""


class LoopWatch:
    """Takes the timing of the loop, once a tick; times are of the operators' clock [s] unless stated otherwise."""

    def __init__(
        self, robot: GuardedRobot, autonomy: Autonomy, health: SensorHealth, limits: LimitGuard, say: Say
    ) -> None:
        self._robot, self._autonomy, self._health, self._limits, self._say = (
            robot,
            autonomy,
            health,
            limits,
            say,
        )
        self._cap = LatencySpeedCap()
        self._factor, self._lag = 1.0, 0.0
        self._told = ""
        self._since = math.nan
        self._next = -math.inf
        self.share, self.factor, self.lag = 1.0, 1.0, 0.0
        """As operators read it: share of the full speed, 0 to 1, real-time factor, 1 at most, and age of the newest data [s]."""

    def update(self, factor: float, lag: float, now: float) -> None:
        """In a second of real time `factor` seconds of the robot's clock pass, and its newest data are `lag` [s] old."""
        self._factor, self._lag = factor, lag
        self._cap.limit(share_by_factor(factor) if self._robot.simulated else share_by_lag(lag), now)
        self._limits.pace = self._cap.shown
        self._autonomy.situation.late = self._cap.shown <= 0.0
        self._report(now)
        if now >= self._next:
            self._next = now + FIGURES_PERIOD
            self._show()

    def skip(self, now: float, seconds: float) -> None:
        """The robot's clock jumps to `now`, by `seconds` [s, robot clock], in which nothing happened and nothing was measured."""
        self._robot.skip_to(now)
        self._autonomy.skip(seconds)
        self._health.skip(seconds)

    def status(self) -> DiagnosticStatus:
        """For `/diagnostics`."""
        level = 0 if self._state == "" else 2 if self._state == "rests" else 1
        values = [
            KeyValue("real_time_factor", f"{self._factor:.2f}"),
            KeyValue("lag", f"{self._lag:.2f}"),
            KeyValue("speed_share", f"{self._cap.shown:.2f}"),
        ]
        name = "simulation" if self._robot.simulated else "control loop"
        return DiagnosticStatus(level, name, self._words(), values=values)

    @property
    def _state(self) -> str:
        """`slow` or `rests`; empty while it is on time."""
        shown = self._cap.shown
        return "" if shown >= 1.0 else "slow" if shown > 0.0 else "rests"

    def _words(self) -> str:
        if self._robot.simulated:
            return f"{self._factor:.1f} of real time, {self._lag:.1f} s behind"
        return f"{self._lag:.1f} s late"

    def _report(self, now: float) -> None:
        """Say that it lags, lags more or is on time again, once that has lasted."""
        state = self._state
        if state == self._told or (state == "slow" and self._told == "rests"):
            self._since = math.nan
            return
        self._since = now if math.isnan(self._since) else self._since
        if now - self._since < (LATE_TIME if state else ON_TIME_TIME):
            return
        self._told, self._since = state, math.nan
        if not state:
            self._say("robot", Notice(Code.LOOP_ON_TIME, "The robot's computer keeps up again."), "ok")
            return
        does = "the robot goes slower" if state == "slow" else "the robot rests"
        if self._robot.simulated:
            said = f"Simulation at {self._factor:.1f} of real time, {self._lag:.1f} s behind: {does}."
            late = Notice(
                Code.SIMULATION_SLOW, said, factor=round(self._factor, 1), seconds=round(self._lag, 1)
            )
        else:
            said = f"The robot's computer is {self._lag:.1f} s late: {does}."
            late = Notice(Code.LOOP_LATE, said, seconds=round(self._lag, 1))
        self._say("robot", late, "warn" if state == "slow" else "alarm")

    def _show(self) -> None:
        late = self._state != ""
        self.share = self._cap.shown
        self.factor = min(1.0, round(self._factor, 1)) if late and self._robot.simulated else 1.0
        self.lag = round(2 * self._lag) / 2 if late else 0.0
