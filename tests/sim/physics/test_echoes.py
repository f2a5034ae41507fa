"""Strength of a laser's echoes against the geometry of what the beams meet."""

from __future__ import annotations

import math
from contextlib import closing

import numpy as np
import pytest

from sim.core.noise import Noise
from sim.core.shapes import Shape, compose, from_yaw
from sim.physics.backend_bullet import Bullet
from sim.physics.bodies import Floating
from sim.robot import ROBOTS
from sim.sensors.laser import Laser
from sim.world.props_docks import STRIP_SPACING, STRIP_WIDTH
from sim.world.world_files import WORLDS, load

UPRIGHT = (0.0, 0.0, 0.0, 1.0)
REACH = 12.0
GREY = (0.5, 0.5, 0.5)
WHITE = (1.0, 1.0, 1.0)


@pytest.fixture
def backend():
    with closing(Bullet()) as backend:
        yield backend


def eye_at(backend, x=0.0, y=0.0, z=0.0, rotation=UPRIGHT):
    eye = backend.add_body(Shape("sphere", (0.01, 0.01, 0.01)), 0.001)
    backend.place(eye, (x, y, z), rotation)
    return eye


def ahead(backend, body, half=0.3, count=121):
    """A fan of beams round straight ahead."""
    return backend.fan(
        body, (0.0, 0.0, 0.0), first=-half, step=2 * half / (count - 1), count=count, reach=REACH
    )


def bearings(fan):
    return np.arctan2(fan.sines, fan.cosines)


@pytest.mark.parametrize("turned", [0.0, 0.4, -0.9])
def test_a_flat_wall_answers_by_its_colour_and_the_cosine_of_the_angle(backend, turned):
    backend.add_static((Shape("box", (0.2, 60.0, 2.0), (3.0, 0.0, 0.0), from_yaw(turned), GREY),))
    fan = ahead(backend, eye := eye_at(backend))
    expected = 99 * 0.5 * np.abs(np.cos(bearings(fan) - turned))
    assert backend.echoes(eye, fan).strength == pytest.approx(expected, abs=0.501)


def test_a_wall_that_leans_answers_by_its_normal(backend):
    lean = compose(UPRIGHT, (0.0, math.sin(0.35), 0.0, math.cos(0.35)))
    backend.add_static((Shape("box", (0.2, 20.0, 3.0), (3.0, 0.0, 0.0), lean, WHITE),))
    fan = ahead(backend, eye := eye_at(backend))
    expected = 99 * math.cos(0.7) * np.cos(bearings(fan))
    assert backend.echoes(eye, fan).strength == pytest.approx(expected, abs=0.501)


@pytest.mark.parametrize("kind", ["cylinder", "sphere"])
def test_a_round_thing_answers_less_towards_its_edge(backend, kind):
    backend.add_static((Shape(kind, (2.0, 2.0, 2.0), (4.0, 0.0, 0.0), colour=WHITE),))
    fan = ahead(backend, eye := eye_at(backend))
    aside = 4.0 * np.abs(fan.sines)
    expected = np.where(aside < 1.0, 99 * np.sqrt(np.maximum(0.0, 1.0 - aside**2)), 0.0)
    assert backend.echoes(eye, fan).strength == pytest.approx(expected, abs=0.501)


def test_the_end_of_a_lying_cylinder_is_flat(backend):
    lying = (0.0, math.sqrt(0.5), 0.0, math.sqrt(0.5))
    backend.add_static((Shape("cylinder", (6.0, 6.0, 1.0), (4.0, 0.0, 0.0), lying, WHITE),))
    fan = ahead(backend, eye := eye_at(backend))
    assert backend.echoes(eye, fan).strength == pytest.approx(99 * fan.cosines, abs=0.501)


def test_a_tapered_solid_answers_by_its_slope(backend):
    backend.add_static((Shape("box", (2.0, 20.0, 1.0), (4.0, 0.0, 0.0), colour=WHITE, taper=(0.5, 1.0)),))
    fan = ahead(backend, eye := eye_at(backend))
    assert backend.echoes(eye, fan).strength == pytest.approx(
        99 * math.cos(math.atan(0.5)) * fan.cosines, abs=0.501
    )


def test_the_ground_answers_a_laser_that_leans(backend):
    backend.add_ground(-1.0)
    eye = eye_at(backend, rotation=(0.0, math.sin(0.25), 0.0, math.cos(0.25)))
    fan = ahead(backend, eye)
    assert backend.echoes(eye, fan).strength == pytest.approx(
        99 * 0.3 * math.sin(0.5) * fan.cosines, abs=0.501
    )


def test_what_hides_another_thing_answers_and_what_moves_too(backend):
    own = backend.add_floating(
        Floating(Shape("box", (0.2, 0.2, 0.2)), 1.0, (0.1,) * 3, (0.0,) * 3, 0.4), (0.0,) * 3, UPRIGHT
    )
    backend.add_static((Shape("box", (0.2, 8.0, 2.0), (5.0, 0.0, 0.0), colour=WHITE),))
    backend.add_static((Shape("box", (0.2, 0.3, 2.0), (2.0, 0.0, 0.0), colour=(0.0, 0.0, 0.0)),))
    backend.add_floating(
        Floating(Shape("box", (0.2, 0.4, 0.4)), 1.0, (0.1,) * 3, (0.0,) * 3, 0.4), (3.0, 0.7, 0.0), UPRIGHT
    )
    fan = ahead(backend, own)
    echoes = backend.echoes(own, fan)
    moving = np.abs(3.0 * np.tan(bearings(fan)) - 0.69) < 0.15
    assert (echoes.strength[np.abs(bearings(fan)) < 0.06] == 0).all()
    assert echoes.strength[moving] == pytest.approx(99 * 0.35 * fan.cosines[moving], abs=1.0)
    assert (echoes.strength[bearings(fan) < -0.1] > 90).all()


@pytest.mark.parametrize("degrees", [0, 20, 40, 59])
def test_what_throws_light_back_does_so_up_to_sixty_degrees(backend, degrees):
    strip = Shape(
        "box", (0.002, 0.05, 0.4), (2.0, 0.0, 0.0), from_yaw(math.radians(degrees)), WHITE, retro=True
    )
    backend.add_static((strip,))
    fan = ahead(backend, eye := eye_at(backend), 0.005, 3)
    (strength,) = set(backend.echoes(eye, fan).strength[1:2].tolist())
    assert strength == pytest.approx(200 + 110 * (math.cos(math.radians(degrees)) - 0.5), abs=0.501)


def test_seen_more_askew_it_is_as_matt_as_anything_white(backend):
    strip = Shape("box", (0.002, 0.05, 0.4), (2.0, 0.0, 0.0), from_yaw(math.radians(62)), WHITE, retro=True)
    backend.add_static((strip,))
    fan = ahead(backend, eye := eye_at(backend), 0.005, 3)
    assert backend.echoes(eye, fan).strength[1] == pytest.approx(99 * math.cos(math.radians(62)), abs=0.501)


def scan_in(world, x, y, yaw, name):
    own = ROBOTS[name].parameters.laser
    with closing(Bullet()) as backend:
        backend.add_ground(world.bottom)
        for prop in world.props:
            if prop.solids:
                backend.add_static(prop.solids)
        eye = eye_at(backend, x, y, world.bottom, from_yaw(yaw))
        return Laser(own, backend, eye, Noise(0, "laser", on=False)).measure(0.0)


@pytest.mark.parametrize("name", ["patrol", "commander"])
@pytest.mark.parametrize("world", [name for name in WORLDS if load(name).water is None])
def test_in_front_of_a_dock_a_laser_sees_its_two_strips_and_nothing_else_as_bright(world, name):
    loaded = load(world)
    (dock,) = (each for each in loaded.docks if each.kind == "contacts")
    for back, aside in ((1.0, 0.2), (1.5, -0.4), (1.9, 0.3)):
        cosine, sine = math.cos(dock.angle), math.sin(dock.angle)
        front = ROBOTS[name].parameters.laser.ahead + back
        x, y = dock.x - cosine * front - sine * aside, dock.y - sine * front + cosine * aside
        scan = scan_in(loaded, x, y, dock.angle, name)
        ranges = np.frombuffer(scan.ranges, dtype=np.float32)
        shine = np.frombuffer(scan.intensities, dtype=np.float32)
        angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
        assert len(shine) == len(ranges)
        assert (shine[~np.isfinite(ranges)] == 0).all()
        bright = shine >= 200
        assert (shine[~bright] < 100).all()
        assert (shine <= 255).all()
        left = ranges[bright] * np.sin(angles[bright]) + aside
        assert ranges[bright] * np.cos(angles[bright]) == pytest.approx(back, abs=1e-3)
        for side in (1, -1):
            strip = left[np.sign(left) == side] - side * STRIP_SPACING / 2
            assert len(strip) >= 1
            assert (np.abs(strip) <= STRIP_WIDTH / 2 + 1e-3).all()
