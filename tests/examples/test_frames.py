"""Frames that are left out; tests/pixels/test_picture.py has the pictures that are not."""

from __future__ import annotations

from kivy.core.window import Window
from kivy.graphics import Callback
from kivy.uix.widget import Widget

from examples.demo.frames import seldom_drawn


def test_one_frame_in_so_many_is_drawn_and_the_first_one_is(stage):
    drawn, asked = [], []
    widget = Widget()
    with widget.canvas:
        Callback(lambda _: drawn.append(len(asked)))
    stage.show(widget, size=(20, 20))
    drawn.clear()
    with seldom_drawn(3):
        for _ in range(7):
            Window.dispatch("on_draw")
            asked.append(1)
    assert drawn == [0, 3, 6]
    Window.dispatch("on_draw")
    assert drawn[-1] == 7, "all of them again"
