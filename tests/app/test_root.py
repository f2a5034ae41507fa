"""The glass: what must always be reached is above everything that comes onto it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from kivy.core.window import Window
from kivy.uix.widget import Widget

from app.root import Root
from widgets.core.theme import PALETTES, theme


@pytest.fixture
def themed() -> Iterator[None]:
    """The window and the theme are everybody's: both are given back."""
    before = Window.clearcolor
    yield
    theme.name = "dark"
    Window.clearcolor = before


def test_what_must_be_reached_is_above_pages_and_questions() -> None:
    root, stop, page, question = Root(), Widget(), Widget(), Widget()
    root.over = stop
    root.show_page(page)
    assert root.children == [stop, page], "the first is on top"
    root.add_widget(question)
    assert root.children == [stop, question, page]


def test_a_page_takes_the_place_of_the_one_before_and_of_its_questions() -> None:
    root, page = Root(), Widget()
    root.show_page(Widget())
    root.add_widget(Widget())
    root.show_page(page)
    assert root.children == [page]


@pytest.mark.usefixtures("themed")
def test_the_window_begins_each_frame_in_the_colour_of_the_theme() -> None:
    theme.name = "night"
    root = Root()
    assert list(Window.clearcolor) == list(theme.bg)
    for name in PALETTES:
        theme.name = name
        assert list(Window.clearcolor) == list(theme.bg)
        assert root.children == []
