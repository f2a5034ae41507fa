from __future__ import annotations

import numpy as np
import pytest

from widgets.core.geometry import View
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map import map_marks as marks
from widgets.map.grid_map import GridMap


class Noted(Shapes):
    """Shapes that remember the lines and rings that were asked for."""

    def __init__(self):
        super().__init__()
        self.lines, self.rings = [], []

    def line(self, points, width, colour):
        self.lines.append(np.asarray(points).tolist())
        super().line(points, width, colour)

    def ring(self, x, y, radius, width, colour, *, dashes=0):
        self.rings.append((tuple(colour), dashes))
        super().ring(x, y, radius, width, colour, dashes=dashes)


@pytest.mark.parametrize("count", [0, 1, 2])
def test_a_trail_of_few_points_is_drawn(count):
    shapes = Noted()
    marks.trail_line(shapes, View(), np.zeros((count, 2)))
    assert [len(line) for line in shapes.lines] == [count, count]


def test_a_trail_is_broken_where_the_robot_jumped():
    shapes, view = Noted(), View.centred(0, 0, at=(0, 0), scale=10)
    trail = np.array([[0.0, 0.0], [0.9, 0.0], [5.0, 5.0], [5.0, 6.0]])
    marks.trail_line(shapes, view, trail)
    seen = view.many_to_screen(trail).tolist()
    assert shapes.lines == [seen[:2], seen[:2], seen[2:], seen[2:]]


def test_the_robot_being_placed_is_hollow_and_the_robot_keeps_its_colour(stage, monkeypatch):
    map_ = GridMap(state="live", robot=[0.0, 0.0, 0.0])
    stage.show(map_, (400, 300))
    map_.mode = "place_robot"
    map_.placed = [2.0, 1.0, 0.5]
    real, shapes = [], Noted()
    monkeypatch.setattr(marks, "robot_mark", lambda *_, **looks: real.append(looks["faded"]))
    list(map_._fill_robot(shapes))
    assert real == [False]
    assert all(colour[:3] == tuple(theme.plan[:3]) and dashes for colour, dashes in shapes.rings)
    assert len(shapes.rings) == 2


def test_a_name_of_a_place_that_would_lie_on_another_is_left_out_until_there_is_room():
    places = [(0.0, 0.0, "Charger", "dock"), (0.5, 0.0, "Reception", "reception")]

    def names(scale: float) -> set[str]:
        view = View.centred(0, 0, at=(0.0, 0.0), scale=scale)
        words = marks.place_marks(Shapes(), view, places, 12.0)
        return {word.text for word in words if word.text in ("Charger", "Reception")}

    assert names(20.0) == {"Charger"}
    assert names(400.0) == {"Charger", "Reception"}


def test_a_long_name_of_a_place_is_cut():
    view = View.centred(0, 0, at=(0.0, 0.0), scale=20.0)
    place = (0.0, 0.0, "The room behind the second door", "place")
    texts = {word.text for word in marks.place_marks(Shapes(), view, [place], 12.0)}
    assert "The room behind…" in texts


@pytest.mark.parametrize(("faded", "role"), [(False, "danger"), (True, "muted")])
def test_an_intruder_of_which_nobody_tells_any_more_is_grey(faded, role):
    shapes, colour = Noted(), tuple(theme.roles[role])
    (word,) = marks.intruder_marks(
        shapes, View(), [(0.0, 0.0, "Intruder 1")], 20, box=(0, 0, 400, 400), faded=faded
    )
    assert (tuple(word.colour), shapes.rings) == (colour, [(colour, 16)])
