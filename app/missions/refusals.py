"""Refusals that the robot's fence and map would cause, said before it is asked. The robot's own answer is what counts."""

from __future__ import annotations

import math
from collections.abc import Iterable

from app.link.feeds import Feeds
from app.missions.ground import CLEARANCE, Fault, Ground
from app.missions.mission_editor import Draft
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.nav_msgs import OccupancyGrid
from bridge.msgs.pilothouse_msgs import Limits, Place, PlaceArray, RobotInfo, TaskOrder
from widgets.core.language import tr, trn
from widgets.map.fence import Fence
from widgets.map.map_heights import between_words

__all__ = ["Refusals", "summary"]

RADIUS = 0.2
"""Of a robot that does not tell its own [m]."""


class Refusals:
    """The fence and the map that one robot tells, and what they mean for what is being made here."""

    def __init__(self, feeds: Feeds) -> None:
        self._feeds = feeds
        self._told: Limits | None = None
        self._fence = Fence()
        self._judged_by: tuple[OccupancyGrid | None, float, float] = None, 0.0, 0.0
        self._ground: Ground | None = None

    @property
    def fence(self) -> Fence:
        """The fence; none before the robot told it."""
        told: Limits | None = self._feeds.latest("/limits")
        if told is not self._told:
            self._told, self._fence = told, Fence.of(told) if told is not None else Fence()
        return self._fence

    @property
    def ground(self) -> Ground | None:
        """The robot's map; None where it told none that places can be judged by."""
        grid: OccupancyGrid | None = self._feeds.latest("/map")
        info: RobotInfo | None = self._feeds.latest("/robot/info")
        told: Limits | None = self._feeds.latest("/limits")
        radius = 0.0 if info is None else _room(info)
        clearance = CLEARANCE if told is None or math.isnan(told.clearance) else told.clearance
        if self._judged_by[0] is not grid or self._judged_by[1:] != (radius, clearance):
            self._judged_by = grid, radius, clearance
            self._ground = Ground.of(grid, radius, clearance)
        return self._ground

    def fault(self, name: str, x: float, y: float) -> Fault | None:
        """Why the robot would not go to (x, y) in `map` [m] that is called `name`; None when it would."""
        info: RobotInfo | None = self._feeds.latest("/robot/info")
        radius = info.radius if info is not None else 0.0
        said = self.fence.fault(name, x, y, radius or RADIUS)
        if said:
            return Fault(said, tr("outside the fence") if said.endswith("fence.") else tr("near the fence"))
        ground = self.ground
        return ground.fault(name, x, y, self._robot) if ground is not None else None

    def _height_fault(self, name: str, height: float | None) -> Fault | None:
        """Why it would not go to a point at a `height` [m]; None for no height, and when it would."""
        said = self.fence.height_fault(name, height) if height is not None else ""
        if not said:
            return None
        return Fault(said, between_words(self.fence.floor, self.fence.ceiling))

    @property
    def _robot(self) -> tuple[float, float] | None:
        """Where the robot is in `map` [m]; None while that is not known, or old."""
        pose: PoseWithCovarianceStamped | None = self._feeds.latest("/pose")
        if pose is None or self._feeds.state("/pose") != "live":
            return None
        place = pose.pose.pose.position
        return place.x, place.y

    def at(self, name: str, x: float, y: float) -> str:
        """The sentence of `fault`; empty when there is none."""
        fault = self.fault(name, x, y)
        return fault.sentence if fault is not None else ""

    def faults(self, draft: Draft) -> dict[str, Fault]:
        """Name, as the robot would call it, of each point and of home that it would refuse, to why."""
        names = [tr("Point {number}").format(number=number) for number in range(1, len(draft.points) + 1)]
        places = [*zip(names, draft.points, strict=True)]
        places += [(tr("Home"), draft.home)] if draft.home is not None else []
        found = {name: self.fault(name, *place) for name, place in places}
        for name, height in zip(names, draft.levels, strict=True):
            found[name] = found[name] or self._height_fault(name, height)
        return {name: fault for name, fault in found.items() if fault is not None}

    def draft(self, draft: Draft) -> dict[str, str]:
        """The sentences of `faults`."""
        return {name: fault.sentence for name, fault in self.faults(draft).items()}

    def place(self, place: Place) -> str:
        """Why it would not keep or go to a place; of a dock only the robot knows where it stands before it."""
        return (
            "" if place.kind == "dock" else self.at(place.name.strip() or tr("The place"), place.x, place.y)
        )

    def order(self, order: TaskOrder, draft: Draft) -> str:
        """Why it would not take an order: its first place that it would refuse, or for a patrol the points of `draft`."""
        if order.task == "patrol" and not order.places:
            return summary(said for name, said in self.draft(draft).items() if name != tr("Home"))
        told: PlaceArray | None = self._feeds.latest("/places")
        places = {place.name: place for place in told.places} if told is not None else {}
        found = (self.place(places[name]) for name in order.places if name in places)
        return next(filter(None, found), "")


def summary(said: Iterable[str]) -> str:
    """The first sentence of `Refusals.draft`, and of how many more there is one; empty for nothing."""
    sentences = list(said)
    if len(sentences) < 2:
        return "".join(sentences)
    more = len(sentences) - 1
    return f"{sentences[0]} " + trn(
        "{count} more would be refused too.", "{count} more would be refused too.", more
    ).format(count=more)


def _room(info: RobotInfo) -> float:
    """How far from a wall the middle of the body fits [m]: half its width where it cannot turn on the spot, and so comes lengthways."""
    if info.footprint and info.min_radius > 0:
        return max(abs(corner.y) for corner in info.footprint)
    return info.radius
