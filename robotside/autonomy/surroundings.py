"""The robot's surroundings by laser or sonars: what localises it, what is in its way, and what moves."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from bridge.msgs.pilothouse_msgs import RobotInfo, SonarRing
from bridge.msgs.sensor_msgs import LaserScan
from robotside.core.pose2 import Points, Pose2
from robotside.localisation.pose_estimator import PoseEstimator
from robotside.mapping.laser_points import LaserProjection
from robotside.mapping.moving_obstacles import MovingObstacles
from robotside.mapping.sight import POSE_ERROR, Sight
from robotside.mapping.sonar_points import SonarProjection
from robotside.navigation.navigator import Navigator
from robotside.perception.intruder_watch import IntruderWatch

__all__ = ["Surroundings"]


class Surroundings:
    """Points round the robot, of its last sweep."""

    def __init__(
        self, info: RobotInfo, pose_estimator: PoseEstimator, navigator: Navigator, watch: IntruderWatch
    ) -> None:
        self._pose_estimator, self._navigator, self._watch = pose_estimator, navigator, watch
        self._laser = LaserProjection(Pose2(info.laser_x, 0.0, 0.0))
        self._sonars, self._movers = SonarProjection(), MovingObstacles()
        self._points: Points = np.empty((0, 2))
        self._swept: Pose2 | None = None
        """Where the robot was at the last sweep, in `map`; None while that was not known."""

    def on_scan(self, scan: LaserScan, now: float, *, mapping: bool) -> None:
        """The laser has swept; `mapping` keeps obstacles for the way of a task. `now` is the robot's clock [s]."""
        stamp = scan.header.stamp.seconds
        points = self._laser.points(scan)
        self._pose_estimator.on_scan(points, stamp)
        placed = self._take_in(
            points, stamp, now, lambda pose, doubt: self._laser.sight(scan, pose, doubt), mapping=mapping
        )
        if placed is not None:
            self._watch.on_scan(placed, stamp)

    def on_sonar(self, ring: SonarRing, now: float, *, mapping: bool) -> None:
        """Sonars have measured, of a robot without a laser: they keep it off obstacles and help to localise it."""
        self._pose_estimator.on_sonar(self._sonars.arcs(ring))
        points, stamp = self._sonars.points(ring), ring.header.stamp.seconds
        self._take_in(
            points,
            stamp,
            now,
            lambda pose, doubt: self._sonars.sight(ring, pose, doubt),
            mapping=mapping,
            vague=True,
        )

    def points(self, pose: Pose2, *, moved: bool) -> Points:
        """The points of the last sweep in `base_link` at `pose`; with `moved` False as they were measured."""
        if self._swept is None or not moved:
            return self._points
        return pose.inverse().apply(self._swept.apply(self._points))

    def forget(self) -> None:
        """The position was wrong, and so is where all that was swept from it seemed to be."""
        self._movers, self._swept = MovingObstacles(), None

    def _take_in(
        self,
        points: Points,
        stamp: float,
        now: float,
        sight: Callable[[Pose2, float], Sight | None],
        *,
        mapping: bool,
        vague: bool = False,
    ) -> Points | None:
        """Take `points` in `base_link` in; where they are in `map`, None while the position is not certain.

        `sight` gives what the sweep saw through from a pose, give or take some metres.
        """
        self._points = points
        self._swept = self._pose_estimator.track.at(stamp)
        if self._swept is None or not self._pose_estimator.sure:
            return None
        placed = self._swept.apply(points)
        if mapping:
            obstacles = self._navigator.obstacles
            fresh = obstacles.fresh(placed, vague=vague)
            moved = self._movers.moving(placed, stamp, fresh)  # what the map knows does not move
            # by two standard deviations, of which the sight reckons with some by itself
            spread = self._pose_estimator.spread
            doubt = max(0.0, 2.0 * spread - POSE_ERROR)
            through = sight(self._swept, doubt) if math.isfinite(spread) else None
            obstacles.update(placed[fresh & ~moved], now, vague=vague, sight=through)
            # sonars are too coarse to tell what moves: whatever is not on the map may
            moving = fresh if vague else fresh & moved
            self._points = np.concatenate([points, self._movers.nearer(points[moving])])
        return placed
