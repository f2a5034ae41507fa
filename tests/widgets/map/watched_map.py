"""A map that tells what a finger did to it, and messages for it."""

from __future__ import annotations

from typing import Any

import pytest

from bridge.msgs.arrays import Int8Array
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped, Quaternion
from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid
from widgets.map.grid_map import GridMap

EVENTS = ("on_add", "on_move", "on_select", "on_set_home", "on_place_robot", "on_new_place")


class Watched(GridMap):
    """A map that keeps a list of its events."""

    def __init__(self, **kwargs: Any) -> None:
        self.log: list[tuple[Any, ...]] = []
        super().__init__(**kwargs)
        self.bind(**{name: self._noter(name) for name in EVENTS})

    def _noter(self, name: str) -> Any:
        return lambda _, *args: self.log.append((name, *args))


def pose(x: float, y: float, yaw: float = 0.0) -> PoseWithCovarianceStamped:
    return PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(x, y), Quaternion.from_yaw(yaw))))


def near(*values: float) -> Any:
    """These values, nearly."""
    return pytest.approx(values, abs=1e-6)


def grid(cells: list[int], width: int) -> OccupancyGrid:
    info = MapMetaData(resolution=0.5, width=width, height=len(cells) // width, origin=Pose(Point(-2.0, 1.0)))
    return OccupancyGrid(info=info, data=Int8Array(cells))
