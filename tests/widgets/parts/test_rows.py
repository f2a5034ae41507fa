from __future__ import annotations

import pytest
from kivy.uix.widget import Widget

from widgets.parts.rows import Roll

SLOW = 1.0
"""Of a frame, where much else goes on [s]."""


@pytest.fixture
def roll(stage):
    roll = Roll(size_hint=(None, None))
    roll.add_widget(Widget(size_hint_y=None, height=400))
    return stage.show(roll, size=(300, 200))


def top(roll):
    return roll.children[0].to_window(0, roll.children[0].top)[1]


@pytest.mark.parametrize("height", [380, 600])
def test_a_list_that_gets_more_room_stays_within_it_however_few_frames_there_are(stage, roll, height):
    roll.scroll_y = 0
    stage.frames(3)
    for each in (height, 300, height):
        roll.height = each
        stage.frames(12, SLOW)
        assert 0 <= roll.scroll_y <= 1
    bottom = roll.children[0].to_window(0, 0)[1]
    assert top(roll) == pytest.approx(roll.top) if height > 400 else bottom == pytest.approx(roll.y)


def test_a_finger_that_goes_on_beyond_the_end_finds_no_more(stage, roll):
    x, y = roll.center
    finger = stage.touch(x, y)
    finger.touch_down()
    for up in range(0, 700, 50):
        finger.touch_move(x, y + up)
        stage.frames()
        assert 0 <= roll.scroll_y <= 1
    finger.touch_up()
    stage.run_for(1.0)
    assert roll.scroll_y == 0


def test_its_bar_lies_beside_what_it_scrolls(roll):
    left_of_bar = roll.right - roll.bar_margin - roll.bar_width
    assert left_of_bar >= roll.children[0].right
