"""The places of a task: the named ones of an order, home and the dock, refused where the robot cannot stand."""

from __future__ import annotations

import math
from collections.abc import Callable

import msgspec

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Mission, Place, TaskOrder, Waypoint
from robotside.core.notice import Notice, Problem
from robotside.core.refusal import Refusal
from robotside.records import Records
from robotside.tasks.order_heights import OrderHeights

__all__ = ["TaskPlaces"]

MAX_NAMED = 8
"""Places that a refusal names."""


class TaskPlaces:
    """Looks up places for tasks. Every method raises Refusal with one sentence for a place that cannot be used."""

    def __init__(
        self, records: Records, fault: Callable[[str, float, float], Problem], heights: OrderHeights
    ) -> None:
        """`fault` gives the reason why the robot cannot or may not stand at a place of that name; empty when it can."""
        self._records, self._fault, self._heights = records, fault, heights

    def home(self) -> Waypoint | None:
        """Where the robot returns to: the mission's home, else the first place that is one; None when it is not set."""
        mission = self._records.missions.current
        if mission.home:
            return mission.home[0]
        place = next((place for place in self._all() if place.kind == "home"), None)
        return Waypoint(place.x, place.y, place.yaw, height=place.height or math.nan) if place else None

    def _all(self) -> list[Place]:
        """Every place, without a height for a robot that keeps none."""
        kept, keeps = self._records.places.all(), self._heights.keeps
        return kept if keeps else [msgspec.structs.replace(place, height=0.0) for place in kept]

    def check_mission(self, mission: Mission) -> None:
        """Look whether the robot can be at every point of `mission`, and at home, also at the height that they name."""
        for number, point in enumerate(mission.waypoints, 1):
            self.check(f"Point {number}", point.x, point.y, point.height)
        for home in mission.home:
            self.check("Home", home.x, home.y, home.height)

    def named(
        self, order: TaskOrder, least: int, most: int, rule: str, *, stands: bool = True
    ) -> list[Place]:
        """The places of the order's names; `stands` when the robot is to stand right there."""
        if not least <= len(order.places) <= most:
            count = len(order.places)
            raise Refusal(Notice(Code.PLACES_MISCOUNTED, f"{rule}, not {count}.", count=count))
        places = [self._place(name) for name in order.places]
        for place in places if stands else ():
            self.check(place.name, place.x, place.y, place.height)
        return places

    def docks(self) -> list[Place]:
        """The places of docks."""
        return [place for place in self._all() if place.kind == "dock"]

    def dock(self, order: TaskOrder) -> Place:
        """The dock that an order names, else the first place that is one."""
        if order.places:
            return self.named(order, 1, 1, "Docking needs one place", stands=False)[0]
        docks = self.docks()
        if not docks:
            said = "There is no place of the kind dock; make one first."
            raise Refusal(Notice(Code.DOCK_MISSING, said))
        return docks[0]

    def _place(self, name: str) -> Place:
        found, home = self._records.places.named(name), self.home()
        if found is not None:
            return next(place for place in self._all() if place.id == found.id)
        if name.strip().casefold() == "home" and home is not None:
            return Place(
                name="Home", kind="home", x=home.x, y=home.y, yaw=home.yaw, height=_given(home.height)
            )
        known = [place.name for place in self._records.places.all()]
        there = ", ".join(known[:MAX_NAMED]) + (
            f" and {len(known) - MAX_NAMED} more" if len(known) > MAX_NAMED else ""
        )
        which = f"there are {there}" if known else "no place has a name yet"
        raise Refusal(Notice(Code.PLACE_UNKNOWN, f"There is no place {name!r}; {which}.", place=name))

    def check(self, name: str, x: float, y: float, height: float = math.nan) -> None:
        """Refuse a place [m, in `map`] called `name`, at a `height` or NaN for any, where the robot cannot or may not be."""
        problem = self._fault(name, x, y)
        if problem:
            raise Refusal(problem)
        self._heights.check_point(height, name)


def _given(height: float) -> float:
    """A height as a place has it: 0 for any, which a point may also give as NaN [m]."""
    return 0.0 if math.isnan(height) else height
