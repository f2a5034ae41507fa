"""The named places of a robot's world, taken over once, so that no one has to enter them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, runtime_checkable

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Place
from robotside.core.notice import Notice
from robotside.records import NotRecorded, Records
from robotside.records.events import Say

__all__ = ["PlaceSource", "take_over"]

_DONE = "places of the world"
"""Setting that says that it was done: what people delete does not come back."""


@runtime_checkable
class PlaceSource(Protocol):
    """A robot that knows the names of places where it is."""

    @property
    def places(self) -> Sequence[Place]:
        """Their ids are of no account."""


def take_over(robot: object, records: Records, say: Say) -> None:
    """Keep the places that `robot` knows, if none is kept yet and they were never taken over before."""
    if not isinstance(robot, PlaceSource) or records.setting(_DONE) or records.places.all():
        return
    places = robot.places
    if not places:
        return
    refused = ""
    with records.together():
        for place in places:
            try:
                records.places.set(place)
            except NotRecorded as problem:
                refused = str(problem)
        records.set_setting(_DONE, str(len(places)))
    count = len(records.places.all())
    said = f"{count} {'place' if count == 1 else 'places'} of the world taken over."
    say("places", Notice(Code.PLACES_TAKEN_OVER, said, count=count))
    if refused:
        said = f"Not all places of the world could be taken over: {refused}"
        say("places", Notice(Code.PLACES_LEFT_OUT, said), "warn")
