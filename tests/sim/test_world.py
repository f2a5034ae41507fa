from __future__ import annotations

import math
from itertools import pairwise

import pytest

from sim.world import WORLDS, WorldError, load, parse
from tests.sim.rooms import ROOM, room

TEXT = ROOM.format(length=20, width=10, x=0, y=0, yaw=0)


def test_the_parking_lot_is_as_large_and_as_full_as_its_task_needs():
    world = load("parking_lot")
    assert (world.ground.length, world.ground.width) == (40, 30)
    assert len(world.cones) == 6
    assert 10 <= len(world.cars) <= 14


def test_every_world_that_is_offered_loads():
    for name in WORLDS:
        assert load(name).name == name


def test_a_patrol_along_the_aisles_passes_every_cone_within_five_metres():
    ring = [(17.5, 7.5), (-17.5, 7.5), (-17.5, -7.5), (17.5, -7.5), (17.5, 7.5)]
    for cone in load("parking_lot").cones:
        distances = [
            math.dist((cone.x, cone.y), (ax + (bx - ax) * i / 50, ay + (by - ay) * i / 50))
            for (ax, ay), (bx, by) in pairwise(ring)
            for i in range(51)
        ]
        assert 0.3 < min(distances) < 5.0


def test_nothing_stands_in_the_robots_first_metre():
    world = load("parking_lot")
    for prop in world.props:
        if prop.kind in ("car", "cone", "lamp"):
            assert math.dist(prop.position[:2], (world.start.x, world.start.y)) > 1.5


def test_the_map_leaves_out_the_cones_and_only_them():
    world = load("parking_lot")
    assert len(world.solids) - len(world.mapped) == len(world.cones)


def test_an_unknown_world_is_refused_with_the_names_there_are():
    with pytest.raises(WorldError, match=r"There is no world 'moon'; there is .*parking_lot"):
        load("moon")


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(WorldError, match=r"gone\.toml: cannot be read \(No such file"):
        load(tmp_path / "gone.toml")


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        (("length = 20", "length = -20"), r"lot\.toml: ground\.length: .*> 0"),
        (("length = 20", 'length = "long"'), r"lot\.toml: ground\.length: .*float.*str"),
        (("latitude = 45.0", ""), r"lot\.toml: datum\.latitude: is missing"),
        (("latitude = 45.0", "latitude = 91.0"), r"lot\.toml: datum\.latitude: .*< 90"),
        (("height = 0.5", "height = 0.5\ncolour = 3"), r"lot\.toml: wall\.colour: is not known here"),
        (("x = 0\n", "x = 11\n"), r"lot\.toml: start: \(11, 0\) is off the ground, which ends at x = ±10"),
        (("[wall]", "[wall"), r"lot\.toml: is not TOML: "),
        (
            ("yaw = 0", 'yaw = 0\n[[cars]]\nmodel = "tank"\nx = 1\ny = 1\ncolour = [0, 0, 0]'),
            r"lot\.toml: cars\[0\]\.model: 'tank' is not one of sedan, hatchback, suv, van",
        ),
        (
            ("yaw = 0", "yaw = 0\n[[cones]]\nx = 1\ny = 9"),
            r"lot\.toml: cones\[0\]: \(1, 9\) is off the ground",
        ),
    ],
)
def test_a_fault_is_named_with_file_key_and_reason(change, fault):
    assert change[0] in TEXT
    with pytest.raises(WorldError, match=fault):
        parse(TEXT.replace(*change), "lot.toml")


def test_a_world_without_wall_is_open():
    world = parse(TEXT.replace("[wall]\nheight = 0.5\nthickness = 0.2\n", ""), "open.toml")
    assert world.solids == ()


def test_angles_in_the_file_are_degrees():
    assert room(yaw=90).start.angle == pytest.approx(math.pi / 2)
