"""Maps as they arrive: the first at once, another one between two tasks."""

from __future__ import annotations

from collections.abc import Callable

from bridge.core.codes import Code
from bridge.msgs.nav_msgs import OccupancyGrid
from robotside.core.notice import Notice
from robotside.localisation.pose_estimator import PoseEstimator
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.navigator import Navigator
from robotside.records.events import Say

__all__ = ["MapIntake"]


class MapIntake:
    """Gives maps to the localisation and to the navigation."""

    def __init__(
        self, pose_estimator: PoseEstimator, navigator: Navigator, fit: Callable[[Grid], Grid], say: Say
    ) -> None:
        """`fit` makes of a map the one to plan on, with all occupied where the robot may not go."""
        self._pose_estimator, self._navigator, self._fit, self._say = pose_estimator, navigator, fit, say
        self._current: OccupancyGrid | None = None
        self._next: OccupancyGrid | None = None
        self.has_map = False
        """There is a map to localise and plan on."""

    def on_map(self, msg: OccupancyGrid) -> None:
        """A map came later, or another one: it counts when no task is under way."""
        if msg is self._current:
            return
        if not self.has_map and not Grid.fault(msg):
            self._say("localisation", Notice(Code.MAP_ARRIVED, "There is a map now."), "ok")
        self._next = msg

    def update(self) -> None:
        """Use the map that came last; to be called while no task is under way."""
        if self._next is not None:
            self.use(self._next)

    def use(self, msg: OccupancyGrid) -> None:
        """Use a map at once; an event says why not when it is of no use."""
        self._next, self._current = None, msg
        problem = Grid.fault(msg)
        if not problem:
            try:
                self._set(Grid.from_msg(msg))
            except MemoryError:
                problem = f"The map cannot be used: {len(msg.data)} cells are too many for this computer."
        if problem:
            self._say("localisation", Notice(Code.MAP_UNUSABLE, problem), "warn")

    def _set(self, grid: Grid) -> None:
        self._navigator.set_map(self._fit(grid))
        self._pose_estimator.set_map(grid)
        self.has_map = True
