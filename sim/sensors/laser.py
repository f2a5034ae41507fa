"""A planar laser that measures distances all round."""

from __future__ import annotations

import math

import msgspec
import numpy as np

from bridge.msgs.arrays import Float32Array
from bridge.msgs.sensor_msgs import LaserScan
from bridge.msgs.std_msgs import Header, Time
from sim.core.noise import Noise
from sim.physics.backend_bullet import Bullet

__all__ = ["Laser", "LaserParameters"]


class LaserParameters(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The `[laser]` table of a vehicle's file; `ahead` of the middle [m], and the sweep's breadth round straight ahead [rad]."""

    rate: float
    beams: int
    height: float
    range_min: float
    range_max: float
    noise: float
    ahead: float = 0.0
    field_of_view: float = math.tau


class Laser:
    """Beams from one point, the first one farthest to the right, then anticlockwise."""

    def __init__(self, parameters: LaserParameters, backend: Bullet, body: int, noise: Noise) -> None:
        """A laser on `body`."""
        self._parameters, self._backend, self._body, self._noise = parameters, backend, body, noise
        breadth = parameters.field_of_view
        whole = breadth >= math.tau
        step = breadth / (parameters.beams if whole else parameters.beams - 1)
        first = -breadth / 2
        self._fan = backend.fan(
            body,
            (parameters.ahead, 0.0, parameters.height),
            first=first,
            step=step,
            count=parameters.beams,
            reach=parameters.range_max,
        )
        self._blank = LaserScan(
            angle_min=first,
            angle_max=first + step * (parameters.beams - 1),
            angle_increment=step,
            scan_time=1 / parameters.rate,
            range_min=parameters.range_min,
            range_max=parameters.range_max,
        )

    def measure(self, stamp: float) -> LaserScan:
        """One sweep, all beams at `stamp` [s]; +inf where nothing is in range, -inf where it is too near (REP-117).

        Intensities are those of `Bullet.echoes`; 0 where there is no range.
        """
        parameters = self._parameters
        echoes = self._backend.echoes(self._body, self._fan)
        hits = echoes.reach
        missed = hits >= 1.0
        ranges = hits * parameters.range_max + self._noise.normals(parameters.noise, len(hits))
        ranges[ranges < parameters.range_min] = -np.inf
        ranges[missed | (ranges > parameters.range_max)] = np.inf
        strength = np.where(np.isfinite(ranges), echoes.strength, 0.0)
        return msgspec.structs.replace(
            self._blank,
            header=Header(Time.at(stamp), "laser"),
            ranges=Float32Array(ranges.astype("<f4").tobytes()),
            intensities=Float32Array(strength.astype("<f4").tobytes()),
        )
