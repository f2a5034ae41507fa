from __future__ import annotations

from itertools import pairwise

import pytest

from sim.world.props_office import chair, desk_things, door, lamp_panel, room_wall, shelf, sofa


@pytest.mark.parametrize("length", [0.5, 1.8, 5.0, 26.4])
def test_a_wall_is_drawn_in_short_pieces_without_gaps(length):
    pieces = [shape for shape in room_wall(length, 2.4, 0.15, (0.8, 0.8, 0.8)) if shape.size[2] == 2.4]
    ends = sorted((s.position[0] - s.size[0] / 2, s.position[0] + s.size[0] / 2) for s in pieces)
    assert ends[0][0] == pytest.approx(-length / 2)
    assert ends[-1][1] == pytest.approx(length / 2)
    assert all(a[1] == pytest.approx(b[0]) for a, b in pairwise(ends))
    assert max(end - start for start, end in ends) <= 1.7


def test_a_door_keeps_nobody_from_passing_and_nothing_is_seen_in_its_way():
    made = door(1.1, 2.05, 2.4, 0.15)
    assert made.solids == ()
    for shape in made.visuals:
        inside = abs(shape.position[0]) - shape.size[0] / 2 < 0.40
        above = shape.position[2] - shape.size[2] / 2 > 1.9
        assert above or not inside, shape


@pytest.mark.parametrize("prop", [chair(), shelf(1.2, 0.35, 1.9), sofa(1.8)], ids=["chair", "shelf", "sofa"])
def test_furniture_stops_a_robot_as_far_as_it_is_seen(prop):
    for axis, more in ((0, 0.08), (1, 0.08)):
        seen, solid = (
            max(abs(shape.position[axis]) + shape.size[axis] / 2 for shape in shapes)
            for shapes in (prop.visuals, prop.solids)
        )
        assert solid == pytest.approx(seen, abs=more)
    assert min(solid.position[2] - solid.size[2] / 2 for solid in prop.solids) == pytest.approx(0.0)


def test_screens_stand_on_the_desk_and_a_table_without_them_is_bare():
    assert desk_things(1.4, 0.7, 0.74, 0) == ()
    things = desk_things(1.4, 0.7, 0.74, 2)
    assert sum(shape.glow > 0.5 for shape in things) == 2
    assert all(abs(shape.position[0]) + shape.size[0] / 2 <= 0.7 for shape in things)


def test_a_lamp_hangs_below_the_ceiling_and_shines():
    panel = lamp_panel(1.2, 0.6)
    assert all(shape.position[2] + shape.size[2] / 2 <= 0.0 for shape in panel)
    assert any(shape.glow == 1.0 for shape in panel)
