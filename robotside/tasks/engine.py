"""The task engine: one task at a time, from start to end, with its progress."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import msgspec
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import TaskOrder, TaskProgress, TaskRun, TaskStatus
from bridge.msgs.std_msgs import Time
from robotside.core.notice import Notice, coded
from robotside.core.pose2 import Points, Pose2
from robotside.navigation.navigator import Navigator
from robotside.records.events import Say
from robotside.tasks.behaviours.course import Noted, Outline
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.place_trust import objection
from robotside.tasks.task_wait import TaskWait

__all__ = ["TO_CHARGE", "Engine", "Task", "charger"]

PROGRESS_PERIOD = 0.5
"""Between two progress messages [s]."""

TO_CHARGE = ("go_home", "dock", "undock")
"""Tasks that may start with a low battery: they bring it to where it can be charged, or but a step away from there."""

ON_THE_WAY = ("driving", "turning")
"""Phases in which the way that is left is known."""
NO_WAY_YET = ("waiting", "unsure", "planning", "taking off", "undocking")
"""Phases before the point in which it is not."""


@dataclass(frozen=True)
class Task:
    """Something to do."""

    name: str
    """One of `bridge.msgs.pilothouse_msgs.TASKS`."""
    title: str
    """As a sentence begins with it: `Patrol`."""
    root: Behaviour
    course: Outline
    order: TaskOrder = field(default_factory=TaskOrder)
    """The order, so that it can be given again."""
    done: Callable[[], str] = lambda: "Done."
    """The sentence at its end."""
    by: str = ""
    """Who started it; empty when the robot or its schedule did."""
    moves: bool = True
    """It takes the robot elsewhere, for which there must be charge enough."""

    @property
    def spoken(self) -> str:
        """The title as it stands within a sentence."""
        return f"{self.title[0].lower()}{self.title[1:]}"


class Engine:
    """Runs one task at a time and reports each change once."""

    def __init__(
        self,
        navigator: Navigator,
        situation: Situation,
        *,
        show: Callable[[TaskStatus], None],
        progress: Callable[[TaskProgress], None],
        say: Say,
        clock: Callable[[], float],
        cruise: float,
    ) -> None:
        """`clock` is the operators' [s], by which messages are stamped; `cruise` is the usual speed [m/s]."""
        self._navigator, self._situation = navigator, situation
        self._show, self._progress, self._say = show, progress, say
        self._clock, self._cruise = clock, cruise
        self._wait = TaskWait(navigator, situation)
        self._detour: Behaviour | None = None
        self.task: Task | None = None
        """The task that has not ended."""
        self._begun_at = self._odometer = 0.0
        self._next_progress = self._ticked = -math.inf
        self._halted = False
        """It did not run at the last tick."""
        self.status = TaskStatus()
        """As last shown."""
        show(self.status)

    @property
    def running(self) -> bool:
        """A task is under way and moves the robot."""
        return self.status.state == "RUNNING"

    @property
    def paused(self) -> bool:
        """A task waits to be resumed."""
        return self.status.state == "PAUSED"

    @property
    def interrupted(self) -> bool:
        """A task that a restart cut waits to be taken up or discarded."""
        return self.status.state == "INTERRUPTED"

    @property
    def active(self) -> bool:
        """There is a task that has not ended."""
        return self.task is not None

    @property
    def noted(self) -> Noted:
        """The progress of the task, for a restart."""
        return self.task.course.noted() if self.task else Noted()

    def recall(self, last: int, run: TaskRun | None) -> None:
        """Show how the task before a restart ended; `last` is the number it had, `run` None when nothing is known of it."""
        self.status = TaskStatus(task_id=last)
        if run is not None and run.id == last and run.ended.seconds > 0:
            self.status = _ended(run)
        self._show(self.status)

    def offer(self, status: TaskStatus) -> None:
        """Show a task that a restart cut; nothing is done about it."""
        self.status = status
        self._show(status)
        self._say("task", Notice.of(status.reason, status), "warn")

    def start(self, task: Task, now: float, *, task_id: int = 0, driven: float = 0.0) -> None:
        """Begin `task`; one that has not ended yet is canceled.

        A task that is taken up after a restart keeps its `task_id`, after `driven` [m].
        """
        if not task_id:
            said = f"{self.title} ended: {task.spoken} was requested instead."
            self.cancel(Notice(Code.TASK_REPLACED, said, task=self.status.task, instead=task.name))
        self.task, self._begun_at = task, self._odometer - driven
        self._next_progress = self._ticked = now
        self._situation.begin()
        self._situation.now = now
        self._wait.begin()
        self._navigator.keep_height(task.order.height)
        course = task.course
        code, verb = (Code.TASK_GOES_ON, "goes on") if task_id else (Code.TASK_STARTED, "started")
        begun = Notice(code, f"{task.title} {verb}.", task=task.name)
        self.status = TaskStatus(
            task_id=task_id or self.status.task_id + 1,
            task=task.name,
            state="RUNNING",
            **_reason(begun),
            **_counts(course),
            stamp=Time.at(self._clock()),
        )
        self._show(self.status)
        self._say("task", begun, "info")

    @property
    def title(self) -> str:
        """Of the task that has not ended, as a sentence begins with it; empty when there is none."""
        if self.task:
            return self.task.title
        return "The task before the restart" if self.interrupted else ""

    def pause(self, reason: Notice, level: str = "info") -> None:
        """Hold the running task where it is; `reason` is one sentence."""
        if self.running:
            self._publish_status("PAUSED", reason)
            self._say("task", reason, level)
            self._navigator.rest()  # last: the robot may fail to obey, and the task is held all the same

    def resume(self) -> None:
        """Go on with the paused task, from wherever the robot is now."""
        if self.paused and self.task:
            self._navigator.rest()
            self._situation.forget_confirmation()
            self._publish_status("RUNNING", self._situation.doing.text or f"{self.task.title} goes on.")
            resumed = Notice(Code.TASK_RESUMED, f"{self.task.title} resumed.", task=self.task.name)
            self._say("task", resumed, "info")

    def confirm(self, by: str) -> bool:
        """Answer what the task asks, or have it go on that charges; False when it does neither."""
        if not (charger(self.status) or (self.running and self.status.asks)):
            return False
        self._situation.confirmed_by = by
        return True

    def cancel(self, reason: Notice) -> None:
        """End the task before its time."""
        if self.task or self.interrupted:
            self._end("CANCELED", reason, "warn")

    def fail(self, reason: Notice) -> None:
        """End the task, which cannot go on; `reason` is one sentence."""
        if self.task:
            self._end("FAILED", reason, "alarm")

    def tick(self, pose: Pose2, points: Points, odometer: float, now: float) -> None:
        """Do the next bit of the running task; `odometer` is all that was ever driven [m]."""
        self._odometer = odometer
        here, halted = self._situation, self._halted
        self._halted = not self.running
        if not self.running or self.task is None:
            return
        task = self.task
        if self._wait.waits(task.name):
            self._halted = True  # its timers stand still
            self._publish_status("RUNNING", here.doing.text)
            self._report(task.course, now)
            return
        if halted:
            here.idle += max(0.0, now - self._ticked)
        self._ticked = now
        here.now, here.pose, here.points = now, pose, points
        root = self._detour or task.root
        root.tick_once()
        here.forget_confirmation()
        if root.status is Status.RUNNING:
            self._publish_status("RUNNING", here.doing.text)
            self._report(task.course, now)
        elif root.status is Status.SUCCESS and self._detour is not None:
            self._detour = None
            goes_on = Notice(Code.TASK_GOES_ON, f"{task.title} goes on.", task=task.name)
            self._publish_status("RUNNING", goes_on)
            self._say("task", goes_on, "info")
        elif root.status is Status.SUCCESS:
            self._succeed(task)
        else:
            failed = Notice(Code.TASK_FAILED, f"{task.title} failed.", task=task.name)
            self._end("FAILED", self._navigator.reason or failed, "alarm")

    def skip(self, seconds: float) -> None:
        """The robot's clock jumped by `seconds` [s], in which nothing happened: timers of the task stand still."""
        self._situation.follows_heard += seconds
        self._situation.battery_heard += seconds
        if not self._halted:  # else it is idle anyway
            self._situation.idle += seconds
        self._navigator.skip(seconds)

    def take_detour(self, detour: Behaviour, why: Notice) -> None:
        """Do `detour` first, then go on with the running task from where it was; the task fails with it."""
        task = self.task
        if task is None or not self.running or self._detour is not None:
            return
        task.root.stop(Status.INVALID)
        self._navigator.finish()
        task.course.take_up(task.course.noted())
        self._detour = detour
        self._publish_status("RUNNING", why)

    @property
    def detouring(self) -> bool:
        """The task that has not ended waits for a detour."""
        return self._detour is not None

    def _succeed(self, task: Task) -> None:
        """End a task that came to its end: it is done only where the robot is sure of its place."""
        if unsure := objection(task.name, self._situation):
            self._end("FAILED", unsure, "warn")
            return
        self._end("SUCCEEDED", Notice(Code.TASK_DONE, task.done(), task=task.name), "ok")

    def _end(self, state: str, reason: Notice, level: str) -> None:
        task, self.task = self.task, None
        detour, self._detour = self._detour, None
        if detour is not None:
            detour.stop(Status.INVALID)
        if task is not None:
            task.root.stop(Status.INVALID)
            self._navigator.finish()
        self._count(task.course if task else None, state, reason)
        self._say("task", reason, level)

    def _publish_status(self, state: str, reason: str) -> None:
        if self.task:
            self._count(self.task.course, state, reason)

    def _count(self, course: Outline | None, state: str, reason: str) -> None:
        """Show the state with the course's counts, if anything of it is new."""
        doing, running = self._situation.doing, state == "RUNNING"
        fresh = msgspec.structs.replace(
            self.status,
            state=state,
            **(_reason(reason) if reason else {}),
            waypoint=course.number if course and state in ("RUNNING", "PAUSED") else 0,
            phase=doing.phase if running else "",
            asks=doing.asks if running else "",
            place=doing.place,
            **(_counts(course) if course else {}),
        )
        if fresh != self.status:
            self.status = msgspec.structs.replace(fresh, stamp=Time.at(self._clock()))
            self._show(self.status)

    def _remaining(self, phase: str) -> float:
        """Way to the task's next point [m]; NaN while it has none, or a way to somewhere else."""
        if self.detouring or phase in NO_WAY_YET:
            return math.nan
        return self._navigator.remaining if phase in ON_THE_WAY else 0.0

    def _report(self, course: Outline, now: float) -> None:
        if now < self._next_progress:
            return
        self._next_progress = max(self._next_progress + PROGRESS_PERIOD, now - PROGRESS_PERIOD)
        here = self._situation
        left = self._remaining(here.doing.phase)
        # in a break, as one to charge, what is told is how long that still takes
        time_left = here.still if self.detouring else course.time_left(left, self._cruise) + here.still
        stamp, driven = Time.at(self._clock()), self._odometer - self._begun_at
        done = course.progress(left)
        self._progress(TaskProgress(stamp, self.status.task_id, done, left, time_left, driven))


def charger(status: TaskStatus) -> str:
    """Name of the charger at which a task that runs waits for charge; empty where it does not."""
    return status.place if status.state == "RUNNING" and status.phase == "charging" else ""


def _ended(run: TaskRun) -> TaskStatus:
    """How the task of `run` ended."""
    return TaskStatus(
        task_id=run.id,
        task=run.order.task,
        state=run.state,
        reason=run.reason,
        visited=run.visited,
        places=run.order.places,
        stamp=run.ended,
        code=run.code,
        actor_id=run.actor_id,
        parameters=run.parameters,
    )


def _reason(text: str) -> dict[str, Any]:
    """The fields of a status that give the reason `text`, with its code where it has one."""
    return {"reason": str(text), **coded(text)}


def _counts(course: Outline) -> dict[str, Any]:
    """The fields of a status that tell of the course."""
    return {
        "motion": course.motion,
        "waypoints": course.count,
        "visited": course.visited,
        "lap": course.lap,
        "laps": course.laps,
        "places": course.places,
    }
