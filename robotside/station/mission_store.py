"""The stored mission of a station, and the patrol that goes by it."""

from __future__ import annotations

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Mission
from robotside.autonomy.autonomy import Autonomy
from robotside.core.notice import Notice
from robotside.records import Records
from robotside.records.events import Say

__all__ = ["MissionStore"]


class MissionStore:
    """Stores missions."""

    def __init__(self, records: Records, autonomy: Autonomy, say: Say) -> None:
        self._records, self._autonomy, self._say = records, autonomy, say

    @property
    def current(self) -> Mission:
        """The stored mission."""
        return self._records.missions.current

    def store(self, mission: Mission) -> None:
        """Store `mission`; an event says so once it is on the disk. NotRecorded when it cannot be kept."""
        count = len(mission.waypoints)
        said = f"Mission stored: {count} {'point' if count == 1 else 'points'}."

        def then() -> None:
            self._say("mission", Notice(Code.MISSION_STORED, said, count=count), "ok")
            self._autonomy.edit_patrol(mission)

        self._records.missions.set(mission, then)
