"""The history of tasks, and the task that is under way."""

from __future__ import annotations

import math
from typing import NamedTuple

import msgspec

from bridge.msgs.pilothouse_msgs import TaskRun
from robotside.records.ledger import Ledger

__all__ = ["Runs", "UnderWay"]

MAX_RUNS = 2000
"""Runs that are kept."""
MAX_PAGE = 200
"""Runs that one question is answered with."""


class UnderWay(NamedTuple):
    """A task that has not ended."""

    run: TaskRun
    course: str
    """How far it is, in words of who runs it; empty when nothing was noted."""


class Runs:
    """All runs; one at most is under way. They are facts: a disk that fails ends no task."""

    def __init__(self, ledger: Ledger) -> None:
        self._ledger = ledger

    def begin(self, run: TaskRun, course: str = "") -> TaskRun:
        """Note that a task began; returns it with its number."""
        ledger = self._ledger
        with ledger.together() as job:
            job.urgent = True
            run = msgspec.structs.replace(run, id=ledger.count("last run"))
            self.note(run, course)
            rows = ledger.rows("runs")
            for old in sorted(rows)[:-MAX_RUNS]:
                ledger.fact("runs", old, None)
        return run

    def note(self, run: TaskRun, course: str = "") -> None:
        """Note how the run with that number is now; it is under way until its `ended` is not 0."""
        if not math.isfinite(run.distance):
            run = msgspec.structs.replace(run, distance=0.0)
        ledger = self._ledger
        with ledger.together() as job:
            job.urgent = job.urgent or run.ended.seconds > 0
            ledger.fact("runs", run.id, run)
            facts = ledger.rows("facts")
            if run.ended.seconds <= 0:
                ledger.fact("facts", "under way", str(run.id))
                ledger.fact("facts", "course", course)
            elif facts.get("under way") == str(run.id):
                ledger.fact("facts", "under way", None)
                ledger.fact("facts", "course", None)

    @property
    def last(self) -> int:
        """Number of the newest run; 0 when there was none."""
        return int(self._ledger.rows("facts").get("last run", 0))

    @property
    def newest(self) -> TaskRun | None:
        """The run that began last; None when there was none."""
        rows = self._ledger.rows("runs")
        return rows[max(rows)] if rows else None

    @property
    def under_way(self) -> UnderWay | None:
        """The task that has not ended: after a start, the one that was cut by a crash or a power cut."""
        facts = self._ledger.rows("facts")
        run = self._ledger.rows("runs").get(int(facts.get("under way", 0)))
        return UnderWay(run, facts.get("course", "")) if run is not None else None

    def before(self, id: int = 0, limit: int = 50) -> list[TaskRun]:
        """The newest runs that are on the disk, newest first: those before `id`, 0 for all; at most `limit` of them."""
        rows = self._ledger.stored("runs")
        found = sorted((key for key in rows if not id or key < id), reverse=True)
        return [rows[key] for key in found[: max(0, min(limit, MAX_PAGE))]]
