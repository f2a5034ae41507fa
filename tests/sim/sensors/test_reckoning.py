"""Dead reckoning says how far off it may be."""

from __future__ import annotations

import math

import pytest

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
