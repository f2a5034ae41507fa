"""The inertial unit measures along its own axes (REP-103, REP-145), whichever way the body lies."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from sim.core.constants import GRAVITY
from sim.core.noise import Noise
from sim.core.shapes import Vec3
from sim.physics.bodies import State
from sim.sensors.imu import ImuParameters, InertialUnit

RATE = 100.0
EXACT = ImuParameters(
    rate=RATE,
    gyro_noise=0.0,
    gyro_bias=0.0,
    accelerometer_noise=0.0,
    tilt_error=0.0,
    heading_error=0.0,
    wander=100.0,
)
AXES = ("x", "y", "z")


def lying(rotation: Rotation, velocity: Vec3 = (0.0, 0.0, 0.0), turning: Vec3 = (0.0, 0.0, 0.0)) -> State:
    x, y, z, w = (float(part) for part in rotation.as_quat())
    return State((1.0, 2.0, 3.0), (x, y, z, w), velocity, turning)


@pytest.mark.parametrize("seed", range(4))
def test_it_measures_in_the_bodys_frame_what_the_body_does_in_the_worlds(seed: int) -> None:
    rotation = Rotation.random(random_state=seed)
    turning, acceleration = np.random.default_rng(seed).uniform(-2.0, 2.0, (2, 3))
    unit = InertialUnit(EXACT, Noise(0, "imu", on=False))
    unit.measure(lying(rotation), 5.0)
    after = tuple(float(part) / RATE for part in acceleration)
    message = unit.measure(
        lying(rotation, (after[0], after[1], after[2]), (turning[0], turning[1], turning[2])), 5.0 + 1 / RATE
    )
    felt = rotation.inv().apply(acceleration + np.array((0.0, 0.0, GRAVITY)))
    rates = rotation.inv().apply(turning)
    assert [getattr(message.linear_acceleration, axis) for axis in AXES] == pytest.approx(list(felt))
    assert [getattr(message.angular_velocity, axis) for axis in AXES] == pytest.approx(list(rates))
    told = Rotation.from_quat([getattr(message.orientation, axis) for axis in (*AXES, "w")])
    assert (told * rotation.inv()).magnitude() == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(
    ("about", "felt"),
    [
        ("x", (0.0, GRAVITY, 0.0)),  # rolled to the right: its left side is up
        ("y", (-GRAVITY, 0.0, 0.0)),  # nose down: its tail is up
        ("z", (0.0, 0.0, GRAVITY)),
    ],
)
def test_at_rest_it_feels_what_holds_it_up(about: str, felt: Vec3) -> None:
    unit = InertialUnit(EXACT, Noise(0, "imu", on=False))
    message = unit.measure(lying(Rotation.from_euler(about, 90, degrees=True)), 0.0)
    assert [getattr(message.linear_acceleration, axis) for axis in AXES] == pytest.approx(list(felt))
