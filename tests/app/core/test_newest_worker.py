"""The worker thread: newest wins, and what waits at the end is still done."""

from __future__ import annotations

import threading

from app.core.newest_worker import NewestWorker


def test_items_that_had_no_turn_are_skipped_and_counted() -> None:
    done: list[int] = []
    busy, go_on = threading.Event(), threading.Event()

    def work(item: int) -> None:
        busy.set()
        go_on.wait(5)
        done.append(item)

    worker = NewestWorker(work, "test")
    worker.put(1)
    busy.wait(5)
    for item in (2, 3, 4):
        worker.put(item)
    go_on.set()
    worker.close()
    assert done == [1, 4]
    assert worker.skipped == 2


def test_after_closing_nothing_is_done() -> None:
    done: list[int] = []
    worker = NewestWorker(done.append, "test")
    worker.close()
    worker.put(1)
    assert done == []


def test_one_that_is_dropped_is_not_waited_for_and_does_no_more() -> None:
    done: list[int] = []
    busy, go_on = threading.Event(), threading.Event()

    def work(item: int) -> None:
        busy.set()
        go_on.wait(60)
        done.append(item)

    worker = NewestWorker(work, "test")
    worker.put(1)
    busy.wait(60)
    worker.put(2)
    worker.drop()
    assert done == [], "it is still at work"
    go_on.set()
    worker.close()
    assert done == [1]


def test_flushing_waits_for_what_waits_and_what_is_worked_on_and_no_longer_than_it_may() -> None:
    done: list[int] = []
    busy, go_on = threading.Event(), threading.Event()

    def work(item: int) -> None:
        busy.set()
        go_on.wait(60)
        done.append(item)

    worker = NewestWorker(work, "test")
    assert worker.flush(0.0), "nothing was given yet"
    worker.put(1)
    busy.wait(60)
    assert not worker.flush(0.0), "it is still at work"
    go_on.set()
    assert worker.flush(60.0)
    assert done == [1]
    worker.close()
