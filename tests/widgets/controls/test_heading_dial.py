from __future__ import annotations

import math

import pytest

from widgets.controls.heading_dial import HeadingDial


@pytest.mark.parametrize(("yaw", "words"), [(0.0, "robot 090°"), (math.pi / 2, "robot 000°"), (math.nan, "")])
def test_the_arrow_of_the_robot_points_where_it_points_and_says_whose_it_is(stage, yaw, words):
    dial = stage.show(HeadingDial(), size=(190, 190))
    dial.robot = yaw
    assert dial.robot_words == words
    if words:
        tip = dial.own[0] - dial.center_x, dial.own[1] - dial.center_y
        assert math.atan2(tip[1], tip[0]) == pytest.approx(yaw, abs=1e-6)
