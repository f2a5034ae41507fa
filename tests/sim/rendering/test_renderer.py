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


def blue_sky(picture):
    red, green, blue = (picture[:, :, i].astype(int) for i in range(3))
    return (blue > red + 30) & (blue > green + 8) & (blue > 150)


def test_no_sky_is_seen_in_a_corridor_but_through_a_window():
    office = load("office")
    renderer = Renderer(office)
    for x, yaw in ((-8.5, 0.0), (0.0, 0.0), (6.0, 0.0)):
        picture = renderer.render(view(x, 0.0, yaw))
        assert blue_sky(picture[:, 200:440]).sum() == 0, (x, yaw)
        assert picture[0:40].mean() > 60, "the ceiling is lit"
    room_with_window = renderer.render(view(2.0, 2.9, 90.0))
    renderer.close()
    assert blue_sky(room_with_window).sum() > 2000
    bare = Renderer(msgspec.structs.replace(office, ceiling=None))
    assert blue_sky(bare.render(view(-8.5, 0.0, 0.0))).sum() > 2000
    bare.close()


def test_a_ceiling_hides_nothing_from_above():
    office = load("office")
    renderer = Renderer(office)
    above = renderer.render(View.from_above(28.0, 16.0, 560))
    renderer.close()
    table = office.tables[0]
    row, column = round((8.0 - table.y) * 20), round((14.0 + table.x - 0.5) * 20)
    red, _, blue = mean(above, (row - 3, row + 3), (column - 2, column + 2))
    assert red > blue + 20


def test_a_tree_has_a_ragged_outline_and_leaves_of_many_greens():
    renderer = Renderer(load("orchard"))
    picture = renderer.render(view(1.0, 0.0, 0.0))
    renderer.close()
    crown = picture[100:140, 280:360].reshape(-1, 3).astype(int)
    green = crown[(crown[:, 1] > crown[:, 0] + 10) & (crown[:, 1] > crown[:, 2] + 10)]
    assert len(green) > 1500
    assert green[:, 1].std() > 15


def test_under_water_the_light_moves_with_time_and_comes_again():
    renderer = Renderer(load("tank"))

    def at(time):
        return renderer.render(View((0.0, 0.0, -3.0), from_yaw(0.0), SIZE, FIELD, time=time)).astype(int)

    first = at(7.0)
    moved = np.abs(at(8.0) - first).mean(axis=2)
    again = np.abs(at(107.0) - first)
    renderer.close()
    assert moved[:150].mean() > 1.0, "the surface"
    assert moved[-100:].mean() > 1.0, "the floor"
    assert again.mean() < 0.2


def test_under_water_what_is_near_is_clear_and_what_is_far_fades():
    world = msgspec.structs.replace(load("tank"), divers=(), corals=(), blocks=())
    renderer = Renderer(world)

    def post(away):
        shape = Shape("box", (0.2, 0.5, 1.0), (away, 0.0, -2.0), colour=(1.0, 0.0, 0.0), glow=1.0)
        picture = renderer.render(View((0.0, 0.0, -2.0), from_yaw(0.0), SIZE, FIELD), [shape])
        return mean(picture, (235, 245), (315, 325))

    near, middle, far = (red - green for red, green, _ in (post(1.0), post(4.0), post(8.0)))
    renderer.close()
    assert near > 150
    assert near > middle > far
