from __future__ import annotations

import math

import pytest

from tests.widgets.map.watched_map import near, pose
from widgets.core.geometry import View
from widgets.core.quantities import quantities
from widgets.core.shapes import Shapes
from widgets.map.map_measure import MAX_POINTS, bearing, leg_words, measure_marks, total_words


@pytest.fixture
def measuring(map_):
    map_.mode = "measure"
    return map_


def tap(stage, x, y):
    touch = stage.touch(x, y)
    touch.touch_down()
    stage.frames()
    touch.touch_up()
    stage.frames()


def test_taps_are_the_places_that_are_measured(measuring, stage):
    tap(stage, 200, 150)
    tap(stage, 230, 190)
    assert [near(*place) for place in measuring.measured] == [(0, 0), (3, 4)]
    assert measuring.log == []


@pytest.mark.parametrize("turn", [0.0, 1.0, -2.5])
def test_a_turned_map_measures_the_same(measuring, stage, turn):
    measuring.set_view(View.centred(0, 0, at=(200, 150), scale=10, turn=turn))
    for x, y in ((0, 0), (3, 4)):
        tap(stage, *measuring.view.to_screen(x, y))
    assert [near(*place) for place in measuring.measured] == [(0, 0), (3, 4)]


def test_a_place_that_was_tapped_can_be_dragged_and_no_other_is_added(measuring, stage):
    tap(stage, 200, 150)
    stage.drag([(200, 150), (240, 150), (250, 160)])
    assert [near(*place) for place in measuring.measured] == [(5, 1)]


def test_a_finger_that_drags_beside_them_moves_the_map(measuring, stage):
    tap(stage, 200, 150)
    stage.drag([(100, 50), (140, 60), (150, 60)])
    assert measuring.measured == [near(0, 0)]
    assert measuring.view.to_screen(0, 0) == near(250, 160)


def test_another_mode_forgets_what_was_measured(measuring, stage):
    tap(stage, 200, 150)
    measuring.mode = "view"
    assert measuring.measured == []


def test_after_the_last_place_measuring_begins_anew(measuring, stage):
    measuring.measured = [(float(n) * 100, 900.0) for n in range(MAX_POINTS)]
    tap(stage, 200, 150)
    assert len(measuring.measured) == 1


@pytest.mark.parametrize(
    ("end", "degrees"), [((0, 1), 0), ((1, 0), 90), ((0, -1), 180), ((-1, 0), 270), ((1, 1), 45)]
)
def test_a_bearing_is_clockwise_from_north(end, degrees):
    assert bearing((0, 0), end) == pytest.approx(degrees)


def test_words_are_in_the_operators_unit_and_a_bearing_has_three_figures(monkeypatch):
    assert leg_words((0, 0), (3, 4)) == "5.00\u00a0m · 037°"
    assert leg_words((0, 0), (-0.001, 10)) == "10.0\u00a0m · 000°"
    monkeypatch.setattr(quantities, "system", "imperial")
    assert leg_words((0, 0), (0, 30.48)) == "100\u00a0ft · 000°"


def test_the_sum_is_said_from_two_ways_on():
    assert total_words([]) == total_words([(0, 0)]) == ""
    assert total_words([(0, 0), (0, 2)]) == leg_words((0, 0), (0, 2))
    assert total_words([(0, 0), (0, 2), (3, 2)]) == "5.00\u00a0m in all"


def test_words_stand_in_the_middle_of_their_way_and_a_short_way_has_none():
    view = View.centred(0, 0, at=(0, 0), scale=10, turn=math.pi / 2)
    (word,) = measure_marks(Shapes(), view, [(0, 0), (20, 0), (21, 0)])
    assert (word.x, word.y) == near(0, 100)
    assert list(measure_marks(Shapes(), view, [])) == []


def test_a_map_that_measures_draws_it(measuring, stage):
    measuring.show(pose(0, 0))
    measuring.measured = [(-10.0, 0.0), (10.0, 0.0)]
    stage.frames(2)
    assert any("20.0" in text and "090°" in text for text in measuring._layers[1][1].texts)
