"""Log lines that strangers cause are limited in number, and none is lost without being counted."""

from __future__ import annotations

import logging
from collections.abc import Iterator

import pytest

from bridge.server.reception import log_limit
from bridge.server.reception.log_limit import MAX_KINDS, WINDOW, LogLimit
from tests.bridge.peers import peer
from tests.bridge.wires import Clock, server


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def limited(clock: Clock) -> Iterator[tuple[logging.Logger, LogLimit]]:
    log, limit = logging.getLogger("a stranger's log"), LogLimit(clock, max_lines=3)
    log.addFilter(limit)
    yield log, limit
    log.removeFilter(limit)


def lines(caplog: pytest.LogCaptureFixture) -> list[str]:
    said = [record.getMessage() for record in caplog.records]
    caplog.clear()
    return said


def test_the_first_of_a_kind_are_written_and_the_rest_counted(
    limited: tuple[logging.Logger, LogLimit], clock: Clock, caplog: pytest.LogCaptureFixture
) -> None:
    log, limit = limited
    for number in range(10):
        log.warning("bad request %d", number)
    log.warning("something else")
    assert lines(caplog) == ["bad request 0", "bad request 1", "bad request 2", "something else"]
    limit.flush()
    assert lines(caplog) == []
    clock.time += WINDOW
    limit.flush()
    assert lines(caplog) == ["7 more lines of a stranger's log within 60 s: bad request %d"]
    log.warning("bad request %d", 10)
    assert lines(caplog) == ["bad request 10"]


def test_nobody_writes_lines_of_its_own_or_commands_the_terminal(
    limited: tuple[logging.Logger, LogLimit], caplog: pytest.LogCaptureFixture
) -> None:
    log, _ = limited
    log.warning("%s is refused", "/\n2026 root logged in\x1b[2J\u202e\ud800")
    log.warning("50 % is é")
    assert lines(caplog) == [
        "/\\n2026 root logged in\\x1b[2J\\u202e\\ud800 is refused",
        "50 % is é",
    ]


def test_a_new_window_begins_with_the_number_of_what_was_left_out(
    limited: tuple[logging.Logger, LogLimit], clock: Clock, caplog: pytest.LogCaptureFixture
) -> None:
    log, _ = limited
    for _ in range(5):
        log.warning("again")
    clock.time += WINDOW
    log.warning("again")
    assert lines(caplog)[3:] == ["2 more lines of a stranger's log within 60 s: again", "again"]


def test_kinds_without_end_are_few_lines(
    limited: tuple[logging.Logger, LogLimit], caplog: pytest.LogCaptureFixture
) -> None:
    log, _ = limited
    for number in range(10 * MAX_KINDS):
        log.warning(f"kind {number}")  # noqa: G004 - what a careless library does
    assert len(lines(caplog)) == MAX_KINDS + 3


async def test_clients_that_come_again_and_again_with_the_same_fault_do_not_fill_the_log(
    caplog: pytest.LogCaptureFixture,
) -> None:
    async with server() as robot:
        for _ in range(log_limit.MAX_LINES + 10):
            async with peer(robot) as bad:
                await bad.say(op="dance")
                await bad.settled()
    assert len([record for record in caplog.records if "dance" in record.getMessage()]) == log_limit.MAX_LINES
