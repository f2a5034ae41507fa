"""The connection to the robot itself: everything is held while the robot cannot be reached."""

from __future__ import annotations

import math
from collections.abc import Callable

from bridge.core.codes import Code
from robotside.control.command_gate import CommandGate
from robotside.core.notice import Notice, Problem
from robotside.records.events import Say
from robotside.tasks.engine import Engine

__all__ = ["PortWatch"]


class PortWatch:
    """Reports when the robot is lost and when it is back."""

    def __init__(
        self, trouble: Callable[[], Problem], controls: CommandGate, engine: Engine, say: Say
    ) -> None:
        """`trouble` is why the robot can be neither driven nor heard, empty when it can."""
        self._trouble, self._controls, self._engine, self._say = trouble, controls, engine, say
        self._known = False
        self.changed_at = -math.inf
        """Time [s, robot clock] of the last change: older measurements say nothing of the time since."""

    @property
    def is_news(self) -> bool:
        """The robot was lost since the last update."""
        return bool(self._trouble()) and not self._known

    def update(self, now: float) -> None:
        """Hold everything while the robot cannot be reached; on its return nothing moves until an operator says so.

        `now` is the robot's clock [s].
        """
        trouble = self._trouble()
        if bool(trouble) != self._known:
            said = trouble or Notice(Code.ROBOT_BACK, "The robot can be driven again; it stands still.")
            self._say("robot", said, "alarm" if trouble else "ok")
            self.changed_at = now
        self._known = bool(trouble)
        if trouble:
            self._controls.halt()
            paused = f"Paused: {trouble[0].lower()}{trouble[1:]}"
            self._engine.pause(Notice(Code.TASK_ROBOT_LOST, paused), "alarm")
