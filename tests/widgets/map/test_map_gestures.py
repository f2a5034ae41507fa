"""A finger on a map: what it moves, adds, selects and places."""

from __future__ import annotations

import math

import pytest

from tests.widgets.map.watched_map import near, pose
from widgets.core.geometry import View
from widgets.core.theme import theme

# taps and drags


def test_a_tap_gives_world_coordinates(map_, stage):
    map_.mode = "points"
    stage.tap(250, 130)
    assert map_.log == [("on_add", pytest.approx(5), pytest.approx(-2))]


@pytest.mark.parametrize("turn", [0.0, 0.5, -2.0])
def test_a_tap_gives_world_coordinates_through_pan_zoom_and_turn(map_, stage, turn):
    map_.mode = "points"
    map_.set_view(View.centred(7, -3, at=(120, 80), scale=33, turn=turn))
    stage.tap(*map_.view.to_screen(6.25, -1.5))
    assert map_.log[0][1:] == near(6.25, -1.5)


def test_a_tap_on_a_map_that_is_only_looked_at_adds_nothing(map_, stage):
    stage.tap(250, 130)
    assert map_.log == []


def test_a_tap_with_an_unsteady_finger_is_still_a_tap(map_, stage):
    map_.mode = "points"
    stage.drag([(250, 130), (254, 133)])
    assert [event[0] for event in map_.log] == ["on_add"]
    assert map_.view.to_screen(0, 0) == near(200, 150)


def test_a_drag_on_free_ground_moves_the_map_and_adds_nothing(map_, stage):
    map_.mode = "points"
    map_.follow = True
    stage.drag([(250, 130), (280, 130), (300, 170)])
    assert map_.log == []
    assert map_.view.to_screen(0, 0) == near(250, 190)
    assert not map_.follow


def test_a_finger_that_stays_asks_for_a_place_once(map_, stage):
    map_.mode = "points"
    touch = stage.touch(250, 130)
    touch.touch_down()
    stage.run_for(1.5)
    assert map_.log == [("on_new_place", pytest.approx(5), pytest.approx(-2))]
    touch.touch_up()
    assert len(map_.log) == 1


@pytest.mark.parametrize("before", [0, 1], ids=["in the long frame", "in the one after it"])
def test_a_tap_during_a_frame_that_takes_long_is_a_tap(map_, stage, before):
    """The finger left while it was drawn, which is only read afterwards."""
    map_.mode = "points"
    touch = stage.touch(250, 130)
    touch.touch_down()
    stage.frames(1, period=2.0)
    stage.frames(before)
    touch.touch_up()
    stage.run_for(1.0)
    assert [event[0] for event in map_.log] == ["on_add"]


def test_on_a_device_that_draws_two_frames_a_second_a_finger_that_stays_asks_for_a_place(map_, stage):
    map_.mode = "points"
    touch = stage.touch(250, 130)
    touch.touch_down()
    stage.frames(5, period=0.5)
    assert [event[0] for event in map_.log] == ["on_new_place"]


def test_a_finger_that_leaves_or_drags_in_time_asks_for_none(map_, stage):
    map_.mode = "points"
    touch = stage.touch(250, 130)
    touch.touch_down()
    stage.run_for(0.5)
    touch.touch_move(300, 130)
    stage.run_for(1.0)
    touch.touch_up()
    assert map_.log == []


def test_dragging_a_waypoint_moves_only_it_and_says_so_once_at_the_end(map_, stage):
    map_.mode = "points"
    map_.waypoints = [(0.0, 0.0), (10.0, 5.0)]
    touch = stage.touch(203, 148)
    touch.touch_down()
    for x in (220, 240, 253):
        touch.touch_move(x, 138)
    assert map_.log == []
    assert map_._places()[0] == near(5.0, -1.0)
    touch.touch_up()
    assert map_.log == [("on_move", 0, pytest.approx(5.0), pytest.approx(-1.0))]
    assert map_.waypoints[0] == near(5.0, -1.0)
    assert map_.waypoints[1] == (10.0, 5.0)
    assert map_.view.to_screen(0, 0) == near(200, 150)


def test_a_waypoint_does_not_jump_to_the_finger_that_takes_it(map_, stage):
    map_.mode = "points"
    map_.waypoints = [(0.0, 0.0)]
    stage.drag([(210, 150), (230, 150)])
    assert map_.waypoints[0] == near(2.0, 0.0)


def test_a_waypoint_is_as_easy_to_hit_as_any_target(map_, stage):
    map_.mode = "points"
    map_.waypoints = [(0.0, 0.0)]
    stage.tap(200 + theme.target / 2 - 1, 150)
    assert map_.log == [("on_select", 0)]
    assert map_.selected == 0


def test_waypoints_stay_where_they_are_unless_they_are_being_edited(map_, stage):
    map_.waypoints = [(0.0, 0.0)]
    stage.drag([(200, 150), (240, 150)])
    assert list(map_.waypoints) == [(0.0, 0.0)]
    assert map_.log == []


def test_a_tap_beside_all_waypoints_selects_none(map_, stage):
    map_.waypoints, map_.selected = [(0.0, 0.0)], 0
    stage.tap(320, 40)
    assert map_.log == [("on_select", -1)]


def test_a_waypoint_that_was_taken_away_under_the_finger_is_not_moved(map_, stage):
    map_.mode = "points"
    map_.waypoints = [(0.0, 0.0)]
    touch = stage.touch(200, 150)
    touch.touch_down()
    touch.touch_move(240, 150)
    map_.waypoints = []
    touch.touch_up()
    assert map_.log == []


def test_changing_the_mode_lets_go_of_what_was_held(map_, stage):
    map_.mode = "points"
    map_.waypoints = [(0.0, 0.0)]
    touch = stage.touch(200, 150)
    touch.touch_down()
    touch.touch_move(240, 150)
    map_.mode = "view"
    touch.touch_up()
    assert map_.log == []
    assert list(map_.waypoints) == [(0.0, 0.0)]


def test_home_is_set_by_a_tap_and_moved_by_a_drag(map_, stage):
    map_.mode = "home"
    stage.tap(250, 150)
    assert map_.log == [("on_set_home", pytest.approx(5.0), pytest.approx(0.0))]
    stage.drag([(250, 150), (250, 200)])
    assert map_.log[1] == ("on_set_home", pytest.approx(5.0), pytest.approx(5.0))
    assert map_.home == near(5.0, 5.0)


# putting the robot somewhere


def test_the_robot_to_be_placed_starts_where_it_believes_to_be(map_):
    map_.show(pose(1, 2, 0.5))
    map_.mode = "place_robot"
    assert map_.placed == near(1, 2, 0.5)


def test_a_robot_of_unknown_place_starts_in_the_middle(map_):
    map_.mode = "place_robot"
    assert map_.placed == near(0, 0, 0)


def test_the_robot_is_dragged_and_then_turned_by_its_handle(map_, stage):
    map_.mode = "place_robot"
    stage.drag([(200, 150), (230, 150), (250, 150)])
    assert map_.log == [("on_place_robot", pytest.approx(5), pytest.approx(0), pytest.approx(0))]
    handle = map_.view.to_screen(*map_.handle_place())
    assert handle[0] > 250 + theme.target / 2
    stage.drag([handle, (280, 200), (250, 220)])
    assert map_.log[1][1:] == near(5, 0, math.pi / 2)
    map_.mode = "view"
    assert map_.placed == []


def test_the_handle_stays_on_the_map(map_):
    map_.mode = "place_robot"
    left, middle = map_.view.to_world(map_.x + 62, map_.center_y), map_.view.to_world(*map_.center)
    map_.placed = [*left, math.pi]
    assert map_.view.to_screen(*map_.handle_place())[0] == pytest.approx(map_.x + 20, abs=1)
    map_.placed = [*middle, math.pi]
    assert map_.center_x - map_.view.to_screen(*map_.handle_place())[0] == pytest.approx(74, abs=1)


# several fingers


def test_two_fingers_zoom_and_turn_what_is_between_them(map_, stage):
    map_.mode = "points"
    one, two = stage.touch(150, 150), stage.touch(250, 150)
    one.touch_down()
    two.touch_down()
    two.touch_move(350, 150)
    assert map_.view.scale == pytest.approx(20)
    assert map_.view.to_screen(-5, 0) == near(150, 150)
    two.touch_move(150, 350)
    assert map_.view.turn == pytest.approx(math.pi / 2)
    one.touch_up()
    two.touch_move(170, 350)
    two.touch_up()
    assert map_.log == []


def test_a_second_finger_does_not_disturb_the_drag_of_the_first(map_, stage):
    map_.mode = "points"
    map_.waypoints = [(0.0, 0.0)]
    one, two = stage.touch(200, 150), stage.touch(300, 250)
    one.touch_down()
    one.touch_move(220, 150)
    two.touch_down()
    two.touch_move(350, 290)
    two.touch_up()
    one.touch_up()
    assert map_.view.scale == pytest.approx(10)
    assert map_.log == [("on_move", 0, pytest.approx(2.0), pytest.approx(0.0))]


def test_a_finger_that_came_down_elsewhere_is_not_followed(map_, stage):
    map_.pos = 100, 0
    before = map_.view
    stage.drag([(50, 50), (250, 150)])
    assert map_.view == before


def test_a_disabled_map_lets_touches_through(map_, stage):
    map_.state, map_.mode = "disabled", "points"
    stage.tap(250, 130)
    assert map_.log == []


def test_the_wheel_zooms_about_the_pointer(map_, stage):
    touch = stage.touch(300, 200)
    touch.profile = ["pos", "button"]
    touch.button = "scrolldown"
    before = map_.view.to_world(300, 200)
    touch.touch_down()
    touch.touch_up()
    assert map_.view.scale == pytest.approx(12)
    assert map_.view.to_world(300, 200) == near(*before)
