"""Battery of the robot: a warning when it is low, and the way home while there is charge for it."""

from __future__ import annotations

import math

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import TaskOrder
from bridge.msgs.sensor_msgs import BatteryState
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.records.events import Say
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.engine import TO_CHARGE, Engine
from robotside.tasks.task_factory import TaskFactory

__all__ = ["LOW_CHARGE", "BatteryWatch"]

HOME_CHARGE = 0.10
"""A task that moves the robot ends and it goes home when the battery has less than this left, 0 to 1."""

LOW_CHARGE = 0.15
"""A battery with less than this left is low: an event says so, and no task that moves the robot starts, 0 to 1."""

_CHARGING = (BatteryState.POWER_SUPPLY_STATUS_CHARGING, BatteryState.POWER_SUPPLY_STATUS_FULL)


class BatteryWatch:
    """Watches the charge."""

    def __init__(self, engine: Engine, task_factory: TaskFactory, situation: Situation, say: Say) -> None:
        self._engine, self._task_factory, self._situation, self._say = engine, task_factory, situation, say
        self.charge = math.nan
        """0 empty to 1 full; NaN while unknown."""

    @property
    def is_low(self) -> bool:
        """There is charge only for the way to where there is more."""
        return self.charge < LOW_CHARGE

    def on_battery(self, msg: BatteryState, now: float) -> None:
        """The battery was measured; go home where that is due, at `now` [s, robot clock]."""
        if msg.percentage < LOW_CHARGE <= self.charge:
            low = Notice(Code.BATTERY_LOW, f"Battery low: {msg.percentage:.0%}.", charge=msg.percentage)
            self._say("battery", low, "warn")
        self.charge = msg.percentage
        self._situation.charging = msg.power_supply_status in _CHARGING
        self._go_home(now)

    def _go_home(self, now: float) -> None:
        """Go home while there is charge enough for it, whatever task moves the robot elsewhere."""
        task = self._engine.task
        due = self.charge < HOME_CHARGE and self._engine.running
        if not due or task is None or not task.moves or task.name in TO_CHARGE:
            return
        said = f"Battery at {self.charge:.0%}"
        try:
            home = self._task_factory.task(TaskOrder(task="go_home"))
        except Refusal as problem:
            why = f"{said}: the {task.spoken} ends here. {problem}"
            ends = Notice(Code.TASK_BATTERY, why, charge=self.charge)
            self._say("battery", ends, "alarm")
            self._engine.cancel(ends)
            return
        goes = Notice(Code.BATTERY_GOING_HOME, f"{said}: going home.", charge=self.charge)
        self._say("battery", goes, "warn")
        self._engine.start(home, now)
