from __future__ import annotations

import ast
import re
from importlib import import_module
from pathlib import Path

import pytest
from kivy.uix.label import Label

import widgets
from tests.looped import looped
from widgets import CATALOGUE
from widgets.core.base import STATES, Control, RobotWidget
from widgets.core.theme import PALETTES, theme
from widgets.gallery import Exhibit, Gallery, all_samples, modules, page
from widgets.parts.labels import Icon

SAMPLES = list(all_samples())
TITLES = list(dict.fromkeys(title for title, _, _ in SAMPLES))
SLACK = 1.5
"""Rounding of a text's size [px]."""


@pytest.fixture(autouse=True)
def dark_afterwards():
    yield
    theme.name = "dark"


def of(widget, kind):
    return [part for part in widget.walk() if isinstance(part, kind)]


def test_every_widget_has_a_line_for_the_type_checker():
    body = ast.parse(Path(widgets.__file__).read_text()).body
    typed = next(node.body for node in body if isinstance(node, ast.If) and node.test.id == "TYPE_CHECKING")
    assert {line.names[0].name: line.module for line in typed} == CATALOGUE


@looped("name", CATALOGUE)
def test_every_widget_of_the_catalogue_is_there_and_shows_its_states(name):
    kind = getattr(widgets, name)
    assert issubclass(kind, RobotWidget)
    assert import_module(CATALOGUE[name]).samples()
    assert kind.__doc__


@looped("name", CATALOGUE)
def test_every_widget_says_what_it_takes_or_gives(name):
    kind = getattr(widgets, name)
    assert issubclass(kind, Control) or kind.accepts or name == "LinkQuality"


def test_a_widget_is_imported_when_it_is_asked_for():
    with pytest.raises(AttributeError, match="NoSuchWidget"):
        _ = widgets.NoSuchWidget
    assert set(CATALOGUE) <= set(dir(widgets))


def cut_off(exhibit):
    """Texts that are larger than the room they have."""
    for label in of(exhibit, Label):
        if label.text.strip() and not isinstance(label, Icon) and not label.shorten:
            width, height = label.texture_size
            if width > label.width + SLACK or height > label.height + SLACK:
                yield label.text


def in_colours_of_its_own(exhibit):
    """Texts of a colour that the theme has no role for, and those that Kivy paints otherwise when disabled."""
    allowed = [list(colour) for colour in theme.roles.values()]
    for label in of(exhibit, Label):
        if list(label.color) not in allowed or list(label.disabled_color) != list(label.color):
            yield label.text


@pytest.mark.parametrize("title", TITLES)
def test_no_text_is_cut_off_and_every_text_follows_the_theme(stage, title):
    """All samples of a widget hang at once, so that a change of theme is one for all of them."""
    hung = {state: Exhibit(state, build()) for kind, state, build in SAMPLES if kind == title}
    for exhibit in hung.values():
        stage.window.add_widget(exhibit)
    stage.frames(6)
    wrong = [f"{state}: {text!r} is cut off" for state, exhibit in hung.items() for text in cut_off(exhibit)]
    for name in PALETTES:
        theme.name = name
        stage.frames(2)
        wrong += [
            f"{state}: {text!r} is not of the theme {name}"
            for state, exhibit in hung.items()
            for text in in_colours_of_its_own(exhibit)
        ]
    assert not wrong


def test_the_states_of_the_robot_widgets_are_all_shown():
    left = set(STATES)
    samples = (sample for sample in SAMPLES if sample[0] in CATALOGUE)
    while left:
        _, _, build = next(samples)
        left.discard(build().state)


def test_a_name_picks_one_widget_or_says_what_there_is():
    assert modules("joystick") == {"Joystick": "widgets.controls.sticks.joystick"}
    assert modules("stop_button") == {"StopButton": "widgets.controls.stop.stop_button"}
    with pytest.raises(KeyError, match="There is no widget 'wheel'; there are .*Joystick"):
        modules("wheel")


def test_the_wall_hangs_every_sample_of_a_widget(stage):
    wall = stage.show(Gallery("Joystick"), size=(1280, 800))
    assert len(of(wall, Exhibit)) == len(import_module("widgets.controls.sticks.joystick").samples())
    wall.set_theme("night")
    assert theme.name == "night"


def test_the_page_shows_every_picture_once():
    pictures = [Path("g") / palette / "compass-live.png" for palette in PALETTES]
    text = page(Path("g"), pictures)
    assert re.findall(r'src="([^"]+)"', text) == [f"{palette}/compass-live.png" for palette in PALETTES]
