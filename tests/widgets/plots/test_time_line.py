from __future__ import annotations

import math

import pytest

from widgets.plots.time_line import TimeLine, length_text


@pytest.fixture
def line(stage):
    return stage.show(TimeLine(start=1000.0, end=1100.0, position=1000.0, state="live"), size=(400, 56))


def test_a_finger_goes_to_its_moment_and_along(line, stage):
    asked = []
    line.bind(on_seek=lambda _, at: asked.append(at))
    stage.drag([(line.x_of(1020.0), 28), (line.x_of(1050.0), 28), (line.x_of(1050.0) + 900, 28)])
    assert asked == [pytest.approx(1020.0), pytest.approx(1050.0), 1100.0]


def test_before_a_recording_is_open_a_finger_does_nothing(stage):
    line, asked = stage.show(TimeLine(), size=(400, 56)), []
    line.bind(on_seek=lambda _, at: asked.append(at))
    stage.drag([(100, 28), (200, 28)])
    assert asked == []


def test_the_wheel_is_left_to_others(line, stage):
    wheel = stage.touch(100, 28)
    wheel.button, wheel.profile = "scrolldown", ["button"]
    assert not line.on_touch_down(wheel)


@pytest.mark.parametrize(
    ("seconds", "text"), [(0, "0:00"), (271, "4:31"), (3725, "1:02:05"), (math.nan, "—"), (-3, "0:00")]
)
def test_a_length_is_said_shortly(seconds, text):
    assert length_text(seconds) == text
