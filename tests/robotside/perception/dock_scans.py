"""Sweeps of a laser over lines that reflect more or less, for tests of what is seen of a dock."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bridge.msgs.arrays import Float32Array
from bridge.msgs.sensor_msgs import LaserScan
from bridge.msgs.std_msgs import Header, Time
from robotside.core.pose2 import Pose2

__all__ = ["Line", "dock", "leg", "sweep"]

DULL, BRIGHT = 40.0, 230.0


@dataclass(frozen=True)
class Line:
    """A thin wall [m] with its `shine` as intensity, in the world."""

    ax: float
    ay: float
    bx: float
    by: float
    shine: float = DULL


def dock(at: Pose2, *, width: float = 0.44, strips: tuple[float, ...] = (-0.15, 0.15)) -> list[Line]:
    """A face with its middle at `at`, which looks into the dock, and strips as far to the left of it."""

    def piece(start: float, end: float, ahead: float, shine: float = DULL) -> Line:
        (ax, ay, _), (bx, by, _) = (at.then(Pose2(ahead, aside, 0.0)) for aside in (start, end))
        return Line(ax, ay, bx, by, shine)

    return [piece(-width / 2, width / 2, 0.0)] + [piece(s - 0.025, s + 0.025, -0.001, BRIGHT) for s in strips]


def leg(x: float, y: float, radius: float = 0.07, shine: float = DULL) -> list[Line]:
    """A person's leg, as eight sides."""
    corners = [
        (x + radius * math.cos(a), y + radius * math.sin(a)) for a in np.arange(0.0, math.tau, math.pi / 4)
    ]
    return [Line(*a, *b, shine) for a, b in zip(corners, (*corners[1:], corners[0]), strict=True)]


def sweep(
    lines: list[Line],
    laser: Pose2,
    rng: np.random.Generator | None = None,
    *,
    beams: int = 360,
    noise: float = 0.01,
    intensities: bool = True,
) -> LaserScan:
    """What a laser at `laser` measures of `lines`, with an error of `noise` [m] from `rng`, none without."""
    angles = -math.pi + math.tau / beams * np.arange(beams)
    dx, dy = np.cos(angles + laser.yaw), np.sin(angles + laser.yaw)
    nearest, shine = np.full(beams, np.inf), np.zeros(beams)
    for line in lines:
        ex, ey = line.bx - line.ax, line.by - line.ay
        with np.errstate(divide="ignore", invalid="ignore"):
            cross = dx * ey - dy * ex
            away = ((line.ax - laser.x) * ey - (line.ay - laser.y) * ex) / cross
            part = ((line.ax - laser.x) * dy - (line.ay - laser.y) * dx) / cross
        hit = (away > 0) & (part >= 0) & (part <= 1) & (away < nearest)
        nearest[hit], shine[hit] = away[hit], line.shine
    if rng is not None:
        nearest = nearest + rng.normal(0.0, noise, beams)
    nearest[nearest > 12.0] = np.inf
    step = math.tau / beams
    bright = Float32Array(shine.astype("<f4").tobytes()) if intensities else Float32Array()
    values = Float32Array(nearest.astype("<f4").tobytes())
    first, last = float(angles[0]), float(angles[-1])
    return LaserScan(Header(Time(), "laser"), first, last, step, 0.0, 0.1, 0.05, 12.0, values, bright)
