from __future__ import annotations

import math
import threading

import msgspec
import numpy as np
import pytest
from PIL import Image

from sim.core.shapes import Shape, from_yaw
from sim.rendering import renderer as module
from sim.rendering.renderer import NoRendererError, Renderer
from sim.rendering.view import View
from sim.world.ground_picture import markings
from sim.world.world_files import load
from tests.sim.rooms import orange, room

SIZE = (640, 480)
FIELD = 1.2


@pytest.fixture(scope="module")
def world():
    return load("parking_lot")


@pytest.fixture(scope="module")
def renderer(world):
    renderer = Renderer(world)
    yield renderer
    renderer.close()


def view(x, y, yaw, size=SIZE):
    return View((x, y, 0.36), from_yaw(math.radians(yaw)), size, FIELD)


def mean(picture, rows, columns):
    return picture[rows[0] : rows[1], columns[0] : columns[1]].reshape(-1, 3).mean(axis=0)


def test_a_picture_has_the_size_asked_for(renderer):
    assert renderer.render(view(-17, -7.5, 0, (320, 200))).shape == (200, 320, 3)


def test_the_sky_is_blue_above_and_the_asphalt_grey_below(renderer):
    picture = renderer.render(view(-17.0, -7.5, 0.0))
    red, green, blue = mean(picture, (0, 80), (0, 640))
    assert blue > green > red
    assert max(mean(picture, (400, 480), (0, 640))) - min(mean(picture, (400, 480), (0, 640))) < 15


def test_a_cone_ahead_is_orange_with_a_white_band_and_stands_where_it_should(world, renderer):
    cone = world.cones[2]
    picture = renderer.render(view(cone.x - 3.0, cone.y, 0.0))
    rows, columns = np.nonzero(orange(picture))
    assert columns.mean() == pytest.approx(320, abs=3)
    focal = 320 / math.tan(FIELD / 2)
    assert rows.min() == pytest.approx(240 - focal * (cone.height - 0.36) / 3.0, abs=6)
    assert rows.max() == pytest.approx(240 + focal * 0.36 / 2.85, abs=6)
    middle = picture[rows.min() : rows.max(), 320].astype(int)
    assert (middle.min(axis=1) > 150).sum() > 10


def test_nothing_but_cones_is_orange(world):
    bare = Renderer(msgspec.structs.replace(world, cones=()))
    for x, y in ((-17.5, -12.0), (-10.0, 7.5), (4.0, -7.5), (17.5, 0.0)):
        for yaw in range(0, 360, 60):
            assert orange(bare.render(view(x, y, yaw))).sum() < 10, (x, y, yaw)
    bare.close()


def test_what_is_left_in_the_world_is_left_in_the_picture():
    bare = room()
    renderer = Renderer(bare)
    post = Shape("box", (0.2, 0.2, 1.0), (3.0, 1.0, 0.5), colour=(1.0, 0.0, 0.0), glow=1.0)
    picture = renderer.render(view(0.0, 0.0, 0.0), [post])
    renderer.close()
    red = (picture[:, :, 0] > 200) & (picture[:, :, 1] < 40)
    assert np.nonzero(red)[1].mean() == pytest.approx(320 - 320 / math.tan(FIELD / 2) / 2.95, abs=5)


def test_the_same_view_gives_the_same_picture_and_another_gives_another(renderer):
    first = renderer.render(view(-17.0, -7.5, 10.0))
    assert (renderer.render(view(-17.0, -7.5, 10.0)) == first).all()
    assert (renderer.render(view(-17.0, -7.5, 20.0)) != first).any()


def test_moving_shapes_are_drawn_only_while_they_are_given(renderer):
    ball = Shape("sphere", (0.5, 0.5, 0.5), (-15.0, -7.5, 0.4), colour=(0.0, 1.0, 0.0), glow=1.0)
    without = renderer.render(view(-17.0, -7.5, 0.0))
    assert (renderer.render(view(-17.0, -7.5, 0.0), [ball]) != without).any()
    assert (renderer.render(view(-17.0, -7.5, 0.0)) == without).all()


def test_seen_from_above_north_is_up_and_east_is_right(world, renderer):
    picture = renderer.render(View.from_above(46.0, 36.0, 920))
    car = world.cars[0]
    row, column = round((18.0 - car.y) * 20), round((23.0 + car.x) * 20)
    red, green, blue = mean(picture, (row - 8, row + 8), (column - 8, column + 8))
    assert red > green + 40
    assert red > blue + 40


def test_a_picture_may_be_drawn_in_another_thread(renderer):
    wanted = renderer.render(view(-17.0, -7.5, 0.0))
    drawn = []
    thread = threading.Thread(target=lambda: drawn.append(renderer.render(view(-17.0, -7.5, 0.0))))
    thread.start()
    thread.join()
    assert (drawn[0] == wanted).all()


def test_a_machine_without_egl_is_told_in_one_sentence(monkeypatch):
    def fail(**_):
        raise Exception("eglInitialize failed (0x3001)")  # noqa: TRY002  # as glcontext does

    monkeypatch.setattr(module.moderngl, "create_context", fail)
    with pytest.raises(NoRendererError, match=r"cannot be drawn by OpenGL here: eglInitialize failed"):
        Renderer(room())


def test_shadows_fall_away_from_the_sun(world):
    size, data = markings(world)
    light = np.frombuffer(data, dtype=np.uint8).reshape(size[1], size[0], 2)[:, :, 1]
    cone = world.cones[2]
    row, column = round((cone.y + 15) / 0.02), round((cone.x + 20) / 0.02)
    assert light[row + 15, column + 14] < light[row - 30, column - 28] - 30


def test_arrows_are_painted_where_the_file_puts_them(world):
    size, data = markings(world)
    paint = Image.frombytes("LA", size, data).getchannel("L")
    arrow = world.arrows[0]
    assert paint.getpixel((round((arrow.x + 20) / 0.02), round((arrow.y + 15) / 0.02))) > 200
    assert paint.getpixel((round((arrow.x + 20) / 0.02), round((arrow.y + 17) / 0.02))) == 0
