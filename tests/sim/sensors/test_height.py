"""The ranger that looks down: ground, water and things under it, along its own axis."""

from __future__ import annotations

import math

import pytest

from sim.core.noise import Noise
from sim.core.shapes import Quat, Shape
from sim.physics.backend_bullet import Bullet
from sim.physics.bodies import Floating
from sim.sensors.height import HeightParameters, HeightRanger
from sim.world.weather import Weather
from tests.sim.rooms import plain

RANGER = HeightParameters(rate=20.0, range_min=0.2, range_max=6.0, field_of_view=0.4, noise=0.0)
DRONE = Floating(Shape("box", (0.4, 0.4, 0.1)), 1.0, (0.1, 0.1, 0.1), (0.0, 0.0, 0.0), 0.4)
LEVEL: Quat = (0.0, 0.0, 0.0, 1.0)


def measured(height: float, *, rotation: Quat = LEVEL, ground: float | None = None, water: str = "") -> float:
    """What it says at this height above the map's origin [m], over `ground` or over `water`."""
    backend = Bullet()
    if ground is not None:
        backend.add_ground(ground)
    body = backend.add_floating(DRONE, (0.0, 0.0, height), rotation)
    ranger = HeightRanger(
        RANGER, backend, body, Weather(plain(water), Noise(0, "g", on=False)), Noise(0, "h", on=False)
    )
    said = ranger.measure(backend.state(body), 0.0).range
    backend.close()
    return said


def test_it_measures_the_distance_to_the_ground() -> None:
    assert measured(2.0, ground=0.0) == pytest.approx(2.0, abs=1e-3)


def test_water_is_ground_to_it_wherever_its_bottom_lies() -> None:
    assert measured(2.0, water="[water]\ndepth = 20.0\n") == pytest.approx(2.0)
    assert measured(2.0, ground=-3.0, water="[water]\ndepth = 3.0\n") == pytest.approx(2.0)


def test_a_wave_that_rises_under_it_is_nearer() -> None:
    crest = "[water]\ndepth = 20.0\n[[water.waves]]\nheight = 1.0\nperiod = 3.0\ndirection = 0\nphase = 0\n"
    assert measured(2.0, water=crest) == pytest.approx(1.5)


def test_leaning_it_looks_aslant_and_sees_farther() -> None:
    lean = 0.3
    rotation = (math.sin(lean / 2), 0.0, 0.0, math.cos(lean / 2))
    assert measured(2.0, rotation=rotation, water="[water]\ndepth = 20.0\n") == pytest.approx(
        2.0 / math.cos(lean)
    )


@pytest.mark.parametrize(("height", "said"), [(0.1, -math.inf), (7.0, math.inf)])
def test_too_near_is_minus_infinity_and_out_of_reach_infinity(height: float, said: float) -> None:
    """REP-117."""
    assert measured(height, water="[water]\ndepth = 20.0\n") == said
    assert measured(height, ground=0.0) == said
