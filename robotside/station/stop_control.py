"""STOP of one robot: pressed, released, kept over restarts, and doubted when the robot may not have obeyed."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.autonomy.readiness import Readiness
from robotside.control.command_gate import SOMEBODY, CommandGate
from robotside.control.guarded_robot import GuardedRobot
from robotside.control.stop_consequences import still_moves
from robotside.control.stop_record import StopRecord
from robotside.control.stop_release import StopRelease
from robotside.core.notice import Notice
from robotside.motion.measured import MeasuredState
from robotside.records import Records
from robotside.records.events import Say
from robotside.tasks.engine import Engine

__all__ = ["StopControl"]

log = logging.getLogger(__name__)


class StopControl:
    """Presses and releases STOP at the robot, its controls and its task."""

    def __init__(
        self,
        info: RobotInfo,
        controls: CommandGate,
        robot: GuardedRobot,
        engine: Engine,
        records: Records,
        readiness: Readiness,
        *,
        say: Say,
        clock: Callable[[], float],
        measured: Callable[[], MeasuredState],
        is_at_rest: Callable[[], bool],
    ) -> None:
        """`clock` is the operators' [s]."""
        self._info, self._controls, self._robot, self._engine = info, controls, robot, engine
        self._records, self._readiness = records, readiness
        self._say, self._clock, self._measured, self._is_at_rest = say, clock, measured, is_at_rest
        self.holds = StopRelease()
        """Who holds to release it."""
        self._latch = StopRecord(records, say)
        self._port_fault = ""
        self._ending = False

    def press(self, name: str, client_id: str = "", given: float = math.inf) -> None:
        """Latch STOP, as `CommandGate.stop` does, bring the robot to rest and hold the task; it was `given` now at the latest."""
        self._press(name, client_id, given)
        if (
            self._ending and not self._records.stopped_by
        ):  # the latch is this robot side's own already: what a person pressed meanwhile outlives it
            self._latch.note(name or SOMEBODY)

    def _press(self, name: str, client_id: str = "", given: float = math.inf) -> None:
        fresh = not self._controls.stopped
        self._controls.stop(name, client_id, min(given, self._clock()))  # before all that may fail
        self._port_fault = ""
        self._try(self._robot.stop if self._ending else self._robot.press_stop)
        if fresh:
            pressed = Notice(Code.STOP_PRESSED, f"STOP pressed by {name}.", actor_id=client_id, name=name)
            self._say("stop", pressed, "alarm")
        self._readiness.stop_pressed()
        held = Notice(Code.TASK_STOPPED, f"Stopped by {name}.", actor_id=client_id, name=name)
        self._try(lambda: self._engine.pause(held, "alarm"))
        self.note()
        moves = still_moves(self._info.name, self._info.kind, self._measured())
        if fresh and moves and not self._ending:
            self._say("control", moves, "alarm")

    def release(self, name: str, client_id: str = "") -> None:
        """Unlatch STOP for `name` of that `client_id`; the robot stays where it is."""
        self._controls.release_stop()
        self.holds.on_released(self._clock())
        self._robot.release_stop()
        released = Notice(Code.STOP_RELEASED, f"STOP released by {name}.", actor_id=client_id, name=name)
        self._say("stop", released, "ok")

    def recover(self) -> None:
        """Press STOP again if it was pressed before a restart."""
        by = self._records.stopped_by
        if by:
            self._controls.stop(by)
            self._robot.press_stop()
            said = f"STOP, pressed by {by} before the restart, is still pressed."
            self._say("stop", Notice(Code.STOP_STILL_PRESSED, said, name=by), "alarm")

    def end(self, name: str) -> None:
        """Press STOP for the last time, for `name`; that is the robot side's own and not kept over the restart."""
        self.note()
        self._ending = True
        self._press(name)

    def note(self) -> None:
        """Keep whether STOP is pressed for a restart."""
        if not self._ending:
            self._latch.note(self._controls.stopped_by)

    @property
    def doubt(self) -> str:
        """Why a STOP that is pressed may not have reached the robot, as one sentence; empty when it has."""
        return "" if self._is_at_rest() else self._port_fault or self._robot.trouble

    @property
    def unkept(self) -> str:
        """Why a STOP that is pressed would be gone after a restart, as one sentence; empty when it would not."""
        return self._latch.doubt

    @property
    def saving(self) -> bool:
        """A STOP that is pressed is on its way to the disk."""
        return self._latch.saving

    async def saved(self, timeout: float) -> None:
        """Wait until it is there or could not be written, `timeout` [s] at most."""
        await self._latch.saved(timeout)

    def _try(self, act: Callable[[], None]) -> None:
        try:
            act()
        except Exception as fault:
            log.exception("The robot's port failed at STOP")
            self._port_fault = f"The robot's port failed: {fault!r}."
