"""Missions by name, each change a revision, and the home position."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

import msgspec

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import KeptMission, Mission, Waypoint
from robotside.core.notice import Notice
from robotside.core.text import plain
from robotside.records.database.jobs import NotRecorded
from robotside.records.ledger import Ledger, within

__all__ = ["Missions"]

MAX_MISSIONS = 200
"""Names that are kept."""
MAX_REVISIONS = 20
"""Of each mission that are kept."""
MAX_NAME = 60
"""Characters of a mission's name."""


class Missions:
    """All missions; one of them is the stored one, that a patrol takes."""

    def __init__(self, ledger: Ledger) -> None:
        self._ledger = ledger

    @property
    def current(self) -> Mission:
        """The stored mission, an empty one when none was ever stored."""
        key = self._ledger.rows("facts").get("mission")
        return (self._ledger.rows("missions").get(int(key)) if key else None) or Mission()

    @property
    def stored(self) -> Mission:
        """The same as it is on the disk: what others are shown."""
        key = self._ledger.stored("facts").get("mission")
        return (self._ledger.stored("missions").get(int(key)) if key else None) or Mission()

    @property
    def home(self) -> Waypoint | None:
        """Where the robot returns to; None when it is not set."""
        return next(iter(self.current.home), None)

    def names(self) -> list[str]:
        """Of all missions on the disk that have one, in the order of the alphabet."""
        found = {mission.name for mission in self._ledger.stored("missions").values()}
        return sorted(filter(None, found), key=lambda name: (name.casefold(), name))

    def known(self) -> list[KeptMission]:
        """What is on the disk of each mission that has a name, in the order of the alphabet."""
        rows, newest, count = self._ledger.stored("missions"), dict[str, Mission](), Counter[str]()
        for key in sorted(rows):
            newest[rows[key].name] = rows[key]
            count[rows[key].name] += 1
        found = [newest[name] for name in self.names()]
        return [
            KeptMission(one.name, one.stamp, len(one.waypoints), one.motion, count[one.name]) for one in found
        ]

    def revisions(self, name: str) -> list[Mission]:
        """All that is kept under `name`, oldest first."""
        rows = self._ledger.rows("missions")
        return [rows[key] for key in sorted(rows) if rows[key].name == name]

    def set(self, mission: Mission, then: Callable[[], object] | None = None) -> Mission:
        """Make `mission` the stored one, a new revision under its name; `then` is called once it is on the disk.

        NotRecorded says what is wrong with it.
        """
        mission = msgspec.structs.replace(mission, name=plain(mission.name, MAX_NAME))
        ledger = self._ledger
        with ledger.together():
            rows = ledger.rows("missions")
            names = {kept.name for kept in rows.values()} | {mission.name}
            within(len(names - {""}), MAX_MISSIONS, "missions")
            key = ledger.count("last mission")
            ledger.order("missions", key, mission)
            ledger.order("facts", "mission", str(key), then)
            for old in sorted(k for k in rows if rows[k].name == mission.name)[:-MAX_REVISIONS]:
                ledger.order("missions", old, None)
        return mission

    def recall(self, name: str) -> Mission:
        """Of the missions under `name` the newest, with the home that the robot has now. NotRecorded when there is none."""
        found = self.revisions(plain(name, MAX_NAME))
        if not found or not name:
            names = ", ".join(self.names()) or "none"
            asked = plain(name, MAX_NAME)
            said = f"There is no mission {asked!r}; there are: {names}."
            raise NotRecorded(Notice(Code.MISSION_UNKNOWN, said, mission=asked))
        return msgspec.structs.replace(found[-1], home=self.current.home or found[-1].home)
