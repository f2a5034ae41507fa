"""What is clear is not drawn, and what is drawn is where its rule says."""

from __future__ import annotations

from typing import Any

import pytest
from kivy.factory import Factory
from kivy.graphics import Color, Rectangle, SmoothLine
from kivy.lang import Builder
from kivy.uix.widget import Widget

from widgets.core.base import text_texture
from widgets.core.visible import Outline, Tinted, Visible

RED, CLEAR = (1, 0, 0, 1), (1, 0, 0, 0)


@pytest.mark.parametrize("kind", [Outline, Tinted])
def test_it_is_drawn_only_while_its_colour_lets_something_be_seen(kind: type[Visible]) -> None:
    one: Any = kind()
    assert not one.drawn
    for _ in range(2):
        one.rgba = RED
        assert one.drawn
        assert (one.rgba, [type(part) for part in one.children].count(Color)) == (list(RED), 1)
        one.rgba = CLEAR
        assert (one.drawn, one.children) == (False, [])


def test_an_outline_goes_round_its_box(stage: Any) -> None:
    line, widget = Outline(), Widget()
    line.rgba, line.rounded_rectangle, line.width = RED, (1, 2, 30, 40, 5), 1.5
    widget.canvas.add(line)
    stage.show(widget, (100, 100))
    (drawn,) = (part for part in line.children if isinstance(part, SmoothLine))
    assert len(drawn.points) > 8, "it has corners"
    assert drawn.width == line.width == 1.5
    assert line.rounded_rectangle == (1, 2, 30, 40, 5)
    assert max(drawn.points[::2]) == pytest.approx(31, abs=0.5)
    line.rounded_rectangle = (1, 2, 60, 40, 5)
    stage.frames(2)
    assert max(drawn.points[::2]) == pytest.approx(61, abs=0.5)


def test_a_text_is_where_it_belongs_when_it_is_seen_later(stage: Any) -> None:
    word = Tinted()
    word.texture, word.pos, word.size = text_texture("12 s old", 12), (3, 4), (50, 12)
    word.rgba = RED
    (drawn,) = (part for part in word.children if isinstance(part, Rectangle))
    assert drawn.texture is word.texture is text_texture("12 s old", 12)
    assert (tuple(drawn.pos), tuple(drawn.size)) == ((3, 4), (50, 12)) == (word.pos, word.size)


def test_rules_make_them_in_no_canvas_but_their_own(stage: Any) -> None:
    Builder.load_string("""
<VisibleInARule@Widget>:
    canvas.after:
        Outline:
            rgba: (0, 1, 0, 1) if self.disabled else (0, 0, 0, 0)
            rounded_rectangle: self.pos + self.size + [4]
        Tinted:
            rgba: 0, 1, 0, 1
            pos: self.pos
            size: self.size
""")
    widget: Widget = stage.show(Factory.VisibleInARule(), (90, 40))
    outline, tinted = widget.canvas.after.children
    assert (outline.drawn, tinted.drawn) == (False, True)
    widget.disabled, widget.pos = True, (5, 6)
    stage.frames(2)
    assert outline.drawn
    assert outline.rounded_rectangle == (5, 6, 90, 40, 4)
    assert tinted.pos == (5, 6)
