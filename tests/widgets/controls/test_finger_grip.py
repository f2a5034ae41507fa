from __future__ import annotations

import pytest
from kivy.properties import NumericProperty
from kivy.uix.widget import Widget

from widgets.controls.finger_grip import Grip


class Handle(Grip, Widget):
    """A grip without a picture."""

    at = NumericProperty(0.0)

    def follow(self, touch):
        self.at = touch.x

    def spring(self):
        self.at = 0.0


@pytest.fixture
def handle(stage):
    return stage.show(Handle(), size=(200, 60))


def hold(stage, x, y=30):
    finger = stage.touch(x, y)
    finger.touch_down()
    return finger


def test_it_follows_the_finger_and_springs_back(stage, handle):
    finger = hold(stage, 40)
    finger.touch_move(900, 30)
    assert (handle.at, handle.finger) == (pytest.approx(900), finger)
    finger.touch_up()
    assert (handle.at, handle.finger) == (0.0, None)


def test_another_finger_neither_moves_nor_releases_it(stage, handle):
    hold(stage, 40)
    other = hold(stage, 120)
    other.touch_up()
    assert handle.at == 40


def test_a_finger_beside_it_is_not_its(stage, handle):
    hold(stage, 300)
    assert handle.finger is None


def test_a_finger_whose_end_was_lost_does_not_hold_it_when_it_comes_down_elsewhere(stage, handle):
    finger = hold(stage, 40)
    finger.sx, finger.sy = 0.9, 0.9
    finger.touch_down()
    assert (handle.at, handle.finger) == (0.0, None)


@pytest.mark.parametrize("change", [{"pos": (40, 0)}, {"size": (120, 60)}, {"state": "disabled"}])
def test_moved_away_or_disabled_under_the_finger_it_rests(stage, handle, change):
    hold(stage, 40)
    for name, value in change.items():
        setattr(handle, name, value)
    assert (handle.at, handle.finger) == (0.0, None)


def test_disabled_it_says_that_a_finger_came_in_vain(stage, handle):
    told = []
    handle.bind(on_in_vain=lambda *_: told.append(1))
    handle.state = "disabled"
    hold(stage, 40)
    hold(stage, 300)
    assert (handle.at, told) == (0.0, [1])
