"""The graph on the glass: it fits itself in so that it can be read, fingers move it, a tap looks at a box and fades the rest."""

from __future__ import annotations

from typing import Any

import pytest

from widgets.graph.graph_ink import drawn, label_of, size_of
from widgets.graph.graph_layout import lay_out
from widgets.graph.graph_model import GROUP, Box, Shown, shown
from widgets.graph.graph_view import CRISP_DELAY, LEGIBLE, GraphView

GRAPH = shown(
    ["/laser", "/slam", "/base"],
    {"/scan": ["/laser"], "/map": ["/slam"], "/odom": ["/base"]},
    {"/scan": ["/slam"], "/odom": ["/slam"]},
)


@pytest.fixture
def view(stage: Any) -> GraphView:
    made = stage.show(GraphView(), size=(900, 500))
    made.shown = GRAPH
    stage.frames(2)
    return made  # type: ignore[no-any-return]


def place(view: GraphView, name: str) -> tuple[float, float]:
    assert view._layout is not None
    return view.view.to_screen(*view._layout.places[name])


def test_every_box_is_in_sight_and_found_by_a_tap(stage: Any, view: GraphView) -> None:
    picked: list[str] = []
    view.bind(on_pick=lambda _, name: picked.append(name))
    for name in GRAPH.boxes:
        x, y = place(view, name)
        assert 0 < x < 900
        assert 0 < y < 500
        stage.tap(x, y)
    stage.tap(5, 5)
    assert picked == [*GRAPH.boxes, ""]


def test_on_an_upright_glass_it_runs_downwards(stage: Any, view: GraphView) -> None:
    assert place(view, "node /laser")[0] < place(view, "topic /scan")[0]
    view.size = 400, 800
    stage.frames(2)
    assert place(view, "node /laser")[1] > place(view, "topic /scan")[1]


def test_a_finger_moves_it_and_is_no_tap_and_a_new_graph_leaves_it_there(stage: Any, view: GraphView) -> None:
    picked: list[str] = []
    view.bind(on_pick=lambda _, name: picked.append(name))
    before = view.view
    stage.drag([(100, 100), (160, 130)])
    assert view.view.offset - before.offset == pytest.approx(60 + 30j)
    moved = view.view
    view.shown = shown(["/laser", "/slam"], {"/scan": ["/laser"]}, {"/scan": ["/slam"]})
    stage.frames(2)
    assert view.view == moved
    assert picked == []


def test_zoom_keeps_the_middle_and_the_words_are_written_anew_once_it_rests(
    stage: Any, view: GraphView
) -> None:
    middle, size = view.view.to_world(*view.center), view._drawn_scale
    view.zoom(1.5)
    assert view.view.to_world(*view.center) == pytest.approx(middle)
    assert view._drawn_scale == size, "while a finger zooms the drawing is only stretched"
    stage.run_for(CRISP_DELAY + 0.1)
    assert view._drawn_scale == view.view.scale
    for _ in range(30):
        view.zoom(0.5)
    assert view.view.scale > 0.05


def test_a_large_graph_begins_at_a_size_that_can_be_read(stage: Any) -> None:
    topics = {f"/t{number}": [f"/n{number % 80}"] for number in range(300)}
    view = stage.show(GraphView(), size=(412, 700))
    view.shown = shown([f"/n{number}" for number in range(80)], topics, {topic: ["/n0"] for topic in topics})
    stage.frames(2)
    assert view.view.scale >= LEGIBLE


def words_by_strength(lit: frozenset[str] | None, selected: str = "") -> dict[str, float]:
    sizes = {name: size_of(box) for name, box in GRAPH.boxes.items()}
    layout = lay_out(sizes, GRAPH.edges)
    return {word.text: word.colour[3] for word in drawn(GRAPH, layout, sizes, 1.0, lit, selected)[1]}


def test_what_is_beside_the_selected_box_stands_out_and_the_rest_is_faded(stage: Any) -> None:
    strength = words_by_strength(GRAPH.beside("topic /scan"), "topic /scan")
    assert {name for name, one in strength.items() if one == 1.0} == {"/laser", "/scan", "/slam"}
    assert all(0 < one < 0.5 for name, one in strength.items() if name in ("/base", "/odom", "/map"))
    assert set(words_by_strength(None).values()) == {1.0}


def test_a_selected_box_that_is_no_longer_there_fades_nothing(view: GraphView) -> None:
    view.selected = "topic /gone"
    assert view._lit() is None
    view.search = "scan"
    assert view._lit() == {"topic /scan"}
    view.selected = "node /slam"
    assert view._lit() == GRAPH.beside("node /slam")


def test_a_long_name_keeps_its_end_and_a_group_counts(stage: Any) -> None:
    assert label_of(Box("topic /a" + "/very_long" * 6 + "/end", "topic")).endswith("/end")
    assert label_of(Box("group /a", GROUP, ("/a", "/b", "/c"))) == "/a and 2 more"


def test_an_empty_graph_is_nothing_and_no_fault(stage: Any) -> None:
    view = stage.show(GraphView(), size=(300, 200))
    view.shown = Shown({}, ())
    stage.frames(2)
    view.fit()
    assert view.box_at(100, 100) == ""
