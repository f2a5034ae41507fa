from __future__ import annotations

import msgspec
import numpy as np

from sim.world.lamp_light import CELL, lamp_light
from sim.world.tables import Ceiling, Partition
from tests.sim.rooms import room


def light(world, x, y):
    (columns, rows), data = lamp_light(world)
    picture = np.frombuffer(data, dtype=np.uint8).reshape(rows, columns)
    row, column = (
        (at + extent / 2) / CELL for at, extent in ((y, world.ground.width), (x, world.ground.length))
    )
    return int(picture[int(row), int(column)])


def lit_room(**more):
    ceiling = Ceiling(height=2.4, lamps=((-3.0, 0.0),))
    return msgspec.structs.replace(room(12.0, 8.0), ceiling=ceiling, **more)


def test_without_a_ceiling_it_is_bright_everywhere():
    assert lamp_light(room()) == ((1, 1), b"\xff")


def test_it_is_brightest_under_a_lamp_and_darkest_in_the_far_corner_but_never_black():
    world = lit_room()
    assert light(world, -3.0, 0.0) > light(world, -1.0, 0.0) > light(world, 5.8, 3.8) > 60


def test_a_wall_throws_a_shadow():
    wall = Partition(start=(-2.0, -1.0), end=(-2.0, 1.0))
    assert light(lit_room(partitions=(wall,)), -1.0, 0.0) < light(lit_room(), -1.0, 0.0) - 20
    assert light(lit_room(partitions=(wall,)), -3.5, 0.0) == light(lit_room(), -3.5, 0.0)
