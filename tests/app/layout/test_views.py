"""Views of a layout file: what a hand may write, all that is wrong with it at once, and where each panel comes to lie."""

from __future__ import annotations

import pytest

from app.layout.layout import LayoutError, load, names, parse
from app.layout.layout_text import text_of
from app.layout.panel_grid import Place
from app.layout.views import Panel, View, places_of
from widgets import CATALOGUE

VIEW = """
[[view]]
title = "Sensors"

[[view.panel]]
widget = "Compass"
topic = "/pose"
wide = [0, 0, 3, 4]

[[view.panel]]
widget = "Readout"
topic = "/odom"
field = "twist.twist.linear.x"
title = "Speed"
unit = "m/s"
stack = "left"

[[view.panel]]
widget = "FieldView"
topic = "/their/own_topic"
stack = "left"

[[view.panel]]
widget = "Joystick"

[[view.panel]]
widget = "SpeedCard"
hidden = true
"""


def panel(*lines: str) -> str:
    return '[[view]]\ntitle = "A"\n[[view.panel]]\n' + "\n".join(lines) + "\n"


def faults(text: str) -> list[tuple[int, str]]:
    with pytest.raises(LayoutError) as caught:
        parse("x", text, CATALOGUE)
    return [(fault.line, fault.sentence) for fault in caught.value.faults]


def test_a_view_is_read_as_it_is_written() -> None:
    (view,) = parse("x", VIEW, CATALOGUE).views
    assert view.title == "Sensors"
    assert [one.widget for one in view.panels] == ["Compass", "Readout", "FieldView", "Joystick", "SpeedCard"]
    assert view.panels[0].place("wide") == Place(0, 0, 3, 4)
    assert view.panels[0].place("tall") is None
    assert view.panels[4].hidden


@pytest.mark.parametrize("name", names())
def test_every_layout_and_its_views_are_written_as_they_are_read(name: str) -> None:
    layout = load(name, CATALOGUE)
    assert parse(name, text_of(layout), CATALOGUE) == layout
    more = parse(name, text_of(layout) + VIEW, CATALOGUE)
    assert parse(name, text_of(more), CATALOGUE) == more


def test_titles_of_any_letters_are_written_as_they_are() -> None:
    layout = parse("x", VIEW.replace("Sensors", 'a\\"b\\\\ \\u007f \\n é 中'), CATALOGUE)
    assert layout.views[0].title == 'a"b\\ \x7f \n é 中'
    assert parse("x", text_of(layout), CATALOGUE) == layout


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (panel("widget = 'Compas'", "topic = '/pose'"), "panel 1: widget is one of .*, not 'Compas'"),
        (panel("widget = 'Compass'"), "panel 1: topic is missing"),
        (panel("widget = 'Compass'", "topic = 'pose'"), "topic is a name as in /imu/data, not 'pose'"),
        (panel("widget = 'Compass'", "topic = '/battery_state'"), "Compass shows .*, not /battery_state"),
        (panel("widget = 'SusForm'", "topic = '/pose'"), "SusForm shows no topic, so it is no panel"),
        (panel("widget = 'Readout'", "topic = '/odom'", "field = 'twist.speed'"), "no number 'twist.speed'"),
        (panel("widget = 'Readout'", "topic = '/odd'", "field = '../etc'"), "field is a path as in"),
        (panel("widget = 'Joystick'", "topic = '/odom'"), "Joystick shows no topic, not /odom"),
        (panel("widget = 'StopButton'"), "StopButton shows no topic, so it is no panel"),
        (panel("widget = 'SlideToConfirm'"), "action is one of .*, not None"),
        (panel("widget = 'Joystick'", "forward = 'up'"), "forward is one of .*, not 'up'"),
        (panel("widget = 'Joystick'", "wide = [10, 0, 3, 4]"), "wide is .* within 12 columns"),
        (panel("widget = 'Joystick'", "tall = [0, 0, 0, 1]"), "tall is .* within 6 columns"),
        (panel("widget = 'Joystick'", "shade = 1"), "view 1, panel 1: key is one of .*, not 'shade'"),
        (panel("widget = 'Joystick'", "[[view.panel]]", "widget = 'Joystick'"), "two controls for ahead"),
        (
            panel("widget = 'Battery'", "topic = '/battery_state'", "wide = [0, 0, 2, 2]")
            + "[[view.panel]]\nwidget = 'Battery'\ntopic = '/battery_state'\nwide = [1, 1, 2, 2]",
            "panels 1 and 2 overlap in wide",
        ),
        ("[[view]]\ntitle = ' '", "view 1: title must not be empty"),
        ("[[view]]\ntitle = 'A'\n" * 13, "13 views, where 12 fit"),
        (panel(*["widget = 'Battery'\ntopic = '/b'\n[[view.panel]]"] * 41, "widget = 'Battery'"), "40 fit"),
    ],
)
def test_a_mistake_in_a_view_is_a_sentence_with_its_place(text: str, sentence: str) -> None:
    with pytest.raises(LayoutError, match=sentence):
        parse("x", text, CATALOGUE)


def test_all_faults_of_a_file_are_told_at_once_in_their_order() -> None:
    text = (
        'title = 3\n[[instrument]]\nwidget = "Compas"\ntopic = "/pose"\n'
        + panel("widget = 'Joystick'", "digits = 'two'")
        + "[[view.panel]]\nwidget = 'Compass'\nshade = 1"
    )
    found = faults(text)
    assert [line for line, _ in found] == [1, 2, 3, 9, 10, 12]
    for (_, sentence), part in zip(
        found,
        ("title must", "slot is missing", "not 'Compas'", "digits must", "topic is missing", "'shade'"),
        strict=True,
    ):
        assert part in sentence


def test_two_sticks_of_one_stack_may_say_the_same_for_one_is_in_sight() -> None:
    stick = "widget = 'Joystick'\nstack = 'hand'\n"
    text = panel(stick, "title = 'Slow'", "[[view.panel]]", stick, "title = 'Fast'")
    assert len(parse("x", text, CATALOGUE).views[0].panels) == 2


def test_what_has_no_place_by_hand_lies_where_nothing_else_is() -> None:
    view = View("A", (Panel("Compass", "/pose", wide=(0, 0, 6, 4)), *[Panel("Compass", "/pose")] * 7))
    for form in ("wide", "short", "tall"):
        places = places_of(view.panels, form)
        assert not any(a.overlaps(b) for i, a in enumerate(places) for b in places[i + 1 :])
    assert places_of(view.panels, "wide")[0] == Place(0, 0, 6, 4)


def test_panels_of_a_stack_share_the_place_of_the_first() -> None:
    panels = (Panel("Compass", "/pose", stack="s"), Panel("Battery", "/b"), Panel("Battery", "/c", stack="s"))
    first, second, third = places_of(panels, "wide")
    assert first == third != second
