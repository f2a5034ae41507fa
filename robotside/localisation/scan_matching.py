"""Scan matching: wheel odometry, corrected by laying each laser sweep on the map.

The sweep's end points should lie on surfaces of the map. The pose that makes it so is found by Gauss-Newton on the
map's distance field with a loss that ignores what the map does not know, and is held by what odometry predicts,
each with its own uncertainty (an iterated Kalman update).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bridge.core.units import wrap
from robotside.core.pose2 import Points, Pose2
from robotside.localisation.field import Field
from robotside.localisation.shared_errors import freshness, fused, pooled

__all__ = ["Localiser", "Match"]

HIT_SPREAD, ECHO_SPREAD = 0.015, 0.06
"""Of a laser's end points and of a sonar's echoes about a surface as the map has it [m]."""

FACE_SHARE = 1.0 / math.sqrt(12.0)
"""Of a cell: by how much the surfaces that face one way are drawn off together, one standard deviation; any part of a cell is as likely."""

MAX_FIT_DISTANCE = 0.15
"""End points within this of a surface agree with the map [m]."""

INDEPENDENT_SHARE = 0.2
"""Part of the end points that count as independent evidence: neighbours err together."""

SKIN_SPREAD, SKIN_DRIFT = 0.04, 0.01
"""How far before the middle of the outermost full cells the surfaces may lie [m]: half a cell, as a map is made; and by how much that differs over a metre [m]."""

STANDING_SPREAD, STANDING_TURN = 0.001, 0.0005
"""What a pose may have changed unseen from sweep to sweep [m, rad]."""

DRIFT_SPREAD = 0.06
"""By how much wheels of a size that is not quite known are off after a metre [m], of which each step is a part in the same direction."""

TURN_DISTANCE = 0.2
"""What a turn of a radian changes of what is seen, as a way [m]."""

MAX_BEAMS = 120
"""End points used of a sweep."""

SLIP_SPREAD = 0.015
"""Odometry's error of place after a metre [m]; it grows with the root of the way."""

YAW_SPREAD = (0.01, 0.02)
"""Odometry's error of yaw after a metre and after a turned radian [rad]: wheels that are not quite equal, and a wheel base that is not quite known. They
err the same way for metres, which is more than steps that err each for itself would add up to."""

LOSS_DISTANCE = 0.25
"""End points count less the farther they are from a surface; at this distance a quarter [m]."""

MAX_ECHO_DISTANCE, MAX_ECHOES = 0.5, 12
"""An echo counts within this of a surface [m], and so many of them are laid on the map."""

ECHO_ROUNDS = 3
"""So often it is asked anew where echoes came from, each time from the place that they told before."""

MIN_FIT = 0.5
"""Part of the end points that must lie on surfaces for the position to be trusted."""

MIN_ECHO_FIT = 0.7
"""Part of all echoes that must come from surfaces for the position to be believed again: 0.8 do at the least, where it is right, and 0.45 at the most, where it is wrong."""

UNSURE_AFTER = 8
"""Sweeps in a row that must disagree before the position is called unsure."""

DISTRUSTED_SWEEPS = 16
"""A position that is distrusted for another reason is as bad as after so many of them."""


@dataclass(frozen=True, slots=True)
class Match:
    """A pose found by laying a sweep on the map."""

    pose: Pose2
    information: NDArray[np.float64]
    """Inverse covariance of x, y [m] and yaw [rad], 3 x 3."""
    fit: float
    """Part of the end points that lie on surfaces of the map, 0 to 1."""


class Localiser:
    """Where the robot is in `map`."""

    def __init__(self, field: Field) -> None:
        """`field` is the map's."""
        self._field = field
        self._odom: Pose2 | None = None
        self.pose: Pose2 | None = None
        """In `map`; None until the first guess."""
        self.covariance: NDArray[np.float64] = np.zeros((3, 3))
        """Of x, y [m] and yaw [rad]."""
        self.fit = math.nan
        """Of the last sweep, 0 to 1; NaN before the first."""
        self._skin, self._skin_variance = 0.0, SKIN_SPREAD**2
        self._travelled = math.inf
        self._bad = 0

    @property
    def sure(self) -> bool:
        """The sweeps agree with the map."""
        return self.pose is not None and self._bad < UNSURE_AFTER

    @property
    def field(self) -> Field:
        """The map's."""
        return self._field

    def map_to_odom(self) -> Pose2:
        """The pose of the odometry's frame in `map`."""
        if self.pose is None or self._odom is None:
            return Pose2(0.0, 0.0, 0.0)
        return self.pose.then(self._odom.inverse())

    def place(self, pose: Pose2, *, spread: float, turn: float) -> None:
        """Begin anew at `pose`, believed to `spread` [m] and `turn` [rad] (one standard deviation)."""
        self.pose = pose
        self.covariance = np.diag([spread**2, spread**2, turn**2])
        self._travelled = math.inf
        self._bad = 0

    @property
    def spread(self) -> float:
        """Of the place in its worst direction, one standard deviation [m]."""
        return math.sqrt(_worst(self.covariance))

    def take_over(self, other: Localiser) -> None:
        """Be where `other` is, as sure as that one is."""
        self.pose, self.covariance, self.fit = other.pose, other.covariance, other.fit
        self._travelled = math.inf
        self._bad = 0

    def lift(self) -> None:
        """The robot is carried elsewhere: its next odometry does not follow from the last."""
        self._odom = None

    def correct_place(self, x: float, y: float, spread: float) -> None:
        """Something else puts it at (x, y) [m], to `spread` [m] (one standard deviation) along each axis."""
        if self.pose is None:
            return
        self._bad = max(0, self._bad - 1)
        gain = self.covariance[:, :2] @ np.linalg.inv(self.covariance[:2, :2] + np.eye(2) * spread**2)
        dx, dy, turn = (gain @ np.array([x - self.pose.x, y - self.pose.y])).tolist()
        self.pose = Pose2(self.pose.x + dx, self.pose.y + dy, wrap(self.pose.yaw + turn))
        self.covariance = self.covariance - gain @ self.covariance[:2, :]

    def correct_yaw(self, yaw: float, spread: float) -> None:
        """Something else lets it look to `yaw` [rad], to `spread` [rad] (one standard deviation)."""
        if self.pose is None:
            return
        gain = self.covariance[:, 2] / (self.covariance[2, 2] + spread**2)
        dx, dy, turn = (gain * wrap(yaw - self.pose.yaw)).tolist()
        self.pose = Pose2(self.pose.x + dx, self.pose.y + dy, wrap(self.pose.yaw + turn))
        self.covariance = self.covariance - np.outer(gain, self.covariance[2, :])

    def correct_by_echoes(self, ends: NDArray[np.float64]) -> None:
        """Lay echoes on the map, each by the place on its arc that is nearest to a surface; `ends` are arcs in `base_link`.

        Shape (echoes, places, 2) [m]. Too few of them, and echoes of what the map does not know, change nothing.
        """
        if self.pose is None or not len(ends):
            return
        if len(ends) >= MAX_ECHOES:
            self._judge_echoes(self._off(self.pose, ends).min(axis=1))
        start = at = self.pose
        for _ in range(ECHO_ROUNDS):
            points, held = self._sources(at, ends)
            if len(points) < MAX_ECHOES:
                return
            match, told, skin = self._fit_sweep(start, points, ECHO_SPREAD, held)
            at = match.pose
        if match.fit >= MIN_FIT:
            self._fuse(start, match, told, skin)

    def _sources(self, pose: Pose2, ends: NDArray[np.float64]) -> tuple[Points, NDArray[np.float64]]:
        """Where echoes came from, were the robot at `pose`, in `base_link`, and 1 for each of them that turns with the robot.

        One from within its arc comes from there too when the robot has turned a little: it tells nothing of the yaw, and has 0.
        """
        off = self._off(pose, ends)
        nearest = off.argmin(axis=1)
        near = off.min(axis=1) < MAX_ECHO_DISTANCE
        held = (nearest == 0) | (nearest == ends.shape[1] - 1)
        return ends[np.arange(len(ends)), nearest][near], held[near].astype(np.float64)

    def _off(self, pose: Pose2, ends: NDArray[np.float64]) -> NDArray[np.float64]:
        """How far each place on each arc is from a surface of the map [m]."""
        return np.abs(self._field.read(pose.apply(ends.reshape(-1, 2)))[:, 0]).reshape(ends.shape[:2])

    def _judge_echoes(self, off: NDArray[np.float64]) -> None:
        """Be the surer of it the more echoes are of what the map knows; each is so far `off` it [m]."""
        known = float((off < MAX_FIT_DISTANCE).mean())
        if known < MIN_FIT:
            self._bad = min(self._bad + 1, DISTRUSTED_SWEEPS)
        elif known >= MIN_ECHO_FIT:
            self._bad = self._bad - 1 if self._bad >= UNSURE_AFTER else 0

    def predict(self, odom: Pose2, against: float = math.nan) -> float:
        """Move on by what the wheels say: `odom` is the pose in the odometry's frame.

        Something that stands is in touch at the bearing `against` [rad], NaN for nothing: what the wheels say of a way into it
        is not believed, only doubted. Returns that way [m].
        """
        before, self._odom = self._odom, odom
        if self.pose is None or before is None:
            return 0.0
        step = odom.since(before)
        into = 0.0
        if not math.isnan(against):
            c, s = math.cos(against), math.sin(against)
            into = max(0.0, c * step.x + s * step.y)
            step = Pose2(step.x - into * c, step.y - into * s, step.yaw)
        self.pose = self.pose.then(step)
        travelled, turned = math.hypot(step.x, step.y), abs(step.yaw)
        doubt = 2.0 * into * math.sqrt(float(self.covariance[:2, :2].trace())) + into**2
        spread = SLIP_SPREAD**2 * travelled + doubt + 1e-9
        turn = YAW_SPREAD[0] ** 2 * travelled + YAW_SPREAD[1] ** 2 * turned + 1e-9
        self.covariance += np.diag([spread, spread, turn])
        self._travelled += travelled + TURN_DISTANCE * turned
        self._skin_variance = min(SKIN_SPREAD**2, self._skin_variance + SKIN_DRIFT**2 * travelled)
        return into

    def distrust(self) -> None:
        """The pose may be wrong: it is unsure until sweeps, echoes or fixes have fitted for a while."""
        self._bad = DISTRUSTED_SWEEPS

    def correct(self, points: Points) -> None:
        """Lay one sweep on the map; `points` are its end points in `base_link`."""
        if self.pose is None or len(points) < 10:
            self._bad += self.pose is not None
            return
        start = self.pose
        match, sweep, skin = self._fit_sweep(start, points[:: max(1, len(points) // MAX_BEAMS)], HIT_SPREAD)
        self.fit = match.fit
        if match.fit < MIN_FIT:
            self._bad += 1
        else:
            self._bad = 0
        if match.fit >= 0.5 * MIN_FIT:
            self._fuse(start, match, sweep, skin)

    def _fuse(self, start: Pose2, match: Match, sweep: NDArray[np.float64], skin: float) -> None:
        """Believe of a match what is new; `sweep` is what the sweep alone tells of x, y, yaw and the walls' skin."""
        travelled, self._travelled = self._travelled, 0.0
        fresh = freshness(travelled)
        drift = STANDING_SPREAD**2 + DRIFT_SPREAD**2 * min(1.0, travelled)
        self.covariance += np.diag([drift, drift, STANDING_TURN**2])
        pose, both, walls = sweep[:3, :3], sweep[:3, 3], float(sweep[3, 3]) + 1.0 / self._skin_variance
        alone = pose - np.outer(both, both) / walls
        self.covariance, part = fused(self.covariance, alone, fresh)
        off = np.array([match.pose.x - start.x, match.pose.y - start.y, wrap(match.pose.yaw - start.yaw)])
        step = (part @ off).tolist()
        self.pose = Pose2(start.x + step[0], start.y + step[1], wrap(start.yaw + step[2]))
        known = walls - float(both @ np.linalg.solve(match.information, both))
        variance, factor = fused(
            np.array([[self._skin_variance]]),
            np.array([[max(0.0, known - 1.0 / self._skin_variance)]]),
            fresh,
        )
        self._skin += float(factor[0, 0]) * (skin - self._skin)
        self._skin_variance = float(variance[0, 0])

    def search(self, points: Points, guess: Pose2, *, reach: float, turn: float) -> None:
        """Find the pose within `reach` [m] and `turn` [rad] of `guess` that fits best, and begin there."""
        sample = points[:: max(1, len(points) // 60)]
        best = guess
        for step, window, angle in ((0.25, reach, turn), (0.08, 0.3, 0.1)):
            best = self._best_near(sample, best, step, window, angle)
        self.place(best, spread=0.1, turn=0.05)

    def _best_near(self, points: Points, guess: Pose2, step: float, reach: float, turn: float) -> Pose2:
        shifts = np.arange(-reach, reach + step / 2, step)
        dx, dy = (axis.ravel() for axis in np.meshgrid(shifts, shifts))
        far = float(np.hypot(points[:, 0], points[:, 1]).max())
        near = self._field.closeness(guess, far + 1.1 * reach + step, 2 * step)
        best, best_score = guess, -math.inf
        for yaw in guess.yaw + np.linspace(-turn, turn, 2 * math.ceil(turn / 0.05) + 1):
            turned = Pose2(guess.x, guess.y, float(yaw)).apply(points)
            placed = near.of(turned[:, 0] + shifts[:, None], turned[:, 1] + shifts[:, None])
            scores = placed.mean(axis=2).ravel()
            scores -= 1e-3 * (dx**2 + dy**2 + (float(yaw) - guess.yaw) ** 2)
            top = int(scores.argmax())
            if scores[top] > best_score:
                best_score = float(scores[top])
                best = Pose2(guess.x + float(dx[top]), guess.y + float(dy[top]), wrap(float(yaw)))
        return best

    def _fit_sweep(
        self, start: Pose2, points: Points, spread: float, held: NDArray[np.float64] | float = 1.0
    ) -> tuple[Match, NDArray[np.float64], float]:
        """The pose that fits best, what the sweep alone tells (4 x 4, of x, y, yaw and skin), and the walls' skin there [m].

        `spread` is that of its points about a surface [m]; `held` is 1 for those that turn with the robot, 0 for others.
        """
        prior = np.zeros((4, 4))
        prior[:3, :3] = np.linalg.inv(self.covariance)
        prior[3, 3] = 1.0 / self._skin_variance
        pose, skin = start, self._skin
        for _ in range(6):
            gradient, information, fit = self._slope(pose, points, skin, spread, held)
            off = np.array(
                [pose.x - start.x, pose.y - start.y, wrap(pose.yaw - start.yaw), skin - self._skin]
            )
            total = information + prior
            step = np.linalg.solve(total, -(gradient + prior @ off)).tolist()
            pose, skin = Pose2(pose.x + step[0], pose.y + step[1], wrap(pose.yaw + step[2])), skin + step[3]
            if abs(step[0]) + abs(step[1]) < 1e-3 and abs(step[2]) < 5e-4:
                break
        return Match(pose, total[:3, :3], fit), information, skin

    def _slope(
        self, pose: Pose2, points: Points, skin: float, spread: float, held: NDArray[np.float64] | float
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
        """Gradient and Gauss-Newton information of the misfit at `pose` in x, y, yaw and skin, and how many points fit."""
        placed = pose.apply(points)
        found = self._field.read(placed)
        off, gx, gy = found[:, 0] - skin, found[:, 1], found[:, 2]
        turn = held * (gy * (placed[:, 0] - pose.x) - gx * (placed[:, 1] - pose.y))
        jacobian = np.column_stack([gx, gy, turn, np.full(len(off), -1.0)])
        weight = 1.0 / (1.0 + (off / LOSS_DISTANCE) ** 2) ** 2
        weight *= INDEPENDENT_SHARE / spread**2
        drawn = FACE_SHARE * self._field.grid.resolution
        gradient, information = pooled(jacobian, off, weight, np.arctan2(gy, gx), drawn)
        return gradient, information, float((np.abs(off) < MAX_FIT_DISTANCE).mean())


def _worst(covariance: NDArray[np.float64]) -> float:
    """Variance of the place in its worst direction [m2]: the larger eigenvalue of the block of x and y.

    Written out, at a sixth of the cost of LAPACK's answer: it is asked for with every step.
    """
    along, across, both = covariance.item(0, 0), covariance.item(1, 1), covariance.item(1, 0)
    return (along + across) / 2.0 + math.hypot((along - across) / 2.0, both)
