"""That a task began or ended is told once it is on the disk: a power cut after that takes nothing back."""

from __future__ import annotations

from collections.abc import Coroutine
from typing import Any

import pytest

from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import CommandRequest, StartTaskRequest, TaskOrder
from robotside.tasks.task_status_publisher import DISK_TIMEOUT
from tests.robotside.slow import FULL, Slow

HOLD = StartTaskRequest(order=TaskOrder(task="hold", duration=600.0))


@pytest.fixture
def slow() -> Slow:
    return Slow()


def order(slow: Slow, name: str, request: Msg | None = None) -> None:
    """Give an order; nobody hears its answer."""
    answer = slow.ask(f"/task/{name}", request or CommandRequest())
    if isinstance(answer, Coroutine):
        answer.close()


def told(slow: Slow) -> list[tuple[int, str]]:
    """Number and state of all that is told of tasks from now on."""
    states: list[tuple[int, str]] = []

    def hear(_: str, msg: Any) -> None:
        if (msg.task_id, msg.state) not in states:
            states.append((msg.task_id, msg.state))

    slow.station.bus.subscribe("/task/status", hear)
    states.clear()
    return states


def test_a_task_is_said_to_run_once_a_power_cut_would_leave_it_to_be_resumed(slow: Slow) -> None:
    states = told(slow)
    order(slow, "start", HOLD)
    slow.run(1.0)
    assert states == []
    slow.write()
    assert states == [(1, "RUNNING")]
    slow.restart()
    assert (slow.last("/task/status").task_id, slow.last("/task/status").state) == (1, "INTERRUPTED")


def test_its_end_too_and_all_is_told_in_its_order(slow: Slow) -> None:
    states = told(slow)
    order(slow, "start", HOLD)
    order(slow, "pause")
    order(slow, "cancel")
    order(slow, "start", HOLD)
    assert states == []
    slow.write()
    assert states == [(1, "RUNNING"), (1, "PAUSED"), (1, "CANCELED"), (2, "RUNNING")]


def test_what_a_restart_need_not_know_waits_for_no_disk(slow: Slow) -> None:
    order(slow, "start", HOLD)
    slow.write()
    states = told(slow)
    order(slow, "pause")
    assert states == [(1, "PAUSED")]


def test_a_disk_that_fails_hides_nothing_of_what_the_robot_does(slow: Slow) -> None:
    states = told(slow)
    order(slow, "start", HOLD)
    slow.write(FULL)
    assert states == [(1, "RUNNING")]


def test_nor_does_one_that_never_answers(slow: Slow) -> None:
    states = told(slow)
    order(slow, "start", HOLD)
    slow.clock += DISK_TIMEOUT - 0.1
    slow.run(0.1)
    assert states == []
    slow.clock += 0.1
    slow.run(0.1)
    assert states == [(1, "RUNNING")]


def test_the_robot_side_does_not_go_before_it_has_said_what_became_of_the_task(slow: Slow) -> None:
    order(slow, "start", HOLD)
    slow.write()
    states = told(slow)
    slow.station.end()
    slow.run(0.5)
    assert slow.station.at_rest
    assert not slow.station.done
    slow.write()
    assert slow.station.done
    assert states == [(1, "CANCELED")]
