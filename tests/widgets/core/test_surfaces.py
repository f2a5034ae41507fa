from __future__ import annotations

import pytest
from kivy.graphics import Color, Rectangle
from kivy.uix.widget import Widget

from widgets.core.rounded import Rounded
from widgets.core.surfaces import Edged, Glass, Outlined, Pressable
from widgets.core.theme import theme
from widgets.core.visible import Visible


class Box(Outlined, Widget):
    pass


class Key(Pressable, Widget):
    pass


class Bar(Edged, Widget):
    pass


class Pane(Glass, Widget):
    pass


def colours(widget):
    return [list(part.rgba) for part in widget.canvas.before.children if isinstance(part, (Color, Visible))]


def boxes(widget):
    return [part for part in widget.canvas.before.children if isinstance(part, Rounded)]


@pytest.mark.parametrize("name", ["dark", "night"])
def test_a_box_has_the_colours_of_its_roles_in_every_theme(stage, name):
    box = stage.show(Box(rim="plan", ground="surface"))
    theme.name = name
    stage.frames(2)
    assert colours(box) == [pytest.approx(theme.plan), pytest.approx(theme.surface)]


def test_without_a_role_nothing_is_seen(stage):
    assert [box.drawn for box in boxes(stage.show(Box(rim="", ground="")))] == [False] * 2


def test_the_ground_lies_within_the_border(stage):
    box = stage.show(Box(corner=8, rim_width=2), size=(100, 50))
    outer, inner = boxes(box)
    x, y = box.pos
    assert (outer.pos, outer.size, outer.radius[0]) == ((x, y), (100, 50), 8)
    assert (inner.pos, inner.size, inner.radius[0]) == ((x + 2, y + 2), (96, 46), 6)


def test_a_finger_changes_what_it_presses(stage):
    key = stage.show(Key(press_role="accent", press_share=0.2))
    assert colours(key)[2][3] == 0
    key.state = "down"
    stage.frames(2)
    assert colours(key)[2] == pytest.approx([*theme.accent[:3], 0.2])


def test_glass_is_there_for_a_card_only(stage):
    assert colours(stage.show(Pane())) == [pytest.approx(theme.glass), pytest.approx(theme.line)]
    assert colours(stage.show(Pane(card=False))) == [[0, 0, 0, 0]] * 2


@pytest.mark.parametrize(
    ("edge", "pos", "size"),
    [("bottom", (10, 20), (300, 1)), ("top", (10, 75), (300, 1)), ("right", (309, 20), (1, 56))],
)
def test_a_bar_has_its_line_along_the_edge_where_the_screen_begins(stage, edge, pos, size):
    bar = Bar(edge=edge, size_hint=(None, None), pos=(10, 20), size=(300, 56))
    stage.show(bar)
    bar.pos = 10, 20
    stage.frames(2)
    ground, line = (part for part in bar.canvas.before.children if isinstance(part, Rectangle))
    assert (tuple(ground.pos), tuple(ground.size)) == ((10, 20), (300, 56))
    assert (line.pos, line.size) == (pytest.approx(pos), pytest.approx(size))
    assert colours(bar) == [pytest.approx(theme.surface), pytest.approx(theme.line)]
