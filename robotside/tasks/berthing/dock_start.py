"""Where going up to a dock begins: as far before it as there is room."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from bridge.msgs.pilothouse_msgs import Place
from robotside.core.pose2 import Pose2
from robotside.navigation.navigator import Goal

__all__ = ["before", "start"]


def before(dock: Place, docked: Pose2, distance: float) -> Goal:
    """Straight before the `dock`, so far from where the robot stands `docked` [m]."""
    x, y, yaw = docked.then(Pose2(-distance, 0.0, 0.0))
    return Goal(dock.name, x, y, yaw, dock.name, dock.height)


def start(
    dock: Place, docked: Pose2, distances: Sequence[float], fault: Callable[[str, float, float], str]
) -> Goal:
    """As far from where it stands `docked` as one of the `distances` [m], the best first, where nothing stands.

    `fault` gives the reason why the robot cannot stand at a place of that name; the last distance is taken where none will do.
    """
    starts = [before(dock, docked, distance) for distance in distances]
    return next((one for one in starts if not fault(dock.name, one.x, one.y)), starts[-1])
