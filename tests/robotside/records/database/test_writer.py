"""The thread that writes."""

from __future__ import annotations

import math
import queue
import threading
from collections.abc import Callable, Iterator

import pytest

from robotside.records.database.jobs import Job
from robotside.records.database.rows import Put
from robotside.records.database.storage import NotWritten
from robotside.records.database.writer import MAX_WAITING, Store, WriterThread


class Paper(Store):
    """Keeps what is written; fails as told."""

    def __init__(self) -> None:
        self.written: list[list[object]] = []
        self.tries = 0
        self.go = threading.Event()
        self.go.set()
        self.problem: NotWritten | None = None
        self.bad: object = None
        self.rebuilt: list[Put] | None = None
        self.backups = 0
        self.age = math.inf
        self.closed = False

    def write(self, puts: list[Put]) -> None:
        self.go.wait(5.0)
        self.tries += 1
        if self.problem:
            raise self.problem
        if any(put.value == self.bad for put in puts):
            raise NotWritten("It is bad.", general=False)
        self.written.append([put.value for put in puts])

    def rebuild(self, puts: list[Put]) -> str:
        self.rebuilt, self.problem = puts, None
        return "Written anew."

    def back_up(self) -> None:
        self.backups += 1

    def backup_age(self) -> float:
        return self.age

    def close(self) -> None:
        self.closed = True


class Desk:
    """The thread of the records: does what is brought to it when it looks."""

    def __init__(self) -> None:
        self.calls: queue.Queue[tuple[Callable[..., None], tuple[object, ...]]] = queue.Queue()
        self.told: list[tuple[Job, str]] = []

    def soon(self, call: Callable[..., None], *arguments: object) -> None:
        self.calls.put((call, arguments))

    def hear(self, job: Job, problem: str) -> None:
        self.told.append((job, problem))

    def look(self, jobs: int) -> list[str]:
        while len(self.told) < jobs:
            call, arguments = self.calls.get(timeout=60.0)
            call(*arguments)
        return [problem for _, problem in self.told]


@pytest.fixture
def paper() -> Paper:
    return Paper()


@pytest.fixture
def desk() -> Desk:
    return Desk()


@pytest.fixture
def writer(paper: Paper, desk: Desk) -> Iterator[WriterThread]:
    writer = WriterThread(paper, desk.soon)
    writer.start()
    yield writer
    paper.go.set()
    writer.close()


def job(value: object) -> Job:
    return Job(orders=[Put("settings", "a", value)])


def test_what_waits_is_written_together_in_its_order(writer: WriterThread, paper: Paper, desk: Desk) -> None:
    paper.go.clear()
    jobs = [job(number) for number in range(5)]
    for each in jobs:
        assert writer.submit(each, desk.hear)
    paper.go.set()
    assert desk.look(5) == [""] * 5
    assert [each for each, _ in desk.told] == jobs
    assert [value for batch in paper.written for value in batch] == [0, 1, 2, 3, 4]
    assert len(paper.written) <= 2


def test_one_that_cannot_be_written_costs_the_others_nothing(
    writer: WriterThread, paper: Paper, desk: Desk
) -> None:
    paper.go.clear()
    paper.bad = 2
    for number in range(5):
        writer.submit(job(number), desk.hear)
    paper.go.set()
    assert desk.look(5) == ["", "", "It is bad.", "", ""]


def test_a_disk_that_fails_is_tried_once_for_all_that_waits(paper: Paper, desk: Desk) -> None:
    paper.problem = NotWritten("The disk is full.")
    writer = WriterThread(paper, desk.soon)
    for number in range(5):
        writer.submit(job(number), desk.hear)
    writer.start()
    assert desk.look(5) == ["The disk is full."] * 5
    writer.close()
    assert paper.tries == 1


def test_too_many_are_refused_and_none_waits_for_the_disk(
    writer: WriterThread, paper: Paper, desk: Desk
) -> None:
    paper.go.clear()
    taken = sum(writer.submit(job(number), desk.hear) for number in range(MAX_WAITING + 100))
    assert MAX_WAITING <= taken <= MAX_WAITING + 50
    paper.go.set()
    desk.look(taken)


def test_a_broken_database_is_written_anew_with_what_came_meanwhile(
    writer: WriterThread, paper: Paper, desk: Desk
) -> None:
    paper.problem = NotWritten("Broken.", damaged=True)
    said = list[str]()
    everything = [Put("settings", "a", 1), Put("settings", "b", 2)]
    writer.on_damage = lambda: writer.rebuild(everything, lambda told, _: said.append(told))  # type: ignore[func-returns-value]
    writer.submit(job(1), desk.hear)
    assert desk.look(1) == [""]
    assert paper.rebuilt == everything
    writer.submit(job(3), desk.hear)
    desk.look(2)
    assert (said, paper.written) == (["Written anew."], [[3]])


def test_what_waits_at_the_end_is_written_before_it_ends(paper: Paper, desk: Desk) -> None:
    writer = WriterThread(paper, desk.soon)
    for number in range(3):
        writer.submit(job(number), desk.hear)
    writer.start()
    writer.close()
    assert [value for batch in paper.written for value in batch] == [0, 1, 2]
    assert paper.closed


def test_a_backup_is_made_soon_after_the_start(writer: WriterThread, paper: Paper, desk: Desk) -> None:
    writer.submit(job(1), desk.hear)
    desk.look(1)
    writer.close()
    assert paper.backups == 1


def test_a_backup_that_is_young_will_do_for_now(paper: Paper, desk: Desk) -> None:
    paper.age = 100.0
    writer = WriterThread(paper, desk.soon)
    writer.start()
    writer.submit(job(1), desk.hear)
    desk.look(1)
    writer.close()
    assert paper.backups == 0


def test_what_was_backed_up_is_not_backed_up_again_before_something_changes(
    paper: Paper, desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    for period in ("BACKUP_PERIOD", "RETRY_PERIOD"):
        monkeypatch.setattr(f"robotside.records.database.writer.{period}", 0.001)
    writer, idle = WriterThread(paper, desk.soon), queue.Queue[None]()
    writer.on_idle = lambda: idle.put(None)
    writer.submit(job(1), desk.hear)
    writer.start()
    desk.look(1)
    for _ in range(4):
        call, arguments = desk.calls.get(timeout=60.0)
        call(*arguments)
    writer.close()
    assert idle.qsize() == 4
    assert paper.backups == 1


def test_so_much_is_held_back_while_the_database_is_broken_and_the_rest_is_refused(
    paper: Paper, desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("robotside.records.database.writer.MAX_WAITING", 3)
    paper.problem = NotWritten("Broken.", damaged=True)
    writer = WriterThread(paper, desk.soon)
    for number in range(3):
        writer.submit(job(number), desk.hear)
    writer.start()
    desk.calls.get(timeout=60.0)  # the damage is told: these three are held back
    late = job(3)
    writer.submit(late, desk.hear)
    desk.look(1)
    assert desk.told == [(late, "The database is damaged: nothing was stored.")]
    writer.close()


def test_a_loop_that_has_ended_stops_nothing(paper: Paper) -> None:
    def ended(*_: object) -> None:
        raise RuntimeError("Event loop is closed")

    writer = WriterThread(paper, ended)
    writer.start()
    writer.submit(job(1), lambda *_: None)
    writer.close()
    assert paper.written == [[1]]
