from __future__ import annotations

import math

import numpy as np
import pytest

from bridge.msgs import nav_msgs
from bridge.msgs.arrays import Float32Array, Int8Array
from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseStamped,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
)
from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid
from bridge.msgs.pilothouse_msgs import Intruder, IntruderArray
from bridge.msgs.sensor_msgs import Imu, LaserScan
from widgets.core.base import text_texture
from widgets.core.geometry import View
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map.grid_map import GridMap, samples

EVENTS = ("on_add", "on_move", "on_select", "on_set_home", "on_place_robot")


class Watched(GridMap):
    """A map that keeps a list of its events."""

    def __init__(self, **kwargs):
        self.log = []
        super().__init__(**kwargs)
        self.bind(**{name: self._noter(name) for name in EVENTS})

    def _noter(self, name):
        return lambda _, *args: self.log.append((name, *args))


@pytest.fixture
def map_(stage):
    made = stage.show(Watched(), size=(400, 300))
    made.set_view(View.centred(0, 0, at=(200, 150), scale=10))
    return made


def pose(x: float, y: float, yaw: float = 0.0) -> PoseWithCovarianceStamped:
    return PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(x, y), Quaternion.from_yaw(yaw))))


def near(*values):
    return pytest.approx(values, abs=1e-6)


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


# what comes in


def test_a_pose_places_the_robot_and_leaves_a_trail(map_):
    for x in (0.0, 0.01, 1.0, 2.0):
        map_.show(pose(x, 1.0))
    assert map_.robot == near(2.0, 1.0, 0.0)
    assert map_.trail.tolist() == [[0, 1], [1, 1], [2, 1]]


def test_a_robot_that_stands_draws_nothing_anew_whatever_its_noise(map_, stage, monkeypatch):
    map_.show(pose(1.0, 2.0, 0.5))
    stage.frames(2)
    drawn: list[list[float]] = []
    monkeypatch.setattr(GridMap, "draw", lambda self: drawn.append(list(self.robot)))
    unseen = min(0.2 / map_.view.scale, 0.04)
    for x, yaw in ((1.0 + unseen, 0.5), (1.0 - unseen, 0.503), (1.0, 0.497)):
        map_.show(pose(x, 2.0, yaw))
        stage.frames()
    assert drawn == []
    assert map_.robot == near(1.0, 2.0, 0.5)
    map_.show(pose(1.0, 2.0, 0.506))
    stage.frames()
    map_.show(pose(1.0 + 3 * unseen, 2.0, 0.506))
    stage.frames()
    assert drawn == [near(1.0, 2.0, 0.506), near(1.0 + 3 * unseen, 2.0, 0.506)]


def test_a_pose_that_is_not_known_leaves_no_trail_and_is_not_drawn(map_, stage):
    map_.show(pose(math.nan, 1.0))
    stage.frames()
    assert not map_.located
    assert len(map_.trail) == 0


def test_the_trail_is_bounded(map_):
    for step in range(5001):
        map_.show(pose(step * 0.1, 0.0))
    assert len(map_.trail) == 2000
    assert map_.trail[-1].tolist() == [500.0, 0.0]


def test_a_plan_is_taken_over_and_an_empty_one_takes_it_away(map_):
    poses = [PoseStamped(pose=Pose(Point(x, 1.0))) for x in (0.0, 2.0)]
    map_.show(nav_msgs.Path(poses=poses))
    assert map_.plan.tolist() == [[0, 1], [2, 1]]
    map_.show(nav_msgs.Path())
    assert len(map_.plan) == 0


def test_intruders_are_called_as_in_the_log(map_):
    map_.show(IntruderArray(intruders=[Intruder(id=1, position=Point(3, 4)), Intruder(id=2)]))
    assert list(map_.intruders) == [(3, 4, "Intruder 1"), (0, 0, "Intruder 2")]


def word_box(word):
    wide, high = text_texture(word.text, round(word.size, 1), word.font, bold=word.bold).size
    left, bottom = word.x - wide * word.anchor[0], word.y - high * word.anchor[1]
    return left, bottom, left + wide, bottom + high


@pytest.mark.parametrize("x", [-18.0, 0.0, 18.0])
@pytest.mark.parametrize("beside", [(3.0, 0.0), (-3.0, 0.0), (0.0, 3.0)])
def test_the_name_of_an_intruder_stands_on_a_free_side_inside_the_glass(map_, x, beside):
    map_.intruders = [(x, 0.0, "Intruder 1")]
    map_.waypoints = [(x + beside[0], beside[1])]
    (word,) = map_._alarms(Shapes())
    left, bottom, right, top = word_box(word)
    assert 0 <= left < right <= 400
    px, py = map_.view.to_screen(*map_.waypoints[0])
    gap = math.hypot(px - min(max(px, left), right), py - min(max(py, bottom), top))
    assert gap >= map_.mark_radius


def test_an_intruder_lies_above_a_waypoint_at_its_place(map_, stage):
    map_.waypoints = [(0.0, 0.0)]
    map_.intruders = [(0.0, 0.0, "Intruder 1")]
    stage.frames(2)
    (_, below), (_, above) = map_._layers
    assert "1" in below.texts
    assert "Intruder 1" in above.texts


def test_laser_points_are_placed_by_the_pose(map_):
    map_.show_laser = True
    map_.show(pose(1, 1, math.pi / 2))
    ranges = Float32Array([2.0, math.inf, math.nan])
    map_.show(LaserScan(angle_min=0.0, angle_increment=0.1, ranges=ranges))
    assert map_.laser.tolist() == [pytest.approx([1, 3])]


def test_a_message_of_another_kind_is_refused(map_):
    with pytest.raises(TypeError, match="sensor_msgs/Imu"):
        map_.show(Imu())


def grid(cells: list[int], width: int) -> OccupancyGrid:
    info = MapMetaData(resolution=0.5, width=width, height=len(cells) // width, origin=Pose(Point(-2.0, 1.0)))
    return OccupancyGrid(info=info, data=Int8Array(cells))


def test_the_known_part_of_a_grid_is_worth_seeing(map_):
    map_.show(grid([-1, 0, -1, 100, -1, -1], 3))
    assert map_.extent().min(axis=0) == near(-2, 1)
    assert map_.extent().max(axis=0) == near(-1, 2)


def test_a_grid_of_unknown_cells_is_drawn_and_is_no_extent(map_, stage):
    map_.show(grid([-1, -1], 2))
    stage.frames()
    assert len(map_.extent()) == 0


def test_a_grid_that_lacks_cells_is_not_shown(map_):
    short = OccupancyGrid(info=MapMetaData(resolution=0.5, width=3, height=3), data=Int8Array([0]))
    map_.show(short)
    assert map_.grid is None


def test_a_grid_lies_where_its_origin_says(map_, stage):
    map_.show(grid([0, 100], 2))
    map_.set_view(View.centred(0, 0, at=(200, 150), scale=10))
    stage.frames()
    assert map_._shift.xy == near(180, 160)
    assert map_._scale.x == pytest.approx(5)
    assert map_._cells.size == (2, 1)


@pytest.mark.parametrize("turn", [0.0, 0.5])
@pytest.mark.parametrize("yaw", [0.0, math.pi / 2, -0.3])
def test_a_grid_is_turned_as_its_origin_says_and_as_the_map_is(map_, stage, yaw, turn):
    """Its far corner in the row of its origin is where the view shows that place."""
    origin, resolution = Point(-2.0, 1.0), 0.5
    info = MapMetaData(
        resolution=resolution, width=2, height=1, origin=Pose(origin, Quaternion.from_yaw(yaw))
    )
    map_.show(OccupancyGrid(info=info, data=Int8Array([0, 100])))
    map_.set_view(View.centred(0, 0, at=(200, 150), scale=10, turn=turn))
    stage.frames()
    far = map_.view.to_screen(
        origin.x + 2 * resolution * math.cos(yaw), origin.y + 2 * resolution * math.sin(yaw)
    )
    angle, long = math.radians(map_._turn.angle), 2 * map_._scale.x
    left, low = map_._shift.xy
    corner = left + long * math.cos(angle), low + long * math.sin(angle)
    assert corner == pytest.approx(far, abs=1e-3)


# how it is looked at


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


@pytest.mark.parametrize("name", samples())
def test_every_sample_can_be_shown(stage, name):
    assert stage.show(samples()[name]()).height > 0


def test_the_age_stands_in_the_middle_of_what_is_free_at_its_top(stage, map_):
    map_.insets = [100, 0, 0, 20]
    map_.state, map_.age = "stale", 12.0
    stage.frames(1)
    x, y = map_.badge_pos
    assert x + map_.badge_size[0] / 2 == pytest.approx(map_.x + 250)
    assert y + map_.badge_size[1] <= map_.top - 20
    map_.badge_span = [map_.x + 200, map_.x + 300]
    assert map_.badge_pos[0] >= map_.x + 200


@pytest.mark.parametrize("size", [(8193, 1), (1, 8193), (4097, 4096)])
def test_a_grid_too_large_for_a_texture_is_not_shown_and_said_once(map_, stage, caplog, size):
    wide, high = size
    small = OccupancyGrid(info=MapMetaData(resolution=0.1, width=2, height=1), data=Int8Array(bytes(2)))
    large = OccupancyGrid(
        info=MapMetaData(resolution=0.1, width=wide, height=high), data=Int8Array(bytes(wide * high))
    )
    map_.show(small)
    stage.frames(1)
    assert map_.grid is small
    for _ in range(3):
        map_.show(large)
        stage.frames(1)
    assert map_.grid is None
    assert sum("the map is not shown" in record.getMessage() for record in caplog.records) == 1
    map_.show(small)
    assert map_.grid is small
