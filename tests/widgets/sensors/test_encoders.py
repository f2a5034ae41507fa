from __future__ import annotations

import math

import pytest

from bridge.msgs.arrays import Float64Array
from bridge.msgs.sensor_msgs import JointState
from widgets.sensors.encoders import EncodersView


@pytest.fixture
def view(stage):
    return stage.show(EncodersView(state="live"), size=(190, 112))


def wheels(*speeds: float, angles: tuple[float, ...] = ()) -> JointState:
    names = ["wheel_left_joint", "wheel_right_joint", "c", "d", "e", "f"][: len(speeds)]
    return JointState(name=names, position=Float64Array(angles), velocity=Float64Array(speeds))


def test_each_wheel_tells_its_speed_and_how_far_it_turned(stage, view):
    view.show(wheels(11.44, -3.0, angles=(math.tau * 12.5, -math.tau)))
    stage.frames(2)
    assert view.texts == ["ENCODERS", "rad/s", "11.4", "left · 12.5 turns", "−3.0", "right · −1.0 turns"]


def test_what_is_not_measured_is_a_dash(stage, view):
    view.show(wheels(math.nan, 2.0))
    stage.frames(2)
    assert view.texts[2:] == ["—", "left · — turns", "2.0", "right · — turns"]


def test_a_full_bar_is_the_fastest_that_was_seen(view):
    view.show(wheels(1.0, -20.0))
    assert view.full == 20.0
    view.show(wheels(1.0, 1.0))
    assert view.full == 20.0


def test_of_many_joints_the_rest_is_counted(stage, view):
    view.size = 230, 160
    view.show(wheels(*[1.0] * 6))
    stage.frames(2)
    assert view.texts[1] == "rad/s · 2 more"


def test_where_it_is_low_there_are_two_lines(stage):
    view = stage.show(EncodersView(state="live", card=False), size=(120, 48))
    view.show(wheels(11.44, 14.3))
    stage.frames(2)
    assert view.texts == ["11.4 rad/s", "left", "14.3 rad/s", "right"]


def test_that_there_are_more_is_said_on_a_narrow_card_too(stage, view):
    view.size = 150, 160
    view.show(wheels(*[1.0] * 6))
    stage.frames(2)
    assert view.texts[1] == "2 more"


def test_low_it_says_its_unit_behind_each_figure_or_behind_none(stage):
    view = stage.show(EncodersView(state="live", card=False), size=(120, 48))
    view.show(wheels(1.0, -12.3))
    stage.frames(2)
    assert view.texts[::2] == ["1.0 rad/s", "−12.3 rad/s"]
    view.width = 72
    stage.frames(2)
    assert view.texts[::2] == ["1.0", "−12.3"]


def test_a_unit_for_which_its_header_has_no_room_stands_behind_each_figure(stage):
    view = stage.show(EncodersView(state="live", card=False), size=(98, 76))
    view.show(wheels(1.0, -12.3))
    stage.frames(2)
    assert "rad/s" not in view.texts
    assert [text for text in view.texts if "rad/s" in text] == ["1.0 rad/s", "−12.3 rad/s"]
