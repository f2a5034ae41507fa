"""Work in the loop: a bounded share in each poll, the result or the fault to who asks, nothing after a cancel."""

from __future__ import annotations

import pytest

from robotside.core.worker import InLoopWorker, Work, completed


def counting(steps: int, done: list[int]) -> Work[str]:
    for step in range(steps):
        done.append(step)
        yield
    return "found"


def failing() -> Work[str]:
    yield
    raise ValueError("no way")


def test_each_poll_does_its_share_and_no_more() -> None:
    done: list[int] = []
    job = InLoopWorker(3).submit(counting(7, done))
    assert done == []
    shares = []
    while not job.poll():
        shares.append(len(done))
    assert shares == [3, 6]
    assert job.result() == "found"
    assert job.poll()


def test_who_asks_for_the_result_gets_the_fault() -> None:
    job = InLoopWorker().submit(failing())
    assert job.poll()
    with pytest.raises(ValueError, match="no way"):
        job.result()


def test_cancelled_work_goes_no_further_and_is_never_done() -> None:
    done: list[int] = []
    job = InLoopWorker(2).submit(counting(4, done))
    job.poll()
    job.cancel()
    assert not any(job.poll() for _ in range(5))
    assert done == [0, 1]


def test_all_of_it_at_once() -> None:
    assert completed(counting(100, [])) == "found"
    with pytest.raises(ValueError, match="no way"):
        completed(failing())
