"""Dead reckoning says how far off it may be."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from sim.core.noise import Noise
from sim.physics.bodies import State
from sim.sensors.reckoning import DeadReckoning, ReckoningParameters

OWN = ReckoningParameters(
    rate=20.0, scale_error=0.03, speed_error=0.02, wander=40.0, yaw_drift=0.0008, height_noise=0.01
)


@pytest.mark.parametrize("speed", [0.0, 0.5])
def test_its_error_is_as_large_as_it_says(speed: float) -> None:
    squares, said = [], 0.0
    for seed in range(40):
        reckoning = DeadReckoning(OWN, (0.0, 0.0, 0.0), Noise(seed, "reckoning"))
        for step in range(601):
            state = State(
                (speed * step / 20, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), (speed, 0.0, 0.0), (0.0, 0.0, 0.0)
            )
            message = reckoning.measure(state, step / 20)
        squares.append((reckoning.pose[0] - speed * 30.0) ** 2)
        said = math.sqrt(message.pose.covariance[0])
    assert math.sqrt(sum(squares) / len(squares)) == pytest.approx(said, rel=0.3)


def test_it_tells_speeds_and_turn_rates_along_the_bodys_axes_and_adds_them_up_in_its_own_frame() -> None:
    """A boat that starts where its map says (2, 1) at a yaw of 0.5, heels, and is driven aside by the current."""
    exact = DeadReckoning(OWN, (2.0, 1.0, 0.5), Noise(0, "reckoning", on=False))
    rotation = Rotation.from_euler("ZYX", [0.5, 0.1, -0.3])
    x, y, z, w = (float(part) for part in rotation.as_quat())
    velocity, turning = (0.4, -0.2, 0.1), (0.3, -0.1, 0.2)
    for step in range(21):
        message = exact.measure(State((9.0, 9.0, 0.7), (x, y, z, w), velocity, turning), step / 20)
    linear, angular = message.twist.twist.linear, message.twist.twist.angular
    assert (linear.x, linear.y, linear.z) == pytest.approx(tuple(rotation.inv().apply(velocity)))
    assert (angular.x, angular.y, angular.z) == pytest.approx(tuple(rotation.inv().apply(turning)))
    place = message.pose.pose.position
    assert (place.x, place.y, place.z) == pytest.approx((2.0 + velocity[0], 1.0 + velocity[1], 0.7))
    assert np.isclose(message.pose.pose.orientation.yaw, 0.5)
