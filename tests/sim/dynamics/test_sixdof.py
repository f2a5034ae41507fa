"""Bodies in water against what was published of them, and against what needs no model."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.core.shapes import Shape
from sim.dynamics.sixdof import Inertia, SixDof
from sim.physics.backend_bullet import Bullet
from sim.physics.bodies import Floating
from tests.sim.dynamics.otter import PUBLISHED, TOLD, sail

NEAR = {"straight": 0.005, "turn": 0.02, "zig-zag": 0.1}
"""How near we come to the published way [m]; in the zig-zag its own step of 5 ms makes 6 cm."""


@pytest.mark.parametrize("name", TOLD)
def test_an_otter_of_our_parts_goes_where_fossens_goes(name):
    """75 m straight, 58 m in a turn, 74 m of zig-zag: everywhere on the way."""
    way = sail(TOLD[name], 40.0)[STEPS_PER_SECOND - 1 :: STEPS_PER_SECOND]
    for ours, (_, *published) in zip(way, PUBLISHED[name], strict=True):
        assert math.dist(ours[:2], published[:2]) < NEAR[name]
        assert ours[2] == pytest.approx(published[2], abs=5e-3)
        assert ours[3:5] == pytest.approx(published[3:5], abs=3e-3)
        assert ours[5] == pytest.approx(published[5], abs=3e-3)


def test_its_figures_are_those_that_were_found_elsewhere_too():
    ahead = {name: rows[-1][4] for name, rows in PUBLISHED.items()}
    assert ahead["straight"] == 1.9287
    assert ahead["turn"] == 1.4879
    assert math.degrees(PUBLISHED["turn"][-1][6]) == pytest.approx(-9.524, abs=0.005)


def ellipsoid(munk, centre=(0.0, 0.0, 0.0)):
    """A slender body that carries more water athwart than along."""
    backend = Bullet()
    mass, moments = 10.0, (0.1, 0.6, 0.6)
    spec = Floating(Shape("box", (1.0, 0.2, 0.2)), mass, moments, centre, 0.4)
    number = backend.add_floating(spec, (0.0, 0.0, 5.0), (0.0, 0.0, 0.0, 1.0))
    inertia = Inertia(mass, centre, moments, 0.0, (1.0, 9.0, 9.0), (0.01, 0.5, 0.5))
    return backend, number, SixDof(backend, number, inertia, munk=munk)


def drift(munk, seconds, velocity, turning=(0.0, 0.0, 0.0), force=(0.0, 0.0, 0.0), centre=(0.0, 0.0, 0.0)):
    backend, number, body = ellipsoid(munk, centre)
    backend.set_velocity(number, velocity, turning)
    for _ in range(round(seconds * STEPS_PER_SECOND)):
        body.update((0.0, 0.0, 0.0))
        body.apply(force, (0.0, 0.0, 0.0))
        backend.step()
    body.update((0.0, 0.0, 0.0))
    backend.close()
    return body


def test_a_force_accelerates_the_body_and_the_water_that_it_carries():
    along = drift(False, 1.0, (0.0, 0.0, 0.0), force=(2.0, 0.0, 0.0))
    athwart = drift(False, 1.0, (0.0, 0.0, 0.0), force=(0.0, 2.0, 0.0))
    assert along.through[0] == pytest.approx(2.0 / 11.0, rel=1e-9)
    assert athwart.through[1] == pytest.approx(2.0 / 19.0, rel=1e-9)


def test_a_slender_body_left_alone_keeps_its_energy_while_it_turns_athwart():
    """The Munk moment turns it, and gives it no energy."""
    started = 0.5 * (11.0 * 1.0**2 + 19.0 * 0.05**2)
    body = drift(True, 3.0, (1.0, 0.05, 0.0))
    (u, v, w), (p, q, r) = body.through, body.turning
    kept = 0.5 * (11.0 * u * u + 19.0 * (v * v + w * w) + 0.11 * p * p + 1.1 * (q * q + r * r))
    assert abs(r) > 0.1
    assert kept == pytest.approx(started, rel=0.02)


def test_without_that_moment_it_stays_on_its_way():
    assert abs(drift(False, 3.0, (1.0, 0.05, 0.0)).turning[2]) < 1e-9


def test_a_weight_off_the_origin_swings_round_as_newton_says():
    """Free of the water's mass a thrown body moves on straight by its centre of mass, wherever its origin lies."""
    backend = Bullet()
    spec = Floating(Shape("box", (1.0, 0.2, 0.2)), 10.0, (0.1, 0.6, 0.6), (0.3, 0.0, 0.1), 0.4)
    number = backend.add_floating(spec, (0.0, 0.0, 5.0), (0.0, 0.0, 0.0, 1.0))
    body = SixDof(backend, number, Inertia(10.0, (0.3, 0.0, 0.1), (0.1, 0.6, 0.6)))
    backend.set_velocity(number, (0.5, 0.0, 0.0), (0.0, 0.0, 1.0))
    for _ in range(2 * STEPS_PER_SECOND):
        body.update((0.0, 0.0, 0.0))
        body.apply((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        backend.step()
    at, _, velocity, turning = backend.motion(number)
    backend.close()
    assert velocity == pytest.approx((0.5, 0.0, 0.0), abs=2e-3)
    assert at == pytest.approx((1.3, 0.0, 5.1), abs=2e-3)
    assert turning[2] == pytest.approx(1.0, abs=5e-3)


def cross(vector):
    """The matrix that multiplies crosswise by a vector."""
    x, y, z = vector
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def whole(inertia):
    """The 6 x 6 mass matrices of the body and of the water about the origin, as Fossen's handbook (2021, 3.3 and 6.3) has them."""
    turned = cross(inertia.centre)
    moments = np.diag(inertia.moments)
    moments[0, 2] = moments[2, 0] = inertia.product
    body = np.block(
        [
            [inertia.mass * np.eye(3), -inertia.mass * turned],
            [inertia.mass * turned, moments - inertia.mass * turned @ turned],
        ]
    )
    return body, np.diag((*inertia.added_mass, *inertia.added_moments))


def coriolis(matrix, motion):
    """Force and torque of a mass matrix that moves so (his theorem 3.2)."""
    linear, angular = np.split(matrix @ motion, 2)
    velocity, turning = np.split(motion, 2)
    return np.concatenate(
        [np.cross(turning, linear), np.cross(turning, angular) + np.cross(velocity, linear)]
    )


class Engine:
    """Holds one body still in any motion, and keeps what force and torque it is given."""

    def __init__(self, at, rotation, velocity, turning):
        self.now = (tuple(at), tuple(rotation.as_quat()), tuple(velocity), tuple(turning))

    def motion(self, _):
        return self.now

    def apply(self, _, at, force, torque):
        self.given = (at, force, torque)


@pytest.mark.parametrize("munk", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_however_it_moves_the_engine_is_given_what_the_equations_of_a_body_in_water_ask_for(seed, munk):
    """In any attitude and motion, in a current, with the centre of mass off the origin and a product of inertia."""
    rng = np.random.default_rng(seed)
    centre = (*rng.uniform(-0.3, 0.3, 2), 0.0)
    inertia = Inertia(
        12.0,
        (centre[0], 0.0, centre[1]),
        (0.5, 1.4, 1.7),
        0.12,
        tuple(rng.uniform(1.0, 20.0, 3)),
        tuple(rng.uniform(0.1, 2.0, 3)),
    )
    rotation = Rotation.random(random_state=seed)
    flow, velocity, turning = rng.uniform(-1.0, 1.0, (3, 3))
    force, torque = rng.uniform(-5.0, 5.0, (2, 3))
    engine = Engine(rng.uniform(-9.0, 9.0, 3), rotation, velocity, turning)
    body = SixDof(engine, 1, inertia, munk=munk)
    body.update(tuple(flow))
    body.apply(tuple(force), tuple(torque))

    spin = rotation.inv().apply(turning)
    arm = np.array(inertia.centre)
    through = rotation.inv().apply(velocity - flow) - np.cross(spin, arm)
    motion = np.concatenate([through, spin])
    own, water = whole(inertia)
    pull = coriolis(own + water, motion)
    if not munk:
        pull[3:] -= np.cross(through, water[:3, :3] @ through)
    acceleration, turned = np.split(np.linalg.solve(own + water, np.concatenate([force, torque]) - pull), 2)
    of_mass = acceleration + np.cross(turned, arm) + np.cross(spin, through + np.cross(spin, arm))
    bare = np.diag(inertia.moments)
    at, pushed, twisted = engine.given
    assert body.through == pytest.approx(tuple(through))
    assert body.position == pytest.approx(tuple(np.array(at) - rotation.apply(arm)))
    expected = np.add(rotation.apply(inertia.mass * of_mass), (0.0, 0.0, inertia.mass * GRAVITY))
    assert pushed == pytest.approx(tuple(expected))
    assert twisted == pytest.approx(tuple(rotation.apply(bare @ turned + np.cross(spin, bare @ spin))))


def test_thrown_with_a_spin_it_tumbles_as_eulers_equations_say():
    """Three different moments of inertia, spinning nearly about the middle one: the axis turns over."""
    moments, start, seconds = (0.2, 0.35, 0.5), (0.4, 3.0, -0.3), 3.0
    backend = Bullet()
    spec = Floating(Shape("box", (0.4, 0.3, 0.2)), 10.0, moments, (0.0, 0.0, 0.0), 0.4)
    number = backend.add_floating(spec, (0.0, 0.0, 5.0), (0.0, 0.0, 0.0, 1.0))
    body = SixDof(backend, number, Inertia(10.0, (0.0, 0.0, 0.0), moments))
    backend.set_velocity(number, (0.0, 0.0, 0.0), start)
    for _ in range(round(seconds * STEPS_PER_SECOND)):
        body.update((0.0, 0.0, 0.0))
        body.apply((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        backend.step()
    body.update((0.0, 0.0, 0.0))
    backend.close()
    tensor = np.array(moments)
    euler = solve_ivp(
        lambda _, spin: -np.cross(spin, tensor * spin) / tensor, (0.0, seconds), start, rtol=1e-9, atol=1e-12
    )
    assert body.turning == pytest.approx(tuple(euler.y[:, -1]), abs=0.1)
    assert min(euler.y[1]) < 0.0 < max(euler.y[1]), "it turned over"
