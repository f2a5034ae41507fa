"""The free space that one sweep has seen: where beams or cones passed, nothing stands any more."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from robotside.core.pose2 import Points, Pose2

__all__ = ["POSE_ERROR", "BeamSight", "ConeSight", "Sight"]

MIN_BEYOND = 0.15
"""A beam has to go on so far behind a place before nothing stands there [m]: its own noise, and how a thing's face bends."""

THING_RADIUS = 0.07
"""What stands at a remembered place is taken to be so wide to either side [m]."""

POSE_ERROR, HEADING_ERROR = 0.05, 0.01
"""A remembered place may be off by so much against the sweep, beside what the position's spread says [m, rad]."""

MAX_BEAM_SPACING = 0.2
"""Where beams are farther apart than this they may pass beside a thing that stands there [m]."""

MAX_NEAR_ANGLE = 1.2
"""Nearer things than fill this angle to either side are not judged [rad]: half the sweep would have to see past them."""

CONE_MIDDLE, CONE_BEYOND = 0.35, 0.3
"""A cone tells of what lies within this part of its width of its axis, when it sees so much farther [m]."""


class Sight(Protocol):
    """What one sweep saw through."""

    @property
    def sweeps(self) -> int:
        """So many in a row have to see through a place before nothing stands there."""

    def through(self, places: Points) -> NDArray[np.bool_]:
        """Which `places`, in `map`, it saw through: all that passed them or close beside them went on well behind them."""

    def beside(self, places: Points) -> NDArray[np.bool_]:
        """At which `places`, in `map`, it met something a little before or behind, so that what stands there was measured anew."""


@dataclass(frozen=True)
class BeamSight:
    """Of a laser."""

    place: Pose2
    """Of the laser, in `map`."""
    first: float
    """Direction of the first beam, from the laser's own [rad]."""
    step: float
    """From one beam to the next [rad], above 0."""
    free: NDArray[np.float64]
    """How far each beam met nothing [m]; 0 for one that measured nothing or too near."""
    doubt: float = 0.0
    """How far the position may be off [m]."""
    sweeps: int = 2

    def through(self, places: Points) -> NDArray[np.bool_]:
        """Every beam that passes within its margin of a place must go on behind it; a place with no such beam is not seen."""
        seen = np.zeros(len(places), dtype=np.bool_)
        if not len(places) or not len(self.free):
            return seen
        x, y = (places - (self.place.x, self.place.y)).T
        far = np.hypot(x, y)
        aside = (THING_RADIUS + POSE_ERROR + self.doubt + HEADING_ERROR * far) / np.maximum(far, 1e-6)
        asked = (aside < math.sin(MAX_NEAR_ANGLE)) & (far * self.step < MAX_BEAM_SPACING)
        asked &= far + MIN_BEYOND < self.free.max()
        which = np.flatnonzero(asked)
        if not len(which):
            return seen
        bearing = np.arctan2(y[which], x[which]) - self.place.yaw - self.first
        half = np.arcsin(aside[which]) / self.step + 0.5
        seen[which] = self._least(np.mod(bearing, math.tau) / self.step, half) > far[which] + MIN_BEYOND
        return seen

    def beside(self, places: Points) -> NDArray[np.bool_]:
        """The beam in the direction of the place ends a little before or behind it."""
        if not len(places) or not len(self.free):
            return np.zeros(len(places), dtype=np.bool_)
        x, y = (places - (self.place.x, self.place.y)).T
        bearing = np.arctan2(y, x) - self.place.yaw - self.first
        beam = np.round(np.mod(bearing, math.tau) / self.step).astype(np.intp) % round(math.tau / self.step)
        met = self.free[beam.clip(0, len(self.free) - 1)]
        return np.asarray((beam < len(self.free)) & (np.abs(met - np.hypot(x, y)) < MIN_BEYOND))

    def _least(self, middle: NDArray[np.float64], half: NDArray[np.float64]) -> NDArray[np.float64]:
        """The shortest of the beams within `half` of `middle`, both in beams [m]; 0 where some of them are missing."""
        free, count = self.free, len(self.free)
        around = round(math.tau / self.step)
        low, high = np.ceil(middle - half).astype(np.intp), np.floor(middle + half).astype(np.intp)
        if count < around - 1:
            # what lies a little before the first beam was counted as far behind the last
            over = low > count - 1
            low, high = low - around * over, high - around * over
            outside = (low < 0) | (high > count - 1)
            low, high = low.clip(0, count - 1), high.clip(0, count - 1)
        else:
            outside = np.zeros(len(low), dtype=np.bool_)
            free = np.concatenate([free, free, free])
            low, high = low + count, high + count
        least = _minima(free, low, np.maximum(high, low))
        return np.where(outside, 0.0, least)


@dataclass(frozen=True)
class ConeSight:
    """Of a ring of sonars: an echo may come from anywhere in its cone, and one that is not there from something oblique."""

    place: Pose2
    """Of the robot, in `map`."""
    bearings: NDArray[np.float64]
    """Of the cones [rad]."""
    width: float
    """Of a cone [rad]."""
    radius: float
    """Of the ring [m]."""
    free: NDArray[np.float64]
    """How far each cone met nothing [m]; 0 for one that measured nothing or too near."""
    doubt: float = 0.0
    """How far the position may be off [m]."""
    sweeps: int = 3

    def through(self, places: Points) -> NDArray[np.bool_]:
        """Some cone has a place about its middle, and every cone that has it at all sees well behind it."""
        if not len(places) or not len(self.free):
            return np.zeros(len(places), dtype=np.bool_)
        x, y = self.place.inverse().apply(places).T
        across = (
            x[:, None] - self.radius * np.cos(self.bearings),
            y[:, None] - self.radius * np.sin(self.bearings),
        )
        far = np.hypot(*across)
        off = np.abs(
            np.remainder(np.arctan2(across[1], across[0]) - self.bearings + math.pi, math.tau) - math.pi
        )
        behind = self.free > far + CONE_BEYOND + self.doubt
        inside, middle = off < 0.5 * self.width, off < CONE_MIDDLE * self.width
        return np.asarray((middle & behind).any(axis=1) & ~(inside & ~behind).any(axis=1))

    def beside(self, places: Points) -> NDArray[np.bool_]:
        """Never: a cone is too wide to say."""
        return np.zeros(len(places), dtype=np.bool_)


def _minima(
    values: NDArray[np.float64], first: NDArray[np.intp], last: NDArray[np.intp]
) -> NDArray[np.float64]:
    """The least of `values` from `first` to `last`, both included, for many pairs at once."""
    level = np.log2(last - first + 1).astype(np.intp)
    least = [values]
    for power in range(int(level.max(initial=0))):
        half = 1 << power
        shorter = least[-1]
        least.append(np.minimum(shorter[:-half], shorter[half:]))
    found = np.empty(len(first))
    for power, row in enumerate(least):
        on = level == power
        if on.any():
            found[on] = np.minimum(row[first[on]], row[last[on] - (1 << power) + 1])
    return found
