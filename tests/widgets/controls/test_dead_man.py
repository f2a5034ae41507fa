"""A held control that can no longer be seen rests: nobody holds what nobody sees."""

from __future__ import annotations

import pytest
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.modalview import ModalView
from kivy.uix.widget import Widget

from bridge.msgs.std_msgs import Bool
from widgets.controls.dead_man import WATCH_PERIOD, DeadMan


class Knob(DeadMan):
    sends = (Bool,)
    held = False

    def follow(self, touch):
        self.held = True

    def spring(self):
        self.held = False


@pytest.fixture
def scene(stage):
    """A knob in a box in a screen, and a finger on it."""
    screen, box = FloatLayout(), FloatLayout()
    screen.knob = Knob(size_hint=(None, None), size=(100, 100))
    box.add_widget(screen.knob)
    screen.add_widget(box)
    screen.box = box
    stage.show(screen, size=(400, 300))
    stage.touch(50, 50).touch_down()
    assert screen.knob.held
    return screen


def away_itself(scene):
    scene.box.remove_widget(scene.knob)


def away_with_its_box(scene):
    scene.remove_widget(scene.box)


def away_with_the_screen(scene):
    scene.get_root_window().remove_widget(scene)


def unseen(scene):
    scene.knob.opacity = 0


def unseen_with_its_box(scene):
    scene.box.opacity = 0


def disabled_with_the_screen(scene):
    scene.disabled = True


def under_a_dialogue(scene):
    ModalView(size_hint=(0.5, 0.5)).open(animation=False)


@pytest.mark.parametrize(
    "gone",
    [
        away_itself,
        away_with_its_box,
        away_with_the_screen,
        unseen,
        unseen_with_its_box,
        disabled_with_the_screen,
        under_a_dialogue,
    ],
)
def test_what_can_no_longer_be_seen_rests(stage, scene, gone):
    gone(scene)
    stage.run_for(WATCH_PERIOD * 1.5)
    assert not scene.knob.held
    assert scene.knob.finger is None


def test_what_can_be_seen_stays_held(stage, scene):
    scene.add_widget(Widget(size_hint=(0.1, 0.1)))
    stage.run_for(3.0)
    assert scene.knob.held


def test_it_takes_no_finger_while_it_is_hidden(stage, scene):
    scene.knob.rest()
    scene.box.opacity = 0
    stage.touch(50, 50).touch_down()
    assert not scene.knob.held


def test_nothing_watches_once_it_is_let_go(stage, scene):
    before = len(stage.clock.get_events())
    scene.knob.rest()
    assert len(stage.clock.get_events()) == before - 1
