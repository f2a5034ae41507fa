from __future__ import annotations

import math

import pytest

from bridge.msgs.arrays import Float32Array
from bridge.msgs.pilothouse_msgs import LineSensor
from widgets.sensors.line_sensor import LineSensorView


@pytest.fixture
def view(stage):
    return stage.show(LineSensorView(state="live"), size=(170, 84))


def cells(*values: float, spacing: float = 0.02) -> LineSensor:
    return LineSensor(values=Float32Array(values), spacing=spacing)


@pytest.mark.parametrize(
    ("message", "words"),
    [
        (cells(0.1, 0.8, 0.1, 0.1, 0.1), "20 mm left"),
        (cells(0.1, 0.1, 0.1, 0.1, 0.8), "40 mm right"),
        (cells(0.1, 0.1, 0.8, 0.1, 0.1), "in the middle"),
        (cells(0.1, 0.1, 0.1, 0.1, 0.8, spacing=math.nan), "2.0 cells right"),
        (cells(0.1, 0.1, 0.1), "no line"),
        (cells(0.8, 0.8, 0.8), "all bright"),
        (cells(math.nan, math.nan), "–"),
        (LineSensor(), "–"),
    ],
)
def test_it_says_where_the_line_is(stage, view, message, words):
    view.show(message)
    stage.frames(2)
    assert view.texts == ["LINE", words]


def test_where_it_is_low_only_the_figure_is_written(stage):
    view = stage.show(LineSensorView(state="live", card=False), size=(72, 54))
    view.show(cells(0.1, 0.8, 0.1, 0.1, 0.1))
    stage.frames(2)
    assert view.texts == ["20 mm L"]


def test_noise_of_a_ground_that_stays_is_not_drawn_anew(stage, view):
    view.show(cells(0.101, 0.8))
    stage.frames(2)
    drawn = []
    view.bind(values=lambda *_: drawn.append(1))
    view.show(cells(0.13, 0.76))
    assert not drawn
    view.show(cells(0.16, 0.801))
    assert len(drawn) == 1
    view.show(cells(math.nan, 0.801))
    view.show(cells(math.nan, 0.801))
    assert len(drawn) == 2
