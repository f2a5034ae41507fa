"""Battery of the robot: a warning when it is low, and the way to where there is more while there is charge for it."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import TaskOrder
from bridge.msgs.sensor_msgs import BatteryState
from robotside.autonomy.energy_use import EnergyUse
from robotside.autonomy.power_supply import PowerSupply
from robotside.core.config import ChargingSettings
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.records.events import Say
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.engine import TO_CHARGE, Engine, Task
from robotside.tasks.task_factory import TaskFactory

__all__ = ["LOW_CHARGE", "BatteryWatch"]

HOME_CHARGE = 0.10
"""Without a dock, a task that moves the robot ends and it goes home when the battery has less than this left, 0 to 1."""

LOW_CHARGE = 0.15
"""A battery with less than this left is low: an event says so, no task that moves the robot starts, and where there is a dock
none goes on before it has charged, 0 to 1."""


class BatteryWatch:
    """Watches the charge."""

    def __init__(
        self,
        engine: Engine,
        task_factory: TaskFactory,
        situation: Situation,
        say: Say,
        *,
        settings: ChargingSettings,
        odometer: Callable[[], float],
    ) -> None:
        """`odometer` is all that was ever driven [m]."""
        self._engine, self._task_factory, self._situation, self._say = engine, task_factory, situation, say
        self._settings, self._odometer = settings, odometer
        self._use, self._supply = EnergyUse(), PowerSupply()
        self.charge = math.nan
        """0 empty to 1 full; NaN while unknown."""

    @property
    def is_low(self) -> bool:
        """There is charge only for the way to where there is more."""
        return self.charge < LOW_CHARGE

    def on_battery(self, msg: BatteryState, now: float) -> None:
        """The battery was measured; go where there is more where that is due, at `now` [s, robot clock]."""
        if msg.percentage < LOW_CHARGE <= self.charge:
            low = Notice(Code.BATTERY_LOW, f"Battery low: {msg.percentage:.0%}.", charge=msg.percentage)
            self._say("battery", low, "warn")
        self.charge = self._situation.charge = msg.percentage
        self._situation.battery_heard, self._situation.last_power = now, msg.power_supply_status
        self._supply.on_battery(msg, now)
        self.update(now)
        self._use.note(self.charge, self._odometer(), charging=self._situation.charging)
        task, engine = self._engine.task, self._engine
        if task is None or not engine.running or engine.detouring:
            return
        if task.moves and task.name not in TO_CHARGE and not self._charges(task, now):
            self._go_home(task, now)

    def update(self, now: float) -> None:
        """What was said of the charger holds no longer than the battery is heard, at `now` [s, robot clock]."""
        self._situation.power = self._supply.status(now)
        self._situation.charging = self._supply.charging(now)

    def skip(self, seconds: float) -> None:
        """The clock jumped by `seconds` [s], in which nothing could be heard."""
        self._situation.battery_heard += seconds
        self._supply.skip(seconds)

    def charge_order(self) -> TaskOrder | None:
        """The order to go and charge by itself; None where it does not, or cannot."""
        if not self._settings.by_itself:
            return None
        order = TaskOrder(task="dock", charge_to=self._settings.until)
        try:
            self._task_factory.task(order)
        except Refusal:
            return None
        return order

    def _charges(self, task: Task, now: float) -> bool:
        """Go and charge where that is due and there is a dock; what has points goes on afterwards. False without a dock."""
        place = self._task_factory.dock_place() if self._settings.by_itself else None
        if place is None:
            return False
        away = self._situation.pose.distance(place.x, place.y)
        if not self.charge < max(LOW_CHARGE, self._use.needed(away)):
            return True  # it will be due before it has to go home
        goes_on, until = isinstance(task.course, Course), self._settings.until
        said = f"Battery at {self.charge:.0%}: going to {place.name} to charge"
        said = f"{said}; the {task.spoken} goes on at {until:.0%}." if goes_on else f"{said}."
        goes = Notice(Code.BATTERY_GOING_TO_DOCK, said, place=place.name, charge=self.charge)
        begin: Callable[[], None]
        try:
            if goes_on:
                begin = partial(self._engine.take_detour, self._task_factory.charge_break(until), goes)
            else:
                charges = self._task_factory.task(TaskOrder(task="dock", charge_to=until))
                begin = partial(self._engine.start, charges, now)
        except Refusal:
            return False
        self._say("battery", goes, "warn")
        begin()
        return True

    def _go_home(self, task: Task, now: float) -> None:
        """Go home while there is charge enough for it, whatever task moves the robot elsewhere."""
        if not self.charge < HOME_CHARGE:
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
