"""The robot's response to an intruder: an event always, and on a patrol what the mission says."""

from __future__ import annotations

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Intruder
from robotside.core.notice import Notice
from robotside.records import Records
from robotside.records.events import Say
from robotside.tasks.behaviours.situation import Seen, Situation
from robotside.tasks.engine import Engine

__all__ = ["IntruderResponse"]


class IntruderResponse:
    """Responds to intruders."""

    def __init__(self, engine: Engine, situation: Situation, records: Records, say: Say) -> None:
        """The mission is that of `records`."""
        self._engine, self._situation, self._records, self._say = engine, situation, records, say

    def on_intruder(self, intruder: Intruder) -> None:
        """A new one was found."""
        x, y = intruder.position.x, intruder.position.y
        what = "something unknown" if intruder.class_id == "unknown" else f"a {intruder.class_id}"
        text = f"Intruder {intruder.id}: {what} at ({x:.1f}, {y:.1f})."
        found = Notice(Code.INTRUDER_FOUND, text, id=intruder.id, kind=intruder.class_id, x=x, y=y)
        self._say("intruder", found, "alarm", at=(x, y))
        mission = self._records.missions.current
        if self._engine.status.task != "patrol":
            return
        if mission.stop_on_intruder or mission.on_intruder == "stop":
            said = f"Paused: intruder {intruder.id} was found."
            self._engine.pause(Notice(Code.TASK_INTRUDER, said, id=intruder.id), "warn")
        elif mission.on_intruder == "circle" and self._engine.running:
            self._situation.intruders.append(Seen(intruder.id, x, y))
