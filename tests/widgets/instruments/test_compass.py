from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Pose, PoseWithCovariance, PoseWithCovarianceStamped, Quaternion
from bridge.msgs.pilothouse_msgs import Manoeuvre
from bridge.msgs.sensor_msgs import Imu
from widgets.instruments.compass import Compass, samples


def words(compass: Compass) -> list[str]:
    return [word.text for word in compass._texts(not math.isnan(compass.heading))]


@pytest.fixture
def compass(stage):
    return stage.show(Compass(), size=(200, 200))


@pytest.mark.parametrize(("yaw", "heading"), [(0, 90), (math.pi / 2, 0), (math.pi, 270), (-math.pi / 2, 180)])
def test_an_imu_turned_to_a_yaw_shows_the_heading(compass, yaw, heading):
    compass.show(Imu(orientation=Quaternion.from_yaw(yaw)))
    assert compass.heading == pytest.approx(heading)


def test_a_pose_shows_its_heading_too(compass):
    compass.show(
        PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(orientation=Quaternion.from_yaw(0.0))))
    )
    assert compass.heading == pytest.approx(90)


def test_an_imu_without_orientation_shows_a_dash(compass):
    compass.heading = 10
    compass.show(Imu(orientation_covariance=[-1.0] + [0.0] * 8))
    assert math.isnan(compass.heading)
    assert words(compass)[-1] == "–"


def test_before_the_first_message_there_is_a_dash(compass):
    assert words(compass)[-1] == "–"


def test_the_card_turns_under_the_pointer(compass, stage):
    compass.heading = 98
    stage.frames()
    assert compass._turn.angle == pytest.approx(98)
    assert words(compass)[-1] == "098°"


def test_359_goes_over_to_0(compass):
    compass.heading = 359.7
    assert words(compass)[-1] == "000°"


def test_north_is_left_of_the_pointer_when_heading_east(compass):
    compass.heading = 90
    north = next(word for word in compass._texts(known=True) if word.text == "N")
    assert north.x < compass.center_x - 50
    assert north.y == pytest.approx(compass.center_y)


def drawn(compass: Compass) -> list[tuple[object, ...]]:
    """Texture, colour and place of each text on the glass."""
    slots = [*compass._words._slots, *compass._reading._slots]
    return [(text.texture, tuple(colour.rgba), *text.pos, *text.size) for colour, text in slots]


@pytest.mark.parametrize("heading", [1.0, 93.0, 271.5, math.nan])
def test_figures_that_were_moved_are_where_a_new_card_has_them(compass, stage, heading):
    for before in (350.0, 42.0, heading):
        compass.heading = before
        stage.frames()
    fresh = Compass(size=compass.size, pos=compass.pos, heading=heading)
    fresh.draw()
    assert drawn(compass) == drawn(fresh)


def test_the_mark_of_the_wanted_heading_stays_with_the_card(compass, stage):
    marks = []
    for heading, wanted in ((10.0, 40.0), (20.0, 50.0), (20.0, 80.0), (math.nan, 80.0)):
        compass.heading, compass.wanted = heading, wanted
        stage.frames()
        marks.append(list(compass._marks.vertices))
    assert marks[0] == marks[1] != marks[2]
    assert len(marks[3]) == len(marks[2]) / 2  # the pointer alone


def test_many_changes_in_one_frame_are_drawn_once(compass, stage, monkeypatch):
    shown = []
    monkeypatch.setattr(Compass, "draw", lambda self: shown.append(self.heading))
    for heading in (1, 2, 3):
        compass.heading = heading
    stage.frames()
    assert shown == [3]


@pytest.mark.parametrize("name", samples())
def test_every_sample_can_be_shown(stage, name):
    assert stage.show(samples()[name]()).width == 220


def test_an_order_that_holds_a_course_says_where_it_should_point():
    compass = Compass(heading=10.0)
    compass.show(Manoeuvre(kind="course", yaw=0.0))
    assert (compass.heading, compass.wanted) == (10.0, 90.0)
    compass.show(Manoeuvre(kind="twist", yaw=0.0))
    assert math.isnan(compass.wanted)
