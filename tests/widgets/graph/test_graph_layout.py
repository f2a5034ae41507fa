"""A graph in layers: arrows run one way, boxes leave each other room, and a circle does no harm."""

from __future__ import annotations

import itertools
import random

import pytest

from widgets.graph.graph_layout import BOX_GAP, GraphLayout, lay_out

SIZE = (100.0, 30.0)


def laid(*edges: tuple[str, str], down: bool = False) -> GraphLayout:
    return lay_out({name: SIZE for edge in edges for name in edge}, edges, down=down)


def test_arrows_run_to_the_right_and_on_a_tall_glass_downwards() -> None:
    edges = [
        ("/driver", "/scan"),
        ("/scan", "/slam"),
        ("/slam", "/map"),
        ("/driver", "/odom"),
        ("/odom", "/slam"),
    ]
    right, down = laid(*edges).places, laid(*edges, down=True).places
    assert all(right[a][0] < right[b][0] for a, b in edges)
    assert all(down[a][1] > down[b][1] for a, b in edges)


def test_a_circle_is_laid_out_and_every_arrow_of_it_keeps_its_direction() -> None:
    edges = [("a", "b"), ("b", "c"), ("c", "a")]
    found = laid(*edges)
    assert set(found.ways) == set(edges)
    for (first, last), way in found.ways.items():
        assert (way[0], way[-1]) == (found.places[first], found.places[last])


def test_two_that_tell_each_other_have_an_arrow_each_way() -> None:
    found = laid(("a", "b"), ("b", "a"))
    assert found.ways["a", "b"] == found.ways["b", "a"][::-1]
    assert set(found.places) == {"a", "b"}


def test_an_arrow_over_several_layers_passes_between_the_boxes() -> None:
    found = laid(("a", "b"), ("b", "c"), ("c", "d"), ("a", "d"))
    assert len(found.ways["a", "d"]) == 4
    passed = found.ways["a", "d"][1:-1]
    for (x, y), name in zip(passed, ("b", "c"), strict=True):
        assert x == found.places[name][0]
        assert abs(y - found.places[name][1]) >= SIZE[1] / 2


@pytest.mark.parametrize("seed", range(5))
def test_no_box_of_a_large_graph_lies_on_another(seed: int) -> None:
    dice = random.Random(seed)
    nodes, topics = [f"/n{i}" for i in range(80)], [f"/t{i}" for i in range(300)]
    edges = [(dice.choice(nodes), topic) for topic in topics]
    edges += [(topic, dice.choice(nodes)) for topic in topics for _ in range(2)]
    sizes = {name: (60.0 + len(name), 30.0) for name in nodes + topics}
    found = lay_out(sizes, edges)
    assert set(found.places) == set(sizes)
    assert set(found.ways) == set(edges)
    columns: dict[float, list[float]] = {}
    for x, y in found.places.values():
        columns.setdefault(x, []).append(y)
    for ys in columns.values():
        ys.sort()
        assert all(high - low >= 30.0 + BOX_GAP - 1e-6 for low, high in itertools.pairwise(ys))


def test_the_same_graph_is_laid_out_alike_in_whatever_order_it_is_told() -> None:
    edges = [("a", "x"), ("x", "b"), ("b", "y"), ("y", "a"), ("c", "x")]
    assert laid(*edges).places == laid(*edges[::-1]).places


def test_what_has_no_arrow_and_arrows_to_nowhere_are_no_fault() -> None:
    found = lay_out({"a": SIZE, "b": SIZE}, [("a", "gone"), ("a", "a")])
    assert set(found.places) == {"a", "b"}
    assert found.ways == {}
    assert lay_out({}, []).places == {}
