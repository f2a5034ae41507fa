"""Layout of a directed graph in layers: arrows run one way, ties that would close a circle run back.

No Kivy in here. Lengths are the unit of the boxes' sizes. Layers follow each other along x, or along y downwards.
"""

from __future__ import annotations

import itertools
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["GraphLayout", "lay_out"]

SWEEPS = 6
"""How often the layers are put into a better order, there and back."""
SHIFTS = 8
"""How often boxes are drawn towards their neighbours."""
MAX_BENDS = 3000
"""Places by which arrows pass the layers between their ends; of more all arrows are straight."""
MAX_LAYERS = 12
"""A graph that takes more is laid out by the shortest ways, so that it does not become one long row."""
LAYER_GAP, BOX_GAP = 74.0, 14.0
"""Between two layers, and between two boxes of one."""
BEND_SIZE = 6.0
"""Room across that a passing arrow takes."""

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class GraphLayout:
    """Where everything lies, y upwards."""

    places: Mapping[str, Point]
    """Middle of each box."""
    ways: Mapping[tuple[str, str], tuple[Point, ...]]
    """Of each arrow: the middles of the box it leaves, of what it passes, and of the box it reaches."""
    down: bool
    """Layers follow each other downwards, not to the right."""


def lay_out(
    sizes: Mapping[str, Point], edges: Sequence[tuple[str, str]], *, down: bool = False
) -> GraphLayout:
    """Lay out boxes of these sizes, width and height, by name; edges of unknown names are left out."""
    names = sorted(sizes)
    known = sorted({edge for edge in edges if edge[0] != edge[1] and edge[0] in sizes and edge[1] in sizes})
    ahead = _turned(known, _ranks(names, known))
    layer = _layers(names, set(ahead))
    if max(layer.values(), default=0) >= MAX_LAYERS:
        layer = _distances(names, known)
        ahead = _turned(known, layer)
    chains, between = _chains(ahead, layer)
    rows: dict[int, list[str]] = defaultdict(list)
    for name in [*names, *between]:
        rows[layer[name] if name in layer else between[name]].append(name)
    order = [rows[number] for number in sorted(rows)]
    ties = [(a, b) for chain in chains.values() for a, b in itertools.pairwise(chain)]
    _sort(order, ties)
    across = {name: (sizes[name][0 if down else 1] if name in sizes else BEND_SIZE) for name in _all(order)}
    along = {name: (sizes[name][1 if down else 0] if name in sizes else 0.0) for name in _all(order)}
    places = _placed(order, ties, along, across, down=down)
    ways = {}
    for (first, last), chain in chains.items():
        way = tuple(places[name] for name in chain)
        ways[ahead[first, last]] = way if ahead[first, last] == (first, last) else way[::-1]
    for first, last in known:  # both ways between the same two
        if (first, last) not in ways:
            ways[first, last] = ways[last, first][::-1]
    return GraphLayout({name: places[name] for name in names}, ways, down)


def _all(order: Sequence[Sequence[str]]) -> list[str]:
    return [name for row in order for name in row]


def _ranks(names: Sequence[str], edges: Sequence[tuple[str, str]]) -> dict[str, int]:
    """An order in which few edges run back: what nothing leads to first, what leads nowhere last, else who tells most."""
    outward: dict[str, set[str]] = {name: set() for name in names}
    inward: dict[str, set[str]] = {name: set() for name in names}
    for first, last in edges:
        outward[first].add(last)
        inward[last].add(first)
    head: list[str] = []
    tail: list[str] = []
    left = dict.fromkeys(names)
    while left:
        found = next((name for name in left if not inward[name]), "")
        into = head
        if not found and (found := next((name for name in left if not outward[name]), "")):
            into = tail
        if not found:
            found = max(left, key=lambda name: len(outward[name]) - len(inward[name]))
        into.append(found)
        del left[found]
        for other in outward.pop(found):
            inward[other].discard(found)
        for other in inward.pop(found):
            outward[other].discard(found)
    return {name: number for number, name in enumerate([*head, *reversed(tail)])}


def _turned(
    edges: Sequence[tuple[str, str]], rank: Mapping[str, int]
) -> dict[tuple[str, str], tuple[str, str]]:
    """Edges that all run ahead by rank, each with the edge that it stands for: itself, or one that was turned round."""
    ahead: dict[tuple[str, str], tuple[str, str]] = {}
    for first, last in edges:
        key = (first, last) if rank[first] <= rank[last] else (last, first)
        if key not in ahead or key == (first, last):
            ahead[key] = (first, last)
    return ahead


def _distances(names: Sequence[str], edges: Sequence[tuple[str, str]]) -> dict[str, int]:
    """The shortest way to each from where it begins: few layers, between which more edges run back."""
    outward: dict[str, list[str]] = defaultdict(list)
    inward: dict[str, int] = defaultdict(int)
    for first, last in edges:
        outward[first].append(last)
        inward[last] += 1
    layer: dict[str, int] = {}
    for start in sorted(names, key=lambda name: (inward[name] > 0, -len(outward[name]), name)):
        if start in layer:
            continue
        layer[start] = 0
        found = [start]
        for name in found:  # grows on the way
            for other in outward[name]:
                if other not in layer:
                    layer[other] = layer[name] + 1
                    found.append(other)
    return layer


def _layers(names: Sequence[str], edges: set[tuple[str, str]]) -> dict[str, int]:
    """The longest way to each; what nothing leads to stands just before what it leads to."""
    inward: dict[str, list[str]] = defaultdict(list)
    outward: dict[str, list[str]] = defaultdict(list)
    for first, last in edges:
        inward[last].append(first)
        outward[first].append(last)
    left = {name: len(inward[name]) for name in names}
    ready = [name for name in names if not left[name]]
    layer = dict.fromkeys(names, 0)
    while ready:
        name = ready.pop()
        for other in outward[name]:
            layer[other] = max(layer[other], layer[name] + 1)
            left[other] -= 1
            if not left[other]:
                ready.append(other)
    for name in names:
        if not inward[name] and outward[name]:
            layer[name] = min(layer[other] for other in outward[name]) - 1
    return layer


def _chains(
    ahead: Mapping[tuple[str, str], tuple[str, str]], layer: Mapping[str, int]
) -> tuple[dict[tuple[str, str], list[str]], dict[str, int]]:
    """What each edge passes from layer to layer, and the layers of the places between the ends."""
    bends = sum(layer[last] - layer[first] - 1 for first, last in ahead)
    between: dict[str, int] = {}
    chains = {}
    for number, (first, last) in enumerate(ahead):
        passed = []
        if bends <= MAX_BENDS:
            for row in range(layer[first] + 1, layer[last]):
                name = f"\0{number}.{row}"  # no name of ROS begins so
                between[name] = row
                passed.append(name)
        chains[first, last] = [first, *passed, last]
    return chains, between


def _sort(order: list[list[str]], ties: Sequence[tuple[str, str]]) -> None:
    """Put each layer into the order of the middles of its neighbours, so that few arrows cross."""
    before: dict[str, list[str]] = defaultdict(list)
    after: dict[str, list[str]] = defaultdict(list)
    for first, last in ties:
        before[last].append(first)
        after[first].append(last)
    at = {name: float(place) for row in order for place, name in enumerate(row)}
    for sweep in range(SWEEPS):
        neighbours, rows = (before, order) if sweep % 2 == 0 else (after, order[::-1])
        for row in rows:
            middle = {
                name: sum(at[one] for one in near) / len(near) if (near := neighbours[name]) else at[name]
                for name in row
            }
            row.sort(key=lambda name, middle=middle: (middle[name], name))  # type: ignore[misc]
            for place, name in enumerate(row):
                at[name] = place - (len(row) - 1) / 2


def _placed(
    order: Sequence[Sequence[str]],
    ties: Sequence[tuple[str, str]],
    along: Mapping[str, float],
    across: Mapping[str, float],
    *,
    down: bool,
) -> dict[str, Point]:
    near: dict[str, list[str]] = defaultdict(list)
    for first, last in ties:
        near[first].append(last)
        near[last].append(first)
    at: dict[str, float] = {}
    for row in order:
        sizes = np.array([across[name] for name in row])
        at.update(zip(row, _apart(np.zeros(len(row)), sizes), strict=True))
    for shift in range(SHIFTS):
        for row in order if shift % 2 == 0 else reversed(order):
            wanted = [sum(at[one] for one in near[name]) / len(near[name]) if near[name] else at[name] for name in row]  # fmt: skip
            sizes = np.array([across[name] for name in row])
            at.update(zip(row, _apart(np.array(wanted), sizes), strict=True))
    places: dict[str, Point] = {}
    start = 0.0
    for row in order:
        deep = max((along[name] for name in row), default=0.0)
        for name in row:
            middle = start + deep / 2
            places[name] = (float(at[name]), -middle) if down else (middle, -float(at[name]))
        start += deep + LAYER_GAP
    return places


def _apart(wanted: NDArray[np.float64], sizes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Places in this order nearest to those that are wanted, with room for each: means of those that push each other."""
    if not len(wanted):
        return wanted
    room = np.concatenate([[0.0], np.cumsum((sizes[1:] + sizes[:-1]) / 2 + BOX_GAP)])
    blocks: list[tuple[float, int]] = []  # sum and number of those that stand shoulder to shoulder
    for one in wanted - room:
        total, count = float(one), 1
        while blocks and blocks[-1][0] / blocks[-1][1] > total / count:
            other, more = blocks.pop()
            total, count = total + other, count + more
        blocks.append((total, count))
    return np.asarray(np.concatenate([np.full(count, total / count) for total, count in blocks]) + room)
