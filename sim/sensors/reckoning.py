"""Dead reckoning of a vehicle without wheels: a speed log and a gyro, with the errors that they add up."""

from __future__ import annotations

import math

import msgspec

from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    Quaternion,
    Twist,
    TwistWithCovariance,
    Vector3,
)
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.std_msgs import Header, Time
from sim.core.noise import GaussMarkov, Noise
from sim.core.shapes import Quat, compose, from_yaw, rotate, rotate_back
from sim.physics.backend_bullet import State

__all__ = ["DeadReckoning", "ReckoningParameters"]


class ReckoningParameters(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The `[reckoning]` table of a vehicle's file."""

    rate: float
    """[Hz]"""
    scale_error: float
    """Standard deviation of the log's scale, one draw a run."""
    speed_error: float
    """Standard deviation of what wanders, along each axis [m/s]."""
    wander: float
    """Its time constant [s]."""
    yaw_drift: float
    """Standard deviation of the drift of the yaw, one draw a run [rad/s]."""
    height_noise: float
    """Standard deviation of the height, which a gauge measures [m]."""


class DeadReckoning:
    """Integrates measured velocities from a given pose; height, roll and pitch are measured anew each time."""

    def __init__(
        self, parameters: ReckoningParameters, pose: tuple[float, float, float], noise: Noise
    ) -> None:
        """`pose` is x, y [m], yaw [rad] in `odom`."""
        self._parameters, self._noise = parameters, noise
        self._scale = 1 + noise.normal(parameters.scale_error)
        self._drift = noise.normal(parameters.yaw_drift)
        self._errors = tuple(
            GaussMarkov(noise, parameters.speed_error, parameters.wander, 1 / parameters.rate)
            for _ in range(3)
        )
        self.pose = pose
        """Believed x, y [m], yaw [rad] in `odom`; yaw is not wrapped."""
        self._stamp: float | None = None
        self._rotation: Quat = (0.0, 0.0, 0.0, 1.0)
        self._way = self._time = 0.0

    def restart(self, pose: tuple[float, float, float]) -> None:
        """Believe to be at x, y [m], yaw [rad] in `odom`, wherever it was until now."""
        self.pose, self._stamp, self._way, self._time = pose, None, 0.0, 0.0

    def measure(self, state: State, stamp: float, *, stands: bool = False) -> Odometry:
        """The belief at `stamp` [s] of a body in `state`, `odom` to `base_link`.

        One that knows that it `stands` goes by that: it has no speed, and nothing adds up.
        """
        period = 0.0 if self._stamp is None else stamp - self._stamp
        u, v, w = (
            part * self._scale + error.step()
            for part, error in zip(rotate_back(state.rotation, state.velocity), self._errors, strict=True)
        )
        drift = self._drift
        if stands:
            u = v = w = drift = 0.0
        turning = rotate_back(state.rotation, state.turning)
        x, y, yaw = self.pose
        true_yaw = Quaternion(*state.rotation).yaw
        if self._stamp is not None:
            last = Quaternion(*self._rotation).yaw
            yaw += math.remainder(true_yaw - last, math.tau) + drift * period
        self._stamp, self._rotation = stamp, state.rotation
        tilted = compose(from_yaw(yaw - true_yaw), state.rotation)
        dx, dy, _ = rotate(tilted, (u, v, w))
        self.pose = (x + dx * period, y + dy * period, yaw)
        self._way += math.hypot(u, v) * period
        height = state.position[2] + self._noise.normal(self._parameters.height_noise)
        self._time += 0.0 if stands else period
        variance = self._variance()
        covariance = [0.0] * 36
        covariance[0] = covariance[7] = variance
        covariance[14], covariance[35] = self._parameters.height_noise**2 + 1e-6, 1e-4 * (1 + self._way)
        return Odometry(
            Header(Time.at(stamp), "odom"),
            "base_link",
            PoseWithCovariance(Pose(Point(*self.pose[:2], height), Quaternion(*tilted)), covariance),
            TwistWithCovariance(Twist(Vector3(u, v, w), Vector3(*turning))),
        )

    def _variance(self) -> float:
        """Of the place along each axis by now [m2]: what wanders adds up, the scale and the yaw err all the way."""
        own, since = self._parameters, self._time / self._parameters.wander
        wandered = 2 * (own.speed_error * own.wander) ** 2 * (since - 1 + math.exp(-since))
        swerved = own.yaw_drift * self._time / 2
        return wandered + (self._way * math.hypot(own.scale_error, swerved)) ** 2 + 1e-4
