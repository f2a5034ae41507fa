"""The agenda: the queue goes on when a task is done, and the schedule starts tasks when their time comes.

Nothing of it starts while anything speaks against it, and never two tasks at once.
"""

from __future__ import annotations

import datetime as dt
import math
from collections.abc import Callable, Sequence

import msgspec

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Schedule, ScheduledTask, TaskOrder, TaskQueue
from bridge.msgs.std_msgs import Time
from robotside.core.bus import Publish
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.records import Job, NotRecorded, Records
from robotside.records.events import Say
from robotside.records.plans import MAX_QUEUED
from robotside.tasks.engine import TO_CHARGE, Engine
from robotside.tasks.manual_hold import ManualHold
from robotside.tasks.schedule import ScheduledStart, fault, following, scheduled_starts
from robotside.tasks.task_factory import TaskFactory, words_for

__all__ = ["Agenda"]

PERIOD = 1.0
"""Between two looks [s], robot clock."""

CLOCK_TOLERANCE = 1.0
"""Two clocks that differ by less are one [s]."""

_BARS = ("PAUSED", "INTERRUPTED")


class Agenda:
    """Queue and schedule of one robot."""

    def __init__(
        self,
        records: Records,
        engine: Engine,
        task_factory: TaskFactory,
        *,
        publish: Publish,
        say: Say,
        clock: Callable[[], float],
        civil: Callable[[], float],
        zone: dt.tzinfo,
        barred: Callable[[bool], str],
        charge: Callable[[], TaskOrder | None] = lambda: None,
    ) -> None:
        """`clock` is the operators' [s]; `civil` is what the computer's own clock says, which may jump [s].

        `barred(drains)` gives the reason why no task may start now, one that drains the battery or not; empty when it may.
        `charge` gives the order to charge before a queue that the battery holds up; None where the robot does not by itself.
        """
        self._records, self._engine, self._task_factory = records, engine, task_factory
        self._publish, self._say, self._clock = publish, say, clock
        self._civil, self._zone, self._barred = civil, zone, barred
        self._charge = charge
        self.manual = ManualHold(records, say)
        """Whether anything may start by itself at all."""
        self._next = -math.inf
        self._settled = self._excused = 0
        """The task that does not hold the queue, however it ended; and the one that does not though it ended unsure of its place."""
        self._held_under = 0
        """The task that was under way when the queue was parked; 0 for none."""
        self.held = "the robot's computer was restarted" if records.queue.current.orders else ""
        """Why the queue does not go on, as the end of a sentence; empty when it does."""
        if self.held:
            self._tell_held()
        for table, show in (("queue", self._show_queue), ("schedule", self._show_schedule)):
            records.watch(table, show)
            show()

    def stay_manual(self, name: str, client_id: str) -> bool:
        """`name` chose MANUAL: what waits in the queue goes on waiting. False when that was so already."""
        fresh = self.manual.choose(name, client_id)
        if fresh:
            self.hold(self.manual.why)
        return fresh

    def step(self, now: float) -> None:
        """Look what is due at `now` [s, robot clock]; call it often."""
        if now < self._next:
            return
        if self._records.undecided("queue", "schedule"):
            return  # what may be taken back yet sets nothing going
        self._next = now + PERIOD
        for turn in scheduled_starts(self._records.schedule.all(), self._civil(), self._zone):
            self._records.schedule.note(turn.task)
            self._take_turn(turn, now)
        if not self._engine.active and self._records.queue.current.orders:
            self._go_on(now)

    def hold(self, why: str) -> None:
        """Hold the queue until it is released; `why` ends a sentence. Nothing happens when it is empty."""
        if self._records.queue.current.orders and not self.held:
            self.held = why
            self._held_under = self._engine.status.task_id if self._engine.active else 0
            self._tell_held()
            self._show_queue()

    def taken_up(self) -> None:
        """The task under way goes on: so does what was parked together with it, and nothing from before it."""
        if self.held and self._engine.active and self._held_under == self._engine.status.task_id:
            self.release()

    @property
    def parked(self) -> str:
        """The held queue as a sentence; empty when it is not held."""
        count = len(self._records.queue.current.orders)
        if not self.held or not count:
            return ""
        return (
            f"{_counted(count)} from before {'waits' if count == 1 else 'wait'} in the queue until resumed."
        )

    def release(self) -> bool:
        """Have the queue go on; False when it did not wait."""
        was, self.held = bool(self.held), ""
        self._settled = self._engine.status.task_id
        if not self._engine.active:
            self._excused = self._settled
        if was:
            self._show_queue()
        return was and bool(self._records.queue.current.orders)

    def set_queue(self, orders: Sequence[TaskOrder], revision: int) -> tuple[TaskQueue, str]:
        """Replace what waits; returns it, and why it does not go on by itself, as the end of a sentence, empty when it does.

        Refusal when one of them cannot be done, NotRecorded when the queue has changed meanwhile.
        """
        tidy = _checked(orders[:MAX_QUEUED], self._task_factory)
        fresh = not (orders and self._records.queue.current.orders)
        with self._records.together() as job:
            queue = self._records.queue.set([*tidy, *orders[MAX_QUEUED:]], revision)
            why = self._against(queue.orders, fresh=fresh)
            job.then.append(lambda: self._taken_over(job, fresh=fresh))
        return queue, why

    def _taken_over(self, job: Job, *, fresh: bool) -> None:
        """The queue is on the disk as it was set, a `fresh` one that waits for nothing or one that was edited."""
        if job.given_up:
            self.hold("it was stored too late")
        elif fresh:
            self.release()
        if self.manual.by:
            self.hold(self.manual.why)

    def set_scheduled(self, task: ScheduledTask) -> ScheduledTask:
        """Keep a scheduled task with the time of its next start. Refusal or NotRecorded says what is wrong with it."""
        if problem := fault(task):
            raise Refusal(problem)
        order = msgspec.structs.replace(self._task_factory.task(task.order).order, id=0)
        start = following(task, self._civil(), self._zone)
        return self._records.schedule.set(
            msgspec.structs.replace(task, order=order, next=Time.at(start) if start else Time())
        )

    def when(self, task: ScheduledTask) -> str:
        """When a scheduled task starts next, as the end of a sentence."""
        if task.next.seconds <= 0:
            return "it is switched off"
        return f"next on {self._spoken(task.next.seconds)}"

    def _go_on(self, now: float) -> None:
        if self.held or self._engine.interrupted:
            return
        why = self._against(self._records.queue.current.orders)
        if why:
            if not self._charges_first(now):
                self.hold(why)
            return
        order = self._records.queue.pop()
        if order is not None:
            self._start(order, now, Code.QUEUE_LEFT_OUT, f"{_title(order)} of the queue is left out")

    def _charges_first(self, now: float) -> bool:
        """Go and charge where only the battery holds the queue up; False where that cannot be, or has just failed."""
        tried = self._engine.status.task == "dock" and self._engine.status.state != "SUCCEEDED"
        order = None if tried or self._against([TaskOrder(task="dock")]) else self._charge()
        if order is not None:
            self._start(order, now, Code.QUEUE_LEFT_OUT, "Charging before the queue is left out")
        return order is not None

    def _against(self, orders: Sequence[TaskOrder], *, fresh: bool = False) -> str:
        """Why `orders` would not go on just now, as the end of a sentence; empty when they would, or after the task that runs.

        A `fresh` queue does not wait for what an older one waits for.
        """
        status = self._engine.status
        if self.manual.why or (self.held and not fresh):
            return self.manual.why or self.held
        if self._engine.interrupted:
            return "the task before the restart is neither resumed nor discarded"
        if self._engine.active or not orders:
            return ""
        if status.state == "CANCELED" and status.task_id != self._settled and not fresh:
            return "the task before it was canceled"
        if status.code == Code.TASK_PLACE_UNSURE and status.task_id != self._excused and not fresh:
            return "the robot is unsure of its place"
        barred = self._barred(_drains(orders[0]))
        return _tail(barred)

    def _start(self, order: TaskOrder, now: float, code: Code, otherwise: str) -> None:
        try:
            task = self._task_factory.task(order)
        except Refusal as problem:
            self._say("task", Notice(code, f"{otherwise}: {problem}", task=order.task), "warn")
            return
        self._engine.start(task, now)

    def _take_turn(self, turn: ScheduledStart, now: float) -> None:
        """Start what is due, have it wait for the task that runs, or say why it is skipped."""
        order = turn.task.order
        title = f"{_title(order)} that was due"
        if turn.missed:
            when = self._spoken(turn.missed)
            self._skip(
                order, f"{title} at {when} is skipped: the robot's computer was off or its clock was changed"
            )
        if not turn.due:
            return
        barred = self.manual.why or self._barred(_drains(order)) or self._waiting()
        running = self._engine.active or bool(self._records.queue.current.orders)
        if barred:
            self._skip(order, f"{title} now is skipped: {barred}")
        elif running and self._same(order):
            self._skip(order, f"{title} now is skipped: the one before it has not ended")
        elif running:
            self._wait(order, title)
        else:
            self._start(order, now, Code.SCHEDULE_SKIPPED, f"{title} now is skipped")

    def _wait(self, order: TaskOrder, title: str) -> None:
        with self._records.together() as job:
            try:
                self._records.queue.add(order)
            except NotRecorded as problem:
                self._skip(order, f"{title} now is skipped: {problem}")
                return
            job.after.append(lambda: self._waits(job, order, title))

    def _waits(self, job: Job, order: TaskOrder, title: str) -> None:
        if job.problem:
            self._skip(order, f"{title} now is skipped: {job.problem}")
            return
        until = f"; it waits, since {self.held}" if self.held else ""
        said = f"{title} now waits in the queue for its turn{until}."
        self._say("task", Notice(Code.QUEUE_ADDED, said, task=order.task), "info")

    def _waiting(self) -> str:
        """The reason why the start of a queued task is unknown; empty when it is known."""
        state = self._engine.status.state
        return f"a task is {state.lower()}" if state in _BARS else ""

    def _same(self, order: TaskOrder) -> bool:
        task = self._engine.task
        waiting = list(self._records.queue.current.orders)
        known = [*waiting, task.order] if task else waiting
        return any(_alike(order, other) for other in known)

    def _skip(self, order: TaskOrder, said: str) -> None:
        self._say("task", Notice(Code.SCHEDULE_SKIPPED, f"{said.rstrip('.')}.", task=order.task), "warn")

    def _spoken(self, instant: float) -> str:
        return dt.datetime.fromtimestamp(instant, self._zone).strftime("%Y-%m-%d at %H:%M")

    def _tell_held(self) -> None:
        self._say("task", _held_notice(len(self._records.queue.current.orders), self.held), "warn")

    def _show_queue(self) -> None:
        stored, stamp = self._records.queue.stored, Time.at(self._clock())
        held = self.held if stored.orders else ""
        self._publish("/task/queue", msgspec.structs.replace(stored, stamp=stamp, held=held))

    def _show_schedule(self) -> None:
        now = self._clock()
        ahead = (
            now - self._civil()
        )  # the computer's clock may have been set since the start, the operators' goes on evenly
        tasks = [_with_times(task, ahead) for task in self._records.schedule.stored()]
        self._publish("/schedule", Schedule(Time.at(now), tasks))


def _checked(orders: Sequence[TaskOrder], task_factory: TaskFactory) -> list[TaskOrder]:
    """The orders of a queue as they are kept; Refusal names the first one that cannot be done."""
    tidy = []
    for number, order in enumerate(orders, 1):
        try:
            tidy.append(task_factory.task(order).order)
        except Refusal as problem:
            raise Refusal(problem.notice.reworded(f"Task {number} of the queue: {problem}")) from problem
    return tidy


def _held_notice(count: int, why: str) -> Notice:
    """That `count` tasks wait in the queue, and `why`, as the end of a sentence."""
    these, still = ("this", "waits") if count == 1 else ("these", "wait")
    said = f"{_counted(count)} {still} in the queue, since {why}, until you choose Go on with {these}."
    return Notice(Code.QUEUE_HELD, said, count=count)


def _with_times(task: ScheduledTask, ahead: float) -> ScheduledTask:
    """With its next start by a clock that is `ahead` [s] of the computer's."""
    if task.next.seconds <= 0 or abs(ahead) < CLOCK_TOLERANCE:
        return task
    return msgspec.structs.replace(task, next=Time.at(task.next.seconds + ahead))


def _tail(why: str) -> str:
    """A reason as the end of a sentence, whether it is one itself or not."""
    first = why.partition(" ")[0]
    return (why if first.isupper() and len(first) > 1 else f"{why[:1].lower()}{why[1:]}").rstrip(".")


def _drains(order: TaskOrder) -> bool:
    """It takes the robot elsewhere than to where it can be charged."""
    return order.task != "hold" and order.task not in TO_CHARGE


def _counted(count: int) -> str:
    return "1 task" if count == 1 else f"{count} tasks"


def _title(order: TaskOrder) -> str:
    words = words_for(order.task)
    return f"{words[0].upper()}{words[1:]}"


def _alike(a: TaskOrder, b: TaskOrder) -> bool:
    """The same but for the number; NaN is like NaN."""
    return repr(msgspec.structs.replace(a, id=0)) == repr(msgspec.structs.replace(b, id=0))
