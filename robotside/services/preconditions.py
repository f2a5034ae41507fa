"""Preconditions of a command: the operator may give it, and the robot can do it."""

from __future__ import annotations

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from robotside.autonomy.battery_watch import LOW_CHARGE
from robotside.control.command_gate import STOP_SENTENCE
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.station.fitness import NO_MAP
from robotside.station.station import Station
from robotside.tasks.behaviours.charge import too_little
from robotside.tasks.engine import TO_CHARGE, Task, charger
from robotside.tasks.task_factory import words_for

__all__ = ["Preconditions"]


class Preconditions:
    """Each method raises Refusal with one sentence when it is not so."""

    def __init__(self, station: Station) -> None:
        self._station = station

    def need_control(self, client: Operator) -> None:
        """`client` has control, or takes it now."""
        problem = self._station.controls.acquire(client, self._station.clock())
        if problem:
            raise Refusal(problem)

    def may_change(self, client: Operator) -> None:
        """No one else has control."""
        problem = self._station.controls.objection(client)
        if problem:
            raise Refusal(problem)

    def may_set_off(self, client: Operator, moves: bool) -> None:
        """`client` may change what the robot will do by itself: it takes control when that `moves` the robot."""
        if moves:
            self.need_control(client)
        else:
            self.may_change(client)

    def may_move(self, client: Operator) -> None:
        """`client` may have the robot move by itself, and it can."""
        if self._station.controls.stopped:
            raise Refusal(STOP_SENTENCE)
        self.need_control(client)
        problem = self._station.fitness.unfit or self._station.fitness.lost
        if problem:
            raise Refusal(problem)

    def tell(self, payload: str, order: Msg) -> None:
        """Give `order` to a `payload` of the robot, which takes it."""
        trouble = self._station.robot.trouble
        if trouble:
            raise Refusal(trouble)
        try:
            self._station.robot.command(payload, order)
        except ValueError as problem:
            raise Refusal(Notice(Code.EQUIPMENT_REFUSED, str(problem))) from problem

    def has_map(self) -> None:
        """Places can be judged."""
        if not self._station.autonomy.has_map:
            raise Refusal(NO_MAP)

    def idle(self) -> None:
        """No task is under way."""
        engine = self._station.autonomy.engine
        if engine.active:
            state = engine.status.state.lower()
            said = f"A task is {state} already; stop it first."
            raise Refusal(Notice(Code.TASK_ACTIVE, said, state=state))

    def charged_enough(self) -> None:
        """The robot may go on from where it charges, if it charges."""
        autonomy = self._station.autonomy
        if charger(autonomy.engine.status) and (short := too_little(autonomy.situation.charge)):
            raise Refusal(short)

    def charged(self, task: Task) -> None:
        """There is charge enough for `task`."""
        mind = self._station.autonomy
        if task.moves and mind.low and task.name not in TO_CHARGE:
            words = words_for(task.name)
            said = f"The battery is at {mind.battery:.0%}; {words} needs at least {LOW_CHARGE:.0%}."
            code, charge = Code.BATTERY_TOO_LOW, mind.battery
            raise Refusal(Notice(code, said, task=task.name, charge=charge, needed=LOW_CHARGE))
