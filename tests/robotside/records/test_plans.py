"""The queue and the schedule."""

from __future__ import annotations

import msgspec
import pytest

from bridge.msgs.pilothouse_msgs import ScheduledTask, TaskOrder
from robotside.records import NotRecorded, Records

HOLD, DOCK = TaskOrder(task="hold", duration=5.0), TaskOrder(task="dock", places=["Dock"])


@pytest.fixture
def records() -> Records:
    return Records.in_memory()


def tasks(records: Records) -> list[tuple[int, str]]:
    return [(order.id, order.task) for order in records.queue.current.orders]


def test_orders_wait_in_their_order_and_are_given_numbers(records: Records) -> None:
    records.queue.add(HOLD)
    queue = records.queue.set([DOCK, *records.queue.current.orders], 1)
    assert queue.revision == 2
    assert tasks(records) == [(2, "dock"), (1, "hold")]


def test_the_next_one_is_taken_out(records: Records) -> None:
    records.queue.set([HOLD, DOCK])
    taken = records.queue.pop()
    assert taken is not None
    assert (taken.id, taken.task) == (1, "hold")
    assert tasks(records) == [(2, "dock")]
    records.queue.pop()
    assert records.queue.pop() is None


def test_a_change_made_from_an_old_queue_is_refused(records: Records) -> None:
    records.queue.add(HOLD)
    with pytest.raises(NotRecorded, match="this is revision 0, the robot's is 1"):
        records.queue.set([], 0)
    assert tasks(records) == [(1, "hold")]


@pytest.mark.parametrize(("ids", "said"), [((1, 1), "one is in it twice"), ((7,), "number 7 waits no more")])
def test_an_order_that_does_not_wait_or_waits_twice_is_refused(
    records: Records, ids: tuple[int, ...], said: str
) -> None:
    records.queue.add(HOLD)
    with pytest.raises(NotRecorded, match=said):
        records.queue.set([msgspec.structs.replace(HOLD, id=id) for id in ids])


def test_scheduled_tasks_are_kept_changed_and_forgotten(records: Records) -> None:
    kept = records.schedule.set(ScheduledTask(order=DOCK, at="22:00"))
    assert kept.id == 1
    records.schedule.set(msgspec.structs.replace(kept, enabled=False))
    assert [task.enabled for task in records.schedule.all()] == [False]
    assert records.schedule.delete(1).at == "22:00"
    assert records.schedule.all() == []


@pytest.mark.parametrize("change", ["set", "delete"])
def test_an_unknown_scheduled_task_is_refused(records: Records, change: str) -> None:
    with pytest.raises(NotRecorded, match="There is no scheduled task with the number 4."):
        records.schedule.set(ScheduledTask(id=4)) if change == "set" else records.schedule.delete(4)
