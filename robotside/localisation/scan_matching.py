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
from robotside.mapping.distances import distance_from
from robotside.mapping.occupancy_grid import Grid

__all__ = ["Field", "Localiser", "Match"]

HIT_SPREAD = 0.06
"""Of a sweep's end points about the map's surfaces [m]; the grid's own coarseness is most of it."""

MAX_FIT_DISTANCE = 0.15
"""End points within this of a surface agree with the map [m]."""

FIELD_RANGE = (-1.0, 2.0)
"""Distances of the field end at these [m]: within a wall, and in the open."""

INDEPENDENT_SHARE = 0.15
"""Part of the end points that count as independent evidence: neighbours err together."""

MAX_BEAMS = 120
"""End points used of a sweep."""

SLIP_SPREAD = 0.1
"""Odometry's error of place from sweep to sweep [m/m], one standard deviation."""

YAW_SPREAD = (0.03, 0.03)
"""Odometry's error of yaw per metre [rad/m] and per turned radian [rad/rad]: wheels that are not quite equal."""

LOSS_DISTANCE = 0.25
"""End points count less the farther they are from a surface; at this distance a quarter [m]."""

MAX_ECHO_DISTANCE, MAX_ECHOES = 0.5, 12
"""An echo counts within this of a surface [m], and so many of them are laid on the map."""

MIN_FIT = 0.5
"""Part of the end points that must lie on surfaces for the position to be trusted."""

MIN_ECHO_FIT = 0.7
"""Part of all echoes that must come from surfaces for the position to be believed again: 0.8 do at the least, where it is right, and 0.45 at the most, where it is wrong."""

UNSURE_AFTER = 8
"""Sweeps in a row that must disagree before the position is called unsure."""

DISTRUSTED_SWEEPS = 16
"""A position that is distrusted for another reason is as bad as after so many of them."""


class Field:
    """A map's distance field, readable between the cells and with slopes."""

    def __init__(self, grid: Grid) -> None:
        """It takes its time on a large map, and may be made in another thread."""
        most = math.ceil(FIELD_RANGE[1] / grid.resolution) + 2
        outside = distance_from(grid.occupied, most)
        inside = distance_from(~grid.occupied, most)
        signed = np.where(grid.occupied, 1.0 - inside, outside) * grid.resolution
        values = np.clip(signed, *FIELD_RANGE)
        slope_y, slope_x = np.gradient(values, grid.resolution)
        self._layers = np.stack([values, slope_x, slope_y], axis=-1).astype(np.float32)
        self._grid = grid

    def read(self, points: Points) -> NDArray[np.float64]:
        """Distance to the nearest surface [m] and its slope along x and y, shape (n, 3); constant off the map."""
        rows, columns = self._layers.shape[:2]
        u = ((points[:, 0] - self._grid.x) / self._grid.resolution - 0.5).clip(0, columns - 1.001)
        v = ((points[:, 1] - self._grid.y) / self._grid.resolution - 0.5).clip(0, rows - 1.001)
        j, i = u.astype(np.intp), v.astype(np.intp)
        fu, fv = (u - j)[:, None], (v - i)[:, None]
        layers = self._layers
        low = layers[i, j] * (1 - fu) + layers[i, j + 1] * fu
        high = layers[i + 1, j] * (1 - fu) + layers[i + 1, j + 1] * fu
        return np.asarray(low * (1 - fv) + high * fv)

    def closeness(self, centre: Pose2, reach: float, width: float) -> Closeness:
        """How near to a surface each cell within `reach` [m] of `centre` is, `width` [m] being near."""
        return Closeness(self._layers[:, :, 0], self._grid, centre, reach, width)


class Closeness:
    """A part of a map by how near to a surface each cell is: 1 on it, less the farther from it."""

    def __init__(
        self, distances: NDArray[np.float32], grid: Grid, centre: Pose2, reach: float, width: float
    ) -> None:
        """`distances` are the map's [m]; what lies beyond `reach` [m] of `centre` must not be asked for."""
        self._grid = grid
        self._rows, self._columns = (count - 1 for count in distances.shape)
        ends = np.array([-reach, reach])
        self._left, right = self._column(centre.x + ends).tolist()
        self._bottom, top = self._row(centre.y + ends).tolist()
        part = distances[self._bottom : top + 1, self._left : right + 1]
        self._near = np.exp(-((part / width) ** 2)).ravel()
        self._width = right - self._left + 1

    def of(self, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float32]:
        """Of points at each row of `x` [m] with each row of `y` [m], shape (rows of y, rows of x, points).

        A column goes by x alone and a row by y alone: no cell is computed for a pair of them, only looked up.
        """
        columns, rows = self._column(x) - self._left, (self._row(y) - self._bottom) * self._width
        near: NDArray[np.float32] = self._near[rows[:, None, :] + columns[None, :, :]]
        return near

    def _column(self, x: NDArray[np.float64]) -> NDArray[np.intp]:
        return ((x - self._grid.x) / self._grid.resolution).clip(0, self._columns).astype(np.intp)

    def _row(self, y: NDArray[np.float64]) -> NDArray[np.intp]:
        return ((y - self._grid.y) / self._grid.resolution).clip(0, self._rows).astype(np.intp)


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
        self._bad = 0

    @property
    def sure(self) -> bool:
        """The sweeps agree with the map."""
        return self.pose is not None and self._bad < UNSURE_AFTER

    def map_to_odom(self) -> Pose2:
        """The pose of the odometry's frame in `map`."""
        if self.pose is None or self._odom is None:
            return Pose2(0.0, 0.0, 0.0)
        return self.pose.then(self._odom.inverse())

    def place(self, pose: Pose2, *, spread: float, turn: float) -> None:
        """Begin anew at `pose`, believed to `spread` [m] and `turn` [rad] (one standard deviation)."""
        self.pose = pose
        self.covariance = np.diag([spread**2, spread**2, turn**2])
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
        off = self._off(self.pose, ends)
        nearest = off.argmin(axis=1)
        points = ends[np.arange(len(ends)), nearest][off.min(axis=1) < MAX_ECHO_DISTANCE]
        if len(ends) >= MAX_ECHOES:
            self._judge_echoes(off.min(axis=1))
        if len(points) < MAX_ECHOES:
            return
        match = self._fit(self.pose, points)
        if match.fit >= MIN_FIT:
            self.pose = match.pose
            self.covariance = np.asarray(np.linalg.inv(match.information), dtype=np.float64)

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
        spread = (SLIP_SPREAD * travelled) ** 2 + doubt + 1e-9
        turn = (YAW_SPREAD[0] * travelled + YAW_SPREAD[1] * turned) ** 2 + 1e-9
        self.covariance += np.diag([spread, spread, turn])
        return into

    def distrust(self) -> None:
        """The pose may be wrong: it is unsure until sweeps, echoes or fixes have fitted for a while."""
        self._bad = DISTRUSTED_SWEEPS

    def correct(self, points: Points) -> None:
        """Lay one sweep on the map; `points` are its end points in `base_link`."""
        if self.pose is None or len(points) < 10:
            self._bad += self.pose is not None
            return
        match = self._fit(self.pose, points[:: max(1, len(points) // MAX_BEAMS)])
        self.fit = match.fit
        if match.fit < MIN_FIT:
            self._bad += 1
        else:
            self._bad = 0
        if match.fit >= 0.5 * MIN_FIT:
            self.pose = match.pose
            self.covariance = np.asarray(np.linalg.inv(match.information), dtype=np.float64)

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

    def _fit(self, start: Pose2, points: Points) -> Match:
        prior = np.linalg.inv(self.covariance)
        pose = start
        for _ in range(6):
            gradient, information, fit = self._slope(pose, points)
            off = np.array([pose.x - start.x, pose.y - start.y, wrap(pose.yaw - start.yaw)])
            total = information + prior
            step = np.linalg.solve(total, -(gradient + prior @ off)).tolist()
            pose = Pose2(pose.x + step[0], pose.y + step[1], wrap(pose.yaw + step[2]))
            if abs(step[0]) + abs(step[1]) < 1e-3 and abs(step[2]) < 5e-4:
                break
        return Match(pose, total, fit)

    def _slope(self, pose: Pose2, points: Points) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
        """Gradient and Gauss-Newton information of the misfit at `pose`, and how many points fit."""
        placed = pose.apply(points)
        found = self._field.read(placed)
        off, gx, gy = found[:, 0], found[:, 1], found[:, 2]
        jacobian = np.column_stack([gx, gy, gy * (placed[:, 0] - pose.x) - gx * (placed[:, 1] - pose.y)])
        weight = 1.0 / (1.0 + (off / LOSS_DISTANCE) ** 2) ** 2
        weight *= INDEPENDENT_SHARE / HIT_SPREAD**2
        weighted = jacobian * weight[:, None]
        return weighted.T @ off, weighted.T @ jacobian, float((np.abs(off) < MAX_FIT_DISTANCE).mean())
