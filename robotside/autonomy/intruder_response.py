"""The robot's response to an intruder: an event with its picture always, and on a patrol what the mission says."""

from __future__ import annotations

from collections.abc import Collection

from bridge.core.codes import Code
from bridge.msgs.additions import INTRUDER_CLASSES
from bridge.msgs.pilothouse_msgs import Intruder
from robotside.core.notice import Notice
from robotside.records import Records
from robotside.records.events import Events
from robotside.tasks.behaviours.situation import Seen, Situation
from robotside.tasks.engine import Engine

__all__ = ["IntruderResponse"]

ELSEWHERE = frozenset({"cone"})
"""Classes that count while no patrol is under way: who leads a visitor or is driven among people expects people."""


class IntruderResponse:
    """Responds to intruders."""

    def __init__(self, engine: Engine, situation: Situation, records: Records, events: Events) -> None:
        """The mission is that of `records`."""
        self._engine, self._situation, self._records, self._events = engine, situation, records, events

    def counted(self) -> Collection[str]:
        """The classes that count as intruders just now: on a patrol those of the mission."""
        if self._engine.status.task != "patrol":
            return ELSEWHERE
        return self._records.missions.current.intruder_classes or INTRUDER_CLASSES

    def on_intruder(self, intruder: Intruder, picture: bytes) -> None:
        """A new one was found; `picture` is a JPEG file of it, empty where there is none."""
        x, y = intruder.position.x, intruder.position.y
        what = "something unknown" if intruder.class_id == "unknown" else f"a {intruder.class_id}"
        text = f"Intruder {intruder.id}: {what} at ({x:.1f}, {y:.1f})."
        found = Notice(Code.INTRUDER_FOUND, text, id=intruder.id, kind=intruder.class_id, x=x, y=y)
        with self._records.together():
            event = self._events.say("intruder", found, "alarm", at=(x, y))
            self._records.crops.keep(event.id, picture)
        mission = self._records.missions.current
        if self._engine.status.task != "patrol":
            return
        if mission.stop_on_intruder or mission.on_intruder == "stop":
            said = f"Paused: intruder {intruder.id} was found."
            self._engine.pause(Notice(Code.TASK_INTRUDER, said, id=intruder.id), "warn")
        elif mission.on_intruder == "circle" and self._engine.running:
            self._situation.intruders.append(Seen(intruder.id, x, y))
