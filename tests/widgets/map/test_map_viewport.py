"""How a map is looked at: it fits itself, follows the robot, and keeps its middle."""

from __future__ import annotations

import numpy as np
import pytest

from tests.widgets.map.watched_map import Watched, grid, near, pose


def test_it_fits_itself_until_a_finger_moves_it(stage):
    made = stage.show(Watched(), size=(400, 300))
    made.show(grid([0] * 400, 20))
    assert made.view.scale > 12
    assert made.view.to_screen(3.0, 6.0) == near(200, 150)
    stage.drag([(100, 100), (160, 100)])
    moved = made.view
    made.show(grid([0] * 800, 40))
    assert made.view == moved


def test_following_keeps_the_robot_in_the_middle_of_what_is_free(map_):
    map_.insets = [100, 0, 0, 0]
    map_.show(pose(3, 1))
    map_.centre_on_robot()
    map_.show(pose(4, 2))
    assert map_.view.to_screen(4, 2) == near(250, 150)


def test_centring_on_a_robot_of_unknown_place_does_nothing(map_):
    before = map_.view
    map_.centre_on_robot()
    assert map_.view == before
    assert not map_.follow


def test_zoom_buttons_keep_the_middle_and_stop_at_the_limits(map_):
    before = map_.view.to_world(200, 150)
    map_.zoom_in()
    assert map_.view.scale == pytest.approx(15)
    assert map_.view.to_world(200, 150) == near(*before)
    for _ in range(30):
        map_.zoom_out()
    assert map_.view.scale == pytest.approx(0.5)


def test_a_new_size_keeps_what_was_in_the_middle(map_):
    before = map_.view.to_world(200, 150)
    map_.size = 800, 500
    assert map_.view.to_world(400, 250) == near(*before)


def test_a_fit_shows_every_waypoint(map_):
    map_.waypoints = [(-30.0, 2.0), (40.0, -25.0)]
    map_.fit()
    seen = map_.view.many_to_screen(np.array(map_.waypoints))
    assert (seen > 0).all()
    assert (seen < (400, 300)).all()


def test_a_fit_of_nothing_changes_nothing(map_):
    before = map_.view
    map_.fit()
    assert map_.view == before
