"""The demo's hand: its fingers are touches like any other."""

from __future__ import annotations

import pytest
from kivy.base import EventLoop
from kivy.uix.button import Button
from kivy.uix.slider import Slider

from examples.demo.fingers import Hand
from examples.demo.glass import Glass, Unseen


@pytest.fixture
def hand(stage):
    hand = Hand()
    EventLoop.add_input_provider(hand)
    yield hand
    EventLoop.remove_input_provider(hand)


def play(stage, story):
    """Take a story to its end, a frame at each turn, and return what it gave."""
    while True:
        try:
            next(story)
        except StopIteration as end:
            return end.value
        stage.frames()


def test_a_tap_presses_what_is_under_it(stage, hand):
    button = stage.show(Button(), size=(200, 100))
    pressed = []
    button.bind(on_press=pressed.append)
    play(stage, hand.tap((100, 50)))
    play(stage, hand.tap((300, 50)))
    assert pressed == [button]


def test_a_drag_goes_through_every_place_on_its_way(stage, hand):
    slider = stage.show(Slider(padding=0, min=0, max=200), size=(200, 40))
    seen = []
    slider.bind(value=lambda _, value: seen.append(round(value)))
    play(stage, hand.drag([(0, 20), (160, 20)]))
    assert seen[-1] == 160
    assert seen == sorted(seen)
    assert len(seen) >= 5


def test_two_fingers_are_two_touches(stage, hand):
    stage.show(Button(), size=(200, 100))
    one, two = hand.down((20, 20)), hand.down((60, 20))
    stage.frames(2)
    assert len(EventLoop.touches) == 2
    hand.up(one)
    hand.up(two)
    stage.frames(2)
    assert not EventLoop.touches


def test_a_thing_is_found_by_the_words_on_it(stage, hand):
    pressed = []
    button = Button(text="Start patrol")
    button.bind(on_release=pressed.append)
    stage.show(button, size=(200, 100))
    play(stage, Glass(hand).press("Start"))
    assert pressed == [button]


def test_what_cannot_be_pressed_is_not_found(stage, hand):
    stage.show(Button(text="Start patrol", disabled=True), size=(200, 100))
    with pytest.raises(Unseen, match="something that says 'Start'"):
        play(stage, Glass(hand).press("Start", seconds=0))


def test_what_is_off_the_glass_or_transparent_is_not_seen(stage, hand):
    glass = Glass(hand)
    button = stage.show(Button(text="Here"), size=(200, 100))
    assert glass.all("Button") == [button]
    button.pos = (5000, 0)
    assert glass.all("Button") == []
    button.pos, button.opacity = (0, 0), 0
    assert glass.all("Button") == []
