"""A hull that floats: the wind, the water and its own weight on it, each by the formula of a textbook written out anew."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import msgspec
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from sim.core.constants import GRAVITY
from sim.core.noise import Noise
from sim.core.shapes import Vec3
from sim.dynamics.hull import Hull, HullParameters
from sim.world.weather import Weather
from tests.sim.rooms import plain

MASS, WATERPLANE, DENSITY, ACROSS, ALONG = 50.0, 0.8, 1000.0, 0.4, 1.5
FRONT, SIDE, WIND_DRAG, AIR = 0.3, 0.9, 0.8, 1.225
HULL = HullParameters(
    mass=MASS,
    length=2.0,
    beam=0.8,
    draft=0.1,
    depth=0.4,
    centre_of_mass=(0.0, 0.0, 0.1),
    inertia=(4.0, 16.0, 17.0),
    added_mass=(5.0, 40.0, 60.0),
    added_inertia=(1.0, 8.0, 9.0),
    waterplane=WATERPLANE,
    metacentric=(ACROSS, ALONG),
    damping=(30.0, 50.0, 400.0),
    rotary_damping=(10.0, 80.0, 20.0),
    yaw_quadratic=15.0,
    cross_drag=1.1,
    friction=0.4,
    windage=(FRONT, SIDE),
    wind_drag=WIND_DRAG,
)
SINK = MASS / DENSITY / WATERPLANE
"""So deep it lies when it floats [m]."""


def lying(
    *,
    roll: float = 0.0,
    pitch: float = 0.0,
    yaw: float = 0.0,
    height: float = 0.0,
    through: Vec3 = (0.0, 0.0, 0.0),
    turning: Vec3 = (0.0, 0.0, 0.0),
) -> Any:
    """A body that lies so; what a hull asks of one."""
    axes = Rotation.from_euler("ZYX", [yaw, pitch, roll]).as_matrix()
    return SimpleNamespace(
        through=through, turning=turning, axes=tuple(axes.ravel().tolist()), position=(0.0, 0.0, height)
    )


def sea(*, wind: tuple[float, float] = (0.0, 0.0), current: tuple[float, float] = (0.0, 0.0)) -> Weather:
    """Flat water with a `current` under a steady `wind` [m/s]."""
    weather = Weather(
        plain(f"[water]\ndepth = 20.0\ndensity = {DENSITY}\ncurrent = [{current[0]}, {current[1]}]\n"),
        Noise(0, "gusts", on=False),
    )
    weather.wind = (*wind, 0.0)
    return weather


@pytest.mark.parametrize("yaw", [0.0, 0.7, -2.5])
@pytest.mark.parametrize("current", [(0.0, 0.0), (0.5, -0.2), (-1.0, 0.6)])
@pytest.mark.parametrize("wind", [(4.0, 0.0), (-3.0, 5.0)])
def test_the_air_pushes_by_the_speed_that_the_hull_has_through_it(
    wind: tuple[float, float], current: tuple[float, float], yaw: float
) -> None:
    """The hull goes 0.3 m/s ahead and 0.1 m/s to the left through water that itself moves over the ground."""
    through = np.array([0.3, 0.1])
    c, s = math.cos(yaw), math.sin(yaw)
    to_world = np.array([[c, -s], [s, c]])
    over_ground = to_world @ through + current
    felt = to_world.T @ (np.array(wind) - over_ground)
    expected = AIR / 2 * WIND_DRAG * np.hypot(*felt) * felt * (FRONT, SIDE)
    body = lying(yaw=yaw, through=(0.3, 0.1, 0.0))
    with_air, _ = Hull(HULL, sea(wind=wind, current=current)).forces(body)
    still = (over_ground[0], over_ground[1])
    without, _ = Hull(HULL, sea(wind=still, current=current)).forces(body)
    assert np.subtract(with_air, without)[:2] == pytest.approx(expected)


def test_air_that_drifts_with_the_water_pushes_nothing() -> None:
    force, torque = Hull(HULL, sea(wind=(0.7, 0.4), current=(0.7, 0.4))).forces(lying())
    assert (*force, *torque) == pytest.approx((0.0,) * 6, abs=1e-9)


@pytest.mark.parametrize(("roll", "pitch"), [(0.1, 0.0), (-0.1, 0.0), (0.0, 0.05), (0.0, -0.05)])
def test_heeled_it_is_righted_by_its_weight_at_its_metacentric_heights(roll: float, pitch: float) -> None:
    _, (k, m, n) = Hull(HULL, sea()).forces(lying(roll=roll, pitch=pitch))
    assert k == pytest.approx(-MASS * GRAVITY * ACROSS * math.sin(roll))
    assert m == pytest.approx(-MASS * GRAVITY * ALONG * math.sin(pitch))
    assert n == pytest.approx(0.0, abs=1e-9)


def test_deeper_it_is_lifted_by_the_water_that_it_displaces_more() -> None:
    (_, _, lift), _ = Hull(HULL, sea()).forces(lying(height=-0.02))
    assert lift == pytest.approx(DENSITY * GRAVITY * WATERPLANE * 0.02)


@pytest.mark.parametrize("height", [SINK, 0.5])
def test_out_of_the_water_its_weight_alone_acts_on_it_and_nothing_rights_or_brakes_it(height: float) -> None:
    hull = Hull(msgspec.structs.replace(HULL, windage=(1e-12, 1e-12)), sea())
    heeled = lying(roll=0.4, pitch=0.2, height=height, through=(1.0, 1.0, 1.0), turning=(0.5, 0.5, 0.5))
    force, torque = hull.forces(heeled)
    weight = Rotation.from_matrix(np.reshape(heeled.axes, (3, 3))).inv().apply([0.0, 0.0, -MASS * GRAVITY])
    assert force == pytest.approx(tuple(weight))
    assert torque == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)
    assert hull.wet == 0.0


def test_half_out_of_it_half_of_it_rights_it() -> None:
    whole, half = (
        Hull(HULL, sea()).forces(lying(roll=0.1, height=height))[1][0] for height in (0.0, SINK / 2)
    )
    assert half == pytest.approx(whole / 2)


def test_the_drag_across_is_that_of_a_plate_and_brakes_a_turn_at_its_ends() -> None:
    """1/2 rho C A v |v|; a turn about the middle moves each strip by its own distance: the integral of x |x| x is L^4/32."""
    hull, rho, draft = Hull(HULL, sea(wind=(0.0, 0.3))), DENSITY, 0.1
    (_, across, _), _ = hull.forces(lying(through=(0.0, 0.3, 0.0)))
    assert across == pytest.approx(-rho / 2 * 1.1 * draft * 2.0 * 0.3**2 - 50.0 * 0.3)
    still = Hull(HULL, sea())
    _, (_, _, n) = still.forces(lying(turning=(0.0, 0.0, 0.4)))
    assert n == pytest.approx(-rho / 2 * 1.1 * draft * 2.0**4 / 32 * 0.4**2 - 20.0 * 0.4 - 15.0 * 0.4**2)
