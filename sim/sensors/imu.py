"""An inertial unit with a compass: attitude, turn rate and acceleration as in REP-145."""

from __future__ import annotations

import math

import msgspec

from bridge.msgs.geometry_msgs import Quaternion, Vector3
from bridge.msgs.sensor_msgs import Imu
from bridge.msgs.std_msgs import Header, Time
from sim.core.constants import GRAVITY
from sim.core.noise import GaussMarkov, Noise
from sim.core.shapes import Vec3, compose, rotate_back
from sim.physics.backend_bullet import State

__all__ = ["ImuParameters", "InertialUnit"]


class ImuParameters(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The `[imu]` table of a vehicle's file."""

    rate: float
    gyro_noise: float
    gyro_bias: float
    accelerometer_noise: float
    tilt_error: float
    heading_error: float
    wander: float


def _diagonal(x: float, y: float, z: float) -> list[float]:
    return [x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z]


class InertialUnit:
    """In `base_link`, at the centre of mass; orientation in `map` (x east)."""

    def __init__(self, parameters: ImuParameters, noise: Noise) -> None:
        """A unit at rest."""
        self._parameters, self._noise = parameters, noise
        self._bias = tuple(noise.normal(parameters.gyro_bias) for _ in range(3))
        period = 1 / parameters.rate
        self._errors = tuple(
            GaussMarkov(noise, deviation, parameters.wander, period)
            for deviation in (parameters.tilt_error, parameters.tilt_error, parameters.heading_error)
        )
        self._last: tuple[Vec3, float] | None = None

    def measure(self, state: State, stamp: float) -> Imu:
        """Measurement at `stamp` [s] of a body in `state`; acceleration is the mean since the last call."""
        parameters = self._parameters
        gyro, accelerometer = parameters.gyro_noise, parameters.accelerometer_noise
        return Imu(
            Header(Time.at(stamp), "imu"),
            self._orientation(state),
            _diagonal(parameters.tilt_error**2, parameters.tilt_error**2, parameters.heading_error**2),
            self._noisy(rotate_back(state.rotation, state.turning), gyro, self._bias),
            _diagonal(gyro**2, gyro**2, gyro**2),
            self._noisy(self._specific_force(state, stamp), accelerometer, (0.0, 0.0, 0.0)),
            _diagonal(accelerometer**2, accelerometer**2, accelerometer**2),
        )

    def _orientation(self, state: State) -> Quaternion:
        roll, pitch, yaw = (error.step() for error in self._errors)
        # A small rotation, brought back to unit length.
        length = math.sqrt(1.0 + (roll**2 + pitch**2 + yaw**2) / 4)
        error = (roll / 2 / length, pitch / 2 / length, yaw / 2 / length, 1.0 / length)
        return Quaternion(*compose(error, state.rotation))

    def _specific_force(self, state: State, stamp: float) -> Vec3:
        velocity = state.velocity
        before, earlier = self._last or (velocity, stamp)
        self._last = (velocity, stamp)
        period = stamp - earlier
        if period <= 0:
            return rotate_back(state.rotation, (0.0, 0.0, GRAVITY))
        ax, ay, az = ((now - then) / period for now, then in zip(velocity, before, strict=True))
        return rotate_back(state.rotation, (ax, ay, az + GRAVITY))

    def _noisy(self, vector: Vec3, deviation: float, bias: tuple[float, ...]) -> Vector3:
        return Vector3(*(v + b + self._noise.normal(deviation) for v, b in zip(vector, bias, strict=True)))
