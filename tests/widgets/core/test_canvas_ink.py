from __future__ import annotations

import gc
import math
import re
import weakref

import numpy as np
import pytest

from widgets.core import canvas_ink as ink
from widgets.core.base import text_texture
from widgets.core.canvas_ink import Drawing, Ink, Told, Word, Words, folded, tint
from widgets.core.shapes import FLOATS, Shapes
from widgets.core.theme import theme
from widgets.instruments import horizon
from widgets.sensors import video

SHADERS = {
    "ink vertex": ink.VERTEX,
    "ink": ink.FRAGMENT,
    "horizon": horizon.FRAGMENT,
    "video": video.FRAGMENT,
}


class Counted(Drawing):
    """Counts how often it is drawn."""

    drawn_from = ("age",)

    def __init__(self, **kwargs):
        self.count = 0
        super().__init__(**kwargs)

    def draw(self):
        self.count += 1


@pytest.fixture
def counted(stage):
    made = stage.show(Counted(), size=(50, 50))
    made.count = 0
    return made


def test_a_drawing_is_made_anew_once_a_frame_however_much_changes(counted, stage):
    counted.age = 1.0
    counted.age = 2.0
    counted.state = "stale"
    assert counted.count == 0
    stage.frames()
    assert counted.count == 1
    stage.frames(5)
    assert counted.count == 1


@pytest.mark.parametrize(
    ("name", "value"), [("pos", (5, 5)), ("size", (60, 60)), ("state", "alarm"), ("age", 3.0)]
)
def test_a_drawing_follows_what_it_depends_on(counted, stage, name, value):
    setattr(counted, name, value)
    stage.frames()
    assert counted.count == 1


def test_what_stays_unknown_is_no_reason_to_draw(counted, stage):
    counted.age = 3.0
    counted.age = math.nan
    stage.frames()
    counted.count = 0
    for _ in range(3):  # Kivy tells of each: NaN is not itself
        counted.age = math.nan
        stage.frames()
    assert counted.count == 0
    counted.age = 3.0
    stage.frames()
    counted.age = math.nan
    stage.frames()
    assert counted.count == 2, "that it became known, and that it no longer is"


def test_a_drawing_follows_the_theme(counted, stage):
    before = theme.name
    theme.name = "night"
    stage.frames()
    theme.name = before
    assert counted.count == 1


def test_a_widget_without_room_is_not_drawn(counted, stage):
    counted.size = 0, 50
    stage.frames()
    assert counted.count == 0


def test_words_are_written_on_instructions_that_are_kept():
    words = Words()
    words.write([Word("a", 10, 10, 20, (1, 1, 1, 1)), Word("b", 30, 10, 20, (1, 1, 1, 1))])
    kept = list(words.canvas.children)
    words.write([Word("c", 10, 10, 20, (1, 0, 0, 1))], strength=0.5)
    assert words.texts == ["c"]
    assert list(words.canvas.children) == kept
    (colour, first), (_, second) = words._slots
    assert colour.rgba == [1, 0, 0, 0.5]
    assert second.size == (0, 0)
    assert first.size == first.texture.size
    words.write([Word("a", 0, 0, 20, (1, 1, 1, 1)), Word("b", 0, 0, 20, (1, 1, 1, 1))])
    assert second.size == second.texture.size


@pytest.mark.parametrize(("anchor", "share"), [((0, 0), 0), ((0.5, 0.5), 0.5), ((1, 1), 1)])
def test_a_word_is_held_at_its_anchor(anchor, share):
    words = Words()
    words.write([Word("word", 100, 100, 20, (1, 1, 1, 1), anchor=anchor)])
    rectangle = words._slots[0][1]
    assert rectangle.pos[0] == pytest.approx(100 - share * rectangle.size[0], abs=0.5)
    assert rectangle.pos[1] == pytest.approx(100 - share * rectangle.size[1], abs=0.5)


@pytest.mark.parametrize("text", ["Its place on this map is not known yet", "它在这张地图上的位置尚不清楚"])
@pytest.mark.parametrize("up", [0.0, 0.5, 1.0])
def test_a_sentence_without_room_is_in_lines_about_its_anchor_and_loses_nothing(text, up):
    word = Word(text, 50, 40, 14, theme.text, anchor=(0.5, up))
    room = text_texture(text, 14).width / 2.5
    lines = folded(word, room)
    assert len(lines) >= 3
    assert (" " if " " in text else "").join(line.text for line in lines) == text
    assert all(text_texture(line.text, 14).width <= room for line in lines)
    high = text_texture(text, 14).height
    low = min(line.y - up * high for line in lines)
    assert low + up * len(lines) * high == pytest.approx(40), "all of them are held at the anchor"
    assert [line.y for line in lines] == sorted((line.y for line in lines), reverse=True)
    assert folded(word, 1000) == [word]


def test_words_that_are_moved_lie_where_new_ones_would():
    def words(x, y):
        return [
            Word("left", x, y, 20, (1, 1, 1, 1), anchor=(0, 0.5)),
            Word("middle", y, x, 14, (1, 0, 0, 1)),
        ]

    def places(of):
        return [tuple(rectangle.pos) for _, rectangle in of._slots]

    moved, fresh = Words(), Words()
    moved.write(words(10, 20))
    moved.move([(70.3, 41.8), (41.8, 70.3)])
    fresh.write(words(70.3, 41.8))
    assert places(moved) == places(fresh)
    moved.write(words(10, 20))  # and back: what is known of a place is where it was moved to
    fresh.write(words(10, 20))
    assert places(moved) == places(fresh)


def test_words_that_slide_lie_and_fade_as_new_ones_would():
    def words(x, strength):
        return [Word("a", x, 20, 16, (1, 0, 0, strength)), Word("b", x + 30, 20, 16, (1, 1, 1, 1 - strength))]

    def seen(of):
        return [(tuple(colour.rgba), tuple(box.pos)) for colour, box in of._slots]

    slid, fresh = Words(), Words()
    slid.write(words(10, 0.5))
    slid.slide([70.3, 100.3], 41.8, [0.25, 0.75])
    fresh.write([Word("a", 70.3, 41.8, 16, (1, 0, 0, 0.25)), Word("b", 100.3, 41.8, 16, (1, 1, 1, 0.75))])
    assert seen(slid) == seen(fresh)
    slid.write(words(10, 0.5))  # and back: what is known of a tone is what it slid to
    fresh.write(words(10, 0.5))
    assert seen(slid) == seen(fresh)


def test_a_uniform_is_told_what_is_new_to_it_and_nothing_else():
    class Counted(Told):
        told = 0

        def __setitem__(self, name, value):
            self.told += 1
            super().__setitem__(name, value)

    context, colour = Counted(None, "void main() { gl_FragColor = vec4(1.0); }"), [1, 0, 0, 1]
    context.tell("sky", colour)
    context.tell("sky", tuple(colour))
    assert context.told == 1
    colour[1] = 1  # the same list, changed in place as Kivy's are
    context.tell("sky", colour)
    assert (context.told, context["sky"]) == (2, (1.0, 1.0, 0.0, 1.0))


def test_a_sheet_lies_above_those_before_in_the_same_ink():
    drawn, shapes = Ink(), Shapes()
    shapes.disc(1, 1, 5, (1, 1, 1, 1))
    lower, upper = drawn.sheet(), drawn.sheet()
    upper.fill(shapes)
    assert drawn.indexof(lower) < drawn.indexof(upper)
    assert len(upper.vertices) == 4 * FLOATS
    upper.fill(Shapes())
    assert not np.asarray(upper.vertices).any()


def test_ink_can_be_wiped_away():
    drawn = Ink()
    shapes = Shapes()
    shapes.disc(1, 1, 5, (1, 1, 1, 1))
    drawn.fill(shapes)
    assert len(drawn._mesh.vertices) == 4 * FLOATS
    drawn.fill(Shapes())
    assert not np.asarray(drawn._mesh.vertices).any()


def test_a_tint_keeps_the_hue():
    assert tint((0.1, 0.2, 0.3, 1.0), 0.5) == (0.1, 0.2, 0.3, 0.5)


@pytest.mark.parametrize("name", SHADERS)
def test_shaders_have_no_whole_numbers_which_gles_would_refuse(name):
    text = "\n".join(line for line in SHADERS[name].splitlines() if not line.startswith("#"))
    assert re.findall(r"(?<![\w.])\d+(?![\w.])", text) == []


@pytest.mark.parametrize("name", ["ink", "horizon", "video"])
def test_shaders_say_their_precision_and_write_one_colour(name):
    assert "$HEADER$" in SHADERS[name] or "precision highp float;" in SHADERS[name]
    assert SHADERS[name].count("gl_FragColor =") == 1


def test_the_inks_vertices_are_as_long_as_the_shapes_make_them():
    assert sum(count for _, count, _ in ink.FORMAT) == FLOATS
    for name, _, _ in ink.FORMAT:
        assert name.decode() in ink.VERTEX


def test_a_widget_that_is_dropped_goes(stage):
    made = Counted()
    gone = weakref.ref(made)
    stage.frames(2)
    del made
    gc.collect()
    assert gone() is None


def test_shapes_are_as_see_through_as_their_widget(stage):
    class Inked(Drawing):
        def __init__(self, **kwargs):
            self.ink = Ink()
            super().__init__(**kwargs)
            self.canvas.add(self.ink)

        def draw(self):
            pass

    made = stage.show(Inked(opacity=0), size=(50, 50))
    stage.frames(2)
    assert made.ink["seen"] == 0
    made.opacity = 0.5
    assert made.ink["seen"] == 0.5
