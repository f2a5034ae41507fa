from __future__ import annotations

import math
import subprocess
import sys

import numpy as np
import pytest

from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.core.shapes import Shape, from_yaw
from sim.physics.backend_bullet import Bullet
from sim.physics.bodies import Floating


@pytest.fixture
def backend():
    backend = Bullet()
    yield backend
    backend.close()


def test_a_body_falls_as_newton_says(backend):
    ball = backend.add_body(Shape("sphere", (0.2, 0.2, 0.2), (0.0, 0.0, 100.0)), 1.0)
    for _ in range(STEPS_PER_SECOND):
        backend.step()
    state = backend.state(ball)
    assert state.velocity[2] == pytest.approx(-GRAVITY, abs=1e-9)
    # Semi-implicit Euler falls one step further than half g t squared.
    assert 100.0 - state.position[2] == pytest.approx(GRAVITY / 2 * (1 + 1 / STEPS_PER_SECOND), abs=1e-6)


def test_a_body_comes_to_rest_on_the_ground(backend):
    backend.add_ground()
    box = backend.add_body(Shape("box", (0.2, 0.2, 0.2), (0.0, 0.0, 0.3)), 1.0)
    for _ in range(2 * STEPS_PER_SECOND):
        backend.step()
    assert backend.state(box).position[2] == pytest.approx(0.1, abs=2e-3)


def ring(count, reach):
    angles = [math.tau * i / count for i in range(count)]
    return angles, [(reach * math.cos(angle), reach * math.sin(angle), 0.0) for angle in angles]


def measure(backend, shapes, count=360, reach=10.0):
    """Distances from the origin to `shapes`, all belonging to one thing."""
    backend.add_static(shapes)
    eye = backend.add_body(Shape("sphere", (0.01, 0.01, 0.01)), 0.001)
    angles, ends = ring(count, reach)
    hits = backend.rays(eye, [(0.0, 0.0, 0.0)] * count, ends)
    backend.close()
    return np.array(angles), hits * reach


def test_rays_measure_a_rectangular_room_exactly(backend):
    walls = (
        Shape("box", (0.2, 8.0, 1.0), (3.1, 0.0, 0.0)),
        Shape("box", (0.2, 8.0, 1.0), (-3.1, 0.0, 0.0)),
        Shape("box", (8.0, 0.2, 1.0), (0.0, 2.1, 0.0)),
        Shape("box", (8.0, 0.2, 1.0), (0.0, -2.1, 0.0)),
    )
    angles, measured = measure(backend, walls)
    with np.errstate(divide="ignore"):
        expected = np.minimum(3.0 / np.abs(np.cos(angles)), 2.0 / np.abs(np.sin(angles)))
    assert np.abs(measured - expected).max() < 1e-4


@pytest.mark.parametrize(
    "shape",
    [
        Shape("cylinder", (1.0, 1.0, 1.0), (4.0, 0.0, 0.0)),
        Shape("sphere", (1.0, 1.0, 1.0), (4.0, 0.0, 0.0)),
        Shape("cylinder", (1.2, 1.2, 1.0), (4.0, 0.0, 0.0), taper=(2 / 3, 2 / 3)),
    ],
    ids=["cylinder", "sphere", "frustum"],
)
def test_rays_measure_a_round_thing_to_a_centimetre(backend, shape):
    _, measured = measure(backend, (shape,))
    assert measured[0] == pytest.approx(3.5, abs=0.012)
    assert measured[90] == pytest.approx(10.0)


def test_rays_turn_with_the_body_they_come_from(backend):
    backend.add_static((Shape("box", (0.2, 2.0, 2.0), (0.0, 5.1, 0.0), from_yaw(math.pi / 2)),))
    eye = backend.add_body(Shape("box", (0.1, 0.1, 0.1)), 1.0)
    backend.place(eye, (0.0, 0.0, 0.0), from_yaw(math.pi / 2))
    assert backend.rays(eye, [(0.0, 0.0, 0.0)], [(10.0, 0.0, 0.0)])[0] * 10 == pytest.approx(5.0, abs=1e-4)


def test_the_engine_prints_nothing_and_leaves_standard_output_working():
    program = (
        "import os; os.write(1, b'before '); from sim.physics.backend_bullet import Bullet; "
        "b = Bullet(); b.add_ground(); b.step(); b.close(); print('after')"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=True
    )
    assert done.stdout == "before after\n"
    assert done.stderr == ""


def test_closing_twice_does_nothing(backend):
    backend.close()
    backend.close()


@pytest.mark.parametrize("count", [16, 17, 40])
def test_a_thing_of_many_solids_has_them_all(backend, count):
    backend.add_static([Shape("sphere", (0.1, 0.1, 0.1), (1.0 + 0.5 * i, 0.0, 0.0)) for i in range(count)])
    eye = backend.add_body(Shape("sphere", (0.01, 0.01, 0.01)), 0.001)
    starts = [(1.0 + 0.5 * i, 0.0, 2.0) for i in range(count)]
    hits = backend.rays(eye, starts, [(x, y, -z) for x, y, z in starts])
    assert (hits < 1.0).all()


def test_a_thing_of_several_solids_has_the_tapered_ones_too(backend):
    tapered = Shape("cylinder", (0.2, 0.2, 1.0), (1.0, 0.0, 0.0), taper=(0.7, 0.7))
    first = backend.add_static((tapered, Shape("sphere", (0.2, 0.2, 0.2), (2.0, 0.0, 0.0))))
    eye = backend.add_body(Shape("sphere", (0.01, 0.01, 0.01)), 0.001)
    hits = backend.rays(eye, [(0.0, 0.0, 0.0), (2.0, 0.0, 2.0)], [(1.5, 0.0, 0.0), (2.0, 0.0, 0.0)])
    assert hits * (1.5, 2.0) == pytest.approx((0.915, 1.9), abs=5e-3)
    assert first >= 0


BUOY = Floating(Shape("box", (0.4, 0.4, 0.4)), 1.0, (0.1, 0.1, 0.1), (0.0, 0.0, 0.1), 0.4)


def test_a_vehicles_rays_look_through_itself_and_not_through_another(backend):
    own = backend.add_floating(BUOY, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    backend.add_floating(BUOY, (0.0, 3.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    through = backend.ray_points(own, [(2.0, 0.0, 0.0), (2.0, 3.0, 0.0)])
    hits = backend.rays(own, through, backend.ray_points(own, [(-2.0, 0.0, 0.0), (-2.0, 3.0, 0.0)]))
    assert hits[0] == 1.0
    assert hits[1] * 4.0 == pytest.approx(1.8, abs=0.05)


def test_what_is_put_somewhere_else_lies_still_there_however_it_moved(backend):
    buoy = backend.add_floating(BUOY, (0.0, 0.0, 5.0), (0.0, 0.0, 0.0, 1.0))
    backend.set_velocity(buoy, (1.0, 2.0, 3.0), (0.5, 0.5, 0.5))
    backend.step()
    backend.place(buoy, (4.0, 5.0, 6.0), from_yaw(1.0))
    state = backend.state(buoy)
    assert (*state.velocity, *state.turning) == (0.0,) * 6
    assert state.position == pytest.approx((4.0, 5.0, 6.0))
    assert state.rotation == pytest.approx(from_yaw(1.0))


@pytest.mark.parametrize("grip", [0.65, 0.5, 0.2])
@pytest.mark.parametrize("way", [0.0, 0.4, math.pi / 4])
def test_on_the_ground_a_body_slides_as_far_as_the_stated_friction_has_it(backend, grip, way):
    """v²/2μg in every direction, with its own friction of 1: no other factor comes in."""
    backend.add_ground(0.0, grip)
    box = Floating(Shape("box", (0.4, 0.4, 0.1)), 10.0, (0.2, 0.2, 0.3), (0.0, 0.0, 0.0), 1.0)
    body = backend.add_floating(box, (0.0, 0.0, 0.05), (0.0, 0.0, 0.0, 1.0))
    backend.step()
    backend.set_velocity(body, (2.0 * math.cos(way), 2.0 * math.sin(way), 0.0), (0.0, 0.0, 0.0))
    start = backend.state(body).position
    for _ in range(3 * STEPS_PER_SECOND):
        backend.step()
    slid = math.dist(start, backend.state(body).position)
    assert slid == pytest.approx(2.0**2 / (2 * grip * GRAVITY), rel=0.02)


def test_against_a_thing_a_body_has_its_own_friction_and_not_half_of_it(backend):
    backend.add_static((Shape("box", (20.0, 4.0, 1.0), (0.0, 0.0, -0.5)),))
    box = Floating(Shape("box", (0.4, 0.4, 0.1)), 10.0, (0.2, 0.2, 0.3), (0.0, 0.0, 0.0), 0.4)
    body = backend.add_floating(box, (0.0, 0.0, 0.05), (0.0, 0.0, 0.0, 1.0))
    backend.step()
    backend.set_velocity(body, (2.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    for _ in range(3 * STEPS_PER_SECOND):
        backend.step()
    assert backend.state(body).position[0] == pytest.approx(2.0**2 / (2 * 0.4 * GRAVITY), rel=0.02)
