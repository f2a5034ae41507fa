"""Named poses."""

from __future__ import annotations

import math

import msgspec

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import PLACE_KINDS, Place
from robotside.core.notice import Notice
from robotside.core.text import plain
from robotside.records.database.jobs import NotRecorded
from robotside.records.ledger import Ledger, within

__all__ = ["KINDS", "Places"]

KINDS = PLACE_KINDS
MAX_PLACES = 1000
"""Places that are kept."""
MAX_TEXTS = {"name": 60, "floor": 20, "tag": 64, "note": 300}
"""Characters of each text."""


class Places:
    """All places; no two have the same name, capital letters or not."""

    def __init__(self, ledger: Ledger) -> None:
        self._ledger = ledger

    def all(self) -> list[Place]:
        """Every place, in the order of the ids."""
        rows = self._ledger.rows("places")
        return [rows[key] for key in sorted(rows)]

    def stored(self) -> list[Place]:
        """The same as it is on the disk: what others are shown."""
        rows = self._ledger.stored("places")
        return [rows[key] for key in sorted(rows)]

    def get(self, id: int) -> Place | None:
        """The place with that id."""
        return self._ledger.rows("places").get(id)

    def named(self, name: str) -> Place | None:
        """The place that people call so; large and small letters are the same."""
        wanted = plain(name, MAX_TEXTS["name"]).casefold()
        return next((place for place in self.all() if place.name.casefold() == wanted), None)

    def set(self, place: Place) -> Place:
        """Keep a place, a new one when its id is 0; returns it as it is kept, with its id.

        NotRecorded says what is wrong with it.
        """
        _check(place)
        texts = {field: plain(getattr(place, field), most) for field, most in MAX_TEXTS.items()}
        place = msgspec.structs.replace(place, **texts)
        if not place.name:
            raise NotRecorded(Notice(Code.PLACE_UNNAMED, "A place needs a name."))
        other = self.named(place.name)
        if other is not None and other.id != place.id:
            said = f"There is a place {other.name!r} already; choose another name."
            raise NotRecorded(Notice(Code.PLACE_NAME_TAKEN, said, place=other.name))
        if place.id and self.get(place.id) is None:
            raise _no_place(place.id)
        with self._ledger.together():
            if not place.id:
                within(len(self._ledger.rows("places")) + 1, MAX_PLACES, "places")
                place = msgspec.structs.replace(place, id=self._ledger.count("last place"))
            self._ledger.order("places", place.id, place)
        return place

    def delete(self, id: int) -> Place:
        """Forget a place; returns what it was. NotRecorded when there is none."""
        place = self.get(id)
        if place is None:
            raise _no_place(id)
        self._ledger.order("places", id, None)
        return place


def _check(place: Place) -> None:
    if place.kind not in KINDS:
        said = f"There is no kind of place {place.kind!r}; there are {', '.join(KINDS)}."
        raise NotRecorded(Notice(Code.PLACE_KIND_UNKNOWN, said, kind=place.kind[:20]))
    if not (math.isfinite(place.x) and math.isfinite(place.y)):
        said = f"A place's x and y must be numbers, not {place.x} and {place.y}."
        raise NotRecorded(Notice(Code.PLACE_INVALID, said))
    if not math.isfinite(place.height):
        said = f"A place's height must be a number, 0 for any, not {place.height}."
        raise NotRecorded(Notice(Code.PLACE_INVALID, said))


def _no_place(id: int) -> NotRecorded:
    return NotRecorded(Notice(Code.PLACE_ID_UNKNOWN, f"There is no place with the number {id}.", id=id))
