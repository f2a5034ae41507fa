"""Docks as the robots' sensors meet them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from robotside.perception import tag_reader
from sim.core.shapes import compose, from_yaw, rotate
from sim.rendering.renderer import Renderer
from sim.rendering.view import View
from sim.robot import ROBOTS
from sim.world.occupancy import occupancy
from sim.world.props_docks import CAGE_REACH, MAKERS, STRIP_SPACING, STRIP_WIDTH, TAG_HEIGHT
from sim.world.tag_pattern import TAG_SIZE
from sim.world.world_files import WORLDS, load
from tests.sim.rooms import room

GREY = np.array([0.299, 0.587, 0.114])


@pytest.fixture(scope="module")
def detector():
    return tag_reader.detector()


def look(renderer, detector, eye, rotation, field_of_view):
    """The tags that the detector reads in a picture of 640 x 480, with their places in the camera's frame."""
    view = View(eye, rotation, (640, 480), field_of_view)
    focus = 320 / math.tan(field_of_view / 2)
    grey = (renderer.render(view) @ GREY).astype(np.uint8)
    return detector.detect(
        grey, estimate_tag_pose=True, camera_params=(focus, focus, 320.0, 240.0), tag_size=TAG_SIZE
    )


def camera_of(kind):
    """The field of view of the camera of a robot for this kind of dock, and how high it is above the contacts' origin [m]."""
    name = {"contacts": "scout", "jetty": "minnow", "cage": "aqua"}[kind]
    camera = ROBOTS[name].parameters.cameras[0]
    return camera.field_of_view, camera.position[2]


@pytest.mark.parametrize("world", WORLDS)
def test_a_detector_reads_each_dock_from_two_metres_and_says_where_it_is(detector, world):
    loaded = load(world)
    renderer = Renderer(loaded)
    for dock in loaded.docks:
        if dock.kind == "pad":
            continue
        field, height = camera_of(dock.kind)
        for aside in (-0.5, 0.0, 0.5):
            ahead = math.sqrt(4.0 - aside * aside)
            offset = rotate(from_yaw(dock.angle), (-ahead, aside, height + dock.z))
            eye = (dock.x + offset[0], dock.y + offset[1], offset[2])
            turned = from_yaw(dock.angle - math.atan2(aside, ahead))
            (found,) = look(renderer, detector, eye, turned, field)
            assert (found.tag_id, found.hamming) == (dock.tag, 0)
            to_right, down, forward = found.pose_t[:, 0]
            deep = 0.22 if dock.kind == "jetty" else 0.0
            assert to_right == pytest.approx(-deep * aside / 2, abs=0.02)
            assert down == pytest.approx(height - TAG_HEIGHT[dock.kind], abs=0.03)
            assert forward == pytest.approx(2.0 + deep * ahead / 2, abs=0.05)
    renderer.close()


@pytest.mark.parametrize("world", WORLDS)
def test_a_drone_above_its_pad_reads_the_tag_and_which_way_it_lies(detector, world):
    loaded = load(world)
    (dock,) = (each for each in loaded.docks if each.kind == "pad")
    renderer = Renderer(loaded)
    down = compose(from_yaw(dock.angle), (0.0, math.sin(math.pi / 4), 0.0, math.cos(math.pi / 4)))
    for height in (0.5, 1.0, 2.0):
        (found,) = look(renderer, detector, (dock.x, dock.y, dock.z + height), down, 0.84)
        assert (found.tag_id, found.hamming) == (dock.tag, 0)
        assert found.pose_t[2, 0] == pytest.approx(height, abs=0.04)
        assert found.center == pytest.approx((320, 240), abs=4)
        lower_left, *_, upper_left = found.corners
        assert lower_left[1] > upper_left[1] + 10, "its top is ahead of a drone that faces as the pad does"
    renderer.close()


def test_the_strips_of_a_pillar_stand_in_the_plane_of_its_contacts_where_lasers_look():
    strips = [
        shape for shape in MAKERS["contacts"](3, 0.0).solids if shape.size[1] == pytest.approx(STRIP_WIDTH)
    ]
    assert sorted(shape.position[1] for shape in strips) == pytest.approx(
        [-STRIP_SPACING / 2, STRIP_SPACING / 2]
    )
    for shape in strips:
        assert shape.position[0] - shape.size[0] / 2 == pytest.approx(0.0)
        for name in ("patrol", "commander"):
            height = ROBOTS[name].parameters.laser.height
            assert abs(shape.position[2] - height) < shape.size[2] / 2 - 0.01


def test_a_cage_is_open_in_front_and_there_is_room_in_it_for_the_swimmer():
    body = ROBOTS["aqua"].parameters.body
    half = body.width / 2 + 0.06, body.height / 2 + 0.06
    for shape in MAKERS["cage"](3, -1.5).solids:
        low, high = (
            [p + side * s / 2 for p, s in zip(shape.position, shape.size, strict=True)] for side in (-1, 1)
        )
        within = low[1] < half[0] and high[1] > -half[0] and low[2] < half[1] and high[2] > -half[1]
        assert not within or low[0] >= 0.0, "only its back is behind the coil"
        assert low[0] >= -CAGE_REACH - 1e-9


@pytest.mark.parametrize("world", WORLDS)
def test_the_map_has_what_stands_and_not_what_one_drives_over(world):
    loaded = load(world)
    told = occupancy(loaded, 0.0)
    info = told.info
    grid = np.frombuffer(told.data.tobytes(), dtype=np.int8).reshape(info.height, info.width)
    for dock in loaded.docks:
        deep = 0.0 if dock.kind == "pad" else 0.06
        x, y = dock.x + math.cos(dock.angle) * deep, dock.y + math.sin(dock.angle) * deep
        column = int((x - info.origin.position.x) / info.resolution)
        row = int((y - info.origin.position.y) / info.resolution)
        flat = dock.kind == "pad" and not dock.z
        assert grid[row, column] == (0 if flat else 100)


def test_a_world_of_ones_own_may_have_docks_too():
    world = room(extra='[[docks]]\nname = "here"\nkind = "contacts"\nx = 3\ny = 2\ntag = 4\n')
    (dock,) = world.docks
    assert (dock.power, dock.live, dock.angle) == (500.0, True, 0.0)
    assert [prop.kind for prop in world.props if prop.kind == "dock"] == ["dock"]
