"""The robot's task queue as it is edited here: shown at once, sent one change at a time, undone step by step."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import msgspec

from bridge.msgs.pilothouse_msgs import TaskOrder, TaskQueue

__all__ = ["QueueEditor"]

STEPS = 50
"""How many edits can be undone."""


@dataclass
class QueueEditor:
    """What shall wait, what the robot says that waits, and the way from one to the other.

    The robot takes a queue only when it was made from its newest revision, so that one change is under way at a time
    and the next one waits for what the robot says then.
    """

    send: Callable[[int, tuple[TaskOrder, ...]], object] = lambda _, __: None
    """Asks the robot for a queue that was made from a revision."""
    on_change: Callable[[], object] = lambda: None
    told: TaskQueue | None = None
    """None until the robot has said what waits."""
    wanted: tuple[TaskOrder, ...] | None = None
    """What the operator wants; None when that is what the robot says."""
    _sent: int | None = None
    """Revision that the change under way was made from; None when none is."""
    _under_way: tuple[TaskOrder, ...] | None = None
    """What that change asks for."""
    _accepted: bool = False
    _undo: list[tuple[TaskOrder, ...]] = field(default_factory=list)
    _gone: set[int] = field(default_factory=set)
    """Numbers of the orders that the robot took out by itself; an undo does not bring them back."""

    @property
    def orders(self) -> tuple[TaskOrder, ...]:
        """What to show: what is wanted, else what the robot says."""
        if self.wanted is not None:
            return self.wanted
        return tuple(self.told.orders) if self.told is not None else ()

    @property
    def waits(self) -> bool:
        """The robot has not confirmed what is shown."""
        return self.wanted is not None

    @property
    def can_undo(self) -> bool:
        """There is an edit to take back."""
        return bool(self._undo)

    def add(self, order: TaskOrder) -> None:
        """Put an order behind the others."""
        self._edit((*self.orders, order))

    def remove(self, index: int) -> None:
        """Take out the order at `index`, from 0; IndexError when there is none."""
        orders = list(self.orders)
        del orders[self._checked(index)]
        self._edit(tuple(orders))

    def move(self, index: int, target: int) -> None:
        """Bring the order at `index` to the place `target`, both from 0; IndexError when there is none."""
        orders = list(self.orders)
        order = orders.pop(self._checked(index))
        orders.insert(self._checked(target), order)
        self._edit(tuple(orders))

    def undo(self) -> None:
        """Take the last edit back; does nothing when there is none. What the robot has begun meanwhile stays out."""
        if self._undo:
            self._want(tuple(order for order in self._undo.pop() if order.id not in self._gone))

    def _checked(self, index: int) -> int:
        if not 0 <= index < len(self.orders):
            raise IndexError(f"There is no task {index + 1} in the queue; there are {len(self.orders)}.")
        return index

    def _edit(self, orders: tuple[TaskOrder, ...]) -> None:
        if orders != self.orders:
            self._undo.append(self.orders)
            del self._undo[:-STEPS]
            self._want(orders)

    def _want(self, orders: tuple[TaskOrder, ...]) -> None:
        self.wanted = orders
        self._push()
        self.on_change()

    def _push(self) -> None:
        if self.wanted is None or self._sent is not None or self.told is None:
            return
        known = {order.id for order in self.told.orders}
        orders = tuple(
            order if order.id in known else msgspec.structs.replace(order, id=0) for order in self.wanted
        )
        self._sent, self._under_way, self._accepted = self.told.revision, self.wanted, False
        self.send(self.told.revision, orders)

    def robot_has(self, queue: TaskQueue) -> None:
        """Take in what the robot says that waits."""
        before, self.told = self.told, queue
        if self._sent is None:
            left = {order.id for order in queue.orders}
            self._gone |= {order.id for order in (before.orders if before else ()) if order.id not in left}
            self._push()
        elif self._accepted and queue.revision != self._sent:
            self._settle()
        self.on_change()

    def answered(self, accepted: bool) -> None:
        """Tell what became of the change under way; a refusal brings back what the robot says."""
        if self._sent is None:
            return
        self._accepted = accepted
        if not accepted:
            self._sent = self.wanted = None
            self._undo.clear()
        elif self.told is not None and self.told.revision != self._sent:
            self._settle()
        self.on_change()

    def _settle(self) -> None:
        """What was under way is done: the robot's queue is the truth, or what was wanted meanwhile is sent."""
        self._sent = None
        if self.wanted is self._under_way:
            self.wanted = None
        self._push()
