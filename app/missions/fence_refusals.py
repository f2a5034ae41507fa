"""Refusals that the robot's fence would cause, said before it is asked. The robot's own answer is what counts."""

from __future__ import annotations

from collections.abc import Iterable

from app.link.feeds import Feeds
from app.missions.mission_editor import Draft
from bridge.msgs.pilothouse_msgs import Limits, Place, PlaceArray, RobotInfo, TaskOrder
from widgets.map.fence import Fence

__all__ = ["FenceRefusals", "summary"]

MAX_NAMED_POINTS = 4
"""As many points are called by their numbers."""
RADIUS = 0.2
"""Of a robot that does not tell its own [m]."""


class FenceRefusals:
    """The fence that one robot tells, and what it means for what is being made here."""

    def __init__(self, feeds: Feeds) -> None:
        self._feeds = feeds
        self._told: Limits | None = None
        self._fence = Fence()

    @property
    def fence(self) -> Fence:
        """The fence; none before the robot told it."""
        told: Limits | None = self._feeds.latest("/limits")
        if told is not self._told:
            self._told, self._fence = told, Fence.of(told) if told is not None else Fence()
        return self._fence

    def at(self, name: str, x: float, y: float) -> str:
        """Why the robot would not go to (x, y) in `map` [m] that is called `name`; empty when it would."""
        info: RobotInfo | None = self._feeds.latest("/robot/info")
        radius = info.radius if info is not None else 0.0
        return self.fence.fault(name, x, y, radius or RADIUS)

    def draft(self, draft: Draft) -> dict[str, str]:
        """Name, as the robot would call it, of each point and of home that it would refuse, to its sentence."""
        places = [(f"Point {number}", point) for number, point in enumerate(draft.points, 1)]
        places += [("Home", draft.home)] if draft.home is not None else []
        said = {name: self.at(name, *place) for name, place in places}
        return {name: sentence for name, sentence in said.items() if sentence}

    def place(self, place: Place) -> str:
        """Why it would not keep or go to a place; of a dock only the robot knows where it stands before it."""
        return "" if place.kind == "dock" else self.at(place.name.strip() or "The place", place.x, place.y)

    def order(self, order: TaskOrder, draft: Draft) -> str:
        """Why it would not take an order: its first place that it would refuse, or for a patrol the points of `draft`."""
        if order.task == "patrol" and not order.places:
            return summary(name for name in self.draft(draft) if name != "Home")
        told: PlaceArray | None = self._feeds.latest("/places")
        places = {place.name: place for place in told.places} if told is not None else {}
        found = (self.place(places[name]) for name in order.places if name in places)
        return next(filter(None, found), "")


def summary(names: Iterable[str]) -> str:
    """One short sentence about what `FenceRefusals.draft` found; empty for nothing."""
    names = list(names)
    points = [name.removeprefix("Point ") for name in names if name != "Home"]
    words = []
    if len(points) > MAX_NAMED_POINTS:
        words.append(f"{len(points)} points")
    elif points:
        words.append(f"point{'s' if len(points) > 1 else ''} {', '.join(points)}")
    if "Home" in names:
        words.append("home")
    return f"The fence forbids {' and '.join(words)}." if words else ""
