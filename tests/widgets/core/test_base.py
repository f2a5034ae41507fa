from __future__ import annotations

import gc
import math
import weakref

import pytest
from kivy.metrics import sp
from kivy.uix.label import Label

from bridge.msgs.std_msgs import Float64
from widgets.core.base import (
    MAX_LABEL,
    MAX_LABEL_LINES,
    MAX_LETTERS,
    MAX_SHORTENED,
    STATES,
    Control,
    RobotWidget,
    age_text,
    text_texture,
)
from widgets.core.theme import theme
from widgets.core.visible import Tinted


def test_a_new_widget_was_never_heard_and_a_new_control_is_live():
    assert RobotWidget().state == "never"
    assert Control().state == "live"
    assert math.isnan(RobotWidget().age)


@pytest.mark.parametrize(
    ("age", "text"),
    [(math.nan, ""), (0.4, "< 1 s old"), (3.4, "3 s old"), (65.0, "1 min old"), (7300.0, "2 h old")],
)
def test_an_age_is_said_in_words(age, text):
    assert age_text(age) == text


def test_only_stale_data_says_how_old_it_is():
    widget = RobotWidget(age=3.0)
    said = {}
    for state in STATES:
        widget.state = state
        said[state] = widget.badge
    assert said == {"never": "", "live": "", "stale": "3 s old", "alarm": "", "disabled": ""}


def test_each_state_has_a_look_of_its_own():
    widget = RobotWidget(age=3.0)
    looks = set()
    for state in ("live", "stale", "alarm", "disabled"):
        widget.state = state
        looks.add((widget.veil[3], widget.badge, widget.alarmed))
    assert len(looks) == 4


def test_a_disabled_widget_takes_no_touch():
    widget = RobotWidget(state="disabled")
    assert widget.disabled
    widget.state = "live"
    assert not widget.disabled


def test_a_control_rests_when_it_is_disabled():
    rests = []

    class Lever(Control):
        def rest(self):
            rests.append(True)

    lever = Lever()
    lever.state = "disabled"
    assert rests
    rests.clear()
    lever.state = "live"
    assert not rests


def test_a_widget_refuses_a_message_that_it_does_not_know():
    with pytest.raises(TypeError, match="std_msgs/Float64"):
        RobotWidget().show(Float64(1.0))


def test_in_what_is_small_the_badge_lies_on_the_lower_edge_and_not_on_the_figures(stage):
    widget = stage.show(RobotWidget(state="stale", age=12.0), size=(200, 120))
    assert widget.badge_pos[1] + widget.badge_size[1] / 2 == widget.y


def test_in_what_is_big_the_badge_lies_within(stage):
    widget = stage.show(RobotWidget(state="stale", age=12.0), size=(200, 260))
    x, y = widget.badge_pos
    width, height = widget.badge_size
    assert x >= widget.x
    assert x + width <= widget.right
    assert y >= widget.y
    assert y + height <= widget.top


def test_the_same_text_is_drawn_once():
    assert text_texture("87 %", 20) is text_texture("87 %", 20)
    assert text_texture("87 %", 20) is not text_texture("88 %", 20)


def test_the_theme_keeps_no_widget_alive():
    widget = weakref.ref(RobotWidget())
    gc.collect()
    assert widget() is None


def test_an_age_that_comes_later_is_drawn_as_wide_as_it_is(stage):
    widget = RobotWidget(state="live")
    stage.show(widget, (200, 200))
    widget.age, widget.state = 12.0, "stale"
    stage.frames(2)
    texture = text_texture("12 s old", sp(12), theme.font)
    drawn = [one for one in widget.canvas.after.children if isinstance(one, Tinted) and one.drawn]
    assert tuple(texture.size) in [tuple(one.size) for one in drawn if one.texture is texture]


def test_what_is_live_has_nothing_over_it_and_an_alarm_or_an_age_has(stage):
    widget = stage.show(RobotWidget(state="live"), (200, 200))

    def over():
        return [part for part in widget.canvas.after.children if part.drawn]

    assert over() == []
    for state, count in (("stale", 4), ("alarm", 2), ("disabled", 1), ("live", 0)):
        widget.state, widget.age = state, 12.0
        stage.frames(2)
        assert len(over()) == count, state


def test_a_name_of_any_length_is_a_word_that_has_a_texture(stage):
    whole, longer = (text_texture("w" * count, 12) for count in (MAX_LETTERS + 1, 100_000))
    assert whole is longer, "both begin alike"
    assert longer.width < 16384, "what every graphics takes"


@pytest.mark.parametrize("shorten", [True, False])
@pytest.mark.parametrize("text", ["w" * 200_000, "word " * 40_000, "\n" * 200_000])
def test_a_label_draws_no_more_of_a_robots_word_than_fits_a_glass(stage, text, shorten):
    """Kivy's way of cutting a line short takes minutes for a text of such length."""
    label = Label(text=text, shorten=shorten, text_size=(300, None))
    label.texture_update()
    drawn = label._label._text
    assert len(drawn) <= (MAX_SHORTENED if shorten else MAX_LABEL) + 2
    assert drawn.count("\n") <= MAX_LABEL_LINES
    assert label.text == text, "what it says stays whole"


def test_a_label_of_usual_length_is_drawn_whole(stage):
    label = Label(text="Patrol-1 is ready.\nIt waits.", text_size=(300, None))
    label.texture_update()
    assert label._label._text == label.text
