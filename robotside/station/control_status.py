"""The published state of control: who drives, the mode, STOP, rest and the speed cap."""

from __future__ import annotations

from collections.abc import Callable

from msgspec.structs import replace

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import ControlStatus
from bridge.msgs.std_msgs import Time
from robotside.autonomy.readiness import Readiness
from robotside.control.command_gate import CommandGate
from robotside.control.teleop import LOST_LINK_STOPS_TASK, Options
from robotside.core.bus import Publish
from robotside.core.notice import Notice
from robotside.records.events import Say
from robotside.station.loop_watch import LoopWatch
from robotside.station.rest_detector import RestDetector
from robotside.tasks.engine import Engine

__all__ = ["ControlStatusPublisher"]


class ControlStatusPublisher:
    """Publishes `/control/status` when it has changed."""

    def __init__(
        self,
        controls: CommandGate,
        engine: Engine,
        options: Options,
        rest: RestDetector,
        readiness: Readiness,
        loop: LoopWatch,
        *,
        publish: Publish,
        say: Say,
        clock: Callable[[], float],
    ) -> None:
        """`clock` is the operators' [s], by which the message is stamped."""
        self._controls, self._engine, self._options = controls, engine, options
        self._rest, self._readiness, self._loop = rest, readiness, loop
        self._publish, self._say, self._clock = publish, say, clock
        self._last = ControlStatus()
        publish("/control/status", self._last)

    def update(self) -> None:
        """Publish the status if it has changed, and report who has control if that has."""
        fresh = self._now()
        if fresh == self._last:
            return
        if fresh.driver_id != self._last.driver_id:
            self._say("control", _who_has_control(fresh))
        self._last = fresh
        self._publish("/control/status", replace(fresh, stamp=Time.at(self._clock())))

    def _now(self) -> ControlStatus:
        controls, at_rest = self._controls, self._rest.update()
        driver, asker = controls.driver, controls.asker
        if at_rest:
            self._readiness.rests(stopped=controls.stopped)
        return ControlStatus(
            mode=self._mode(),
            driver=driver.name if driver else "",
            driver_id=driver.client_id if driver else "",
            stopped=controls.stopped,
            stopped_by=controls.stopped_by,
            stopped_by_id=controls.stopped_by_id,
            at_rest=at_rest,
            stop_tested=self._readiness.stop_tested,
            requested_by=asker.name if asker else "",
            requested_by_id=asker.client_id if asker else "",
            handover=Time.at(asker.due) if asker else Time(),
            speed_cap=controls.pace.shown,
            follows_link=controls.follows,
            lost_link_stops_task=self._options.on(LOST_LINK_STOPS_TASK),
            loop_cap=self._loop.share,
            real_time_factor=self._loop.factor,
            loop_lag=self._loop.lag,
        )

    def _mode(self) -> str:
        if self._controls.stopped:
            return "STOPPED"
        return "PAUSED" if self._engine.paused else "AUTO" if self._engine.running else "MANUAL"


def _who_has_control(status: ControlStatus) -> Notice:
    if not status.driver_id:
        return Notice(Code.CONTROL_FREE, "Control is free.")
    said, who = f"{status.driver} has control.", status.driver_id
    return Notice(Code.CONTROL_TAKEN, said, actor_id=who, name=status.driver)
