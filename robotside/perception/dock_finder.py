"""The dock in one laser sweep: two reflecting strips at its face, 0.30 m apart, or one where something hides the other.

A laser without intensities shows no strips; then a flat face of the right width near where the dock should be has to do.
The frame of a dock lies in the middle between its strips and looks as a robot does that is docked: into the dock.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bridge.core.units import wrap
from bridge.msgs.sensor_msgs import LaserScan
from robotside.core.pose2 import ORIGIN, Points, Pose2

__all__ = ["MIN_REFLECTION", "STRIP_SPACING", "DockFinder", "DockSighting", "Expected"]

STRIP_SPACING, STRIP_WIDTH = 0.30, 0.05
"""Between the middles of the two strips, and the breadth of each [m]."""

MIN_REFLECTION = 150.0
"""Intensity of a beam that ended on a strip; of all else it is below 100."""

SPACING_TOLERANCE = 0.03
"""Of the strips, beside what the distance between two beams makes uncertain [m]."""

FACE_WIDTHS = (0.34, 0.70)
"""Least and greatest breadth of a face that may be a dock's where only the shape is seen [m]."""

FLATNESS = 0.035
"""A point of the face lies so near its line [m]."""

MAX_GRAZE = 1.15
"""Most angle between the view and the dock's direction [rad]: seen more from the side its strips tell nothing."""

RANGE_NOISE = 0.01
"""Standard deviation of a usual laser [m]."""

JUMP = 0.08
"""Two neighbouring beams whose ends are farther apart than this, beside their spread, end on two things [m]."""

HIDDEN_BY = 0.05
"""What hides a strip is nearer than it by so much [m]."""


class Expected(NamedTuple):
    """Where the dock should be."""

    pose: Pose2
    """Of the dock in `base_link`."""
    reach: float
    """It is no farther from there than this [m]."""
    turn: float
    """Nor turned by more than this [rad]."""

    def misses(self, pose: Pose2) -> float:
        """How badly `pose` fits: 0 not at all, above 1 it is another thing."""
        off = pose.distance(self.pose.x, self.pose.y) / self.reach
        return max(off, abs(wrap(pose.yaw - self.pose.yaw)) / self.turn)


@dataclass(frozen=True, slots=True)
class DockSighting:
    """One look at the dock."""

    pose: Pose2
    """Of the dock in `base_link`."""
    spread: float
    """Standard deviation of its place along each axis [m]."""
    turn: float
    """Standard deviation of its direction [rad]."""
    by: Literal["reflectors", "one reflector", "shape", "tag"]


class _Sweep(NamedTuple):
    """What the beams of one sweep met, in `base_link`."""

    points: Points
    """Where each ended; NaN for a beam that met nothing."""
    ranges: NDArray[np.float64]
    """[m] from the laser."""
    bright: NDArray[np.bool_]
    step: float
    """From one beam to the next [rad], negative for clockwise."""
    laser: tuple[float, float]
    """Where they come from, in `base_link` [m]."""
    sees: bool
    """It has intensities."""


class _Strip(NamedTuple):
    """Neighbouring beams on one reflecting strip."""

    x: float
    y: float
    middle: int
    """Number of the beam in its middle."""
    range: float


class DockFinder:
    """Looks for a dock in sweeps of a laser that is mounted at `mount` in `base_link`."""

    def __init__(self, mount: Pose2 = ORIGIN) -> None:
        self._mount = mount

    def find(self, scan: LaserScan, expected: Expected) -> DockSighting | None:
        """The dock nearest to where it is expected; None where nothing fits, or two fit and nothing tells which it is."""
        sweep = self._sweep(scan)
        if not sweep.sees:
            return _only(list(_by_shape(sweep, expected)))
        strips = list(_strips(sweep))
        pairs = [seen for seen in _pairs(strips, sweep) if expected.misses(seen.pose) <= 1.0]
        if pairs:
            return min(pairs, key=lambda seen: expected.misses(seen.pose))
        return _only([seen for strip in strips for seen in _halves(strip, sweep, expected)])

    def _sweep(self, scan: LaserScan) -> _Sweep:
        ranges = np.frombuffer(scan.ranges, dtype=np.float32).astype(np.float64)
        with np.errstate(invalid="ignore"):
            ranges[~((ranges > scan.range_min) & (ranges < scan.range_max))] = np.nan
        angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
        points = self._mount.apply(np.column_stack([np.cos(angles) * ranges, np.sin(angles) * ranges]))
        shine = np.frombuffer(scan.intensities, dtype=np.float32)
        sees = len(shine) == len(ranges) and bool(np.any(shine > 0))
        bright = (shine >= MIN_REFLECTION) & np.isfinite(ranges) if sees else np.zeros(len(ranges), bool)
        step, laser = scan.angle_increment, (self._mount.x, self._mount.y)
        return _Sweep(points, ranges, bright, step, laser, sees)


def _only(found: list[DockSighting]) -> DockSighting | None:
    """The one that was found; None for none and for several that differ."""
    if not found:
        return None
    first = found[0]
    same = all(first.pose.distance(other.pose.x, other.pose.y) < STRIP_SPACING / 3 for other in found)
    return first if same else None


def _strips(sweep: _Sweep) -> Iterator[_Strip]:
    """Runs of bright beams no broader than a strip may look: a vest that reflects is broader."""
    numbers = np.flatnonzero(sweep.bright)
    for run in np.split(numbers, np.flatnonzero(np.diff(numbers) > 1) + 1):
        if not len(run):
            continue
        ends, away = sweep.points[run], float(np.mean(sweep.ranges[run]))
        broad = math.dist(ends[0], ends[-1])
        if broad <= STRIP_WIDTH + away * abs(sweep.step) + 4 * RANGE_NOISE:
            x, y = ends.mean(axis=0)
            yield _Strip(float(x), float(y), int(run[len(run) // 2]), away)


def _pairs(strips: list[_Strip], sweep: _Sweep) -> Iterator[DockSighting]:
    """Two strips as far apart as a dock's, with a face between them that no beam passes through."""
    for number, right in enumerate(strips):
        for left in strips[number + 1 :]:
            blur = (right.range + left.range) / 2 * abs(sweep.step) / math.sqrt(12)
            apart = math.hypot(left.x - right.x, left.y - right.y)
            if abs(apart - STRIP_SPACING) > SPACING_TOLERANCE + 2 * math.hypot(blur, RANGE_NOISE):
                continue
            middle = ((left.x + right.x) / 2, (left.y + right.y) / 2)
            along = ((left.x - right.x) / apart, (left.y - right.y) / apart)
            face = _on_face(sweep.points, middle, along, STRIP_SPACING / 2 + STRIP_WIDTH)
            pose, turn = _frame(middle, along, sweep.points[face])
            if _grazes(pose) or _open(sweep, pose, right.middle, left.middle):
                continue
            spread = math.hypot(blur, RANGE_NOISE) / math.sqrt(2)
            yield DockSighting(pose, spread, turn, "reflectors")


def _halves(strip: _Strip, sweep: _Sweep, expected: Expected) -> Iterator[DockSighting]:
    """One strip whose fellow, to its left or its right, something nearer hides."""
    yaw = expected.pose.yaw
    along = (-math.sin(yaw), math.cos(yaw))
    near = _on_face(sweep.points, (strip.x, strip.y), along, STRIP_SPACING, slack=0.1)
    frame, turn = _frame((strip.x, strip.y), along, sweep.points[near])
    along = (-math.sin(frame.yaw), math.cos(frame.yaw))
    for side in (1.0, -1.0):
        fellow = (
            strip.x + side * STRIP_SPACING * along[0],
            strip.y + side * STRIP_SPACING * along[1],
        )
        if not _hidden(sweep, strip, fellow):
            continue
        half = side * STRIP_SPACING / 2
        pose = Pose2(strip.x + half * along[0], strip.y + half * along[1], frame.yaw)
        if expected.misses(pose) <= 1.0 and not _grazes(pose):
            spread = math.hypot(RANGE_NOISE + strip.range * abs(sweep.step) / math.sqrt(12), 0.15 * turn)
            yield DockSighting(pose, spread, turn, "one reflector")


def _by_shape(sweep: _Sweep, expected: Expected) -> Iterator[DockSighting]:
    """Flat faces that stand free of what is behind them, as broad as a dock's may be."""
    hit = np.flatnonzero(np.isfinite(sweep.ranges))
    if not len(hit):
        return
    points = sweep.points[hit]
    gaps = np.hypot(*np.diff(points, axis=0).T) > JUMP + 1.5 * sweep.ranges[hit][1:] * abs(sweep.step)
    for part in np.split(points, np.flatnonzero(gaps) + 1):
        broad = math.dist(part[0], part[-1])
        if len(part) < 6 or not FACE_WIDTHS[0] <= broad <= FACE_WIDTHS[1]:
            continue
        along = ((part[-1][0] - part[0][0]) / broad, (part[-1][1] - part[0][1]) / broad)
        middle = (float(part[0][0] + part[-1][0]) / 2, float(part[0][1] + part[-1][1]) / 2)
        flat = _on_face(part, middle, along, broad)
        pose, turn = _frame(middle, along, part[flat])
        if np.count_nonzero(flat) > 0.9 * len(part) and not _grazes(pose) and expected.misses(pose) <= 1.0:
            yield DockSighting(pose, 0.03, turn, "shape")


def _on_face(
    points: Points,
    middle: tuple[float, float],
    along: tuple[float, float],
    half: float,
    slack: float = FLATNESS,
) -> NDArray[np.bool_]:
    """Which `points` lie on the line through `middle`, no farther than `half` [m] from it."""
    off = points - np.array(middle)
    with np.errstate(invalid="ignore"):
        beside: NDArray[np.bool_] = np.abs(off @ np.array([-along[1], along[0]])) < slack
        near: NDArray[np.bool_] = np.abs(off @ np.array(along)) <= half
        return beside & near


def _frame(middle: tuple[float, float], along: tuple[float, float], face: Points) -> tuple[Pose2, float]:
    """The dock's frame by the points of its `face`, by the line from its right to its left where they are few; and the spread of its direction [rad]."""
    yaw, turn = math.atan2(-along[0], along[1]), math.sqrt(2) * RANGE_NOISE / STRIP_SPACING
    if len(face) >= 5:
        centred = face - face.mean(axis=0)
        spread, axes = np.linalg.svd(centred, full_matrices=False)[1:]
        line = axes[0] if axes[0] @ np.array(along) >= 0 else -axes[0]
        fitted = RANGE_NOISE / max(float(spread[0]), 1e-6)
        if fitted < turn and spread[1] < 0.5 * spread[0]:
            yaw, turn = math.atan2(-line[0], line[1]), fitted
    # the face looks at the robot, so a docked robot looks away from where the robot is now
    if middle[0] * math.cos(yaw) + middle[1] * math.sin(yaw) < 0:
        yaw = wrap(yaw + math.pi)
    return Pose2(middle[0], middle[1], wrap(yaw)), turn


def _grazes(pose: Pose2) -> bool:
    """It is seen too much from the side."""
    return abs(wrap(math.atan2(pose.y, pose.x) - pose.yaw)) > MAX_GRAZE


def _open(sweep: _Sweep, pose: Pose2, first: int, last: int) -> bool:
    """Most beams between two strips pass through where the face should be: two things that reflect, and no dock."""
    inner = slice(min(first, last) + 1, max(first, last))
    depth = pose.inverse().apply(sweep.points[inner])[:, 0]
    return bool(len(depth)) and float(np.mean(~(depth < 2 * HIDDEN_BY))) > 0.5


def _hidden(sweep: _Sweep, strip: _Strip, fellow: tuple[float, float]) -> bool:
    """Something nearer than `fellow` hides it, or the sweep does not reach there."""
    laser = sweep.laser
    x, y = sweep.points[strip.middle]
    to_strip = math.atan2(y - laser[1], x - laser[0])
    to_fellow = math.atan2(fellow[1] - laser[1], fellow[0] - laser[0])
    number = strip.middle + round(wrap(to_fellow - to_strip) / sweep.step)
    away = math.dist(laser, fellow)
    beams = [n for n in (number - 1, number, number + 1) if 0 <= n < len(sweep.ranges)]
    return not beams or all(sweep.ranges[n] < away - HIDDEN_BY for n in beams)
