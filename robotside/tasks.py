"""Tasks: what the operator asked, from start to end, and what is said about it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import msgspec
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.msgs.pilothouse_msgs import TaskProgress, TaskStatus
from bridge.msgs.std_msgs import Time
from robotside.behaviours.course import Course
from robotside.behaviours.situation import Situation
from robotside.events import Say
from robotside.guide import Guide
from robotside.pose2 import Points, Pose2

__all__ = ["Engine", "Task"]

PROGRESS_PERIOD = 0.5
"""Between two progress messages [s]."""


@dataclass(frozen=True)
class Task:
    """Something to do."""

    name: str
    """`patrol`, `go_home` or `go_to`."""
    title: str
    """As a sentence begins with it: `Patrol`."""
    root: Behaviour
    course: Course


class Engine:
    """Runs one task at a time and tells of each change once."""

    def __init__(
        self,
        guide: Guide,
        situation: Situation,
        *,
        show: Callable[[TaskStatus], None],
        progress: Callable[[TaskProgress], None],
        say: Say,
        clock: Callable[[], float],
        cruise: float,
    ) -> None:
        """`clock` is the operators' [s], by which messages are stamped; `cruise` is the usual speed [m/s]."""
        self._guide, self._situation = guide, situation
        self._show, self._progress, self._say = show, progress, say
        self._clock, self._cruise = clock, cruise
        self._task: Task | None = None
        self._begun_at = self._odometer = 0.0
        self._next_progress = -math.inf
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
    def active(self) -> bool:
        """There is a task that has not ended."""
        return self._task is not None

    @property
    def title(self) -> str:
        """Of the task that has not ended, as a sentence begins with it; empty when there is none."""
        return self._task.title if self._task else ""

    def start(self, task: Task, now: float) -> None:
        """Begin `task`; one that has not ended yet is canceled."""
        if self._task:
            self.cancel(f"{self._task.title} ended: {task.title.lower()} was asked for instead.")
        self._task, self._begun_at = task, self._odometer
        self._next_progress = now
        self._situation.now = now
        course = task.course
        self.status = TaskStatus(
            task_id=self.status.task_id + 1,
            task=task.name,
            state="RUNNING",
            reason=f"{task.title} started.",
            motion=course.motion,
            waypoints=len(course.goals),
            lap=1,
            laps=course.laps,
            stamp=Time.at(self._clock()),
        )
        self._show(self.status)
        self._say("task", f"{task.title} started.", "info")

    def pause(self, reason: str, level: str = "info") -> None:
        """Hold the running task where it is; `reason` is one sentence."""
        if self.running:
            self._guide.rest()
            self._tell("PAUSED", reason)
            self._say("task", reason, level)

    def resume(self) -> None:
        """Go on with the paused task, from wherever the robot is now."""
        if self.paused and self._task:
            self._guide.rest()
            self._tell("RUNNING", self._heading(self._task))
            self._say("task", f"{self._task.title} resumed.", "info")

    def cancel(self, reason: str) -> None:
        """End the task before its time."""
        if self._task:
            self._end("CANCELED", reason, "warn")

    def fail(self, reason: str) -> None:
        """End the task, which cannot go on; `reason` is one sentence."""
        if self._task:
            self._end("FAILED", reason, "alarm")

    def tick(self, pose: Pose2, points: Points, odometer: float, now: float) -> None:
        """Do the next bit of the running task; `odometer` is all that was ever driven [m]."""
        self._odometer = odometer
        if not self.running or self._task is None:
            return
        task, here = self._task, self._situation
        here.now, here.pose, here.points = now, pose, points
        task.root.tick_once()
        if task.root.status is Status.RUNNING:
            self._tell("RUNNING", self._heading(task))
            self._report(task.course, now)
        elif task.root.status is Status.SUCCESS:
            self._end("SUCCEEDED", _done(task), "ok")
        else:
            self._end("FAILED", self._guide.reason or f"{task.title} failed.", "alarm")

    def _end(self, state: str, reason: str, level: str) -> None:
        task, self._task = self._task, None
        if task is None:
            return
        task.root.stop(Status.INVALID)
        self._guide.finish()
        self._count(task.course, state, reason)
        self._say("task", reason, level)

    def _tell(self, state: str, reason: str) -> None:
        if self._task:
            self._count(self._task.course, state, reason)

    def _count(self, course: Course, state: str, reason: str) -> None:
        """Show the state with the course's counts, if anything of it is new."""
        fresh = msgspec.structs.replace(
            self.status,
            state=state,
            reason=reason,
            waypoint=course.index + 1 if state in ("RUNNING", "PAUSED") else 0,
            visited=course.visited,
            lap=course.lap,
        )
        if fresh != self.status:
            self.status = msgspec.structs.replace(fresh, stamp=Time.at(self._clock()))
            self._show(self.status)

    def _heading(self, task: Task) -> str:
        if task.name == "go_home":
            return "Heading home."
        name = task.course.goal.name.rstrip(",")
        return f"Heading for {name[0].lower()}{name[1:]}."

    def _report(self, course: Course, now: float) -> None:
        if now < self._next_progress:
            return
        self._next_progress = max(self._next_progress + PROGRESS_PERIOD, now - PROGRESS_PERIOD)
        left = self._guide.remaining
        self._progress(
            TaskProgress(
                Time.at(self._clock()),
                self.status.task_id,
                course.progress(left),
                left,
                course.time_left(left, self._cruise),
                self._odometer - self._begun_at,
            )
        )


def _done(task: Task) -> str:
    if task.name == "go_home":
        return "Home."
    course = task.course
    if task.name != "patrol":
        return f"{task.title} done."
    points = "point" if course.visited == 1 else "points"
    return f"Patrol done: {course.visited} {points} visited."
