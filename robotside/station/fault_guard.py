"""Faults of the robot's own program, and orders that the robot refuses: they end the task at rest, and driving by hand goes on."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable

from bridge.core.codes import Code
from robotside.core.notice import Notice, Problem
from robotside.core.refusal import OrderRefused
from robotside.records.events import Say
from robotside.tasks.engine import Engine

__all__ = ["FaultGuard"]

log = logging.getLogger(__name__)

FAULT_PERIOD = 3.0
"""Faults are logged and reported at most this often [s]."""


class FaultGuard:
    """Runs what the robot thinks by itself."""

    def __init__(self, engine: Engine, brake: Callable[[], None], say: Say, now: Callable[[], float]) -> None:
        """`brake` brings the robot to rest; `now` is the robot's clock [s]."""
        self._engine, self._brake, self._say, self._now = engine, brake, say, now
        self._next_report = -math.inf

    def run(self, think: Callable[[], Problem | None]) -> Problem:
        """Run `think` and give what it says is not done; if it fails, the task fails with the robot at rest."""
        try:
            return think() or ""
        except OrderRefused as refused:  # no fault of the program
            if self._engine.active:
                self._brake()
            self._engine.fail(refused.notice)
            return refused.notice
        except Exception as fault:
            if self._engine.active:
                self._brake()
            kind = type(fault).__name__
            told = Notice(Code.ROBOT_FAULT, f"The robot's program has a fault: {fault!r}.", fault=kind)
            if self._now() >= self._next_report:
                self._next_report = self._now() + FAULT_PERIOD
                log.exception("The robot's own mind failed")
                self._say("task", told, "alarm")
            said = f"The task ended: the robot's program has a fault ({kind})."
            self._engine.fail(Notice(Code.TASK_FAULT, said, fault=kind))
            return told
