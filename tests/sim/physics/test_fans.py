from __future__ import annotations

import math
import random
from contextlib import closing

import numpy as np
import pytest

from sim.core.shapes import Shape, compose, from_yaw
from sim.physics.backend_bullet import Bullet
from sim.physics.bodies import Floating
from sim.world.world_files import WORLDS, load

UPRIGHT = (0.0, 0.0, 0.0, 1.0)
REACH, BEAMS = 12.0, 360
BUOY = Floating(Shape("box", (0.4, 0.4, 0.4)), 1.0, (0.1, 0.1, 0.1), (0.0, 0.0, 0.1), 0.4)
LYING = (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))


@pytest.fixture
def backend():
    with closing(Bullet()) as backend:
        yield backend


def eye_at(backend, x=0.0, y=0.0, z=0.0, rotation=UPRIGHT):
    """A small body that stands there."""
    eye = backend.add_body(Shape("sphere", (0.01, 0.01, 0.01)), 0.001)
    backend.place(eye, (x, y, z), rotation)
    return eye


def all_round(backend, body, *, start=(0.0, 0.0, 0.0), count=BEAMS, reach=REACH):
    return backend.fan(body, start, first=-math.pi, step=math.tau / count, count=count, reach=reach)


def by_the_engine(backend, body, fan):
    """The same beams, each asked of the physics engine."""
    return backend.rays(body, [fan.start] * fan.count, [fan.end(number) for number in range(fan.count)])


def leaning(roll, pitch, yaw):
    about_y = (0.0, math.sin(pitch / 2), 0.0, math.cos(pitch / 2))
    about_x = (math.sin(roll / 2), 0.0, 0.0, math.cos(roll / 2))
    return compose(from_yaw(yaw), compose(about_y, about_x))


def test_the_walls_of_a_room_are_as_far_away_as_geometry_says(backend):
    backend.add_static(
        (
            Shape("box", (0.2, 8.0, 1.0), (3.1, 0.0, 0.0)),
            Shape("box", (0.2, 8.0, 1.0), (-3.1, 0.0, 0.0)),
            Shape("box", (0.2, 8.0, 1.0), (0.0, 2.1, 0.0), from_yaw(math.pi / 2)),
            Shape("box", (8.0, 0.2, 1.0), (0.0, -2.1, 0.0)),
        )
    )
    fan = all_round(backend, eye := eye_at(backend))
    with np.errstate(divide="ignore"):
        expected = np.minimum(3.0 / np.abs(fan.cosines), 2.0 / np.abs(fan.sines))
    assert backend.sweep(eye, fan) * REACH == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(
    ("shape", "nearest"),
    [
        (Shape("box", (1.0, 1.0, 1.0), (4.0, 0.0, 0.0), from_yaw(math.pi / 4)), 4.0 - math.sqrt(0.5)),
        (Shape("cylinder", (1.0, 1.0, 1.0), (4.0, 0.0, 0.0)), 3.5),
        (Shape("cylinder", (1.0, 1.0, 2.0), (4.0, 0.0, 0.0), LYING), 3.5),
        (Shape("sphere", (1.0, 1.0, 1.0), (4.0, 0.0, 0.3)), 4.0 - 0.4),
        (Shape("cylinder", (1.2, 1.2, 1.0), (4.0, 0.0, 0.0), taper=(2 / 3, 2 / 3)), 3.5),
        (Shape("box", (1.0, 2.0, 1.0), (4.0, 0.0, 0.0), taper=(0.5, 1.0)), 4.0 - 0.375),
    ],
    ids=["box", "cylinder", "lying", "sphere", "frustum", "tapered box"],
)
def test_each_solid_is_met_where_geometry_says(backend, shape, nearest):
    backend.add_static((shape,))
    fan = all_round(backend, eye := eye_at(backend))
    reach = backend.sweep(eye, fan) * REACH
    assert reach[180] == pytest.approx(nearest, abs=1e-9)
    assert (reach < REACH).sum() == (by_the_engine(backend, eye, fan) < 1).sum()
    assert (reach[:150] == REACH).all()


def test_a_ball_is_met_all_over_as_its_equation_says(backend):
    backend.add_static((Shape("sphere", (2.0, 2.0, 2.0), (4.0, 0.0, 0.0)),))
    fan = all_round(backend, eye := eye_at(backend))
    reach = backend.sweep(eye, fan) * REACH
    inside = 1.0 - (4.0 * fan.sines) ** 2
    meets = (inside >= 0) & (fan.cosines > 0)
    assert ((reach < REACH) == meets).all()
    assert reach[meets] == pytest.approx(4.0 * fan.cosines[meets] - np.sqrt(inside[meets]), abs=1e-9)


@pytest.mark.parametrize("world", WORLDS)
def test_a_world_looks_as_the_engine_sees_it(backend, world):
    """From anywhere, leaning as a vehicle does: the engine grows tapered solids by a millimetre, is vague by a beam on edges, and cannot be asked from within a solid."""
    loaded, places = load(world), random.Random(1)
    backend.add_ground(loaded.bottom)
    for prop in loaded.props:
        if prop.solids:  # some are pictures alone
            backend.add_static(prop.solids)
    eye = eye_at(backend)
    fan, differing, met = all_round(backend, eye, start=(0.05, 0.0, 0.3)), 0, 0
    for _ in range(25):
        x, y = (places.uniform(-0.45, 0.45) * size for size in (loaded.ground.length, loaded.ground.width))
        rotation = leaning(places.gauss(0, 0.03), places.gauss(0, 0.03), places.uniform(-3.1, 3.1))
        backend.place(eye, (x, y, loaded.bottom + places.uniform(0.0, 0.4)), rotation)
        engine = by_the_engine(backend, eye, fan)
        if engine.min() > 0.05:
            differing += int((np.abs(backend.sweep(eye, fan) - engine) * REACH > 1e-2).sum())
            met += int((engine < 1.0).sum())
    assert met > 200
    assert differing < 0.015 * met


def test_beams_that_sink_meet_the_ground(backend):
    backend.add_ground(-1.0)
    eye = eye_at(backend, rotation=leaning(0.0, math.pi / 6, 0.7))
    reach = backend.sweep(eye, all_round(backend, eye)) * REACH
    assert reach[180] == pytest.approx(2.0, abs=1e-9)
    assert reach[240] == pytest.approx(4.0, abs=1e-9)
    assert reach[0] == REACH


def test_from_below_the_ground_a_sweep_does_not_meet_it_and_the_engine_does(backend):
    backend.add_ground(1.0)
    eye = eye_at(backend, rotation=leaning(0.0, math.pi / 6, 0.7))
    fan = all_round(backend, eye)
    assert (backend.sweep(eye, fan) == 1.0).all()
    assert by_the_engine(backend, eye, fan)[0] * REACH == pytest.approx(2.0, abs=1e-6)


def test_from_within_a_fixed_ball_a_sweep_looks_out_and_the_engine_is_blind_towards_its_middle(backend):
    backend.add_static((Shape("sphere", (1.0, 1.0, 1.0), (0.2, 0.0, 0.0)),))
    eye = eye_at(backend)
    fan = all_round(backend, eye)
    assert (backend.sweep(eye, fan) == 1.0).all()
    engine = by_the_engine(backend, eye, fan)
    assert (engine[fan.cosines > 0.01] == 0.0).all()
    assert (engine[fan.cosines < -0.01] == 1.0).all()


def test_the_engine_has_a_tapered_solid_a_millimetre_nearer_which_is_more_along_a_beam_that_grazes_it(
    backend,
):
    backend.add_static((Shape("box", (4.0, 1.0, 1.0), (3.0, 0.6, 0.0), taper=(1.0, 0.9)),))
    eye = eye_at(backend)
    fan = backend.fan(eye, (0.0, 0.0, 0.0), first=0.026, step=0.004, count=20, reach=REACH)
    farther = (backend.sweep(eye, fan) - by_the_engine(backend, eye, fan)) * REACH
    assert farther * fan.sines == pytest.approx(1e-3, abs=5e-5)
    assert farther[0] > 0.03


def test_another_vehicle_is_met_and_the_own_one_is_not(backend):
    own = backend.add_floating(BUOY, (0.0, 0.0, 0.0), UPRIGHT)
    backend.add_floating(BUOY, (0.0, 3.0, 0.0), UPRIGHT)
    backend.add_static((Shape("box", (0.2, 2.0, 2.0), (0.0, -5.1, 0.0), from_yaw(math.pi / 2)),))
    fan = all_round(backend, own)
    reach = backend.sweep(own, fan) * REACH
    assert reach[270] == pytest.approx(2.8, abs=5e-3)
    assert reach[90] == pytest.approx(5.0, abs=1e-9)
    assert reach == pytest.approx(by_the_engine(backend, own, fan) * REACH, abs=2e-3)


@pytest.mark.parametrize(
    ("x", "y", "z"), [(-2.0, 0.0, 0.0), (2.0, 0.1, 0.0), (0.0, 0.0, 0.7), (0.1, -0.1, 0.0)]
)
def test_what_moves_is_met_wherever_it_is(backend, x, y, z):
    """Straight behind, where the first and the last beam are; ahead; too high to be met; and round the laser itself."""
    own = backend.add_floating(BUOY, (0.0, 0.0, 0.0), UPRIGHT)
    backend.add_floating(BUOY, (x, y, z), UPRIGHT)
    fan = all_round(backend, own)
    assert backend.sweep(own, fan) * REACH == pytest.approx(
        by_the_engine(backend, own, fan) * REACH, abs=2e-3
    )


def test_a_wall_hides_what_moves_behind_it(backend):
    own = backend.add_floating(BUOY, (0.0, 0.0, 0.0), UPRIGHT)
    backend.add_static((Shape("box", (0.2, 2.0, 2.0), (2.1, 0.0, 0.0)),))
    backend.add_floating(BUOY, (4.0, 0.0, 0.0), UPRIGHT)
    assert backend.sweep(own, all_round(backend, own))[180] * REACH == pytest.approx(2.0, abs=1e-9)


def test_a_fan_may_span_a_part_of_the_circle(backend):
    backend.add_static(
        (Shape("box", (0.2, 8.0, 1.0), (-3.1, 0.0, 0.0)), Shape("box", (0.2, 8.0, 1.0), (3.1, 0.0, 0.0)))
    )
    eye = eye_at(backend)
    fan = backend.fan(eye, (0.0, 0.0, 0.0), first=-0.5, step=0.01, count=101, reach=REACH)
    assert backend.sweep(eye, fan) * REACH == pytest.approx(3.0 / fan.cosines, abs=1e-9)
    behind = backend.fan(eye, (0.0, 0.0, 0.0), first=math.pi - 0.5, step=0.01, count=101, reach=REACH)
    assert backend.sweep(eye, behind) * REACH == pytest.approx(-3.0 / behind.cosines, abs=1e-9)


def test_a_beam_that_starts_within_a_solid_looks_through_it(backend):
    backend.add_static((Shape("box", (1.0, 1.0, 1.0)), Shape("box", (0.2, 8.0, 1.0), (3.1, 0.0, 0.0))))
    eye = eye_at(backend)
    assert backend.sweep(eye, all_round(backend, eye))[180] * REACH == pytest.approx(3.0, abs=1e-9)


def test_a_sweep_does_not_depend_on_where_others_were_made(backend):
    loaded = load("parking_lot")
    for prop in loaded.props:
        if prop.solids:  # some are pictures alone
            backend.add_static(prop.solids)
    eye = eye_at(backend)
    fan = all_round(backend, eye)

    def seen(*ways):
        for x in ways:
            backend.place(eye, (x, -7.5, 0.3), from_yaw(0.3))
            found = backend.sweep(eye, fan)
        return found.tobytes()

    assert seen(-15.0, -14.3, 3.0) == seen(3.4, 3.0) == seen(-20.0, 3.0)


def test_an_empty_world_has_nothing_to_meet(backend):
    eye = eye_at(backend)
    assert (backend.sweep(eye, all_round(backend, eye)) == 1.0).all()


def test_a_sweep_holds_only_while_nothing_moves(backend):
    eye = eye_at(backend)
    fan = all_round(backend, eye)
    first = backend.sweep(eye, fan)
    assert backend.sweep(eye, fan) is first
    assert not first.flags.writeable
    backend.add_static((Shape("box", (0.2, 2.0, 2.0), (2.1, 0.0, 0.0)),))
    assert backend.sweep(eye, fan)[180] * REACH == pytest.approx(2.0, abs=1e-9)
    backend.place(eye, (1.0, 0.0, 0.0), UPRIGHT)
    assert backend.sweep(eye, fan)[180] * REACH == pytest.approx(1.0, abs=1e-9)
