from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.msgs.geometry_msgs import Pose, PoseWithCovariance, PoseWithCovarianceStamped, Quaternion
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import Imu
from bridge.msgs.std_msgs import Header
from widgets.core import geometry
from widgets.core.geometry import View

finite = st.floats(-500, 500)
views = st.builds(
    View.centred,
    finite,
    finite,
    at=st.tuples(finite, finite),
    scale=st.floats(0.5, 200),
    turn=st.floats(-3, 3),
)


@given(views, finite, finite)
def test_a_point_of_the_screen_goes_to_the_world_and_back(view, px, py):
    assert view.to_screen(*view.to_world(px, py)) == pytest.approx((px, py), abs=1e-6)


@given(views, st.floats(0.2, 5), finite, finite)
def test_zooming_keeps_the_point_under_the_finger(view, factor, px, py):
    zoomed = view.zoomed(factor, px, py)
    assert zoomed.to_world(px, py) == pytest.approx(view.to_world(px, py), abs=1e-6)
    assert zoomed.scale == pytest.approx(view.scale * factor)


def test_north_is_up_and_east_is_right():
    view = View.centred(10, 20, at=(100, 200), scale=50)
    assert view.to_screen(10, 20) == pytest.approx((100, 200))
    assert view.to_screen(11, 20) == pytest.approx((150, 200))
    assert view.to_screen(10, 21) == pytest.approx((100, 250))


def test_a_turned_world_turns_anticlockwise():
    view = View.centred(0, 0, at=(0, 0), scale=10, turn=math.pi / 2)
    assert view.to_screen(1, 0) == pytest.approx((0, 10), abs=1e-9)


def test_many_points_go_where_single_ones_go():
    view = View.centred(3, -2, at=(40, 50), scale=7, turn=0.6)
    points = np.array([[1.0, 2.0], [-4.0, 0.5]])
    assert view.many_to_screen(points) == pytest.approx(np.array([view.to_screen(*p) for p in points]))


def test_two_fingers_hold_what_is_under_them():
    view = View.centred(0, 0, at=(0, 0), scale=10)
    before, after = (10 + 10j, 30 + 10j), (0 + 20j, 0 + 80j)
    pinched = view.pinched(before, after)
    for was, now in zip(before, after, strict=True):
        assert pinched.to_world(now.real, now.imag) == pytest.approx(view.to_world(was.real, was.imag))
    assert pinched.scale == pytest.approx(30)
    assert pinched.turn == pytest.approx(math.pi / 2)


def test_two_fingers_on_a_map_that_does_not_turn_only_zoom_it():
    view = View.centred(0, 0, at=(0, 0), scale=10)
    pinched = view.pinched((0j, 10 + 0j), (0j, 0 + 20j), may_turn=False)
    assert pinched.turn == 0
    assert pinched.scale == pytest.approx(20)
    assert pinched.to_world(0, 10) == pytest.approx(view.to_world(5, 0))


def test_two_fingers_on_one_spot_change_nothing():
    view = View.centred(0, 0, at=(0, 0), scale=10)
    assert view.pinched((5j, 5j), (1 + 0j, 60 + 0j)) == view


def test_the_scale_is_kept_within_its_limits():
    view = View.centred(0, 0, at=(0, 0), scale=10)
    assert view.within(20, 100, 5, 5).scale == pytest.approx(20)
    assert view.within(1, 4, 5, 5).scale == pytest.approx(4)
    assert view.within(1, 100, 5, 5) is view


@pytest.mark.parametrize("turn", [0.0, 0.7, -2.0])
def test_a_fitted_view_shows_every_point_inside_the_box(turn):
    points = np.array([[-3.0, 1.0], [8.0, -4.0], [2.0, 6.0]])
    view = View.fitting(points, box=(10, 20, 300, 200), turn=turn)
    seen = view.many_to_screen(points)
    assert (seen >= (9.999, 19.999)).all()
    assert (seen <= (310.001, 220.001)).all()
    assert max(np.ptp(seen, axis=0) / (300, 200)) == pytest.approx(1)
    assert view.turn == pytest.approx(turn)


def test_one_point_is_fitted_at_the_greatest_scale():
    assert View.fitting(np.array([[5.0, 5.0]]), box=(0, 0, 100, 100), most=40).scale == pytest.approx(40)


def test_a_trail_keeps_the_newest_points_that_are_apart():
    trail = geometry.Trail(most=3, apart=0.5)
    taken = [trail.add(x, 0.0) for x in (0, 0.4, 1, 2, 3, 4, 5, 6, 7, math.nan)]
    assert taken == [True, False] + [True] * 7 + [False]
    assert trail.points[:, 0].tolist() == [5, 6, 7]


@pytest.mark.parametrize(("yaw", "angle"), [(0, 0), (math.pi / 2, 90), (-math.pi / 2, 270)])
def test_kivy_turns_in_degrees_anticlockwise_like_yaw(yaw, angle):
    assert geometry.screen_angle(yaw) == pytest.approx(angle)


@pytest.mark.parametrize(
    ("start", "end", "turn"), [(359, 0, 1), (0, 359, -1), (10, 190, -180), (90, 100, 10)]
)
def test_a_heading_turns_the_short_way(start, end, turn):
    assert geometry.shortest_turn(start, end) == pytest.approx(turn)


def test_the_own_heading_is_at_the_top_of_the_dial_and_what_is_right_of_it_on_the_right():
    assert geometry.dial_point(98, 10, heading=98) == pytest.approx((0, 10))
    assert geometry.dial_point(188, 10, heading=98) == pytest.approx((10, 0), abs=1e-9)


def test_a_compass_card_has_letters_and_tens():
    assert [geometry.dial_text(b) for b in (0, 30, 90, 120, 180, 270, 330, 360)] == [
        "N", "3", "E", "12", "S", "W", "33", "N",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("heading", "text"), [(0, "000°"), (98.4, "098°"), (359.4, "359°"), (359.6, "000°"), (math.nan, "–")]
)
def test_a_heading_has_three_figures(heading, text):
    assert geometry.heading_text(heading) == text


def test_the_tape_goes_on_over_north():
    assert geometry.tape_marks(358, 20, 5) == [350, 355, 360, 365]


@pytest.mark.parametrize(("value", "floor"), [(7, 5), (5, 5), (1.9, 1), (0.3, 0.2), (1234, 1000)])
def test_a_scale_bar_has_a_round_length(value, floor):
    assert geometry.nice_floor(value) == pytest.approx(floor)


@pytest.mark.parametrize(("metres", "text"), [(0.2, "20 cm"), (5, "5 m"), (2000, "2 km")])
def test_a_length_has_its_unit(metres, text):
    assert geometry.length_text(metres) == text


def test_a_picture_covers_its_frame_or_is_contained_in_it():
    assert geometry.cover(640, 480, 1280, 480) == pytest.approx((1280, 960))
    assert geometry.contain(640, 480, 1280, 480) == pytest.approx((640, 480))


def test_the_nearest_point_within_reach_is_found():
    points = [(0, 0), (10, 0), (12, 0)]
    assert geometry.nearest(points, 9, 0, 5) == 1
    assert geometry.nearest(points, 30, 0, 5) == -1


def test_beams_lie_ahead_and_to_the_left_as_measured():
    _, angles, points = geometry.scan_points([2.0, 1.0, math.nan, math.inf], -math.pi / 2, math.pi / 2)
    assert points[:2] == pytest.approx(np.array([[0, -2], [1, 0]]), abs=1e-9)
    assert not np.isfinite(points[2:]).all(axis=1).any()
    assert angles[2] == pytest.approx(math.pi / 2)


def test_points_that_are_not_known_are_left_out():
    assert geometry.spread([(1, 2), (math.nan, 3), (4, 5)]).tolist() == [[1, 2], [4, 5]]
    assert geometry.spread([]).shape == (0, 2)


def test_a_thinned_line_keeps_its_ends_and_loses_no_bend():
    line = np.array([[x / 10, 0.0] for x in range(101)] + [[10.0, y / 10] for y in range(1, 101)])
    thin = geometry.thinned(line, 1.0)
    assert len(thin) in (21, 22)
    assert thin[0].tolist() == [0, 0]
    assert thin[-1].tolist() == [10, 10]
    assert np.abs(thin - [10, 0]).sum(axis=1).min() < 0.2


def test_a_line_too_short_to_thin_stays_as_it_is():
    assert len(geometry.thinned(np.zeros((2, 2)), 1.0)) == 2
    assert len(geometry.thinned(np.zeros((0, 2)), 1.0)) == 0


def test_the_heading_of_a_message_is_that_of_its_bow_and_unknown_where_none_is_measured():
    """REP-145: an Imu whose first covariance is -1 measures no orientation."""
    north = Quaternion.from_yaw(math.pi / 2)
    pose = PoseWithCovariance(Pose(orientation=north))
    assert geometry.heading_of(Imu(orientation=north)) == pytest.approx(0.0)
    assert geometry.heading_of(PoseWithCovarianceStamped(pose=pose)) == pytest.approx(0.0)
    assert geometry.heading_of(Odometry(Header(frame_id="map"), pose=pose)) == pytest.approx(0.0)
    assert geometry.heading_of(Odometry(Header(frame_id="robot/map"), pose=pose)) == pytest.approx(0.0)
    blind = Imu(orientation=north, orientation_covariance=[-1.0, *[0.0] * 8])
    assert math.isnan(geometry.heading_of(blind))


@pytest.mark.parametrize("frame", ["odom", "robot_1/odom", "odom_combined", "base_link"])
def test_there_is_no_heading_in_a_frame_that_has_no_north(frame):
    pose, header = PoseWithCovariance(Pose(orientation=Quaternion.from_yaw(0.3))), Header(frame_id=frame)
    assert math.isnan(geometry.heading_of(Odometry(header, pose=pose)))
    assert math.isnan(geometry.heading_of(PoseWithCovarianceStamped(header, pose))), (
        "as of a robot without a map"
    )
    assert math.isnan(geometry.heading_of(Odometry(pose=pose))), (
        "wheels that name no frame count from anywhere"
    )


@pytest.mark.parametrize(
    ("shown", "value", "then"),
    [(1.0, 1.05, 1.0), (1.0, 0.95, 1.0), (1.0, 1.1, 1.1), (1.0, 0.5, 0.5), (359.95, 0.0, 0.0)],
)
def test_a_change_that_is_not_seen_is_left_out(shown, value, then):
    assert geometry.steady(shown, value, 0.1) == then


def test_many_small_changes_are_followed():
    shown = value = 0.0
    for _ in range(1000):
        value += 0.03
        shown = geometry.steady(shown, value, 0.1)
        assert abs(shown - value) < 0.1


def test_what_becomes_known_or_unknown_is_told():
    assert geometry.steady(math.nan, 2.0, 0.1) == 2.0
    assert math.isnan(geometry.steady(2.0, math.nan, 0.1))


@given(st.lists(finite, min_size=1, max_size=40), st.sampled_from([0.0, 0.1, 0.5, 0.6, 0.9, 1.0]))
def test_a_share_of_the_values_does_not_exceed_their_percentile(values, share):
    ours = geometry.not_exceeded_by(np.array(values), share)
    assert ours == pytest.approx(float(np.percentile(values, share * 100)), abs=1e-9)


def test_of_no_values_there_is_no_share():
    with pytest.raises(ValueError, match="no values"):
        geometry.not_exceeded_by(np.array([]), 0.5)
