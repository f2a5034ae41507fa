"""The queue of orders and the schedule."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import msgspec

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import ScheduledTask, TaskOrder, TaskQueue
from robotside.core.notice import Notice
from robotside.records.database.jobs import NotRecorded
from robotside.records.database.rows import Key, Queued
from robotside.records.ledger import Ledger, within

__all__ = ["OrderQueue", "Schedule"]

MAX_QUEUED = 100
"""Orders that may wait."""
MAX_SCHEDULED = 200
"""Scheduled tasks that are kept."""


class OrderQueue:
    """Orders that wait, the next one first; every change counts as a revision."""

    def __init__(self, ledger: Ledger) -> None:
        self._ledger = ledger

    @property
    def current(self) -> TaskQueue:
        """As it will be when everything was written; without a stamp."""
        return _queue(self._ledger.rows("queue"), self._ledger.rows("facts"))

    @property
    def stored(self) -> TaskQueue:
        """As it is on the disk: what others are shown; without a stamp."""
        return _queue(self._ledger.stored("queue"), self._ledger.stored("facts"))

    def set(self, orders: Sequence[TaskOrder], revision: int | None = None) -> TaskQueue:
        """Replace all that waits; orders with the id 0 are given one. Returns the queue as it is kept.

        NotRecorded when `revision` is not that of now, None does not look; for an id that waits no more; for too many.
        """
        ledger, now = self._ledger, self.current
        if revision is not None and revision != now.revision:
            said = f"The queue was changed meanwhile: this is revision {revision}, the robot's is {now.revision}."
            changed = f"{said} View it and try again."
            raise NotRecorded(Notice(Code.QUEUE_CHANGED, changed, revision=now.revision))
        within(len(orders), MAX_QUEUED, "waiting tasks")
        ids = [order.id for order in orders if order.id]
        strange = sorted(set(ids) - {order.id for order in now.orders})
        if strange or len(set(ids)) < len(ids):
            wrong = f"number {strange[0]} waits no more" if strange else "one is in it twice"
            said = f"The queue was not changed: of its tasks {wrong}."
            raise NotRecorded(Notice(Code.QUEUE_WRONG, said))
        self._replace(orders, ledger.order)
        return self.current

    def add(self, order: TaskOrder) -> TaskOrder:
        """Have `order` wait behind all others; returns it with its id. NotRecorded for too many."""
        fresh = msgspec.structs.replace(order, id=0)
        return self.set([*self.current.orders, fresh]).orders[-1]

    def pop(self) -> TaskOrder | None:
        """Take the next order out of the queue, which is so even if the disk fails; None when nothing waits."""
        orders = self.current.orders
        if not orders:
            return None
        self._replace(orders[1:], self._ledger.fact)
        return orders[0]

    def _replace(self, orders: Sequence[TaskOrder], change: Callable[[str, Key, Any], None]) -> None:
        ledger, revision = self._ledger, self.current.revision + 1
        with ledger.together():
            for key in set(ledger.rows("queue")) - {order.id for order in orders}:
                change("queue", key, None)
            for position, order in enumerate(orders):
                id = order.id or ledger.count("last order")
                change("queue", id, Queued(position, msgspec.structs.replace(order, id=id)))
            change("facts", "queue revision", str(revision))


class Schedule:
    """Tasks that start by themselves."""

    def __init__(self, ledger: Ledger) -> None:
        self._ledger = ledger

    def all(self) -> list[ScheduledTask]:
        """In the order of the ids; `next` is what it was when it was kept."""
        rows = self._ledger.rows("schedule")
        return [rows[key] for key in sorted(rows)]

    def stored(self) -> list[ScheduledTask]:
        """The same as it is on the disk: what others are shown."""
        rows = self._ledger.stored("schedule")
        return [rows[key] for key in sorted(rows)]

    def set(self, task: ScheduledTask) -> ScheduledTask:
        """Keep a scheduled task, a new one when its id is 0; returns it with its id.

        NotRecorded when there is no such id, or for too many. What else is wrong with it the caller has looked at.
        """
        rows = self._ledger.rows("schedule")
        if task.id and task.id not in rows:
            raise _no_scheduled(task.id)
        with self._ledger.together():
            if not task.id:
                within(len(rows) + 1, MAX_SCHEDULED, "scheduled tasks")
                task = msgspec.structs.replace(task, id=self._ledger.count("last scheduled"))
            self._ledger.order("schedule", task.id, task)
        return task

    def note(self, task: ScheduledTask) -> None:
        """Note when a kept task starts next, or that it starts no more; unlike `set` this is a fact, not an order."""
        if task.id in self._ledger.rows("schedule"):
            self._ledger.fact("schedule", task.id, task)

    def delete(self, id: int) -> ScheduledTask:
        """Forget a scheduled task; returns what it was. NotRecorded when there is none."""
        task = self._ledger.rows("schedule").get(id)
        if task is None:
            raise _no_scheduled(id)
        self._ledger.order("schedule", id, None)
        return task  # type: ignore[no-any-return]


def _queue(rows: dict[Any, Queued], facts: dict[Any, str]) -> TaskQueue:
    orders = [queued.order for queued in sorted(rows.values(), key=lambda queued: queued.position)]
    return TaskQueue(revision=int(facts.get("queue revision", 0)), orders=orders)


def _no_scheduled(id: int) -> NotRecorded:
    said = f"There is no scheduled task with the number {id}."
    return NotRecorded(Notice(Code.SCHEDULE_UNKNOWN, said, id=id))
