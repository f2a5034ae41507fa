from __future__ import annotations

import msgspec
import pytest

from sim.core.shapes import Shape, rotate_back
from sim.world.tables import Ceiling, Window
from sim.world.world_files import load


@pytest.fixture(scope="module")
def office():
    return load("office")


def covers(shape: Shape, x, y, z):
    """The point lies within this box."""
    px, py, pz = shape.position
    local = rotate_back(shape.rotation, (x - px, y - py, z - pz))
    return all(abs(at) <= extent / 2 for at, extent in zip(local, shape.size, strict=True))


def seen(world, x, y, z):
    return any(covers(shape, x, y, z) for shape in world.visuals if shape.kind == "box")


def test_the_ceiling_windows_and_lamps_are_pictures_that_change_no_solid(office):
    plain = msgspec.structs.replace(office, ceiling=None, windows=(), doors=())
    assert plain.solids == office.solids
    assert plain.visuals != office.visuals


def test_a_window_is_a_hole_in_what_one_sees_and_none_for_what_bumps_into_it(office):
    window = office.windows[0]
    beside = window.width / 4
    assert window.y == 7.0
    assert not seen(office, window.x + beside, 7.1, (window.sill + window.head) / 2)
    assert seen(office, window.x + beside, 7.1, window.sill / 2)
    assert seen(office, window.x + window.width, 7.1, (window.sill + window.head) / 2)
    assert any(covers(solid, window.x + beside, 7.1, 1.5) for solid in office.solids)


@pytest.mark.parametrize(
    ("x", "y", "hole"), [(2.0, -6.9, (2.3, -7.1)), (12.9, 1.0, (13.1, 1.3)), (-12.9, 1.0, (-13.1, 1.3))]
)
def test_a_window_is_in_the_wall_that_is_nearest(office, x, y, hole):
    ceiling = Ceiling(height=2.4)
    bare = msgspec.structs.replace(office, ceiling=ceiling, windows=())
    assert seen(bare, *hole, 1.5)
    assert not seen(msgspec.structs.replace(bare, windows=(Window(x=x, y=y),)), *hole, 1.5)


def test_walls_reach_the_ceiling_so_that_no_sky_is_seen_above_them(office):
    for entry in office.partitions:
        assert entry.height >= office.ceiling.height
    assert office.wall.height >= office.ceiling.height
