"""What covers its place whole is not mixed with what is below, and what follows is."""

from __future__ import annotations

import pytest
from kivy.graphics import Color, Rectangle
from kivy.uix.widget import Widget

from tests.headless import Stage
from widgets.core.unblended import Unblended

SIDE = 20


@pytest.mark.parametrize(("on", "seen"), [(True, 255), (False, 128)])
def test_a_colour_that_lets_half_through_lets_nothing_through(stage: Stage, on: bool, seen: int) -> None:
    widget, plain = Widget(), Unblended()
    plain.on = on
    for part in (Color(1, 0, 0, 0.5), Rectangle(size=(SIDE, SIDE))):
        plain.add_part(part)
    with widget.canvas:
        Color(0, 0, 0, 1)
        Rectangle(size=(SIDE, SIDE))
    widget.canvas.add(plain)
    with widget.canvas.after:
        Color(0, 1, 0, 0.5)
        Rectangle(size=(SIDE / 2, SIDE))
    stage.show(widget, (SIDE, SIDE))
    picture = stage.pixels(widget)
    assert picture[5, SIDE - 2, :2] == pytest.approx([seen, 0], abs=2)
    assert picture[5, 2, :2] == pytest.approx([seen / 2, 128], abs=2), "blended again"
