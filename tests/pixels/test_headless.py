"""Drawing without a display."""

from __future__ import annotations

from kivy.graphics import Color, Rectangle
from kivy.uix.widget import Widget

from tests.headless import difference


def test_colours_reach_the_picture(stage):
    widget = Widget()
    with widget.canvas:
        Color(1, 0, 0)
        Rectangle(size=(40, 20))
    stage.show(widget, size=(40, 20))
    got = stage.pixels(widget)
    assert got.shape == (20, 40, 4)
    assert got[10, 20].tolist() == [255, 0, 0, 255]


def test_the_difference_is_the_share_of_unlike_pixels(stage):
    widget = stage.show(Widget(), size=(10, 10))
    got = stage.pixels(widget)
    want = got.copy()
    want[0, :5] = 255
    assert difference(got, want) == 0.05
