"""A tyre against its formula, and against what Coulomb and Hooke have it do at both ends."""

from __future__ import annotations

import math

import pytest

from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.dynamics.tyres import Footing, Ground, Wheel, pull

GRIP, STIFFNESS, LOAD = 0.5, 10.0, 1000.0
FLAT = ((0.0, 0.0, 0.5), (0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


@pytest.fixture
def wheel():
    wheel = Wheel(0.0, 0.0, STIFFNESS, 0.3)
    wheel.load = LOAD
    return wheel


def test_it_pulls_by_its_stiffness_at_first_and_by_the_grip_at_last():
    assert pull(1e-6, STIFFNESS, GRIP) == pytest.approx(1e-6 * STIFFNESS, rel=1e-5)
    assert pull(0.15, STIFFNESS, GRIP) == pytest.approx(GRIP)
    assert pull(9.0, STIFFNESS, GRIP) == pytest.approx(GRIP)
    steps = [pull(0.15 * part / 20, STIFFNESS, GRIP) for part in range(21)]
    assert steps == sorted(steps)


@pytest.mark.parametrize("angle", [0.01, 0.03, 0.08, 0.12])
def test_rolling_askew_it_pulls_as_fiala_says_once_the_slip_has_built_up(wheel, angle):
    """Fiala's own formula, with the tangent of the slip angle."""
    for _ in range(2 * STEPS_PER_SECOND):
        wheel.rim = 4.0
        ahead, aside = wheel.grasp(4.0, 4.0 * math.tan(angle), 0.0, GRIP)
    t, c, most = math.tan(angle), STIFFNESS * LOAD, GRIP * LOAD
    expected = c * t - c**2 * t**2 / (3 * most) + c**3 * t**3 / (27 * most**2)
    assert aside == pytest.approx(-expected, rel=1e-6)
    assert ahead == pytest.approx(0.0, abs=1e-9)


def test_the_slip_builds_up_within_the_relaxation_length(wheel):
    forces = []
    for _ in range(STEPS_PER_SECOND):
        wheel.rim = 4.0
        forces.append(-wheel.grasp(4.0, 4.0 * 0.001, 0.0, GRIP)[1])
    at = next(step for step, force in enumerate(forces) if force > (1 - 1 / math.e) * forces[-1])
    assert 4.0 * (at + 1) / STEPS_PER_SECOND == pytest.approx(0.3, abs=0.04)


@pytest.mark.parametrize("way", [0.0, 0.7, 1.57, 2.5, -2.0])
def test_locked_it_is_braked_against_its_way_by_friction_alone(wheel, way):
    u, v = 3.0 * math.cos(way), 3.0 * math.sin(way)
    for _ in range(STEPS_PER_SECOND):
        ahead, aside = wheel.grasp(u, v, 0.4, GRIP)
    assert math.hypot(ahead, aside) == pytest.approx(GRIP * LOAD)
    assert math.atan2(-aside, -ahead) == pytest.approx(way, abs=0.02)


def test_what_it_gives_along_it_cannot_give_aside(wheel):
    sideways = []
    for rim in (4.0, 5.0):
        wheel.rest()
        wheel.load = LOAD
        for _ in range(STEPS_PER_SECOND):
            wheel.rim = rim
            ahead, aside = wheel.grasp(4.0, 0.3, 0.0, GRIP)
        assert math.hypot(ahead, aside) <= GRIP * LOAD * (1 + 1e-9)
        sideways.append(abs(aside))
    assert sideways[1] < sideways[0] / 2


def axles():
    return tuple((Wheel(x, 0.5, STIFFNESS, 0.3), Wheel(x, -0.5, STIFFNESS, 0.3)) for x in (-1.0, 1.0))


def footing():
    return Footing(axles(), mass=400.0, balance=(0.8, 0.5), below=0.5, rim=5.0)


def test_its_loads_are_the_weight_and_move_by_the_moment_of_what_accelerates_it():
    four, ground = footing(), Ground(0.0, GRIP)
    four.carry(FLAT, ground)
    (a, b), (c, d) = ((left.load, right.load) for left, right in four.axles)
    assert (a + b, c + d) == pytest.approx((0.6 * 400 * GRAVITY, 0.4 * 400 * GRAVITY))
    four.accelerated = (-2.0, 3.0)  # it brakes in a bend to the left
    four.carry(FLAT, ground)
    (p, q), (r, s) = ((left.load, right.load) for left, right in four.axles)
    assert p + q + r + s == pytest.approx(400 * GRAVITY)
    assert (r + s) - (c + d) == pytest.approx(400 * 2.0 * 0.5 / 2.0)
    assert (q + s) - (p + r) == pytest.approx(2 * 400 * 3.0 * 0.5 / 1.0)


def test_a_wheel_in_the_air_carries_nothing():
    four = footing()
    half = math.radians(-5) / 2
    nose_up = ((0.0, 0.0, 0.55), (0.0, math.sin(half), 0.0, math.cos(half)), (0.0,) * 3, (0.0,) * 3)
    four.carry(nose_up, Ground(0.0, GRIP))
    assert [wheel.load > 0 for axle in four.axles for wheel in axle] == [True, True, False, False]


def test_a_wheel_that_is_braked_no_harder_than_its_motor_can_takes_the_speed_it_is_told():
    four = footing()
    four.carry(FLAT, Ground(0.0, GRIP))
    assert abs(four.turn(0, 0.01, 1e6)) < 1e6
    assert [wheel.rim for wheel in four.axles[0]] == pytest.approx([0.01, 0.01])
    assert four.turn(0, 5.0, 100.0) == 100.0
    assert max(wheel.rim for wheel in four.axles[0]) < 0.2
