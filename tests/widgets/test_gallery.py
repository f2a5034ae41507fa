from __future__ import annotations

import ast
import re
from importlib import import_module
from pathlib import Path

import pytest
from kivy.uix.label import Label

import widgets
from widgets import CATALOGUE
from widgets.core.base import STATES, Control, RobotWidget
from widgets.core.theme import PALETTES, theme
from widgets.gallery import Exhibit, Gallery, all_samples, modules, page
from widgets.parts.labels import Icon

SAMPLES = list(all_samples())
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


@pytest.mark.parametrize("name", CATALOGUE)
def test_every_widget_of_the_catalogue_is_there_and_shows_its_states(name):
    kind = getattr(widgets, name)
    assert issubclass(kind, RobotWidget)
    assert import_module(CATALOGUE[name]).samples()
    assert kind.__doc__


@pytest.mark.parametrize("name", CATALOGUE)
def test_every_widget_says_what_it_takes_or_gives(name):
    kind = getattr(widgets, name)
    assert issubclass(kind, Control) or kind.accepts or name == "LinkQuality"


def test_a_widget_is_imported_when_it_is_asked_for():
    with pytest.raises(AttributeError, match="NoSuchWidget"):
        _ = widgets.NoSuchWidget
    assert set(CATALOGUE) <= set(dir(widgets))


@pytest.mark.parametrize(("title", "state", "build"), SAMPLES, ids=[f"{t}-{s}" for t, s, _ in SAMPLES])
def test_no_text_is_cut_off(stage, title, state, build):
    exhibit = stage.show(Exhibit(state, build()))
    stage.frames(4)
    for label in of(exhibit, Label):
        if label.text.strip() and not isinstance(label, Icon) and not label.shorten:
            width, height = label.texture_size
            assert width <= label.width + SLACK, label.text
            assert height <= label.height + SLACK, label.text


@pytest.mark.parametrize("build", [b for _, _, b in SAMPLES], ids=[f"{t}-{s}" for t, s, _ in SAMPLES])
def test_every_text_follows_the_theme_and_takes_no_colour_of_kivy(stage, build):
    labels = of(stage.show(Exhibit("x", build())), Label)
    for name in PALETTES:
        theme.name = name
        stage.frames(2)
        allowed = [list(colour) for colour in theme.roles.values()]
        assert not [label.text for label in labels if list(label.color) not in allowed]
        assert not [label.text for label in labels if list(label.disabled_color) != list(label.color)]


def test_the_states_of_the_robot_widgets_are_all_shown():
    shown = {build().state for title, _, build in SAMPLES if title in CATALOGUE}
    assert shown == set(STATES)


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
