from __future__ import annotations

import logging
import math

import numpy as np
import pytest

from sim.core.shapes import from_yaw
from sim.physics.backend_bullet import SKY
from sim.rendering.tiny_renderer import TinyRenderer
from sim.rendering.view import View
from sim.world.world_files import load
from tests.sim.rooms import orange


@pytest.fixture(scope="module")
def world():
    return load("parking_lot")


@pytest.fixture
def renderer(world):
    renderer = TinyRenderer(world)
    yield renderer
    renderer.close()


def ahead_of_cone(world):
    cone = world.cones[2]
    return View((cone.x - 3.0, cone.y, 0.36), from_yaw(0.0), (640, 480), 1.2)


def test_it_draws_a_cone_orange_in_the_middle_below_the_sky(world, renderer):
    assert renderer.show(ahead_of_cone(world), 1.0) == []
    (stamp, picture), *_ = renderer.show(ahead_of_cone(world), 2.0)
    red, _, blue = (picture[:, :, i].astype(int) for i in range(3))
    columns = np.nonzero(orange(picture))[1]
    assert stamp == 1.0
    assert picture.shape == (240, 320, 3)
    assert columns.mean() == pytest.approx(160, abs=3)
    assert tuple(picture[2, 160]) == SKY
    assert math.isclose(float(red[230, 40]), float(blue[230, 40]), abs_tol=20)


def test_a_picture_is_given_once(world, renderer):
    renderer.show(ahead_of_cone(world), 1.0)
    assert len(renderer.show(ahead_of_cone(world), 2.0)) == 1
    renderer.close()
    assert renderer.ready() == []


def test_the_end_of_its_process_is_told_and_ends_the_pictures(world, renderer, caplog):
    renderer.show(ahead_of_cone(world), 1.0)
    renderer._process.kill()
    renderer._process.join()
    with caplog.at_level(logging.WARNING):
        renderer.show(ahead_of_cone(world), 2.0)
        assert renderer.show(ahead_of_cone(world), 3.0) == []
    assert "there are no more" in caplog.text


def test_the_end_of_its_process_between_two_pictures_is_told_too(world, renderer, caplog):
    renderer._process.kill()
    renderer._process.join()
    with caplog.at_level(logging.WARNING):
        assert renderer.show(ahead_of_cone(world), 1.0) == []
        assert renderer.show(ahead_of_cone(world), 2.0) == []
    assert "there are no more" in caplog.text


def test_closing_twice_does_nothing(renderer):
    renderer.close()
    renderer.close()
