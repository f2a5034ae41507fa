"""The one door to all records: places, missions, history, settings, home, events, schedule, queue.

Everything is in memory: reading never waits. The robot sees a change at once, and a thread of its own writes it; the job of
`together` is done when the change is on the disk, and only then is it answered and shown. A change that a client asked for
and that cannot be written is taken back; a fact (an event, the progress of a task) stays in memory and is written later.

    with records.together() as job:
        place = records.places.set(Place(name="Office 12", x=4.0, y=2.0))
    problem = await job.kept(10.0)  # one sentence; empty when it is on the disk
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import AbstractContextManager

from robotside.records.answers import Answers
from robotside.records.audit import Audit
from robotside.records.crops import Crops
from robotside.records.database.audit_rows import Audited
from robotside.records.database.jobs import Job
from robotside.records.database.rows import Content, Put, empty
from robotside.records.database.storage import Storage
from robotside.records.database.writer import ImmediateWriter
from robotside.records.erasure import erase
from robotside.records.eventlog import EventLog
from robotside.records.ledger import Ledger, Writer
from robotside.records.missions import Missions
from robotside.records.places import Places
from robotside.records.plans import OrderQueue, Schedule
from robotside.records.runs import Runs

__all__ = ["Records"]


class Records:
    """All that the robot keeps. All calls come from one thread, the serving loop's."""

    def __init__(
        self,
        stored: Content,
        writer: Writer,
        close: Callable[[], None],
        audit: Callable[[], Iterable[Audited]] = tuple,
    ) -> None:
        """`audit` reads the rows of the audit log that are on the disk."""
        self._ledger = Ledger(stored, writer)
        self._close = close
        self.places = Places(self._ledger)
        """Named poses."""
        self.missions = Missions(self._ledger)
        """What to patrol, and home."""
        self.queue = OrderQueue(self._ledger)
        """Orders that wait."""
        self.schedule = Schedule(self._ledger)
        """Tasks that start by themselves."""
        self.runs = Runs(self._ledger)
        """What was done, and what is under way."""
        self.events = EventLog(self._ledger)
        """What happened."""
        self.crops = Crops(self._ledger)
        """Pictures of intruders."""
        self.answers = Answers(self._ledger)
        """What was answered to commands."""
        self.audit = Audit(self._ledger, audit)
        """Who did what by which way in."""
        self.problems: list[str] = []
        """What had to be done to open it, one sentence each, for the operator."""

    @classmethod
    def in_memory(cls, stored: Content | None = None) -> Records:
        """Records that are gone with the process and write at once, in the caller's step: for tests.

        `stored` is what is there at first; it is brought up to date with each write.
        """
        storage = Storage.in_memory()
        return cls(
            empty() if stored is None else stored, ImmediateWriter(storage), storage.close, storage.audit
        )

    def together(self) -> AbstractContextManager[Job]:
        """Have all changes within written as one, or none of them; the job has the outcome."""
        return self._ledger.together()

    def watch(self, table: str, change: Callable[[], None]) -> None:
        """Have `change` called when what is on the disk of a table has changed.

        The tables: places, missions, settings, schedule, queue, runs, events; facts for the queue's revision, for
        which mission is the stored one and for STOP.
        """
        self._ledger.watchers.setdefault(table, []).append(change)

    def on_trouble(self, tell: Callable[[str], None]) -> None:
        """Have `tell` called with a sentence when writing begins to fail, with an empty one when it succeeds again."""
        self._ledger.on_trouble = tell

    def setting(self, name: str, default: str = "") -> str:
        """A setting that an operator changed; `default` when none did."""
        return str(self._ledger.rows("settings").get(name, default))

    def set_setting(self, name: str, value: str, then: Callable[[], object] | None = None) -> None:
        """Keep a setting under a name of at most 64 characters; which there are is the caller's.

        `then` is called once it is on the disk.
        """
        self._ledger.order("settings", name, value, then)

    def note_setting(self, name: str, value: str) -> None:
        """Change a setting even if the disk fails; its client waits until it was tried."""
        with self._ledger.together() as job:
            job.urgent = True
            self._ledger.fact("settings", name, value)

    def undecided(self, *tables: str) -> bool:
        """Something that was asked for in one of the `tables` is on its way to the disk and may be taken back yet."""
        return self._ledger.memory.asked(tables)

    @property
    def stopped_by(self) -> str:
        """Who had pressed STOP, which is pressed until it is released; empty when it is not."""
        return str(self._ledger.rows("facts").get("stopped by", ""))

    @property
    def stop_kept(self) -> bool:
        """That STOP is pressed or released is on the disk as it is, and nothing on its way there says otherwise meanwhile."""
        if self.stop_pending:
            return False
        return bool(self._ledger.stored("facts").get("stopped by")) == bool(self.stopped_by)

    @property
    def stop_pending(self) -> bool:
        """That STOP is pressed or released is on its way to the disk."""
        return self._ledger.memory.is_pending("facts", "stopped by")

    def note_stop(self, by: str, after: Callable[[], object] | None = None) -> None:
        """Note who pressed STOP, or with an empty name that it was released; `after` is called once it was tried."""
        if by != self.stopped_by:
            self._ledger.fact("facts", "stopped by", by, after)

    def erase(self, name: str) -> Job:
        """Erase a person's name in all that happened, and the pictures of intruders, who may be anybody; the job has the outcome. See `robotside.records.erasure`."""
        with self._ledger.together() as job:
            erase(self._ledger, name)
            self.crops.erase()
            self.audit.erase(name)
        return job

    @property
    def trouble(self) -> str:
        """Why nothing can be written just now, as one sentence; empty when it can, as far as is known."""
        return self._ledger.trouble

    def owe(self, facts: list[Put], trouble: str) -> None:
        """Have `facts` written when the trouble is over, of which the sentence is among the problems."""
        self._ledger.owe(facts, trouble)
        self.problems.append(trouble)

    def try_again(self) -> None:
        """Write the facts that could not be written; to be called now and then."""
        self._ledger.try_again()

    def say_trouble(self, sentence: str) -> None:
        """Report trouble that no change has caused, as of a backup."""
        self._ledger.say(sentence)

    def rebuild(self, write: Callable[[list[Put], Callable[[str, str], None]], bool]) -> None:
        """Have everything written anew by `write`, since the database is broken."""
        self._ledger.rebuild(write)

    def close(self) -> None:
        """Write what waits and let go of the database. Nothing can be kept afterwards."""
        self._ledger.end()
        self._close()
