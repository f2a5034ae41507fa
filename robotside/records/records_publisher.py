"""The publisher of the records, once they are on the disk."""

from __future__ import annotations

from collections.abc import Callable

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import PlaceArray
from bridge.msgs.std_msgs import Time
from robotside.core.bus import Publish
from robotside.core.notice import Notice
from robotside.records import Records
from robotside.records.events import Say

__all__ = ["RecordsPublisher"]


class RecordsPublisher:
    """Publishes the records on their topics."""

    def __init__(self, records: Records, publish: Publish, say: Say, clock: Callable[[], float]) -> None:
        """`clock` is the operators' [s]. Publishes all records, and the trouble of opening them."""
        self._records, self._publish, self._say, self._clock = records, publish, say, clock
        for table, show in (("facts", self._mission), ("places", self._places)):
            records.watch(table, show)
            show()
        records.on_trouble(self._trouble)
        for problem in records.problems:
            say("database", Notice(Code.RECORDS_DAMAGED, problem), "warn")

    def _mission(self) -> None:
        mission = self._records.missions.stored
        if mission is not self._shown:
            self._shown = mission
            self._publish("/mission", mission)

    _shown: object = None

    def _places(self) -> None:
        self._publish("/places", PlaceArray(Time.at(self._clock()), self._records.places.stored()))

    def _trouble(self, sentence: str) -> None:
        if sentence:
            self._say("database", Notice(Code.RECORDS_UNWRITTEN, sentence), "alarm")
        else:
            again = Notice(Code.RECORDS_WRITTEN, "The database can be written again.")
            self._say("database", again, "ok")
