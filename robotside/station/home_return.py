"""The return home of a robot that no one drives any more."""

from __future__ import annotations

from collections.abc import Callable

from bridge.msgs.pilothouse_msgs import TaskOrder
from robotside.autonomy.autonomy import Autonomy
from robotside.control.command_gate import CommandGate
from robotside.core.refusal import Refusal
from robotside.station.fitness import Fitness

__all__ = ["HomeReturn"]


class HomeReturn:
    """Begins the way home without an operator."""

    def __init__(
        self,
        autonomy: Autonomy,
        controls: CommandGate,
        fitness: Fitness,
        hold_queue: Callable[[str], None],
        now: Callable[[], float],
    ) -> None:
        """`hold_queue` has the queue wait, for a reason that ends a sentence; `now` is the robot's clock [s]."""
        self._autonomy, self._controls, self._fitness = autonomy, controls, fitness
        self._hold_queue, self._now = hold_queue, now

    def begin(self) -> bool:
        """Begin the way home; False when the robot cannot go."""
        if self._fitness.barred(True):
            return False
        try:
            task = self._autonomy.task_factory.task(TaskOrder(task="go_home"))
        except Refusal:
            return False
        self._controls.hold()
        self._hold_queue("no one drives the robot")
        self._autonomy.engine.start(task, self._now())
        return True
