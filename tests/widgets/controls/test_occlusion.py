"""What lies over a control, and what of it is out of sight."""

from __future__ import annotations

import pytest
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.label import Label
from kivy.uix.modalview import ModalView
from kivy.uix.stencilview import StencilView
from kivy.uix.widget import Widget

from widgets.controls.occlusion import covered, covering, cut_off


def card(x: float, y: float, **more: object) -> Label:
    return Label(size_hint=(None, None), size=(40, 40), pos=(x, y), **more)


@pytest.fixture
def scene(stage):
    """A control of 100 by 100 in a box on a screen."""
    screen, box = FloatLayout(), FloatLayout()
    screen.control = Widget(size_hint=(None, None), size=(100, 100), pos=(100, 100))
    box.add_widget(screen.control)
    screen.add_widget(box)
    return stage.show(screen, size=(400, 300))


@pytest.mark.parametrize(
    ("over", "hidden"),
    [
        (lambda: card(130, 130), True),
        (lambda: card(130, 130, opacity=0), False),
        (lambda: card(70, 70), False),
        (lambda: card(300, 200), False),
        (Widget, False),
        (FloatLayout, False),
        (type("Shade", (FloatLayout,), {}), True),
    ],
    ids=[
        "card",
        "unseen card",
        "card at the corner of the round",
        "card beside it",
        "bare",
        "bare layer",
        "a shade",
    ],
)
def test_only_what_shows_something_over_its_round_covers_it(stage, scene, over, hidden):
    scene.add_widget(over())
    stage.frames(2)
    assert covered(scene.control) is hidden


def test_what_lies_below_it_covers_nothing(stage, scene):
    scene.add_widget(card(130, 130), index=len(scene.children))
    stage.frames(2)
    assert not covered(scene.control)


def test_what_is_within_that_which_covers_is_told_too(stage, scene):
    layer, inner = FloatLayout(), card(130, 130)
    layer.add_widget(inner)
    scene.add_widget(layer)
    stage.frames(2)
    assert list(covering(scene.control)) == [inner]


def test_a_dialogue_covers_all_however_small_it_is(stage, scene):
    ModalView(size_hint=(None, None), size=(10, 10)).open(animation=False)
    assert covered(scene.control)


def test_what_is_off_the_glass_is_covered(scene):
    scene.get_root_window().remove_widget(scene)
    assert covered(scene.control)


def test_what_is_outside_of_what_shows_a_part_of_it_is_cut_off(stage):
    part = StencilView(size_hint=(None, None), size=(100, 100))
    control = Widget(size_hint=(None, None), size=(100, 100), pos=(0, 49))
    part.add_widget(control)
    stage.show(part, size=(100, 100))
    assert not cut_off(control)
    control.y = 51
    assert cut_off(control)
    assert covered(control)
