"""The operator's orders, places, queue, schedule and history of one robot, as the UI thread sees them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import msgspec

from app.core.command_origin import Origin, origins
from app.link.commands import Outcome
from app.missions.queue_editor import QueueEditor
from bridge.msgs.pilothouse_msgs import (
    GetHistoryResponse,
    Mission,
    Place,
    ScheduledTask,
    TaskOrder,
)

__all__ = ["RUNS_LIMIT", "Robot", "Tasking"]

RUNS_LIMIT = 30
"""Runs asked for at a time."""


def nobody(*_: object) -> None:
    """Listens to what is told."""


class Robot(Protocol):
    """What is needed of the session."""

    def command(self, name: str, /, **fields: Any) -> None:
        """Send a one-shot command of `app.link.commands.COMMANDS`."""

    def send_mission(self) -> None:
        """Send the draft to the robot."""


class Tasking:
    """Asks the robot, keeps what can be undone, and goes on with what waited for an answer."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self.queue = QueueEditor(
            send=lambda revision, orders: robot.command("queue", revision=revision, orders=list(orders))
        )
        self.on_forgotten: Callable[[str, Callable[[], None]], object] = nobody
        """Called with what was deleted and how to take that back, once the robot has confirmed it."""
        self.on_history: Callable[[GetHistoryResponse], object] = nobody
        """Called with each part of the history that comes."""
        self._waits_for_mission: tuple[TaskOrder, Origin] | None = None
        self._deleted: dict[tuple[str, int], Callable[[], None]] = {}
        self._words: dict[tuple[str, int], str] = {}

    # what is asked

    def start(self, order: TaskOrder, *, send_first: bool = False, mission: Mission | None = None) -> None:
        """Start a task; with `send_first` the draft is sent before it, or `mission` in its place where there is one, and without
        that being accepted nothing starts."""
        self._waits_for_mission = (order, origins.current()) if send_first or mission is not None else None
        if mission is not None:
            self._robot.command("mission", mission=mission)
        elif send_first:
            self._robot.send_mission()
        else:
            self._robot.command("start", order=order)

    def start_instead(self, order: TaskOrder) -> None:
        """Start this one instead of the task that is under way, which goes on when this one is refused."""
        self._robot.command("start", order=order, instead=True)

    def keep_place(self, place: Place) -> None:
        """Store a place; one with the id 0 is new."""
        self._robot.command("place", place=place)

    def forget_place(self, place: Place) -> None:
        """Delete a place; once that is confirmed it can be undone, by storing it as a new one."""
        again = msgspec.structs.replace(place, id=0)
        self._forget("place_delete", place.id, place.name, lambda: self.keep_place(again))

    def keep_scheduled(self, task: ScheduledTask) -> None:
        """Store a scheduled task; one with the id 0 is new."""
        self._robot.command("schedule", task=task)

    def forget_scheduled(self, task: ScheduledTask, words: str) -> None:
        """Take a scheduled task, which is called `words`, off the schedule; can be undone."""
        again = msgspec.structs.replace(task, id=0)
        self._forget("schedule_delete", task.id, words, lambda: self.keep_scheduled(again))

    def ask_history(self, before: int = 0) -> None:
        """Ask for the runs before a number; 0 begins with the newest."""
        self._robot.command("history", before=before, limit=RUNS_LIMIT)

    def _forget(self, name: str, number: int, words: str, undo: Callable[[], None]) -> None:
        self._deleted[name, number], self._words[name, number] = undo, words
        self._robot.command(name, id=number)

    # what comes in

    def answered(self, outcome: Outcome) -> None:
        """Take in what became of a command."""
        if outcome.phase == "sent":
            return
        accepted = outcome.phase == "accepted"
        if outcome.name == "queue":
            self.queue.answered(accepted)
        elif outcome.name == "mission":
            self._go_on(accepted)
        elif outcome.name in ("place_delete", "schedule_delete"):
            key = outcome.name, outcome.fields["id"]
            undo, words = self._deleted.pop(key, None), self._words.pop(key, "")
            if accepted and undo is not None:
                self.on_forgotten(words, undo)
        elif outcome.name == "history" and accepted:
            self.on_history(outcome.answer)

    def deaf(self) -> None:
        """Nobody listens any more: the screens are left."""
        self.on_forgotten = self.on_history = self.queue.on_change = nobody

    def dropped(self) -> None:
        """The link is another one now: what was under way has no answer."""
        self._waits_for_mission = None
        self._deleted.clear()
        self._words.clear()
        self.queue.answered(False)

    def _go_on(self, accepted: bool) -> None:
        waited, self._waits_for_mission = self._waits_for_mission, None
        if accepted and waited is not None:
            order, origin = waited
            with origins.during(origin):  # the wish was there before the points were sent
                self._robot.command("start", order=order)
