from __future__ import annotations

import zlib

import numpy as np

from sim.core.noise import Noise


def test_draws_are_those_of_the_sensors_own_generator_one_by_one_or_many_at_a_time():
    noise, plain = Noise(7, "imu"), np.random.default_rng([7, zlib.crc32(b"imu")])
    drawn: list[float] = []
    for single, many in ((1, 0), (3, 5), (62, 0), (0, 200), (130, 64), (1, 1)):
        drawn += [noise.normal(1.0) for _ in range(single)]
        drawn += noise.normals(1.0, many).tolist()
    assert drawn == [float(plain.standard_normal()) for _ in drawn]


def test_draws_are_as_large_as_is_asked_for_and_none_when_it_is_off():
    assert Noise(7, "imu").normal(2.0) == 2 * Noise(7, "imu").normal(1.0)
    off = Noise(7, "imu", on=False)
    assert off.normal(2.0) == 0.0
    assert off.normals(2.0, 3).tolist() == [0.0] * 3
