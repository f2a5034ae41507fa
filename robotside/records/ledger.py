"""The ledger of changes: at once in memory, then on the disk, and only then published."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Protocol

from bridge.core.codes import Code
from robotside.core.notice import Notice
from robotside.records.database.jobs import Job, NotRecorded
from robotside.records.database.memory import RowMemory
from robotside.records.database.rows import Content, Key, Put

__all__ = ["Ledger", "Writer"]


class Writer(Protocol):
    """Writes jobs one after the other and reports the outcome of each."""

    def submit(self, job: Job, told: Callable[[Job, str], None]) -> bool:
        """Write `job` when its turn comes, then call `told` with why it is not written, empty when it is.

        False when too many wait already: it is not written and `told` is not called.
        """


class Ledger:
    """All rows; every call comes from one thread."""

    def __init__(self, stored: Content, writer: Writer) -> None:
        self.memory = RowMemory(stored)
        self.watchers: dict[str, list[Callable[[], None]]] = {}
        """Of each table who is called when what is on the disk of it has changed."""
        self.on_trouble: Callable[[str], None] = lambda _: None
        """Called when writing begins to fail, and with an empty sentence when it succeeds again."""
        self._writer = writer
        self.trouble = ""
        """Why the last write failed, as one sentence; empty when it did not."""
        self._open: Job | None = None

    @contextmanager
    def together(self) -> Iterator[Job]:
        """Write all that is changed within as one; the job has the outcome, and is done at once if nothing was changed."""
        if self._open is not None:
            yield self._open
            return
        job = self._open = Job()
        try:
            yield job
        finally:
            self._open = None
            self._hand_in(job)

    def rows(self, table: str) -> dict[Any, Any]:
        """Values by key as they will be when everything was written."""
        return self.memory.current[table]

    def stored(self, table: str) -> dict[Any, Any]:
        """Values by key as they are on the disk."""
        return self.memory.stored[table]

    def order(self, table: str, key: Key, value: Any, then: Callable[[], object] | None = None) -> None:
        """Change a row on request, None deletes it; `then` is called once it is on the disk."""
        with self.together() as job:
            job.orders.append(Put(table, key, value))
            self.memory.apply(job.orders[-1])
            if then:
                job.then.append(then)

    def fact(self, table: str, key: Key, value: Any, after: Callable[[], object] | None = None) -> None:
        """Change a row because it is so; `after` is called once it is on the disk or cannot be just now."""
        with self.together() as job:
            job.facts.append(Put(table, key, value))
            self.memory.apply(job.facts[-1])
            if after:
                job.after.append(after)

    def count(self, name: str, least: int = 1) -> int:
        """The next number of a counter, which is never given twice."""
        number = max(int(self.rows("facts").get(name, 0)) + 1, least)
        self.fact("facts", name, str(number))
        return number

    def try_again(self) -> None:
        """Write the facts that could not be written."""
        facts = self.memory.again()
        if facts:
            self._hand_in(Job(facts=facts))

    def owe(self, facts: list[Put], trouble: str) -> None:
        """Have facts that could not be written just now, for that reason."""
        self.trouble = trouble
        for put in facts:
            self.memory.apply(put)
        self.memory.failed(Job(facts=facts))

    def end(self) -> None:
        """Write what could not be written, and with it that this was an orderly end."""
        put = Put("facts", "clean", "1")
        self.memory.apply(put)
        self._hand_in(Job(facts=[*self.memory.again(), put]))

    def rebuild(self, write: Callable[[list[Put], Callable[[str, str], None]], bool]) -> None:
        """Have everything written anew, since the database is broken."""
        puts = self.memory.everything()

        def told(said: str, problem: str) -> None:
            if problem:
                self._trust(problem)
                return
            self.memory.written_anew(puts)
            self.on_trouble(said)

        write(puts, told)

    def say(self, sentence: str) -> None:
        """Report trouble that belongs to no job."""
        self.on_trouble(sentence)

    def _hand_in(self, job: Job) -> None:
        if not job.puts:
            job.settle("")
            return
        self.memory.put(job)
        if not self._writer.submit(job, self._on_written):
            self.memory.failed(job)
            job.settle(f"The database is slow: {self.memory.pending} changes wait already.")

    def _on_written(self, job: Job, problem: str) -> None:
        if problem:
            self.memory.failed(job)
            self._trust(problem)
            job.settle(problem)
            return
        self.memory.succeeded(job)
        self._trust("")
        for table in dict.fromkeys(put.table for put in job.puts):
            for call in self.watchers.get(table, ()):
                call()
        job.settle("")

    def _trust(self, problem: str) -> None:
        if bool(problem) != bool(self.trouble):
            self.trouble = problem
            self.on_trouble(problem)


def within(number: int, most: int, what: str) -> None:
    """NotRecorded when there are more than `most` of `what`."""
    if number > most:
        said = f"At most {most} {what} can be stored; delete one first."
        raise NotRecorded(Notice(Code.RECORDS_FULL, said, max=most))
