"""Changes in memory, on their way to the disk, taken back when they do not get there."""

from __future__ import annotations

import pytest

from robotside.records.database.rows import empty
from robotside.records.ledger import Ledger
from tests.robotside.records.disk import Disk


@pytest.fixture
def disk() -> Disk:
    return Disk()


@pytest.fixture
def ledger(disk: Disk) -> Ledger:
    return Ledger(empty(), disk)


def test_a_change_is_seen_at_once_and_shown_when_it_is_on_the_disk(ledger: Ledger, disk: Disk) -> None:
    done, shown = list[str](), list[str]()
    ledger.watchers["settings"] = [lambda: shown.append(ledger.stored("settings")["a"])]
    ledger.order("settings", "a", "1", lambda: done.append("a"))
    assert ledger.rows("settings") == {"a": "1"}
    assert (ledger.stored("settings"), shown, done) == ({}, [], [])
    disk.answer()
    assert (ledger.stored("settings"), shown, done) == ({"a": "1"}, ["1"], ["a"])


def test_an_order_that_cannot_be_written_is_taken_back(ledger: Ledger, disk: Disk) -> None:
    ledger.order("settings", "a", "1")
    disk.answer()
    done = list[str]()
    with ledger.together() as job:
        ledger.order("settings", "a", "2", lambda: done.append("a"))
        ledger.order("settings", "b", "3")
    disk.answer("The disk is full.")
    assert (job.done, job.problem, done) == (True, "The disk is full.", [])
    assert ledger.rows("settings") == {"a": "1"}


def test_what_was_changed_again_meanwhile_stays_changed(ledger: Ledger, disk: Disk) -> None:
    ledger.order("settings", "a", "1")
    ledger.order("settings", "a", "2")
    disk.answer("The disk is full.")
    assert ledger.rows("settings") == {"a": "2"}
    disk.answer()
    assert ledger.stored("settings") == {"a": "2"}


def test_a_deletion_that_cannot_be_written_is_taken_back_too(ledger: Ledger, disk: Disk) -> None:
    ledger.order("settings", "a", "1")
    disk.answer()
    ledger.order("settings", "a", None)
    assert ledger.rows("settings") == {}
    disk.answer("The disk is full.")
    assert ledger.rows("settings") == {"a": "1"}


def test_a_fact_stays_and_is_written_later_as_it_is_then(ledger: Ledger, disk: Disk) -> None:
    tried = list[str]()
    ledger.fact("facts", "a", "1", lambda: tried.append("a"))
    disk.answer("The disk is full.")
    assert (ledger.rows("facts"), tried) == ({"a": "1"}, ["a"])
    ledger.fact("facts", "a", "2")
    ledger.try_again()
    assert [put.value for job, _ in disk.waiting for put in job.puts] == ["2", "2"]
    disk.answer()
    disk.answer()
    ledger.try_again()
    assert disk.waiting == []
    assert ledger.stored("facts") == {"a": "2"}


def test_a_fact_in_a_refused_job_stays_though_the_orders_beside_it_do_not(ledger: Ledger, disk: Disk) -> None:
    with ledger.together():
        ledger.order("settings", "a", "1")
        ledger.fact("facts", "b", "2")
    disk.answer("The disk is full.")
    assert (ledger.rows("settings"), ledger.rows("facts")) == ({}, {"b": "2"})


def test_all_within_is_one_job_and_nothing_is_none(ledger: Ledger, disk: Disk) -> None:
    with ledger.together() as outer, ledger.together():
        ledger.order("settings", "a", "1")
        ledger.fact("facts", "b", "2")
    assert [job for job, _ in disk.waiting] == [outer]
    with ledger.together() as nothing:
        pass
    assert (nothing.done, len(disk.waiting)) == (True, 1)


def test_what_was_changed_before_a_refusal_is_written_all_the_same(ledger: Ledger, disk: Disk) -> None:
    def refuse() -> None:
        with ledger.together():
            ledger.fact("facts", "a", "1")
            raise ValueError("no")

    with pytest.raises(ValueError, match="no"):
        refuse()
    assert len(disk.waiting) == 1


def test_an_order_is_refused_at_once_when_too_many_wait(ledger: Ledger, disk: Disk) -> None:
    disk.room = 2
    ledger.order("settings", "a", "1")
    ledger.order("settings", "b", "1")
    with ledger.together() as job:
        ledger.order("settings", "c", "1")
    assert (job.done, job.problem) == (True, "The database is slow: 2 changes wait already.")
    assert ledger.rows("settings") == {"a": "1", "b": "1"}


def test_trouble_is_told_when_it_begins_and_when_it_is_over(ledger: Ledger, disk: Disk) -> None:
    told = list[str]()
    ledger.on_trouble = told.append
    for problem in ("Full.", "Full.", "", ""):
        ledger.order("settings", "a", "1")
        disk.answer(problem)
    assert told == ["Full.", ""]


def test_a_counter_never_gives_a_number_twice(ledger: Ledger, disk: Disk) -> None:
    assert [ledger.count("n"), ledger.count("n")] == [1, 2]
    disk.answer("Full.")
    disk.answer("Full.")
    assert ledger.count("n") == 3


async def test_an_answer_that_waits_too_long_says_that_nobody_knows(ledger: Ledger, disk: Disk) -> None:
    with ledger.together() as job:
        ledger.order("settings", "a", "1")
    assert job.binding
    assert await job.kept(0.0) == "The database has not answered for 0 s; it may or may not be stored."
    disk.answer("Full.")
    assert await job.kept(0.0) == "Full."


def test_only_orders_and_what_is_urgent_keep_an_answer_waiting(ledger: Ledger) -> None:
    with ledger.together() as job:
        ledger.fact("facts", "a", "1")
    assert not job.binding
    job.urgent = True
    assert job.binding
