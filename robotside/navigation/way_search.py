"""The search for a way by a worker: one at a time, dropped at any moment, with the robot at rest where it has to be."""

from __future__ import annotations

import math
from collections.abc import Callable

from robotside.core.pose2 import Points, Pose2
from robotside.core.worker import Job, Worker
from robotside.navigation.path_controller import PathController, Piece
from robotside.navigation.planner import Planner

__all__ = ["WaySearch"]

MAX_REST_SPEED, REST_TIMEOUT = 0.15, 3.0
"""Slower than this it stands, and after so long it is taken to [m/s, s]."""


class WaySearch:
    """Looks for the way that was asked for last; one that is found for an earlier asking counts for nothing."""

    def __init__(self, controller: PathController, worker: Worker) -> None:
        """`controller` is the robot's, which knows how to search."""
        self._controller, self._worker = controller, worker
        self._job: Job[list[Piece]] | None = None
        self._seen: tuple[Pose2, float] | None = None
        self.asked = math.inf
        """When a way was asked for [s, robot clock]; infinite when none is looked for."""

    @property
    def active(self) -> bool:
        """A way is looked for."""
        return math.isfinite(self.asked)

    def ask(self, now: float) -> None:
        """A way is to be looked for; one that is looked for already is it, or asking often would find none."""
        if not self.active:
            self.asked = now

    def skip(self, seconds: float) -> None:
        """The clock jumped by `seconds` [s], in which nothing happened."""
        self.asked += seconds
        if self._seen is not None:
            self._seen = self._seen[0], self._seen[1] + seconds

    def drop(self) -> None:
        """Look for no way any more."""
        if self._job is not None:
            self._job.cancel()
        self.asked, self._job, self._seen = math.inf, None, None

    def poll(
        self,
        planner: Planner,
        pose: Pose2,
        goal: tuple[float, float, float],
        name: str,
        obstacles: Callable[[], Points],
        now: float,
    ) -> list[Piece] | None:
        """The way from `pose` once it is found, None until then; call it often, with `goal` (x, y [m], yaw [rad]).

        Unreachable raises. `obstacles` are those that the map does not show.
        """
        if self._job is None:
            if self._controller.stands and not self._stands(pose, now):
                return None
            self._job = self._worker.submit(self._controller.search(planner, pose, goal, name, obstacles()))
        return self._job.result() if self._job.poll() else None

    def _stands(self, pose: Pose2, now: float) -> bool:
        before, self._seen = self._seen, (pose, now)
        if before is None:
            return False
        was, then = before
        slow = pose.distance(was.x, was.y) < MAX_REST_SPEED * max(now - then, 1e-3)
        return slow or now - self.asked > REST_TIMEOUT
