from __future__ import annotations

import math

import pytest

from bridge.msgs import nav_msgs
from bridge.msgs.arrays import Float32Array, Int8Array
from bridge.msgs.geometry_msgs import (
    Point,
    Point32,
    Polygon,
    Pose,
    PoseStamped,
    Quaternion,
)
from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid
from bridge.msgs.pilothouse_msgs import Intruder, IntruderArray, Limits
from bridge.msgs.sensor_msgs import Imu, LaserScan
from tests.widgets.map.watched_map import grid, near, pose
from widgets.core.base import text_texture
from widgets.core.geometry import View
from widgets.core.shapes import Shapes
from widgets.map.grid_map import GridMap


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
    map_.show(IntruderArray(intruders=[Intruder(id=1, position=Point(3, 4)), Intruder(id=2, class_id="")]))
    assert list(map_.intruders) == [(3, 4, "Intruder 1 · cone"), (0, 0, "Intruder 2 · unknown")]


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
    assert map_.picture.shift.xy == near(180, 160)
    assert map_.picture.scale.x == pytest.approx(5)
    assert map_.picture.known == (0, 0, 2, 1)


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
    angle, long = math.radians(map_.picture.turn.angle), 2 * map_.picture.scale.x
    left, low = map_.picture.shift.xy
    corner = left + long * math.cos(angle), low + long * math.sin(angle)
    assert corner == pytest.approx(far, abs=1e-3)


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


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf, 1e308])
@pytest.mark.parametrize("where", ["x", "y", "turn", "resolution"])
def test_a_grid_that_lies_nowhere_is_not_shown(map_, stage, number, where):
    told = {"x": 0.0, "y": 0.0, "turn": 1.0, "resolution": 0.5, where: number}
    origin = Pose(Point(told["x"], told["y"]), Quaternion(w=told["turn"]))
    info = MapMetaData(resolution=told["resolution"], width=2, height=1, origin=origin)
    map_.show(OccupancyGrid(info=info, data=Int8Array([0, 100])))
    stage.frames()
    assert map_.grid is None
    map_.show(grid([0, 100], 2))
    stage.frames()
    assert map_.grid is not None


@pytest.mark.parametrize("resolution", [0.0, -0.5, 5e-324])
def test_a_grid_of_cells_without_width_is_not_shown(map_, stage, resolution):
    info = MapMetaData(resolution=resolution, width=2, height=1)
    map_.show(OccupancyGrid(info=info, data=Int8Array([0, 100])))
    stage.frames()
    assert map_.grid is None


@pytest.mark.parametrize("place", [(math.nan, 0.0), (0.0, math.inf), (1e308, -1e308)])
def test_an_intruder_who_is_nowhere_is_not_drawn_and_the_others_are(map_, stage, place):
    map_.intruders = [(*place, "Nowhere"), (1.0, 1.0, "Intruder 2")]
    stage.frames(2)
    assert "Intruder 2" in map_._layers[1][1].texts


@pytest.mark.filterwarnings(
    "ignore::RuntimeWarning"
)  # numpy's word on numbers that overflow, which ends nothing
@pytest.mark.parametrize("number", [math.nan, math.inf, 1e308, 1e200])
def test_a_robot_that_tells_nonsense_of_its_place_and_its_fence_leaves_a_map_that_is_drawn(
    map_, stage, number
):
    map_.follow = True
    map_.show(pose(number, -number))
    stage.frames(2)
    corners = [Point32(0.0, 0.0), Point32(number, 0.0), Point32(number, number)]
    map_.show(Limits(keep_in=[Polygon(corners)], keep_out=[Polygon(corners)]))
    stage.frames(2)
    map_.show(pose(1.0, 1.0))
    stage.frames(2)
    assert map_.located
