"""The interface between the navigator and a path controller, and the parts that path controllers share."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from robotside.core.pose2 import Points, Pose2
from robotside.core.worker import Work
from robotside.kinds.vehicle_kind import PursuitParameters
from robotside.navigation.planner import Planner
from robotside.navigation.pure_pursuit import ON_WHEELS, PathFollower

__all__ = ["CRUISE_SHARE", "UNSURE_SPEED", "PathController", "GroundBound", "Piece", "SinglePath", "Search"]

CRUISE_SHARE = 0.9
"""Part of the robot's greatest speed that it travels with by itself."""

UNSURE_SPEED = 0.15
"""Speed while the position is unsure [m/s]."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A part of a way without a change of direction."""

    points: Points
    """Of `base_link`, shape (n, 2) [m]."""
    ahead: bool
    """Driven forwards."""


Search = Work[list[Piece]]
"""For a way: each step is a bit of work of less than a few milliseconds; it changes nothing and returns the way's pieces."""


class PathController(Protocol):
    """Goes one way after the other; it stands without one until a `search` has ended, and again after `forget`."""

    stands: bool
    """It has to stand while a way is looked for, since that takes its time."""
    keeps_courses: bool
    """The robot knows manoeuvres that keep a heading, a speed and a height."""
    discs: tuple[float, ...]
    """So far ahead of `base_link` are the middles of the discs that cover its body [m]."""
    turning: float
    """Of the tightest bend in which it turns [m]; 0 when it turns where it is."""
    cruise: float
    """The speed that it travels with [m/s]."""
    avoids: bool
    """It keeps off what its sensors see beside the way; what does not must rest where the way is blocked."""
    look: float
    """How far along the way something new makes the navigator plan anew [m]."""
    clear: float
    """What is nearer than this to the way is in it [m]."""
    height: float
    """To go at, above the map's origin [m]; NaN for the present one. A task sets it, and what keeps no height leaves it be."""
    measured: float
    """Its height now, above the map's origin [m]; NaN while not known. The navigator sets it."""
    aloft: bool
    """It is where it moves: a robot that takes off is in the air. The navigator sets it."""

    @property
    def under_way(self) -> bool:
        """It has a way."""

    @property
    def ahead(self) -> Points:
        """What is left of the way, from beside the robot on."""

    def search(
        self, planner: Planner, pose: Pose2, goal: tuple[float, float, float], name: str, obstacles: Points
    ) -> Search:
        """For a way from `pose` to `goal` (x, y [m], yaw [rad], NaN for any) round `obstacles`.

        It may run in another thread: the way that the controller has stays until `follow`. Unreachable raises.
        """

    def follow(self, way: list[Piece]) -> None:
        """Go a way that a search has found, from its first piece on."""

    def forget(self) -> None:
        """Have no way any more; the robot rests."""

    def remaining(self, pose: Pose2) -> float:
        """Along the way to its end [m]."""

    def arrived(self, pose: Pose2) -> bool:
        """The way is gone to its end."""

    def steer(self, pose: Pose2, points: Points, *, sure: bool) -> None:
        """Go on from `pose`, with something at `points` in `base_link`; slowly where that is not `sure`."""

    def face(self, pose: Pose2, yaw: float) -> bool:
        """At the end: turn to `yaw` [rad]; True when it looks there, or never will."""

    def ready(self) -> str:
        """Get ready to go, if it has to; why it is not yet, as one sentence, empty when it is."""

    def take_off(self, height: float = math.nan) -> None:
        """Rise from the ground to `height` above the map's origin [m], NaN for the usual one; what cannot stays there."""


class GroundBound:
    """The heights of `PathController`, for robots that stay on the ground."""

    def __init__(self) -> None:
        self.height = self.measured = math.nan
        self.aloft = True

    def take_off(self, height: float = math.nan) -> None:
        """It stays on the ground."""


class SinglePath:
    """The way of `PathController`, for robots that follow a single path."""

    cruise: float

    def __init__(self, parameters: PursuitParameters = ON_WHEELS) -> None:
        super().__init__()
        self._parameters = parameters
        self._follower: PathFollower | None = None
        self._speed = 0.0

    @property
    def under_way(self) -> bool:
        """It has a way."""
        return self._follower is not None

    @property
    def ahead(self) -> Points:
        """What is left of the way, from beside the robot on."""
        return self._follower.ahead if self._follower else np.empty((0, 2))

    def search(
        self, planner: Planner, pose: Pose2, goal: tuple[float, float, float], name: str, obstacles: Points
    ) -> Search:
        """For a way to `goal`. Unreachable raises."""
        return [Piece((yield from planner.search((pose.x, pose.y), goal[:2], name, obstacles)), ahead=True)]

    def follow(self, way: list[Piece]) -> None:
        """Go the only piece of `way`."""
        self._follower = PathFollower(way[0].points, cruise=self.cruise, parameters=self._parameters)

    def forget(self) -> None:
        """Have no way any more."""
        self._follower, self._speed = None, 0.0

    def remaining(self, pose: Pose2) -> float:
        """Along the way to its end [m]."""
        return self._follower.remaining(pose) if self._follower else math.nan

    def arrived(self, pose: Pose2) -> bool:
        """The way is gone to its end."""
        return self._follower is not None and self._follower.arrived(pose)
