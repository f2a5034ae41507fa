"""How many pixels are shaded for what is seen: no more than one layer of a box each, and none for what is clear."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from kivy.graphics import Color, Rectangle
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from bench.support.overdraw import Overdraw
from tests.headless import Stage
from widgets.controls.stop.stop_button import StopButton
from widgets.core.canvas_ink import Ink
from widgets.core.rounded import RIM, Rounded
from widgets.core.shapes import Shapes
from widgets.parts.kit import Card, PrimaryButton

SIDE = 100


def shaded(stage: Stage, widget: Widget) -> dict[str, float]:
    """By the class of a widget of SIDE x SIDE pixels, how often each of them is shaded."""
    stage.show(widget, (SIDE, SIDE))
    stage.frames(2)
    return {name: count / SIDE**2 for name, count in Overdraw(stage.window).frame().items()}


class Painted(Widget):
    """A square of one colour, drawn a number of times."""

    def __init__(self, times: int, alpha: float = 1.0) -> None:
        super().__init__()
        with self.canvas:
            Color(1, 0, 0, alpha)
            for _ in range(times):
                Rectangle(size=(SIDE, SIDE))


@pytest.mark.parametrize("times", [1, 3])
@pytest.mark.parametrize("alpha", [0.0, 1.0])
def test_what_is_hidden_or_clear_is_counted_as_well(stage: Stage, times: int, alpha: float) -> None:
    assert shaded(stage, Painted(times, alpha)) == {"Painted": times}


def test_each_widget_is_counted_without_those_in_it_and_nothing_is_left_of_the_counting(stage: Stage) -> None:
    box = BoxLayout()
    box.add_widget(Painted(2))
    with box.canvas.after:
        Rectangle(size=(SIDE, SIDE / 2))
    before = len(box.canvas.before.children), len(box.canvas.after.children)
    for _ in range(2):
        assert shaded(stage, box) == {"BoxLayout": 0.5, "Painted": 2}
        assert (len(box.canvas.before.children), len(box.canvas.after.children)) == before
        stage.clear()


@pytest.mark.parametrize("alpha", [0.0, 0.3, 1.0])
def test_a_box_is_drawn_once_and_a_clear_one_not_at_all(stage: Stage, alpha: float) -> None:
    widget = Widget()
    widget.canvas.add(Rounded((1, 0, 0, alpha), (RIM, RIM), (SIDE - 2 * RIM, SIDE - 2 * RIM), [14]))
    assert shaded(stage, widget) == ({"Widget": 1.0} if alpha else {})


@pytest.mark.parametrize(
    ("build", "most"),
    [
        (lambda: Card(floating=True), 1.15),  # a card and the line round it
        (Card, 2.15),  # the colour of the border, and the ground on it
        (StopButton, 2.2),
        (lambda: PrimaryButton(text="Go"), 2.2),
    ],
    ids=["floating card", "card", "STOP", "button"],
)
def test_what_a_widget_costs(stage: Stage, build: Callable[[], Widget], most: float) -> None:
    """A picture that is clear where nothing is pressed, chosen or stale costs nothing."""
    widget = build()
    assert 0.9 < shaded(stage, widget)[type(widget).__name__] < most


@pytest.mark.parametrize("dashes", [0, 36])
def test_a_large_ring_looks_as_if_its_whole_square_were_shaded(stage: Stage, dashes: int) -> None:
    seen, cost = [], []
    for whole in (True, False):
        shapes, ink, widget = Shapes(), Ink(), Widget()
        if whole:
            period = 2 * np.pi * 40 / dashes if dashes else 0.0
            shapes._rounds(np.array([[50.3, 49.8]]), 40.0, 1.5, (1, 0, 0, 1), period)
        else:
            shapes.ring(50.3, 49.8, 40, 3, (1, 0, 0, 1), dashes=dashes)
        ink.fill(shapes)
        widget.canvas.add(ink)
        cost.append(shaded(stage, widget)["Widget"])
        seen.append(stage.pixels(widget).astype(int))
        stage.clear()
    assert np.abs(seen[0] - seen[1]).max() <= 2
    assert seen[0][..., 0].max() == 255
    assert cost[1] < 0.3 * cost[0]


def test_a_box_with_square_corners_is_as_bright_at_its_edges_as_in_its_middle(stage: Stage) -> None:
    widget = Widget()
    widget.canvas.add(Rounded((1, 1, 1, 1), (0, 0), (SIDE, SIDE), [0]))
    stage.show(widget, (SIDE, SIDE))
    assert (stage.pixels(widget) == 255).all()
