"""The position of a swimmer while it charges: in its cage, whatever its log adds up meanwhile."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from bridge.msgs.pilothouse_msgs import Place
from robotside.core.pose2 import Pose2
from robotside.kinds.registry import kind_of
from robotside.localisation.pose_estimator import PoseEstimator

__all__ = ["MAX_DRIFT", "Mooring"]

MAX_DRIFT = 0.3
"""Believed no farther from its dock than this it is left there [m]: the place of the dock may be off by as much."""


class Mooring:
    """Puts back where it charges what has no other way to know its place: under water no satellite and no laser tells it."""

    def __init__(self, kind: str, places: Callable[[], Sequence[Place]], estimator: PoseEstimator) -> None:
        """Of a robot of a `kind`; `places` are all that have names."""
        self._swims = kind_of(kind).docks == "cage"
        self._places, self._estimator = places, estimator

    def update(self, *, charging: bool) -> None:
        """Call it when the battery was heard: no cable charges what swims, so it is at a dock, the nearest to where it believes to be.

        Its direction stays what the compass says.
        """
        pose = self._estimator.pose
        if not (charging and self._swims) or pose is None:
            return
        docks = [place for place in self._places() if place.kind == "dock"]
        dock = min(docks, key=lambda place: pose.distance(place.x, place.y), default=None)
        if dock is not None and pose.distance(dock.x, dock.y) > MAX_DRIFT:
            self._estimator.place(Pose2(dock.x, dock.y, pose.yaw))
