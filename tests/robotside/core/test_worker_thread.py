"""Work in a thread: one piece after the other, dropped between two steps, and nothing left running at the end."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest

from robotside.core.worker import Job, Work
from robotside.core.worker_thread import MAX_WAITING, WorkerThread

LIMIT = 30.0
"""No step of these tests takes so long [s]; without it a fault would hang them."""


class Gate:
    """Work that begins, waits for the test, and goes on."""

    def __init__(self) -> None:
        self.began, self.go, self.ended = threading.Event(), threading.Event(), threading.Event()
        self.thread: threading.Thread | None = None
        self.steps = 0

    def work(self) -> Work[str]:
        try:
            self.thread = threading.current_thread()
            self.began.set()
            assert self.go.wait(LIMIT)
            for _ in range(3):
                self.steps += 1
                yield
            return "found"
        finally:
            self.ended.set()


def value(of: int) -> Work[int]:
    yield
    return of


def failing() -> Work[str]:
    yield
    raise ValueError("no way")


def finished(worker: WorkerThread) -> None:
    """Wait until all that was handed in before this is done."""
    last = threading.Event()

    def mark() -> Work[None]:
        last.set()
        yield

    worker.submit(mark())
    assert last.wait(LIMIT)


@pytest.fixture
def worker() -> Iterator[WorkerThread]:
    with WorkerThread("a worker") as worker:
        yield worker
    assert "a worker" not in {thread.name for thread in threading.enumerate()}


def test_it_works_in_another_thread_while_the_caller_goes_on(worker: WorkerThread) -> None:
    gate = Gate()
    job = worker.submit(gate.work())
    assert gate.began.wait(LIMIT)
    assert not job.poll()
    gate.go.set()
    finished(worker)
    assert job.poll()
    assert job.result() == "found"
    assert gate.thread is not threading.current_thread()


def test_jobs_are_done_in_their_order(worker: WorkerThread) -> None:
    jobs = [worker.submit(value(number)) for number in range(5)]
    finished(worker)
    assert [job.result() for job in jobs if job.poll()] == [0, 1, 2, 3, 4]


def test_a_fault_is_for_who_asks_and_the_next_job_is_done(worker: WorkerThread) -> None:
    bad, good = worker.submit(failing()), worker.submit(value(7))
    finished(worker)
    assert bad.poll()
    with pytest.raises(ValueError, match="no way"):
        bad.result()
    assert good.poll()
    assert good.result() == 7


def test_a_cancelled_job_is_dropped_at_its_next_step_and_never_done(worker: WorkerThread) -> None:
    gate = Gate()
    job = worker.submit(gate.work())
    assert gate.began.wait(LIMIT)
    job.cancel()
    gate.go.set()
    finished(worker)
    assert gate.ended.is_set()
    assert gate.steps == 1
    assert not job.poll()


def test_a_result_that_came_before_the_cancel_counts_for_nothing_after_it(worker: WorkerThread) -> None:
    job = worker.submit(value(1))
    finished(worker)
    job.cancel()
    assert not job.poll()


def test_cancelled_jobs_take_no_place_and_too_many_others_are_refused(worker: WorkerThread) -> None:
    gate = Gate()
    worker.submit(gate.work())
    assert gate.began.wait(LIMIT)
    for _ in range(3 * MAX_WAITING):
        worker.submit(value(0)).cancel()
    kept: list[Job[int]] = [worker.submit(value(number)) for number in range(MAX_WAITING)]
    with pytest.raises(RuntimeError, match=f"has {MAX_WAITING} jobs waiting"):
        worker.submit(value(0))
    gate.go.set()
    while not kept[-1].poll():
        gate.ended.wait(0.01)
    assert [job.result() for job in kept] == list(range(MAX_WAITING))


def test_its_end_drops_what_runs_and_what_waits_and_takes_nothing_more() -> None:
    gate = Gate()
    with WorkerThread("a worker") as worker:
        jobs: list[Job[object]] = [worker.submit(gate.work()), worker.submit(value(1))]
        assert gate.began.wait(LIMIT)
        gate.go.set()
    assert gate.ended.is_set()
    assert not jobs[1].poll()
    with pytest.raises(RuntimeError, match="The worker thread has ended"):
        worker.submit(value(1))
