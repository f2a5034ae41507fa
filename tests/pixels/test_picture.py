"""Pictures of the demo."""

from __future__ import annotations

from kivy.core.window import Window
from kivy.graphics import Color, Rectangle
from kivy.uix.widget import Widget
from PIL import Image

from examples.demo.frames import seldom_drawn
from examples.demo.report import picture


def test_a_picture_shows_what_is_on_the_glass_whatever_was_left_out(stage, tmp_path):
    widget = Widget()
    with widget.canvas:
        color = Color(1, 0, 0)
        Rectangle(size=Window.size)
    stage.show(widget, size=(20, 20))
    with seldom_drawn(1000):
        stage.frames(2)
        color.rgb = (0, 1, 0)
        stage.frames(2)
        picture(tmp_path / "green.png")
        color.rgb = (0, 0, 1)
        picture(tmp_path / "blue.png")
    for name, seen in (("green", (0, 255, 0)), ("blue", (0, 0, 255))):
        with Image.open(tmp_path / f"{name}.png") as saved:
            assert saved.getpixel((5, saved.height - 5)) == seen
