from __future__ import annotations

import math

import numpy as np
import pytest

from bridge.msgs.geometry_msgs import Point32, Polygon
from bridge.msgs.pilothouse_msgs import Limits, RobotInfo
from robotside.core.config import LimitSettings
from robotside.limits.limits import GOAL_ROOM as ROBOTS_ROOM
from robotside.limits.limits import LimitKeeper
from widgets.map.fence import GOAL_ROOM, MAX_CORNERS, Fence

SQUARE = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]
HOLE = [(4.0, 4.0), (6.0, 4.0), (6.0, 6.0), (4.0, 6.0)]
BESIDE = [(10.0, 2.0), (14.0, 2.0), (14.0, 8.0), (10.0, 8.0)]


def area(corners) -> Polygon:
    return Polygon([Point32(x, y) for x, y in corners])


def told(keep_in=(), keep_out=()) -> Fence:
    return Fence.of(Limits(keep_in=[area(one) for one in keep_in], keep_out=[area(one) for one in keep_out]))


def length(border) -> float:
    return float(np.hypot(*(border.ends - border.starts).T).sum())


def test_a_robot_without_areas_may_be_anywhere():
    fence = told()
    assert not fence
    assert fence.fault("Point 1", 1e9, 0.0, 0.2) == ""


def test_a_place_outside_and_one_too_near_are_told_with_their_figures():
    fence = told([SQUARE], [HOLE])
    assert fence.fault("Point 2", 5.0, 5.0, 0.2) == "Point 2 at (5.0, 5.0) is outside the robot's fence."
    near = "Home at (2.0, 9.7) is 0.30\u00a0m from the robot's fence; the robot needs 0.60\u00a0m."
    assert fence.fault("Home", 2.0, 9.7, 0.2) == near
    assert fence.fault("Home", 2.0, 9.35, 0.2) == ""


def test_areas_that_touch_have_no_border_between_them():
    fence = told([SQUARE, BESIDE])
    assert fence.fault("It", 10.0, 5.0, 0.2) == ""
    assert length(fence.edge) == pytest.approx(40 + 2 * 4)


def test_what_it_never_enters_takes_away_from_where_it_stays():
    fence = told([SQUARE], [[(8.0, 8.0), (12.0, 8.0), (12.0, 12.0), (8.0, 12.0)]])
    assert length(fence.edge) == pytest.approx(36)
    assert length(fence.holes) == pytest.approx(4)


@pytest.mark.parametrize("turned", [1, -1])
def test_every_piece_has_the_robots_ground_on_its_left(turned):
    fence = told([SQUARE[::turned]], [HOLE[::turned]])
    for border in (fence.edge, fence.holes):
        along = border.ends - border.starts
        left = np.stack([-along[:, 1], along[:, 0]], axis=1) * 0.01
        assert fence.allows((border.starts + border.ends) / 2 + left).all()


def test_a_place_asked_for_again_is_judged_by_what_is_known_of_it(monkeypatch):
    fence = told([SQUARE])
    assert fence.forbids(9.55, 5.0, 0.2)
    assert not fence.forbids(9.55, 5.0, 0.02)
    monkeypatch.setattr(fence, "fault", lambda *_: 1 / 0)
    assert fence.forbids(9.55, 5.0, 0.2)


def test_areas_that_are_none_are_left_out():
    nan = [(0.0, 0.0), (math.nan, 1.0), (1.0, 0.0)]
    assert not told([nan, SQUARE[:2]], [[]])


def test_a_fence_with_too_many_corners_is_said_to_be_so_and_not_looked_at():
    turns = np.linspace(0, math.tau, MAX_CORNERS + 1, endpoint=False)
    fence = Fence([np.stack([np.cos(turns), np.sin(turns)], axis=1)])
    assert fence.too_large
    assert fence.fault("It", 5.0, 5.0, 0.2) == ""


def test_it_says_what_the_robot_itself_is_going_to_say():
    rng = np.random.default_rng(5)
    assert GOAL_ROOM == ROBOTS_ROOM
    for _ in range(12):
        rings = [
            [(float(x), float(y)) for x, y in rng.uniform(-8, 8, (int(count), 2)).round(2)]
            for count in rng.integers(3, 8, 4)
        ]
        settings = LimitSettings(keep_in=rings[:2], keep_out=rings[2:])
        keeper = LimitKeeper(settings, RobotInfo(radius=0.25))
        fence = Fence.of(keeper.message)
        for x, y in rng.uniform(-8, 8, (60, 2)):
            wanted = (
                keeper.fault("Point 1", float(x), float(y)).replace("-0.0,", "0.0,").replace("-0.0)", "0.0)")
            )
            # the glass tears no figure from its unit, and has a true minus
            shown = fence.fault("Point 1", x, y, 0.25).replace("\u00a0", " ").replace("−", "-")
            assert shown == wanted
