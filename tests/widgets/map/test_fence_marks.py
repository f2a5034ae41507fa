from __future__ import annotations

import numpy as np
import pytest

from bridge.msgs.geometry_msgs import Point32, Polygon
from bridge.msgs.pilothouse_msgs import Limits
from widgets.core.geometry import View
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map import fence_marks as marks
from widgets.map.fence import Border, Fence
from widgets.map.grid_map import GridMap

BOX = (0.0, 0.0, 400.0, 300.0)
AWAY = np.array([3.0, 5.0])
SQUARE = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])
RING = np.array([[40, 40], [360, 40], [360, 260], [200, 120], [40, 260]], dtype=float)


def limits(keep_in=(), keep_out=()) -> Limits:
    def areas(rings):
        return [Polygon([Point32(x, y) for x, y in ring]) for ring in rings]

    return Limits(keep_in=areas(keep_in), keep_out=areas(keep_out))


@pytest.fixture
def map_(stage):
    made = stage.show(GridMap(robot_radius=0.2), size=(400, 300))
    made.show(limits([SQUARE]))
    made.set_view(View.centred(5, 5, at=(200, 150), scale=20))
    return made


def signs(map_, stage) -> int:
    stage.frames(2)
    texts = map_._layers[0][1].texts
    return sum(text == marks.icon("block") for text in texts)


def test_hatching_stays_within_a_bent_area():
    starts, ends = marks.hatching(RING, (0.0, 0.0), BOX)
    assert len(starts) > 20
    inside = Fence([RING])
    for share in (0.01, 0.5, 0.99):
        assert inside.allows(starts + share * (ends - starts)).all()


def test_hatching_goes_with_the_map_and_does_not_swim():
    starts, _ = marks.hatching(RING, (0.0, 0.0), BOX)
    moved, _ = marks.hatching(RING + AWAY, (3.0, 5.0), (3.0, 5.0, 400.0, 300.0))
    assert moved == pytest.approx(starts + AWAY)


def test_of_an_area_out_of_sight_nothing_is_hatched():
    starts, _ = marks.hatching(RING + 5000, (0.0, 0.0), BOX)
    assert len(starts) == 0


def test_teeth_point_to_where_the_robot_never_is():
    fence, view = Fence([SQUARE]), View.centred(5, 5, at=(200, 150), scale=20)
    feet, tips = marks.teeth(view, fence.edge, BOX)
    assert len(feet) > 40
    outward = np.array([view.to_world(*tip) for tip in tips])
    assert not fence.allows(outward).any()


def test_an_edge_that_is_far_larger_than_the_glass_has_a_bounded_number_of_teeth():
    border = Border(np.array([[-1e6, 5.0]]), np.array([[1e6, 5.0]]))
    feet, _ = marks.teeth(View.centred(5, 5, at=(200, 150), scale=400), border, BOX)
    assert 0 < len(feet) <= marks.MAX_LINES


def test_many_edges_have_fewer_teeth_each():
    y = np.linspace(-5, 5, 2000)[:, None]
    border = Border(np.hstack([np.full_like(y, -9), y]), np.hstack([np.full_like(y, 9), y]))
    feet, _ = marks.teeth(View.centred(0, 0, at=(200, 150), scale=20), border, BOX)
    assert 0 < len(feet) <= 2 * marks.MAX_LINES


def test_the_legend_names_only_what_there_is():
    for rings, names in (
        (([SQUARE], []), ["Stays in"]),
        (([], [SQUARE]), ["Keeps out"]),
        (([], []), []),
    ):
        assert [word.text for word in marks.legend(Shapes(), Fence(*rings), 10, 10, 500)] == names


def test_the_legend_stands_in_one_row_where_there_is_room_and_never_beyond_it(stage):
    fence = Fence([SQUARE], [SQUARE / 2])
    wide = marks.legend_width(fence)
    row = list(marks.legend(Shapes(), fence, 10, 10, wide))
    pile = list(marks.legend(Shapes(), fence, 10, 10, wide - 1))
    assert row[0].y == row[1].y
    assert row[1].x > row[0].x
    assert row[1].x < 10 + wide
    assert pile[0].x == pile[1].x
    assert pile[1].y > pile[0].y


def test_points_home_and_places_that_the_robot_would_refuse_are_marked(map_, stage):
    map_.waypoints = [(5.0, 5.0), (9.8, 5.0), (12.0, 5.0)]
    assert signs(map_, stage) == 2
    map_.home = [5.0, -1.0]
    map_.places = [(11.0, 1.0, "Lab", "office"), (4.0, 4.0, "Store", "place"), (10.0, 9.0, "Dock", "dock")]
    assert signs(map_, stage) == 4
    map_.show(limits())
    assert signs(map_, stage) == 0


def test_a_point_at_a_place_that_the_robot_would_refuse_is_marked_and_said_once(map_, stage):
    map_.waypoints, map_.places = [(12.0, 5.0)], [(12.0, 5.0, "Lab", "office")]
    map_.refused = [(12.0, 5.0, "Height 0.5 m to 6.0 m")]
    assert signs(map_, stage) == 1
    said = [word.text for word in map_._refused(Shapes(), map_._places(), [])]
    assert said.count("Height 0.5 m to 6.0 m") == 1


def test_a_point_is_marked_while_a_finger_still_holds_it(map_, stage):
    map_.mode, map_.waypoints = "points", [(5.0, 5.0)]
    touch = stage.touch(200, 150)
    touch.touch_down()
    touch.touch_move(320, 150)
    assert signs(map_, stage) == 1
    touch.touch_move(210, 150)
    assert signs(map_, stage) == 0
    touch.touch_up()


def test_a_larger_robot_needs_more_room(map_, stage):
    map_.waypoints = [(9.3, 5.0)]
    assert signs(map_, stage) == 0
    map_.robot_radius = 0.5
    assert signs(map_, stage) == 1


def test_where_it_stays_is_worth_seeing(map_):
    map_.fit()
    seen = map_.view.many_to_screen(SQUARE)
    assert (seen > 0).all()
    assert (seen < (400, 300)).all()


def test_a_pose_does_not_draw_the_fence_anew_and_another_view_or_theme_does(map_, stage, monkeypatch):
    drawn = []
    stage.frames(2)
    monkeypatch.setattr(marks, "fence_lines", lambda *_: drawn.append(1))
    map_.robot = [1.0, 2.0, 0.0]
    stage.frames(2)
    assert drawn == []
    map_.zoom_in()
    stage.frames(2)
    theme.name = "sunlight"
    stage.frames(2)
    theme.name = "dark"
    assert drawn == [1, 1]
