from __future__ import annotations

import math

import numpy as np
import pytest

from bridge.msgs.geometry_msgs import Point32
from bridge.msgs.pilothouse_msgs import RobotInfo
from tests.widgets.map.watched_map import near, pose
from widgets.map.geo_map import GeoMap
from widgets.map.map_robot import corners, turned

TRUCK = [(3.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (3.0, -1.0)]
CENTRE = (200, 150)


def seen(map_, x, y):
    return map_.view.to_screen(x, y)


def test_the_way_it_looks_is_up_while_it_is_followed(map_):
    map_.show(pose(2, 1, 0.3))
    map_.look_ahead()
    for x, y, yaw in ((2, 1, 0.3), (5, -3, 2.0), (6, -3, -3.0)):
        map_.show(pose(x, y, yaw))
        ahead = x + math.cos(yaw), y + math.sin(yaw)
        assert seen(map_, x, y) == near(*CENTRE)
        assert seen(map_, *ahead) == near(CENTRE[0], CENTRE[1] + 10)


def test_a_finger_that_drags_ends_that_and_the_button_brings_it_back(map_, stage):
    map_.show(pose(2, 1, 0.3))
    map_.look_ahead()
    stage.drag([(100, 50), (150, 60), (160, 60)])
    turn = map_.view.turn
    map_.show(pose(8, 1, 1.5))
    assert not map_.follow
    assert map_.view.turn == turn
    map_.centre_on_robot()
    assert map_.follow
    assert seen(map_, 8, 1) == near(*CENTRE)
    assert map_.view.turn == pytest.approx(math.pi / 2 - 1.5)


def test_one_button_follows_then_turns_and_turns_back(map_):
    map_.show(pose(2, 1, 0.3))
    seen_so = []
    for _ in range(3):
        map_.follow_or_turn()
        seen_so.append((map_.follow, map_.heading_up))
    assert seen_so == [(True, False), (True, True), (True, False)]


def test_north_is_up_again_about_the_middle_of_the_map(map_):
    map_.show(pose(2, 1, 0.3))
    map_.look_ahead()
    map_.look_ahead()
    assert not map_.heading_up
    assert map_.view.turn == 0
    assert map_.follow
    assert seen(map_, 2, 1) == near(*CENTRE)
    map_.show(pose(2, 1, 1.0))
    assert map_.view.turn == 0


def test_a_map_of_a_robot_that_is_not_located_is_not_turned(map_):
    map_.look_ahead()
    assert map_.view.turn == 0
    map_.show(pose(1, 1, 0.5))
    assert seen(map_, 0, 0) == near(*CENTRE)


def test_a_map_that_cannot_be_turned_follows_with_north_up(stage):
    map_ = stage.show(GeoMap(), size=(400, 300))
    map_.show(pose(2, 1, 0.3))
    map_.look_ahead()
    map_.show(pose(4, 1, 0.9))
    assert map_.view.turn == 0
    assert seen(map_, 4, 1) == near(*CENTRE)


def test_corners_lie_where_the_robot_turns_them():
    there = turned(TRUCK, (10, 5, math.pi / 2))
    assert there == pytest.approx(np.array([(9, 8), (9, 4), (11, 4), (11, 8)]))


@pytest.mark.parametrize("turn", [0.0, 0.8])
def test_an_outline_is_drawn_to_scale_whatever_the_turn(map_, turn):
    map_.footprint = TRUCK
    map_._turn_to(turn)
    outline = map_._outline((1.0, 2.0, 0.4))
    sides = np.hypot(*np.diff(outline, axis=0).T)
    assert sides == pytest.approx([40, 20, 40])
    assert outline[0] == pytest.approx(seen(map_, *turned(TRUCK[:1], (1.0, 2.0, 0.4))[0]))


@pytest.mark.parametrize("told", [[], TRUCK[:2], [*TRUCK[:2], (math.nan, 0.0)], TRUCK * 17])
def test_what_is_no_outline_is_not_drawn(told):
    assert corners(RobotInfo(footprint=[Point32(x, y) for x, y in told])) == []


def test_an_outline_is_taken_over_from_the_robot():
    assert corners(RobotInfo(footprint=[Point32(x, y) for x, y in TRUCK])) == TRUCK


def test_an_outline_too_small_to_see_gives_way_to_the_disc(map_):
    map_.footprint = [(x / 10, y / 10) for x, y in TRUCK]
    assert map_._outline((0.0, 0.0, 0.0)) is None
    map_.set_view(map_.view.zoomed(10, *CENTRE))
    assert map_._outline((0.0, 0.0, 0.0)) is not None


def test_a_robot_without_an_outline_has_its_disc(map_):
    assert map_._outline((0.0, 0.0, 0.0)) is None


def test_north_is_shown_only_while_it_is_not_up(map_, stage):
    map_.show(pose(2, 1, 0.3))
    stage.frames(2)
    assert "N" not in map_._layers[1][1].texts
    map_.look_ahead()
    stage.frames(2)
    assert "N" in map_._layers[1][1].texts
