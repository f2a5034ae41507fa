"""The record of STOP on the disk, which keeps it over restarts; an alarm when it cannot be kept."""

from __future__ import annotations

import asyncio
from contextlib import suppress

from bridge.core.codes import Code
from robotside.core.notice import Notice
from robotside.records import Records
from robotside.records.events import Say

__all__ = ["StopRecord"]


class StopRecord:
    """Notes who pressed STOP; tried again until it is on the disk."""

    def __init__(self, records: Records, say: Say) -> None:
        self._records, self._say = records, say
        self._unkept = False
        self._waiting: set[asyncio.Future[None]] = set()
        records.watch("facts", self._on_change)

    def note(self, by: str) -> None:
        """Keep that STOP is pressed `by` an operator; an empty name when it is released."""
        if by != self._records.stopped_by:
            self._records.note_stop(by, self._tried)

    @property
    def doubt(self) -> str:
        """Why a STOP that is pressed would be gone after a restart, as one sentence; empty when nothing says so."""
        records = self._records
        if records.stop_kept or not records.stopped_by:
            return ""
        if not records.trouble:
            return "It is not saved yet: a restart of the robot's computer just now would release it."
        return f"A restart of the robot's computer would release it. {records.trouble}"

    @property
    def saving(self) -> bool:
        """A STOP that is pressed is on its way to the disk, and nothing says that it does not arrive."""
        records = self._records
        return bool(records.stopped_by) and not (records.stop_kept or records.trouble)

    async def saved(self, timeout: float) -> None:
        """Wait until it is there or could not be written, `timeout` [s] at most."""
        if not self.saving:
            return
        future = asyncio.get_running_loop().create_future()
        self._waiting.add(future)
        try:
            with suppress(TimeoutError):
                async with asyncio.timeout(timeout):
                    await future
        finally:
            self._waiting.discard(future)

    def _tried(self) -> None:
        """What was noted is on the disk or could not be written; a newer note may be on its way still."""
        if self._records.stop_pending:
            return
        for future in self._waiting:
            if not future.done():
                future.set_result(None)
        if self._records.stop_kept:
            self._unkept = False
        elif not self._unkept:
            self._unkept = True
            state, outcome = (
                ("pressed", "release it") if self._records.stopped_by else ("released", "press it")
            )
            said = f"a restart of the robot's computer would {outcome}. {self._records.trouble}".strip()
            said = f"That STOP is {state} could not be saved: {said}"
            self._say("stop", Notice(Code.STOP_UNKEPT, said, state=state), "alarm")

    def _on_change(self) -> None:
        if self._unkept and self._records.stop_kept:
            self._unkept = False
            state = "pressed" if self._records.stopped_by else "released"
            said = f"STOP is {state}, and this is saved now."
            self._say("stop", Notice(Code.STOP_KEPT, said, state=state), "ok")
