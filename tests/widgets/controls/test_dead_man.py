"""A held control that can no longer be seen rests: nobody holds what nobody sees."""

from __future__ import annotations

import pytest
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.label import Label
from kivy.uix.modalview import ModalView
from kivy.uix.widget import Widget

from bridge.msgs.std_msgs import Bool
from widgets.controls.dead_man import WATCH_PERIOD, DeadMan
from widgets.parts.kit import Roll


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


class AskingCard(FloatLayout):
    """A dialogue of an app's own: a card on a shade, no ModalView; of a name that no rule of Kivy's is for."""


class SlidingBox(BoxLayout):
    """Comes in from the side."""


def under_a_question_beside_its_box(scene):
    scene.add_widget(AskingCard())


def under_a_card_on_a_layer(scene):
    layer = FloatLayout()
    scene.add_widget(layer)
    layer.add_widget(Label(size_hint=(None, None), size=(60, 60), pos=(20, 20)))


def under_a_drawer(scene):
    drawer = SlidingBox(size_hint=(None, None), size=(200, 300), pos=(-300, 0))
    scene.add_widget(drawer)
    drawer.x = 0


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
        under_a_question_beside_its_box,
        under_a_card_on_a_layer,
        under_a_drawer,
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


def test_what_is_scrolled_out_of_sight_rests_and_what_is_scrolled_within_it_is_held(stage):
    knob, roll = Knob(size_hint=(None, None), size=(100, 100)), Roll(size_hint=(None, None))
    column = BoxLayout(orientation="vertical", size_hint_y=None, height=900)
    column.add_widget(knob)
    column.add_widget(Widget())
    roll.add_widget(column)
    stage.show(roll, size=(400, 300))
    stage.touch(50, 250).touch_down()
    assert knob.held
    roll.scroll_y = 0.95
    stage.run_for(WATCH_PERIOD * 2)
    assert knob.held, "more than half of it is seen"
    roll.scroll_y = 0.0
    stage.run_for(WATCH_PERIOD * 1.5)
    assert not knob.held


def test_what_let_the_finger_through_does_not_end_its_hold_but_a_dialogue_in_it_does(stage, scene):
    scene.knob.rest()
    shown = AskingCard()  # over all, seen through and letting every finger through
    scene.add_widget(shown)
    stage.frames(2)
    stage.touch(50, 50).touch_down()
    stage.run_for(1.0)
    assert scene.knob.held
    shown.add_widget(Label(text="Sure?"))
    stage.run_for(WATCH_PERIOD * 1.5)
    assert not scene.knob.held


def test_what_is_anywhere_for_a_frame_while_it_is_laid_out_ends_nothing(stage, scene):
    passing = Label(size_hint=(None, None), size=(100, 100))
    scene.add_widget(passing)
    scene.knob._look()
    passing.pos = (300, 200)
    stage.run_for(1.0)
    assert scene.knob.held


def test_it_takes_no_finger_while_it_is_hidden(stage, scene):
    scene.knob.rest()
    scene.box.opacity = 0
    stage.touch(50, 50).touch_down()
    assert not scene.knob.held


def test_hidden_it_rests_at_once_and_not_with_the_next_look(scene):
    scene.knob.opacity = 0
    assert not scene.knob.held


def test_a_finger_on_a_disabled_one_is_left_to_what_lies_below(stage, scene):
    scene.knob.rest()
    scene.disabled = True
    touch = stage.touch(50, 50)
    assert not scene.knob.on_touch_down(touch)
    assert scene.knob.finger is None


def test_nothing_watches_once_it_is_let_go(stage, scene):
    before = len(stage.clock.get_events())
    scene.knob.rest()
    assert len(stage.clock.get_events()) == before - 1
