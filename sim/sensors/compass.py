"""A stabilised marine compass: gyro, accelerometer and magnetometer, told by a speed log how the vehicle accelerates.

An accelerometer alone feels every acceleration as a tilt, and where the field dips by 70° a tilt of a degree is nearly three of
heading. Such a compass therefore keeps its attitude by its gyro and lets the others only pull at it slowly: a complementary filter
after R. Mahony, T. Hamel and J.-M. Pflimlin, Nonlinear complementary filters on the special orthogonal group, IEEE TAC 53(5), 2008.
What the vehicle itself accelerates, by its log and the gyro, is taken off what the accelerometer feels first. The course over the
ground is no part of it: a boat slides by twenty degrees in a turn and sets in a current, where its bow is not.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import msgspec

from bridge.core.units import heading_from_yaw
from bridge.msgs.pilothouse_msgs import Compass as Told
from bridge.msgs.std_msgs import Header, Time
from sim.core.constants import GRAVITY
from sim.core.noise import Noise
from sim.core.shapes import Quat, Vec3, compose, from_yaw, rotate, rotate_back
from sim.physics.backend_bullet import State

__all__ = ["FILTER_RATE", "Compass", "CompassParameters", "levelled"]

FILTER_RATE = 50.0
"""The instrument works so often, and tells what it has at its own rate [Hz]."""
LEVELLING, TURNING, BIAS = 0.2, 0.2, 0.004
"""How fast the accelerometer levels it and the magnetometer turns it [1/s], and how fast both find the gyro's bias [1/s2]."""
MAX_TILT_ERROR = 0.1
"""A greater disagreement with the accelerometer counts as this one: it is a bump, not a tilt [rad]."""
MAX_PAUSE = 0.1
"""After a longer pause it begins anew, by field and weight alone [s]."""


class CompassParameters(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The `[compass]` table of a vehicle's file."""

    rate: float
    """[Hz], a whole part of FILTER_RATE."""
    dip: float
    """Dip of the magnetic field below the horizontal [rad]."""
    noise: float
    """Standard deviation of each part of the field, as a part of its strength."""
    hard_iron: float
    """Standard deviation of what the vehicle's own iron adds to it, one draw a run."""
    accelerometer_noise: float
    """Standard deviation [m/s2]."""
    gyro_noise: float
    """Standard deviation [rad/s]."""
    gyro_bias: float
    """Standard deviation, one draw a run [rad/s]."""
    log_noise: float
    """Standard deviation of the speed log along each axis [m/s]."""
    log_scale: float
    """Standard deviation of its scale, one draw a run."""


def levelled(field: Vec3, force: Vec3) -> tuple[float, float, float]:
    """Yaw, roll and pitch [rad] of a body that feels a magnetic `field` and a specific `force` along its axes.

    Yaw is 0 where x points east of magnetic north by a right angle, as everywhere; NaN when there is no force.
    """
    fx, fy, fz = force
    if math.hypot(fx, fy, fz) < 1e-6 * GRAVITY:
        return math.nan, math.nan, math.nan
    roll, pitch = math.atan2(fy, fz), math.atan2(-fx, math.hypot(fy, fz))
    mx, my, mz = field
    down = my * math.sin(roll) + mz * math.cos(roll)
    ahead, left = mx * math.cos(pitch) + down * math.sin(pitch), my * math.cos(roll) - mz * math.sin(roll)
    return math.atan2(ahead, left), roll, pitch


class Compass:
    """In `base_link`."""

    def __init__(self, parameters: CompassParameters, noise: Noise) -> None:
        """Not yet at work: its first look at field and weight gives its attitude."""
        self._parameters, self._noise = parameters, noise
        self._iron = [noise.normal(parameters.hard_iron) for _ in range(3)]
        self._drift = [noise.normal(parameters.gyro_bias) for _ in range(3)]
        self._scale = 1 + noise.normal(parameters.log_scale)
        self._field = (0.0, math.cos(parameters.dip), -math.sin(parameters.dip))
        self._every = max(1, round(FILTER_RATE / parameters.rate))
        self._count = 0
        self.restart()

    def restart(self) -> None:
        """It was carried elsewhere: begin anew."""
        self._attitude: Quat = (0.0, 0.0, 0.0, 1.0)
        self._bias: Vec3 = (0.0, 0.0, 0.0)
        self._before: tuple[State, Vec3, float] | None = None

    def messages(self, state: State, stamp: float) -> Iterator[tuple[str, Told]]:
        """What it tells when it is called FILTER_RATE times a second."""
        told = self.measure(state, stamp)
        if self._count % self._every == 0:
            yield "/compass", told
        self._count += 1

    def measure(self, state: State, stamp: float) -> Told:
        """Work on to `stamp` [s], and tell; acceleration and turn rate are the means since the last call."""
        own = self._parameters
        u, v, w = rotate_back(state.rotation, state.velocity)
        log = self._noisy((u * self._scale, v * self._scale, w * self._scale), own.log_noise)
        field = self._noisy(rotate_back(state.rotation, self._field), own.noise)
        field = _sum(field, (self._iron[0], self._iron[1], self._iron[2]))
        if self._before is None or not 0.0 < stamp - self._before[2] <= MAX_PAUSE:
            self._begin(state, field)
        else:
            self._go_on(self._before, state, field, log, stamp)
        self._before = state, log, stamp
        return self._told(stamp)

    def _begin(self, state: State, field: Vec3) -> None:
        """At rest, as far as it knows."""
        weight = self._noisy(
            rotate_back(state.rotation, (0.0, 0.0, GRAVITY)), self._parameters.accelerometer_noise
        )
        yaw, roll, pitch = levelled(field, weight)
        rolled = (math.sin(roll / 2), 0.0, 0.0, math.cos(roll / 2))
        pitched = (0.0, math.sin(pitch / 2), 0.0, math.cos(pitch / 2))
        self._attitude = compose(from_yaw(yaw), compose(pitched, rolled))

    def _go_on(
        self, last: tuple[State, Vec3, float], state: State, field: Vec3, log: Vec3, stamp: float
    ) -> None:
        own, (before, logged, earlier) = self._parameters, last
        period = stamp - earlier
        felt = _change(before.velocity, state.velocity, period)
        force = self._noisy(
            rotate_back(state.rotation, (felt[0], felt[1], felt[2] + GRAVITY)), own.accelerometer_noise
        )
        turning = rotate_back(state.rotation, _middle(before.turning, state.turning))
        gyro = self._noisy(_sum(turning, (self._drift[0], self._drift[1], self._drift[2])), own.gyro_noise)
        rate = _sum(gyro, self._bias)
        attitude = _turned(self._attitude, rate, period)
        own_motion = _sum(_change(logged, log, period), _cross(rate, _middle(logged, log)))
        pull = self._pull(attitude, _sum(force, (-own_motion[0], -own_motion[1], -own_motion[2])), field)
        grow = BIAS / LEVELLING * period
        self._bias = _sum(self._bias, (grow * pull[0], grow * pull[1], grow * pull[2]))
        self._attitude = _turned(attitude, pull, period)

    def _pull(self, attitude: Quat, weight: Vec3, field: Vec3) -> Vec3:
        """Turn rate with which weight and field pull at the attitude, about the body's axes [rad/s]."""
        tilt = _cross(_unit(weight), rotate_back(attitude, (0.0, 0.0, 1.0)))
        size = math.hypot(*tilt)
        less = LEVELLING * min(1.0, MAX_TILT_ERROR / size) if size > 0 else 0.0
        level = rotate(attitude, field)
        up = rotate_back(attitude, (0.0, 0.0, TURNING * math.atan2(level[0], level[1])))
        return less * tilt[0] + up[0], less * tilt[1] + up[1], less * tilt[2] + up[2]

    def _told(self, stamp: float) -> Told:
        x, y, z, w = self._attitude
        roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
        pitch = math.asin(min(1.0, max(-1.0, 2 * (w * y - z * x))))
        yaw = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
        return Told(Header(Time.at(stamp), "base_link"), heading_from_yaw(yaw), roll, pitch)

    def _noisy(self, vector: Vec3, deviation: float) -> Vec3:
        normal = self._noise.normal
        return vector[0] + normal(deviation), vector[1] + normal(deviation), vector[2] + normal(deviation)


def _sum(a: Vec3, b: Vec3) -> Vec3:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _middle(a: Vec3, b: Vec3) -> Vec3:
    return (a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2


def _change(then: Vec3, now: Vec3, period: float) -> Vec3:
    return (now[0] - then[0]) / period, (now[1] - then[1]) / period, (now[2] - then[2]) / period


def _cross(a: Vec3, b: Vec3) -> Vec3:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _unit(a: Vec3) -> Vec3:
    size = math.hypot(*a) or 1.0
    return a[0] / size, a[1] / size, a[2] / size


def _turned(attitude: Quat, rate: Vec3, period: float) -> Quat:
    """`attitude` turned at a `rate` [rad/s] about the body's own axes for a short `period` [s], of length 1."""
    half = period / 2
    x, y, z, w = compose(attitude, (rate[0] * half, rate[1] * half, rate[2] * half, 1.0))
    size = math.sqrt(x * x + y * y + z * z + w * w)
    return x / size, y / size, z / size, w / size
