"""Maps as they arrive: made ready by a worker, and used between two tasks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from bridge.core.codes import Code
from bridge.msgs.nav_msgs import OccupancyGrid
from robotside.core.notice import Notice
from robotside.core.worker import Job, Work, Worker, completed
from robotside.localisation.field import Field
from robotside.localisation.pose_estimator import PoseEstimator
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.navigator import Navigator
from robotside.navigation.planner import Planner
from robotside.records.events import Say

__all__ = ["MapIntake"]


@dataclass(frozen=True)
class _ReadyMap:
    """A map with all that takes its time."""

    planner: Planner
    field: Field


class MapIntake:
    """Gives maps to the localisation and to the navigation."""

    def __init__(
        self,
        pose_estimator: PoseEstimator,
        navigator: Navigator,
        fit: Callable[[Grid], Grid],
        say: Say,
        worker: Worker,
    ) -> None:
        """`fit` makes of a map the one to plan on, with all occupied where the robot may not go.

        `worker` makes maps ready: a large one takes seconds.
        """
        self._pose_estimator, self._navigator, self._fit, self._say = pose_estimator, navigator, fit, say
        self._worker = worker
        self._current: OccupancyGrid | None = None
        self._next: OccupancyGrid | None = None
        self._job: Job[_ReadyMap] | None = None
        self.has_map = False
        """There is a map to localise and plan on."""

    def on_map(self, msg: OccupancyGrid) -> None:
        """A map came later, or another one: it counts when no task is under way."""
        if msg is not self._current:
            self._next = msg

    def update(self) -> None:
        """Go on with the maps that came; to be called while no task is under way."""
        if self._job is None and self._next is not None:
            self._begin(self._next)
        if self._job is not None and self._job.poll():
            first, job = not self.has_map, self._job
            self._job = None
            self._install(job.result)
            if first and self.has_map:
                self._say("localisation", Notice(Code.MAP_ARRIVED, "There is a map now."), "ok")

    def use(self, msg: OccupancyGrid) -> None:
        """Use a map at once, before anything waits for the loop; an event says why not when it is of no use."""
        self._current = msg
        problem = Grid.fault(msg)
        if problem:
            self._refuse(problem)
        else:
            self._install(lambda: completed(self._ready(msg)))

    def _begin(self, msg: OccupancyGrid) -> None:
        self._next, self._current = None, msg
        problem = Grid.fault(msg)
        if problem:
            self._refuse(problem)
        else:
            self._job = self._worker.submit(self._ready(msg))

    def _ready(self, msg: OccupancyGrid) -> Work[_ReadyMap]:
        """Make a map ready; it touches nothing that the loop changes."""
        grid = Grid.from_msg(msg)
        yield
        field = Field(grid)
        yield
        fitted = self._fit(grid)
        yield
        return _ReadyMap(self._navigator.planner_on(fitted), field)

    def _install(self, made: Callable[[], _ReadyMap]) -> None:
        try:
            ready = made()
        except MemoryError:
            cells = len(self._current.data) if self._current else 0
            self._refuse(f"The map cannot be used: {cells} cells are too many for this computer.")
            return
        self._navigator.set_map(ready.planner)
        self._pose_estimator.set_map(ready.field)
        self.has_map = True

    def _refuse(self, problem: str) -> None:
        self._say("localisation", Notice(Code.MAP_UNUSABLE, problem), "warn")
