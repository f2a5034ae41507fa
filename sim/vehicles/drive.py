"""The drive of a two-wheeled robot: from a wanted twist to the speeds of its wheels."""

from __future__ import annotations

from bridge.msgs.geometry_msgs import Twist
from sim.backend_bullet import STEPS_PER_SECOND, Bullet
from sim.vehicles.parameters import Limits, Wheels

__all__ = ["DifferentialDrive"]


def _towards(now: float, goal: float, most: float) -> float:
    """`goal`, or as far towards it from `now` as `most` allows."""
    return min(max(goal, now - most), now + most)


class DifferentialDrive:
    """Holds the last wanted twist and approaches it no faster than the limits allow."""

    def __init__(self, wheels: Wheels, limits: Limits, backend: Bullet, body: int) -> None:
        """The drive of `body`, whose joints 0 and 1 are the left and the right wheel; at rest."""
        self._wheels, self._limits, self._backend, self._body = wheels, limits, backend, body
        self._goal = (0.0, 0.0)
        self._now = (0.0, 0.0)
        self._rates = (limits.acceleration, limits.yaw_acceleration)
        self._apply()

    def want(self, twist: Twist) -> None:
        """Go for `twist`, cut to the limits; only its forward and yaw parts matter."""
        limits = self._limits
        self._rates = (limits.acceleration, limits.yaw_acceleration)
        self._goal = (
            _towards(0.0, twist.linear.x, limits.speed),
            _towards(0.0, twist.angular.z, limits.yaw_rate),
        )

    def brake(self) -> None:
        """Go for rest as hard as the brakes allow."""
        self._goal = (0.0, 0.0)
        self._rates = (self._limits.braking, self._limits.yaw_braking)

    def step(self) -> None:
        """Come one physics step nearer to what is wanted."""
        if self._now == self._goal:
            return
        speed, turn = (
            _towards(now, goal, rate / STEPS_PER_SECOND)
            for now, goal, rate in zip(self._now, self._goal, self._rates, strict=True)
        )
        self._now = speed, turn
        self._apply()

    def _apply(self) -> None:
        speed, turn = self._now
        wheels = self._wheels
        lag = turn * wheels.base / 2
        self._backend.spin(self._body, 0, (speed - lag) / wheels.radius, wheels.torque)
        self._backend.spin(self._body, 1, (speed + lag) / wheels.radius, wheels.torque)
